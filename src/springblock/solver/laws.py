"""Laws of friction: what opposes a block that slides.

A block lets go at F_c = max(mu_s, mu_d) F_n. From then on, until it comes to rest again, friction
takes mu F_n from it:

coulomb             mu = mu_d: Amontons-Coulomb, the paper's law.
slip_weakening      mu = mu_d + (mu_s - mu_d) max(1 - s/d_c, 0) after a slip s: linear weakening
                    (Ida 1972, doi:10.1029/JB077i020p03796; Andrews 1976,
                    doi:10.1029/JB081i032p05679). A block that comes to rest heals at once: its
                    next slip begins with s = 0.
velocity_weakening  mu = mu_d + (mu_s - mu_d)/(1 + v/v_c) at a speed v (Burridge & Knopoff 1967,
                    doi:10.1785/BSSA0570030341; in this form Carlson & Langer 1989,
                    doi:10.1103/PhysRevA.40.6470, whose mu_d is zero).

With mu_s <= mu_d there is nothing to weaken. Both weakening laws become Coulomb's, to the bit, as
d_c or v_c goes to zero. A law from a file (`springblock.model.law`) says what mu is, with as many
state variables per block as it declares.

A law is a type: the kernels are compiled for the one they are given, and Coulomb's, None, leaves
nothing behind in them. All laws from files are one type, which calls the functions of the file
through pointers: only these are compiled for a new law, in a second or two. In formulas here T
stands for mu F_n, as the velocity that it takes in one step, and V for the mean speed of that step.
"""

import math
from collections.abc import Callable
from functools import cache
from inspect import isfunction
from typing import Any, NamedTuple

import numpy as np
from numba import NumbaError, cfunc, float64, int64, njit, types, void
from numba.extending import overload
from numpy.typing import NDArray

from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.solver.compilation import kernel

Array = NDArray[np.float64]


class SlipWeakening(NamedTuple):
    """Friction that falls as a block slips."""

    slip: Array  #: of each block since it let go, in l; zero at rest
    rate: float  #: l/d_c


class VelocityWeakening(NamedTuple):
    """Friction that falls with speed."""

    scale: float  #: v_c, in l per step


class FromFile(NamedTuple):
    """Friction by a law from a file."""

    state: Array  #: (2 blocks + 1, variables): now, one step before, and of a block that lets go
    contact: NDArray[np.bool_]  #: (2 blocks + 1,), by the same rows; others feel no friction
    constants: Array  #: in the order of the file
    load: float  #: F_n, as the velocity that it adds in one step
    speed: float  #: l/h, m/s
    step: float  #: h, s
    failed: NDArray[np.int64]  #: (1,) block whose mu was no friction coefficient, or -1
    friction: Any  #: (constants, state, row, mu_static, mu_dynamic, speed) -> mu
    update: Any  #: (constants, state, row, speed, step): the state in a row, after a step


Law = SlipWeakening | VelocityWeakening | FromFile | None

#: Beyond these, in the kernels' units, d_c and v_c are no different from zero or infinity.
_LEAST, _MOST = 1e-100, 1e100
#: Iterations that find V, if it is to be found, and the share of `speed` by which V may be off.
_ITERATIONS, _SAME = 100, 1e-15
#: Slip before a step counts as zero below this share of the slip within it.
_NOTHING = 1e-12


def law_of(
    material: Material,
    step: float,
    load: float,
    contact: NDArray[np.bool_],
    field: Callable[[], Array],
) -> Law:
    """Law of a material in the kernels' units.

    `load` is F_n of a block and `contact` flat, as is what `field` makes: an array of all blocks.
    """
    law = material.law
    if isinstance(law, LawFile):
        initial = np.array(list(law.initial.values()))
        return FromFile(
            state=np.tile(initial, (2 * len(contact) + 1, 1)),
            contact=np.concatenate([contact, contact, [True]]),
            constants=np.array(list(law.constants.values())),
            load=load,
            speed=material.spacing / step,
            step=step,
            failed=np.full(1, -1),
            **_compiled(law),
        )
    if law == "slip_weakening":
        return SlipWeakening(field(), 1.0 / _bounded(material.slip_distance / material.spacing))
    if law == "velocity_weakening":
        return VelocityWeakening(_bounded(material.speed_scale * step / material.spacing))
    return None


_ARRAYS = float64[::1], float64[:, ::1], int64


