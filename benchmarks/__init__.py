"""How fast the solver is, beside peers; `python -m benchmarks` measures it."""
