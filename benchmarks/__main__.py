"""Measure the speed, in a process whose libraries use one thread."""

import os

# Threads that wait for work cost CPU time too. Libraries read this when they are loaded.
os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}

from benchmarks.speed import main

main()
