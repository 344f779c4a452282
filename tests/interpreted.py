"""What the interpreter needs in place of machine code; imported before the integrators."""

import numpy as np

from springblock.solver import compilation, inverse_root, law_file, springs


def _guess(x):
    half = int(np.float64(x).view(np.int64)) >> 1
    return np.uint64(inverse_root._MAGIC - half).view(np.float64)


inverse_root._guess = _guess
compilation.add = lambda total, term: total + term
law_file.cfunc = lambda signature, **options: lambda function: function
springs.U, springs.ONE = int, 1  # indices wrap around
