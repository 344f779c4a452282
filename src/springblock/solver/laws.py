"""Laws of friction of a sliding block.

A block detaches at F_c = max(mu_s, mu_d) F_n. While it slides, friction opposes it with mu F_n:

coulomb             mu = mu_d: Amontons-Coulomb, the paper's law.
slip_weakening      mu = mu_d + (mu_s - mu_d) max(1 - s/d_c, 0) after a slip s: linear weakening
                    (Ida 1972, doi:10.1029/JB077i020p03796; Andrews 1976,
                    doi:10.1029/JB081i032p05679). A block that comes to rest heals instantly: its
                    next slip begins with s = 0. Without healing, s is the slip since the start of
                    the run, and mu F_n is also the threshold of a block at rest.
velocity_weakening  mu = mu_d + (mu_s - mu_d)/(1 + v/v_c) at a speed v (Burridge & Knopoff 1967,
                    doi:10.1785/BSSA0570030341; in this form Carlson & Langer 1989,
                    doi:10.1103/PhysRevA.40.6470, whose mu_d is zero).

With mu_s <= mu_d friction does not weaken. Both weakening laws become Coulomb's in the limit of d_c
or v_c to zero, with the leapfrog to the bit. For laws from files see `law_file`.

A law is a type, for which the kernels are compiled; Coulomb's is None and adds no operation to
them. T is the velocity that mu F_n removes in one step, and V the mean speed of that step.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numba.extending import overload
from numpy.typing import NDArray

from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.solver import law_file
from springblock.solver.law_file import FromFile, from_file


class SlipWeakening(NamedTuple):
    """Friction that decreases with slip."""

    slip: Array  #: of each block since its release, in l; zero at rest
    rate: float  #: l/d_c


class LastingWeakening(NamedTuple):
    """Slip weakening without healing."""

    slip: Array  #: of each block since the start, in l
    rate: float  #: l/d_c


class VelocityWeakening(NamedTuple):
    """Friction that decreases with speed."""

    scale: float  #: v_c, in l per step


Law = SlipWeakening | LastingWeakening | VelocityWeakening | FromFile | None

#: Values, in the kernels' units, beyond which d_c and v_c act as zero or infinity.
_LEAST, _MOST = 1e-100, 1e100
#: Slip before a step that counts as zero, relative to the slip within the step.
_NO_SLIP = 1e-12


def law_of(
    material: Material,
    step: float,
    load: float,
    contact: NDArray[np.bool_],
    field: Callable[[], Array],
) -> Law:
    """Return the law of a material in the kernels' units.

    `load` is F_n of a block; `contact` is one-dimensional, and `field` returns one value per block.
    """
    law = material.law
    if isinstance(law, LawFile):
        return from_file(law, contact, load, material.spacing / step, step)
    if law == "slip_weakening":
        distance = np.clip(material.slip_distance / material.spacing, _LEAST, _MOST)
        weakening = LastingWeakening if material.healing == "none" else SlipWeakening
        return weakening(field(), 1.0 / float(distance))
    if law == "velocity_weakening":
        scale = np.clip(material.speed_scale * step / material.spacing, _LEAST, _MOST)
        return VelocityWeakening(float(scale))
    return None


def _of_each_law(functions: Mapping[type, Callable[..., Any]], usual: Callable[..., Any]) -> Any:
    """Return the function that calls one of `functions`, by the type of its first argument.

    A law that is not among them has the function `usual`. Compiled callers choose when they are
    compiled, and LLVM inlines the function; if numba inlined it instead, the assignment in
    `_store_slip` would be lost.
    """

    def chosen(law, *arguments):
        return functions.get(type(law), usual)(law, *arguments)

    @overload(chosen, strict=False)
    def compiled(law, *arguments):
        return functions.get(getattr(law, "instance_class", type(None)), usual)

    return chosen


def _after_slip(law, slip, speed, share, static, dynamic):
    """Return T after a slip; it drops to mu_d at once if V h >= 2 d_c in a step from rest."""
    mean = speed + share * dynamic
    left = max(1.0 - slip * law.rate, 0.0)
    at_once = (slip <= _NO_SLIP * mean) & (0.5 * mean * law.rate >= 1.0)
    return dynamic + max(static - dynamic, 0.0) * (0.0 if at_once else left)


def _strength(law, slip, static, dynamic):
    return dynamic + max(static - dynamic, 0.0) * max(1.0 - slip * law.rate, 0.0)


def _at_speed(law, slip, speed, share, static, dynamic):
    """Return T at the larger of the two solutions V, which a decelerating block reaches first."""
    drop, c, fastest = max(static - dynamic, 0.0), law.scale, speed + share * dynamic
    under_root = (fastest + c) * (fastest + c) + 4.0 * share * drop * c
    mean = 0.5 * (fastest - c + math.sqrt(max(under_root, 0.0)))
    return dynamic + drop * c / (c + max(mean, 0.0)) if under_root >= 0.0 else np.inf


def _store_slip(law, b, state, moved, slides):
    law.slip[b] = state + moved if slides else 0.0


def _add_slip(law, b, state, moved, slides):
    law.slip[b] = state + moved


def _slip_before(law, slip, moved):
    return max(slip - moved, 0.0)


#: (law, state, speed, share, static, dynamic) -> T at the mean speed V = speed + share T, where
#: `speed` is that without friction: share is -β in the leapfrog, see `friction`. If V is known,
#: share is 0. T is infinite if no V solves the equation: the block stops.
resistance = _of_each_law(
    {
        SlipWeakening: _after_slip,
        LastingWeakening: _after_slip,
        VelocityWeakening: _at_speed,
        FromFile: law_file.resistance,
    },
    lambda law, state, speed, share, static, dynamic: dynamic,
)
#: (law, state, speed, static, dynamic) -> weight β: friction is evaluated at (1 - β) v + β v⁺, with
#: v and v⁺ before and after the step. β is 1/2, or more where friction rises steeply with speed.
end_weight = _of_each_law(
    {FromFile: law_file.end_weight}, lambda law, state, speed, static, dynamic: 0.5
)
#: (law, state, static, dynamic) -> largest force on a block at rest, or that reverses, which holds
#: it: mu_s F_n, unless it has lost strength.
strength_of = _of_each_law(
    {LastingWeakening: _strength}, lambda law, state, static, dynamic: static
)
#: (law, state, static, dynamic) -> threshold of the force on a block at rest, F_c.
threshold_of = _of_each_law(
    {LastingWeakening: _strength, FromFile: law_file.threshold_of},
    lambda law, state, static, dynamic: max(static, dynamic),
)
#: (law, state, moved) -> state at its release of a block that has since slipped by `moved`: its
#: slip, or the row of its state.
state_at_release = _of_each_law(
    {LastingWeakening: _slip_before, FromFile: law_file.state_at_release},
    lambda law, state, moved: 0.0,
)
#: (law, b) -> state of block b.
state_of = _of_each_law(
    {
        SlipWeakening: lambda law, b: law.slip[b],
        LastingWeakening: lambda law, b: law.slip[b],
        FromFile: law_file.state_of,
    },
    lambda law, b: 0.0,
)
#: (law, state, moved) -> state before the last step, in which the block slipped by `moved`.
state_before = _of_each_law(
    {
        SlipWeakening: _slip_before,
        LastingWeakening: _slip_before,
        FromFile: law_file.state_before,
    },
    lambda law, state, moved: 0.0,
)
#: (law, b, state, moved, slides): store the state of block b after a step from `state`.
store_state = _of_each_law(
    {
        SlipWeakening: _store_slip,
        LastingWeakening: _add_slip,
        FromFile: law_file.store_state,
    },
    lambda law, b, state, moved, slides: None,
)
