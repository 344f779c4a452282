"""The loading before the first detachment, computed once for all seeds.

Until the first block detaches, the motion depends on the pattern and the direction, not on the
friction coefficients. A prelude runs the scene with blocks that never let go, and keeps a few
states, each with every block's running maximum of |F_mot|. A realisation may start from the
latest state whose maxima all stay under its own thresholds: it is then, to the last bit, where
it would have come from zero.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.checks import checked_surface
from springblock.direction import heading
from springblock.files import whole_file
from springblock.material import Material
from springblock.setup import PAPER, SAMPLE_INTERVAL, STEP, Setup
from springblock.solver.lattice import Samples, State, prepare

Array = NDArray[np.float64]

#: Sample intervals between two stored states.
_BETWEEN = 10
#: States are kept while the expected number of blocks that should have detached lies between
#: these: hardly any seed needs an earlier one, or can use a later one. Where there are few blocks,
#: until nine in ten should have.
EXPECTED = (1e-4, 10.0)
#: A threshold must exceed the running maximum by this much, against differences in rounding.
_SLACK = 1e-12
#: A threshold that is never reached, and can be squared.
_NEVER = 1e150


@dataclass(frozen=True, eq=False)
class Prelude:
    """Stored states of one scene; k of them, in the kernels' units.

    Valid for the conditions it was computed under, and refused under any other.
    """

    conditions: str  #: what the motion depends on, see `conditions`
    samples: NDArray[np.int64]  #: (k,) sample intervals gone by
    fields: Array  #: (k, 4, lattice) displacement and velocity
    peak: Array  #: (k, lattice) running maximum of |F_mot|²
    ledger: Array  #: (k, 3)
    force: Array  #: (2, samples of the last state) components of ΣF_s

    def save(self, path: Path) -> None:
        """Write whole or not at all, as .npz."""
        with whole_file(path) as partial, partial.open("wb") as file:
            np.savez(file, allow_pickle=False, **vars(self))

    @classmethod
    def read(cls, path: Path) -> "Prelude":
        """Read what `save` wrote."""
        with np.load(path) as stored:
            return cls(**{**stored, "conditions": str(stored["conditions"])})

    def start(self, state: State, latest: float) -> tuple[int, Samples]:
        """Move `state`, at rest so far, on to the latest stored state that is valid for it.

        No further than `latest` sample intervals. Returns the sample intervals gone by and their
        samples; none if no stored state will do.
        """
        blocks = state.blocks
        threshold = np.maximum(blocks.static, blocks.dynamic) ** 2
        bound = blocks.static > 0.0
        holds = (self.peak[:, bound] * (1.0 + _SLACK) <= threshold[bound]).all(axis=1)
        fit = np.flatnonzero(holds & (self.samples <= latest))
        if not fit.size:
            return 0, Samples.empty(0)
        last = int(fit[-1])
        blocks.ux[:], blocks.uy[:], blocks.wx[:], blocks.wy[:] = self.fields[last]
        state.ledger[:] = self.ledger[last]
        skipped = int(self.samples[last])
        force_x, force_y = self.force[:, :skipped].copy()
        return skipped, Samples(force_x, force_y, np.zeros(skipped, np.int64))


def conditions(contact: NDArray[np.bool_], setup: Setup, towards: tuple[float, float]) -> str:
    """All that the motion before the first detachment depends on, as text."""
    mask = np.packbits(contact).tobytes().hex()
    constants = dict(setup.material.items())
    how = setup.integrator, setup.step, setup.every
    return json.dumps([len(contact), mask, constants, towards, *how])


def compute_prelude(
    contact: ArrayLike,
    material: Material = PAPER,
    direction: str | float = "x",
    integrator: str = "leapfrog",
    step: float = STEP,
    sample_interval: float = SAMPLE_INTERVAL,
) -> Prelude:
    """Load a surface whose blocks never let go, until most seeds would have let one go.

    What comes out is shared by `simulate` among all seeds. Arguments and errors are those of
    `simulate`.
    """
    ones = np.ones(np.shape(contact))
    mask, _, _ = checked_surface(contact, ones, ones)
    setup, towards = Setup(material, integrator, step, sample_interval), heading(direction)
    nothing = np.zeros(mask.shape)
    state, constants = prepare(
        mask, ones, nothing, material, towards, setup.method, step, keep_peak=True
    )
    advance, every, blocks = setup.method.advance, setup.every, state.blocks
    load = blocks.static.copy()
    blocks.static[load > 0.0] = _NEVER
    kept = [(0, state.copy())]
    record = [Samples.empty(0)]
    expected, enough = 0.0, min(EXPECTED[1], 0.9 * np.count_nonzero(mask))
    while expected < enough:
        done, taken = (len(record) - 1) * _BETWEEN, Samples.empty(_BETWEEN)
        _, broken, _ = advance(state, constants, done * every, _BETWEEN * every, every, taken)
        if broken >= 0:  # a spring fails before blocks let go: realisations will find out
            break
        record.append(taken)
        expected = _expected_detachments(state, load, material)
        if expected < EXPECTED[0]:
            kept.clear()
        kept.append((done + _BETWEEN, state.copy()))
    return Prelude(
        conditions=conditions(mask, setup, towards),
        samples=np.array([samples for samples, _ in kept]),
        fields=np.array([(b.ux, b.uy, b.wx, b.wy) for b in (s.blocks for _, s in kept)]),
        peak=np.array([s.peak for _, s in kept]),
        ledger=np.array([s.ledger for _, s in kept]),
        force=np.concatenate([(taken.force_x, taken.force_y) for taken in record], axis=1),
    )


def _expected_detachments(state: State, load: Array, material: Material) -> float:
    """Blocks whose threshold, drawn at random, lies below their running maximum: the mean."""
    from scipy.special import ndtr  # loading it takes a third of a second; only a prelude needs it

    bound = load > 0.0
    assert state.peak is not None
    needed = np.sqrt(state.peak[bound]) / load[bound]
    spread = max(material.mu_static_std, 1e-9)
    return float(ndtr((needed - material.mu_static) / spread).sum())
