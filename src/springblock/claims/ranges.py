"""Ranges in which claims put a statistic, all of them open.

What the paper says in words means the same number in all statements.
"""

from springblock.claims.rule import Range

INF = float("inf")
POSITIVE, NEGATIVE = (0.0, INF), (-INF, 0.0)
NEARLY_ALL = (0.9, INF)  #: a rule without exception
MOST, FEWER_THAN_HALF = (0.5, INF), (-INF, 0.5)
NEGLIGIBLE, MORE_THAN_NEGLIGIBLE = (-INF, 0.1), (0.1, INF)
COMPARABLE = (0.5, 2.0)  #: a ratio
ALIKE = (-INF, 0.2)  #: fraction of the variance that place explains where the paper says uniform


def within(distance: float, centre: float = 0.0) -> Range:
    """Return the range that is so far from a value at most."""
    return centre - distance, centre + distance
