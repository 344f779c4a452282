"""How fast the solver and the study are, beside peers; `python -m benchmarks` measures it."""
