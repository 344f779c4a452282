"""Laws of friction from files (`springblock.model.law`), as the kernels call them.

All these laws are one type that calls its functions through pointers: for a new law only these are
compiled, in a second or two. T and V are as in `laws`; a state is an array of states and an index.
"""

import math
from functools import cache
from inspect import isfunction
from typing import Any, NamedTuple

import numpy as np
from numba import boolean, cfunc, float64, int64, njit
from numpy.typing import NDArray

from springblock.model.law import LawFile
from springblock.model.numbers import Array
from springblock.solver.compilation import kernel

#: Largest number of iterations for V, and the error at which they end, relative to `speed`.
_ITERATIONS, _TOLERANCE = 100, 1e-15
#: Speed, in l per step, that counts as zero.
_LEAST = 1e-100


class FromFile(NamedTuple):
    """Friction by a law from a file."""

    now: Array  #: (blocks, variables) state
    before: Array  #: (blocks, variables) state one step before
    at_release: Array  #: (blocks, variables) state of a block that detaches
    contact: NDArray[np.bool_]  #: (blocks,); without contact no friction
    constants: Array  #: in the order of the file
    load: float  #: F_n, as the velocity that it adds in one step
    speed: float  #: l/h, m/s
    step: float  #: h, s
    failed: Array  #: (2 + variables,) of the first failure: block, or -1; speed, m/s; state
    friction: Any  #: (constants, states, b, mu_static, mu_dynamic, speed) -> mu, -1 if it raises
    #: (constants, states, b, speed, step) -> whether it stored a finite state, that after a step
    update: Any

    @staticmethod
    def resistance(law, state, speed, slope, static, dynamic):
        """Return T at the largest solution V, which a decelerating block reaches first.

        If friction decreases with V, a fixed-point iteration from above finds it. If friction
        increases, the iteration overshoots, and V lies between the last two iterates.
        """
        if not law.contact[state[1]]:
            return dynamic
        mean, friction = speed, _friction(law, state, max(speed, 0.0), static, dynamic)
        for _ in range(_ITERATIONS if slope != 0.0 else 0):
            before, mean = mean, speed + slope * friction
            if abs(mean - before) <= _TOLERANCE * abs(speed):
                break
            if mean <= 0.0 and slope < 0.0:
                mean = 0.0
            fast, friction = friction, _friction(law, state, max(mean, 0.0), static, dynamic)
            if friction == fast:  # independent of speed
                break
            if slope < 0.0 and speed + slope * friction >= mean:
                low, high = (mean, friction), (before, fast)
                return _between(law, state, speed, slope, static, dynamic, low, high)
            if mean == 0.0:
                return np.inf
        return friction

    @staticmethod
    def end_weight(law, state, speed, static, dynamic):
        """Return the least weight for which steep friction causes no ringing."""
        if speed == 0.0 or not law.contact[state[1]]:
            return 0.5
        slow = _friction(law, state, speed, static, dynamic)
        fast = _friction(law, state, 2.0 * speed, static, dynamic)
        return max(0.5, 1.0 - speed / max(fast - slow, speed))

    @staticmethod
    def surely_holds(law, state, fx, fy, static, dynamic):
        return False  # the file is asked in each step, and may fail

    @staticmethod
    def threshold_of(law, state, static, dynamic):
        return max(static, _friction(law, state, 0.0, static, dynamic))

    @staticmethod
    def state_now(law, b):
        return law.now, np.int64(b)

    @staticmethod
    def state_before(law, b):
        return law.before, np.int64(b)

    @staticmethod
    def state_at_release(law, b):
        return law.at_release, np.int64(b)

    @staticmethod
    def store_state(law, b, state, moved, slides):
        if not law.contact[b]:
            return
        states, at = state if slides else (law.at_release, np.int64(b))
        for i in range(law.now.shape[1]):
            law.before[b, i] = law.now[b, i]
            law.now[b, i] = states[at, i]
        if slides:
            at, speed = np.int64(b), moved * law.speed
            if not law.update(law.constants, law.now, at, speed, law.step):
                _fail(law, (law.now, at), speed)


