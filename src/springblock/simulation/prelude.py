"""The loading before the first detachment, computed once for all seeds.

Until the first block detaches, the motion depends on the pattern and the direction, but not on the
friction coefficients. A prelude simulates the scene with blocks that never detach and stores a few
states: the motion of the blocks without contact, and the running maximum of |F_mot| on the blocks
in contact, which are at rest. A realisation may start from the latest state whose maxima are all
below its thresholds, with the same result, to the last bit, as a run from zero. (With a law from a
file, the force before that state is summed in another order and may differ by rounding.)
"""

import json
import math
import zlib
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.files import MENDING, whole_file
from springblock.model.asperities import log_share_above
from springblock.model.direction import heading
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface, as_coefficients, as_mask
from springblock.simulation.motion import Motion, SimulationError
from springblock.simulation.setup import DEFAULT, Setup, check_type
from springblock.solver.lattice import Samples, close_edges, unpadded
from springblock.solver.law_file import FromFile
from springblock.solver.laws import state_at_release, threshold_of

#: Sample intervals between two candidates for a stored state.
_BETWEEN = 10
#: Shares of all seeds: for each, the latest state from which this share may start is stored.
#: The expected number of detached blocks grows about exponentially with time; six states at about
#: these shares then save the most time, and few seeds start from zero.
HOLDING = (0.998, 0.96, 0.85, 0.65, 0.4, 0.2)
#: Relative margin by which a threshold must exceed the running maximum, against rounding.
_SLACK = 1e-12
#: Errors of reading a file that is damaged or of another type.
_TORN = BadZipFile, EOFError, KeyError, OSError, TypeError, ValueError, zlib.error
#: A threshold that is never reached, and whose square is finite.
_NEVER = 1e150


@dataclass(frozen=True, eq=False)
class Prelude:
    """Stored states of one scene: k states, at most one per share in `HOLDING`.

    Values are in the kernels' units, with blocks row by row. They are valid for `conditions` only.
    """

    conditions: str  #: all that determines the motion, see `conditions`
    samples: NDArray[np.int64]  #: (k,) sample intervals until the state
    fields: Array  #: (k, 4, blocks without contact) displacement and velocity
    peak: Array  #: (k, blocks in contact) running maximum of |F_mot|²
    ledger: Array  #: (k, 3)
    force: Array  #: (2, samples of the last state) components of ΣF_s
    code_version: str = ""  #: version of the code, if computed by a command

    def save(self, path: Path) -> None:
        """Write an .npz file, whole or not at all."""
        with whole_file(path) as partial, partial.open("wb") as file:
            np.savez_compressed(file, **vars(self))

    @classmethod
    def read(cls, path: Path) -> "Prelude":
        """Read a file that `save` has written; refuse any other with a ValueError."""
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as parts:
                texts = {name: str(parts[name]) for name in ("conditions", "code_version")}
                return cls(**dict(parts) | texts)
        except _TORN:
            raise ValueError(f"{path} is not a prelude, or damaged; {MENDING}") from None

    def start(self, motion: Motion, latest: float) -> None:
        """Set a surface at rest to the latest stored state that is valid for its thresholds.

        States after sample interval `latest` are not used. Without a valid one it stays at rest.
        """
        state, blocks, grid = motion.state, motion.state.blocks, motion.constants.grid
        bound = unpadded(blocks.static, grid) > 0.0
        static, dynamic = (
            unpadded(field, grid)[bound] for field in (blocks.static, blocks.dynamic)
        )
        thresholds = np.maximum(static, dynamic)
        if isinstance(state.law, FromFile):
            each = zip(static, dynamic, strict=True)
            fresh = state_at_release(state.law, 0)
            thresholds = np.array([threshold_of(state.law, fresh, *pair) for pair in each])
        holds = (self.peak * (1.0 + _SLACK) <= thresholds**2).all(axis=1)
        fit = np.flatnonzero(holds & (self.samples <= latest))
        if not fit.size:
            return
        last = int(fit[-1])
        for field, stored in zip(blocks[:4], self.fields[last], strict=True):
            unpadded(field, grid)[~bound] = stored
        close_edges(blocks.ux, blocks.uy, grid)
        state.ledger[:] = self.ledger[last]
        skipped = int(self.samples[last])
        force_x, force_y = self.force[:, :skipped].copy()
        motion.append(Samples(force_x, force_y, np.zeros(skipped, np.int64)))


def conditions(
    contact: NDArray[np.bool_], setup: Setup, towards: tuple[float, float], periodic: bool
) -> str:
    """Return all that determines the motion before the first detachment, as text."""
    mask, constants = np.packbits(contact).tobytes().hex(), dict(setup.material.items())
    how = setup.integrator, setup.step, setup.every
    return json.dumps([contact.shape, periodic, mask, towards, constants, *how])


def compute_prelude(
    contact: Pattern | ArrayLike,
    setup: Setup = DEFAULT,
    direction: str | float = "x",
    periodic: bool = False,
    mu_static: ArrayLike | None = None,
) -> Prelude:
    """Load a surface without detachment until a block would detach in most realisations.

    `simulate` accepts the prelude for any seed. Arguments and errors are those of `Surface` and
    `simulate`; if `mu_static`, an (N_y, N_x) array, is given instead of drawn, only the last state
    before a detachment is stored.
    """
    check_type("setup", setup, Setup)
    mask, material = as_mask(contact), setup.material
    known = None if mu_static is None else as_coefficients("mu_static", mu_static, mask)[mask]
    strongest = material.mu_static if known is None else float(known.max())
    setup.plan(mask, strongest)  # refuses a run that would be too long
    surface = Surface(mask, 1.0, 0.0, periodic)
    motion = Motion(surface, setup, direction, keep_peak=True)
    state, blocks, peak = motion.state, motion.state.blocks, motion.state.peak
    assert peak is not None
    bound, load = blocks.static > 0.0, float(blocks.static.max())
    blocks.static[bound] = _NEVER
    kept: dict[int, tuple[int, Array, Array, Array]] = {}
    holding = 1.0
    while holding >= HOLDING[-1]:
        fields = np.array([unpadded(field, motion.constants.grid)[~mask] for field in blocks[:4]])
        # replaces an earlier state between the same two shares
        passed = sum(holding < share for share in HOLDING)
        kept[passed] = motion.samples, fields, peak[bound], state.ledger.copy()
        try:
            motion.proceed(motion.samples + _BETWEEN)
        except SimulationError:  # before any block detaches: `simulate` raises it again
            break
        needed = np.sqrt(peak[bound]) / load
        if known is None:
            # as if blocks were independent; with correlated coefficients the share is larger
            holding = math.exp(log_share_above(needed, material).sum())
        else:
            holding = float((needed < known).all())
    samples, moving, peaks, ledgers = map(np.array, zip(*kept.values(), strict=True))
    force_x, force_y, _ = motion.recorded()
    return Prelude(
        conditions=conditions(mask, setup, heading(direction), periodic),
        samples=samples,
        fields=moving,
        peak=peaks,
        ledger=ledgers,
        force=np.stack([force_x, force_y])[:, 1 : samples[-1] + 1],
    )
