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

A law is a class, for which the kernels are compiled; its static methods are called by the functions
at the end of this module. What it does not define it has from `Coulomb`, for which kernels take
None, so that it adds no operation to them.

The functions take the state of a block, which is its slip, in l, the place of its variables in an
array for a law from a file, and None without a memory. T is the velocity that mu F_n removes in one
step, and V the mean speed of that step.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.solver.compilation import method
from springblock.solver.law_file import FromFile, from_file
from springblock.solver.springs import aligned

#: Values, in the kernels' units, beyond which d_c and v_c act as zero or infinity.
_LEAST, _MOST = 1e-100, 1e100
#: Relative margin, against rounding, of the strength of blocks that are known to stay at rest.
MARGIN = 1e-9
#: Slip before a step that counts as zero, relative to the slip within the step.
_NO_SLIP = 1e-12


class Coulomb:
    """Friction mu_d F_n, without a state; for the meaning of the functions see below."""

    @staticmethod
    def resistance(law, state, speed, slope, static, dynamic):
        return dynamic

    @staticmethod
    def end_weight(law, state, speed, static, dynamic):
        return 0.5

    @staticmethod
    def strength_of(law, state, static, dynamic):
        return static

    @staticmethod
    def surely_holds(law, state, fx, fy, static, dynamic):
        strength = (1.0 - MARGIN) * strength_of(law, state, static, dynamic)
        return fx * fx + fy * fy <= strength * strength

    @staticmethod
    def threshold_of(law, state, static, dynamic):
        return max(static, dynamic)

    @staticmethod
    def state_now(law, b):
        return None

    state_before = state_at_release = state_now

    @staticmethod
    def state_in_stage(law, b, moved):
        return None

    @staticmethod
    def store_state(law, b, state, moved, slides):
        pass


class SlipWeakening(NamedTuple):
    """Friction that decreases with slip; a block that comes to rest heals."""

    slip: Array  #: (blocks,) since the release, in l; zero at rest
    before: Array  #: (blocks,) slip one step before
    rate: float  #: l/d_c

    @classmethod
    def of(cls, blocks: int, distance: float) -> "SlipWeakening":
        """Return the law for this many blocks; `distance` is d_c in l."""
        rate = 1.0 / float(np.clip(distance, _LEAST, _MOST))
        return cls(aligned(blocks), aligned(blocks), rate)

    @staticmethod
    def resistance(law, slip, speed, slope, static, dynamic):
        """Return T after a slip; it drops to mu_d at once if V h >= 2 d_c in a step from rest."""
        mean, left = speed + slope * dynamic, max(1.0 - slip * law.rate, 0.0)
        at_once = (slip <= _NO_SLIP * mean) & (0.5 * mean * law.rate >= 1.0)
        return dynamic + max(static - dynamic, 0.0) * (0.0 if at_once else left)

    @staticmethod
    def state_now(law, b):
        return law.slip[b]

    @staticmethod
    def state_before(law, b):
        return law.before[b]

    @staticmethod
    def state_at_release(law, b):
        return 0.0

    @staticmethod
    def state_in_stage(law, b, moved):
        return law.slip[b] + moved

    @staticmethod
    def store_state(law, b, slip, moved, slides):
        law.before[b] = law.slip[b]
        law.slip[b] = slip + moved if slides else 0.0


class LastingWeakening(SlipWeakening):
    """Slip weakening without healing: slip counts from the start of the run."""

    @staticmethod
    def strength_of(law, slip, static, dynamic):
        return dynamic + max(static - dynamic, 0.0) * max(1.0 - slip * law.rate, 0.0)

    threshold_of = strength_of
    state_at_release = SlipWeakening.state_before

    @staticmethod
    def store_state(law, b, slip, moved, slides):
        law.before[b] = law.slip[b]
        law.slip[b] = slip + moved


class VelocityWeakening(NamedTuple):
    """Friction that decreases with speed."""

    scale: float  #: v_c, in l per step

    @staticmethod
    def resistance(law, state, speed, slope, static, dynamic):
        """Return T at the larger of the two solutions V, which a block that slows reaches first."""
        drop, c, fastest = max(static - dynamic, 0.0), law.scale, speed + slope * dynamic
        under_root = (fastest + c) * (fastest + c) + 4.0 * slope * drop * c
        mean = 0.5 * (fastest - c + math.sqrt(max(under_root, 0.0)))
        return dynamic + drop * c / (c + max(mean, 0.0)) if under_root >= 0.0 else np.inf


KernelLaw = SlipWeakening | VelocityWeakening | FromFile | None


def law_of(material: Material, step: float, load: float, contact: NDArray[np.bool_]) -> KernelLaw:
    """Return the law of a material in the kernels' units.

    `load` is F_n of a block; `contact` is one-dimensional.
    """
    law = material.law
    if isinstance(law, LawFile):
        return from_file(law, contact, load, material.spacing / step, step)
    if law == "slip_weakening":
        weakening = LastingWeakening if material.healing == "none" else SlipWeakening
        return weakening.of(len(contact), material.slip_distance / material.spacing)
    if law == "velocity_weakening":
        scale = np.clip(material.speed_scale * step / material.spacing, _LEAST, _MOST)
        return VelocityWeakening(float(scale))
    return None


#: (law, state, speed, slope, static, dynamic) -> T at the mean speed V = speed + slope T, where
#: `speed` is that without friction: the slope is -β in the leapfrog, see `friction`, and 0 if V is
#: known. T is infinite if no V solves the equation: the block stops.
resistance = method("resistance", Coulomb)
#: (law, state, speed, static, dynamic) -> weight β: friction is evaluated at (1 - β) v + β v⁺, with
#: v and v⁺ before and after the step. β is 1/2, or more where friction rises steeply with speed.
end_weight = method("end_weight", Coulomb)
#: (law, state, static, dynamic) -> largest force on a block at rest, or that reverses, which holds
#: it: mu_s F_n, unless it has lost strength.
strength_of = method("strength_of", Coulomb)
#: (law, state, fx, fy, static, dynamic) -> whether a block at rest stays so whatever the rounding.
surely_holds = method("surely_holds", Coulomb)
#: (law, state, static, dynamic) -> threshold of the force on a block at rest, F_c.
threshold_of = method("threshold_of", Coulomb)
#: (law, b) -> state of block b; that one step before; and that at its release in the last step.
state_now = method("state_now", Coulomb)
state_before = method("state_before", Coulomb)
state_at_release = method("state_at_release", Coulomb)
#: (law, b, moved) -> state of block b after a part of a step, in which it slipped by `moved`.
state_in_stage = method("state_in_stage", Coulomb)
#: (law, b, state, moved, slides): store the state of block b after a step from `state`, in which it
#: slipped by `moved`, and keep that which it had.
store_state = method("store_state", Coulomb)
