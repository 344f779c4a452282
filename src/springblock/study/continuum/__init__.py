"""The continuum limit: a layer whose friction has a fracture energy."""
