"""1/√x by multiplications alone, which are pipelined, unlike roots and divisions.

The bits of a floating-point number, read as an integer, approximate its logarithm: a constant minus
half of them gives 1/√x to 3.5 % (Lomont, Fast inverse square root, 2003). With h = 1 - x y² for an
estimate y, 1/√x = y (1 - h)^(-1/2); a cubic in h reduces the error to 1e-6, and a second step to
1e-16.
"""

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic
from numpy.polynomial import chebyshev

#: Constant from which half of the bits are subtracted, and the largest |h| of that estimate.
_MAGIC = 0x5FE6EB50C7B537A9
_FIRST_H = 0.0692


def _factor(h):
    """Return (1 - h)^(-1/2)."""
    return 1.0 / np.sqrt(1.0 - h)


def _cubic() -> tuple[float, ...]:
    """Coefficients of the cubic for `_factor` on |h| ≤ `_FIRST_H`, lowest order first."""
    unit = chebyshev.chebinterpolate(lambda x: _factor(_FIRST_H * x), 3)
    return tuple((chebyshev.cheb2poly(unit) / _FIRST_H ** np.arange(4)).tolist())


_C0, _C1, _C2, _C3 = _cubic()
_LARGEST = float(np.finfo(float).max)


@intrinsic
def _guess(typingctx, x):
    """Return 1/√x to 3.5 %."""

    def generate(context, builder, signature, arguments):
        integer = ir.IntType(64)
        bits = builder.bitcast(arguments[0], integer)
        half = builder.lshr(bits, integer(1))
        return builder.bitcast(builder.sub(integer(_MAGIC), half), ir.DoubleType())

    return types.float64(types.float64), generate


@njit(inline="always")
def inverse_root(x):
    """Return 1/√x within 1.5 units in the last place, for normal numbers x.

    Zero and subnormal numbers give a large finite number below 1/√x; infinity gives 1/√x of the
    largest number.
    """
    x = _LARGEST if x > _LARGEST else x
    y = _guess(x)
    h = 1.0 - (x * y) * y
    y *= _C0 + h * (_C1 + h * (_C2 + h * _C3))
    h = 1.0 - (x * y) * y
    return y + (y * h) * (0.5 + 0.375 * h)
