"""The continuum limit: a layer whose friction has a fracture energy."""

#: Parts of the table `continuum`, see `cases.SERIES`; named here, where nothing else is imported.
PARTS = ("across", "along", "square", "lattices", "healing", "disorder")
