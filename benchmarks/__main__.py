"""Measure in a process whose libraries use one thread."""

import os
import sys

#: Threads that wait for work cost CPU time too. Libraries read this when they are loaded.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}

if ONE_THREAD.items() <= os.environ.items():
    from benchmarks.speed import main

    main()
else:
    os.execve(sys.executable, sys.orig_argv, {**os.environ, **ONE_THREAD})
