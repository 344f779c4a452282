"""Slip precursors: what correlates the first detachments along an edge."""

#: Parts of the table `precursors`, see `cases.CELLS`; named here, where nothing else is imported.
PARTS = ("avalanches", "fronts")
