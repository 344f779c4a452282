"""The onset of sliding: where it ends, and the friction of the sliding that follows.

It ends once all contact blocks have detached and the main drop of the force has passed. Static
friction, t_max, precursors and load peaks are taken up to its end; a run without duration ends
there. `docs/model.md` defines the observables.
"""

import math

import numpy as np
from numpy.typing import NDArray

from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation.setup import Setup

#: Usual sample intervals between two looks at whether the onset has ended.
_LOOK = 10
#: Rise of the force after which the main drop has passed, as a share of this drop.
_REBOUND = 0.1
#: Multiple of the largest t_det from which on a surface slides; an onset without a drop of the
#: force (mu_d = mu_s, or strong damping) ends there.
_SLIDING = 1.5


def between_looks(setup: Setup) -> int:
    """Return the samples between two looks at whether the onset has ended.

    They are a fixed time apart, so that its end does not depend on the sample interval.
    """
    return max(1, round(_LOOK * setup.material.usual_interval(setup.step) / setup.interval))


def known_at(t_det: Array, every: int) -> NDArray[np.int64]:
    """Return the samples that follow detachments at these times, in steps."""
    return np.ceil(t_det).astype(np.int64) // every + 1


def end_of_onset(force: Array, t_det: Array, surface: Surface, setup: Setup) -> int | None:
    """Return the sample at which the onset ends, or None if it has not ended.

    `force` is (n,) in N; `t_det` are the times of the contact blocks in steps, some infinite.
    """
    last, every, between = float(t_det.max()), setup.every, between_looks(setup)
    if not math.isfinite(last):
        return None
    contact = surface.contact
    load = setup.material.block_load * contact.size
    sliding = load * float(surface.mu_dynamic[contact].mean())
    first = -(-int(known_at(np.array(last), every)) // between) * between
    for sample in range(first, len(force), between):
        if sample * every > _SLIDING * last or _has_dropped(force[: sample + 1], sliding):
            return sample
    return None


def _has_dropped(force: Array, sliding: float) -> bool:
    """Return whether the main drop of a force has passed.

    The force has risen from its lowest value since the peak by a tenth of its drop, which counts
    as one to `sliding`, mu_d F_n, at least: a wiggle beside the peak is no minimum.
    """
    after = force[np.argmax(force) :]
    lowest = np.minimum.accumulate(after)
    drop = after[0] - np.minimum(lowest, sliding)
    return bool((after - lowest > _REBOUND * drop).any())


def friction_of_sliding(
    time: Array, friction: Array, t_det: Array, surface: Surface, setup: Setup
) -> float:
    """Return the mean friction of the sliding surface, from 1.5 times the largest t_det on.

    `time` and `t_det` are in s. NaN unless this lasts for one reloading, in which the slider covers
    (mu_s - mu_d) F_n/K_s.
    """
    contact, since = surface.contact, _SLIDING * float(t_det.max())
    drop = (surface.mu_static - surface.mu_dynamic)[contact].mean()
    if not time[-1] - since >= setup.loading_time(contact, max(float(drop), 0.0)):
        return math.nan
    return float(friction[time >= since].mean())
