"""Why friction depends on the size of pillars, and when it has two load peaks."""

SIZES = (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)  #: n_p, with gaps n_s as wide
VARIANTS = (
    *("flat", "half", "double"),  # gaps as wide as half a pillar and as two
    *(f"thickness-{micrometres}" for micrometres in (5, 20, 40)),
    *(f"scatter-{of_mu_s}" for of_mu_s in ("0", "0.2", "0.3")),
)
PEAK_JOBS = 4  #: that share the surfaces with pawls and grooves
#: Parts of each table, computed one by one.
TABLES = {
    "mechanism": tuple(map(str, SIZES)),
    "mechanism_variants": VARIANTS,
    "mechanism_peaks": tuple(f"peaks-{job}" for job in range(PEAK_JOBS)),
    "mechanism_budget": ("budget",),
}
