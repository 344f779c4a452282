"""Default integrator and times of a run, in a module that is quick to import."""

#: Names of the integrators, which `springblock.solver.integrators` describes.
INTEGRATORS = ("leapfrog", "rk4")
INTEGRATOR = "leapfrog"
#: Integration step, s, chosen from results/tables/production.parquet.
STEP = 2e-8
#: Time between two samples of the force, s.
SAMPLE_INTERVAL = 2e-7
PAPER_STEP = 1e-8  #: s