def from_file(
    law: LawFile, contact: NDArray[np.bool_], load: float, speed: float, step: float
) -> FromFile:
    """Return a law for blocks at rest; `contact`: (blocks,); other arguments as of `FromFile`.

    A law that numba cannot compile is refused with a ValueError that gives the reason.
    """
    initial = np.array(list(law.initial.values()))
    now, before, at_release = np.tile(initial, (3, len(contact), 1))
    constants, failed = np.array(list(law.constants.values())), np.full(2 + len(initial), -1.0)
    states = now, before, at_release, contact, constants
    return FromFile(*states, load, speed, step, failed, **_compiled(law))


_ARRAYS = float64[::1], float64[:, ::1], int64


@cache
def _compiled(law: LawFile) -> dict[str, Any]:
    """Compile `friction` and `update` of a law to C functions with the arguments of `FromFile`."""
    state = list(law.initial)
    place = {name: f"constants[{i}]" for i, name in enumerate(law.constants)}
    place |= {name: f"states[b, {i}]" for i, name in enumerate(state)}

    def call(name: str) -> str:
        given = ", ".join(place.get(each, each) for each in law.arguments(name))
        return f"{name}({given})"

    after = [f"after_{i}" for i in range(len(state))]
    # an exception would not leave a C function
    lines = [
        "def friction_at(constants, states, b, mu_static, mu_dynamic, speed):",
        "    try:",
        f"        return {call('friction')}",
        "    except Exception:",
        "        return -1.0",
        "def update_at(constants, states, b, speed, step):",
        "    try:",
        f"        {', '.join(after)} = {call('update')}" if state else "        pass",
        "    except Exception:",
        "        return False",
        *(f"    if not 0.0 * {each} == 0.0: return False" for each in after),  # infinite or NaN
        *(f"    states[b, {i}] = {each}" for i, each in enumerate(after)),
        "    return True",
    ]
    module = law.run()
    for name, part in module.items():
        if isfunction(part) and part.__globals__ is module:  # and not imported
            module[name] = njit(part, error_model="numpy", boundscheck=True)
    exec("\n".join(lines), module)
    friction = float64(*_ARRAYS, float64, float64, float64)
    update = boolean(*_ARRAYS, float64, float64)
    try:
        return {
            "friction": cfunc(friction, error_model="numpy")(module["friction_at"]),
            "update": cfunc(update, error_model="numpy")(module["update_at"]),
        }
    except Exception as error:  # NumbaError, and errors of numba's own
        lines = [line.strip() for line in [*str(error).splitlines(), repr(error)]]
        reason = next(line for line in lines if line and not line.startswith("Failed in"))
        raise ValueError(f"{law.file} cannot be compiled by numba: {reason}") from None


@kernel
def _fail(law, state, speed):
    """Record a failure, unless there was one before: others may follow from it."""
    states, b = state
    if law.failed[0] < 0.0:
        law.failed[0], law.failed[1] = b, speed
        for i in range(states.shape[1]):
            law.failed[2 + i] = states[b, i]


@kernel
def _friction(law, state, speed, static, dynamic):
    """Return T for a state, at a speed in l per step."""
    mu_static, mu_dynamic = static / law.load, dynamic / law.load
    states, b = state
    mu = law.friction(law.constants, states, b, mu_static, mu_dynamic, speed * law.speed)
    if not 0.0 <= mu < np.inf:
        _fail(law, state, speed * law.speed)
    return law.load * mu


@kernel
def _between(law, state, speed, slope, static, dynamic, low, high):
    """Return T at V = speed + slope T between two speeds, each given with its T.

    By false position (Illinois) in log V, since friction usually increases with the logarithm of
    the speed.
    """
    left, right = math.log(max(low[0], _LEAST)), math.log(high[0])
    below = low[0] - speed - slope * low[1]
    above, friction, moved = high[0] - speed - slope * high[1], high[1], 0.0
    for _ in range(_ITERATIONS):
        middle = right - above * (right - left) / (above - below)
        mean = math.exp(middle)
        friction = _friction(law, state, mean, static, dynamic)
        excess = mean - speed - slope * friction
        if abs(excess) <= _TOLERANCE * speed:
            break
        # Illinois: halve the residual of an end that is kept twice.
        if excess > 0.0:
            right, above, below = middle, excess, 0.5 * below if moved > 0.0 else below
        else:
            left, below, above = middle, excess, 0.5 * above if moved < 0.0 else above
        moved = excess
    return friction