@cache
def _compiled(law: LawFile) -> dict[str, Any]:
    """Functions of a law as C functions, which find their arguments by name.

    Raises
    ------
    ValueError
        Where numba does not compile them, with its reason.
    """
    state = list(law.initial)
    place = {name: f"constants[{i}]" for i, name in enumerate(law.constants)}
    place |= {name: f"state[row, {i}]" for i, name in enumerate(state)}

    def call(name: str) -> str:
        given = ", ".join(place.get(each, each) for each in law.arguments(name))
        return f"{name}({given})"

    after = ", ".join(f"state[row, {i}]" for i in range(len(state)))
    lines = [
        "def friction_at(constants, state, row, mu_static, mu_dynamic, speed):",
        f"    return {call('friction')}",
        "def update_at(constants, state, row, speed, step):",
        f"    {after} = {call('update')}" if state else "    pass",
    ]
    module = law.run()
    for name, part in module.items():
        if isfunction(part) and part.__globals__ is module:  # and not imported
            module[name] = njit(part, error_model="numpy")
    exec("\n".join(lines), module)
    friction = float64(*_ARRAYS, float64, float64, float64)
    update = void(*_ARRAYS, float64, float64)
    try:
        return {
            "friction": cfunc(friction, error_model="numpy")(module["friction_at"]),
            "update": cfunc(update, error_model="numpy")(module["update_at"]),
        }
    except NumbaError as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"{law.file} cannot be compiled by numba: {reason[:200]}") from None


def strengths(law: Law, static: Array, dynamic: Array) -> Array:
    """`strength` of several blocks."""
    if isinstance(law, FromFile):
        return np.array([strength(law, *each) for each in zip(static, dynamic, strict=True)])
    return np.maximum(static, dynamic)


def _bounded(scale: float) -> float:
    return min(max(scale, _LEAST), _MOST)


def _for_each_law(coulomb, slip_weakening, velocity_weakening, from_file):
    """Return the function that calls the one of the law that it is given, compiled or not.

    Compiled callers have it chosen by type, and LLVM inlines it; numba, told to do so by itself,
    loses the store in `_keep_slip`.
    """
    functions = {
        type(None): coulomb,
        SlipWeakening: slip_weakening,
        VelocityWeakening: velocity_weakening,
        FromFile: from_file,
    }

    def chosen(law, *arguments):
        return functions[type(law)](law, *arguments)

    @overload(chosen, strict=False)
    def compiled(law, *arguments):
        return functions[type(None) if law is types.none else law.instance_class]

    return chosen


def _resistance_dynamic(law, slip, speed, share, static, dynamic):
    return dynamic


def _resistance_after_slip(law, slip, speed, share, static, dynamic):
    """From rest, a block that runs through d_c within the step weakens at once."""
    mean = speed + share * dynamic
    left = max(1.0 - slip * law.rate, 0.0)
    at_once = (slip <= _NOTHING * mean) & (0.5 * mean * law.rate >= 1.0)
    return dynamic + max(static - dynamic, 0.0) * (0.0 if at_once else left)


def _resistance_at_speed(law, slip, speed, share, static, dynamic):
    """Of two V, the larger: the one that a block comes from as it slows down."""
    drop, c, fastest = max(static - dynamic, 0.0), law.scale, speed + share * dynamic
    under_root = (fastest + c) * (fastest + c) + 4.0 * share * drop * c
    mean = 0.5 * (fastest - c + math.sqrt(max(under_root, 0.0)))
    return dynamic + drop * c / (c + max(mean, 0.0)) if under_root >= 0.0 else np.inf


@kernel
def _friction_from_file(law, row, speed, static, dynamic):
    """T of a block with the state of a row, at a speed in l per step."""
    mu_static, mu_dynamic = static / law.load, dynamic / law.load
    at = np.int64(row)
    mu = law.friction(law.constants, law.state, at, mu_static, mu_dynamic, speed * law.speed)
    if not 0.0 <= mu < np.inf:
        law.failed[0] = row
    return law.load * mu


def _resistance_from_file(law, row, speed, share, static, dynamic):
    """Of several V the largest, which a block comes from as it slows down.

    Where friction falls with V, a fixed-point iteration from above finds it; where it rises, that
    oversteps V, which then lies between the last two.
    """
    if not law.contact[row]:
        return dynamic
    mean, friction = speed, _friction_from_file(law, row, max(speed, 0.0), static, dynamic)
    for _ in range(_ITERATIONS if share != 0.0 else 0):
        before, mean = mean, speed + share * friction
        if abs(mean - before) <= _SAME * abs(speed):
            break
        if mean <= 0.0 and share < 0.0:
            mean = 0.0
        friction = _friction_from_file(law, row, max(mean, 0.0), static, dynamic)
        if share < 0.0 and speed + share * friction >= mean:
            return _between(law, row, speed, share, static, dynamic, mean, before)
        if mean == 0.0:
            return np.inf
    return friction


