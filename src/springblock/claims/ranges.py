"""Open ranges in which statements place a statistic, and the curves that define l_c.

A word of the paper stands for the same number in all statements.
"""

from springblock.claims.rule import Range

INF = float("inf")
POSITIVE, NEGATIVE = (0.0, INF), (-INF, 0.0)
NEARLY_ALL = (0.9, INF)  #: "all" and "none"
MOST, FEWER_THAN_HALF = (0.5, INF), (-INF, 0.5)
NEGLIGIBLE = (-INF, 0.1)
COMPARABLE = (0.5, 2.0)  #: a ratio
ALIKE = (-INF, 0.2)  #: uniform: share of the variance, or of a standard deviation
PLAIN, SCALED = "exp(-r/l_c)", "A exp(-r/l_c)"  #: curves fitted to c_x(r)


def within(distance: float, centre: float = 0.0) -> Range:
    """Return the range within a distance of a value."""
    return centre - distance, centre + distance
