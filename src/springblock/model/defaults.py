"""What a run is computed with unless it is told otherwise; nothing that is slow to import."""

INTEGRATOR = "leapfrog"
#: Integration step, s; results/tables/work_precision.parquet says why.
STEP = 2e-8
#: Time between two entries of the force curve, s.
SAMPLE_INTERVAL = 2e-7