@kernel
def _between(law, row, speed, share, static, dynamic, low, high):
    """T where V = speed + share T lies between two speeds: false position (Illinois) in log V.

    Friction that rises with speed usually does so with the logarithm of it.
    """
    left, right = math.log(max(low, _LEAST)), math.log(high)
    friction = _friction_from_file(law, row, math.exp(left), static, dynamic)
    below = math.exp(left) - speed - share * friction
    friction = _friction_from_file(law, row, high, static, dynamic)
    above, moved = high - speed - share * friction, 0.0
    for _ in range(_ITERATIONS):
        if above <= below:
            break
        middle = right - above * (right - left) / (above - below)
        mean = math.exp(middle)
        friction = _friction_from_file(law, row, mean, static, dynamic)
        excess = mean - speed - share * friction
        if abs(excess) <= _SAME * speed:
            break
        # The end that stays twice counts half.
        if excess > 0.0:
            right, above, below = middle, excess, 0.5 * below if moved > 0.0 else below
        else:
            left, below, above = middle, excess, 0.5 * above if moved < 0.0 else above
        moved = excess
    return friction


def _half(law, row, speed, static, dynamic):
    return 0.5


def _end_of_step(law, row, speed, static, dynamic):
    """Return the least share without ringing: a block creeps where friction rises steeply."""
    if speed == 0.0 or not law.contact[row]:
        return 0.5
    slow = _friction_from_file(law, row, speed, static, dynamic)
    fast = _friction_from_file(law, row, 2.0 * speed, static, dynamic)
    return max(0.5, 1.0 - speed / max(fast - slow, speed))


def _stronger(law, static, dynamic):
    return max(static, dynamic)


def _strength_from_file(law, static, dynamic):
    return max(static, _friction_from_file(law, len(law.state) - 1, 0.0, static, dynamic))


def _nothing(law):
    return 0.0


def _of_rest(law):
    return len(law.state) - 1


def _no_slip(law, b):
    return 0.0


def _slip_so_far(law, b):
    return law.slip[b]


def _own_row(law, b):
    return b


def _none_before(law, state, moved):
    return 0.0


def _slip_before(law, state, moved):
    return max(state - moved, 0.0)


def _row_before(law, state, moved):
    return state + len(law.state) // 2


def _keep_none(law, b, state, moved, slides):
    pass


def _keep_slip(law, b, state, moved, slides):
    law.slip[b] = state + moved if slides else 0.0


def _keep_row(law, b, state, moved, slides):
    if not law.contact[b]:
        return
    for i in range(law.state.shape[1]):
        law.state[b + len(law.state) // 2, i] = law.state[b, i]
        law.state[b, i] = law.state[np.int64(state) if slides else -1, i]
    if slides:
        law.update(law.constants, law.state, np.int64(b), moved * law.speed, law.step)


#: (law, state, speed, share, static, dynamic) -> T at the mean speed V = speed + share T. In a step
#: of the leapfrog, `speed` is half of |v + w|, of which friction takes half of T: share is -1/2.
#: Where V is known, share is 0. T is infinite where no V will do: the block stops.
resistance = _for_each_law(
    _resistance_dynamic, _resistance_after_slip, _resistance_at_speed, _resistance_from_file
)
#: (law, state, speed, static, dynamic) -> share of the velocity after a step in the one at which
#: friction acts: 1/2, but more where friction rises steeply with speed.
share_of_end = _for_each_law(_half, _half, _half, _end_of_step)
#: (law, static, dynamic) -> T that the force on a block at rest must exceed.
strength = _for_each_law(_stronger, _stronger, _stronger, _strength_from_file)
#: (law) -> state of a block that lets go: its slip, or the row where its state is.
fresh = _for_each_law(_nothing, _nothing, _nothing, _of_rest)
#: (law, b) -> state of block b.
state_of = _for_each_law(_no_slip, _slip_so_far, _no_slip, _own_row)
#: (law, state, moved) -> state before the last step, as far as it is known.
state_before = _for_each_law(_none_before, _slip_before, _none_before, _row_before)
#: (law, b, state, moved, slides): store the state of block b after a step that began with `state`.
keep = _for_each_law(_keep_none, _keep_slip, _keep_none, _keep_row)
