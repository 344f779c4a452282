"""The loading before the first detachment, computed once for all seeds.

Until the first block detaches, the motion depends on the pattern and the direction, not on the
friction coefficients. A prelude runs the scene with blocks that never let go, and keeps a few
states: how the blocks without contact move, and the running maximum of |F_mot| on those in
contact, which rest. A realisation may start from the latest state whose maxima all stay under
its own thresholds: it is then, to the last bit, where it would have come from zero. (With a law
from a file the force until then, a sum over blocks in another order, may differ by rounding.)
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.files import MENDING, read_arrays, whole_file
from springblock.model.asperities import log_share_above
from springblock.model.defaults import INTEGRATOR, SAMPLE_INTERVAL, STEP
from springblock.model.direction import heading
from springblock.model.material import Material
from springblock.simulation.checks import checked_surface
from springblock.simulation.setup import PAPER, Setup
from springblock.solver.integrators import INTEGRATORS, on_cores
from springblock.solver.lattice import Constants, Samples, State, close_edges, prepare, unpadded
from springblock.solver.laws import strengths

Array = NDArray[np.float64]

#: Sample intervals between two looks at the state.
_BETWEEN = 10
#: For each of these shares of all seeds, the latest state is kept that so many may start from.
#: The number of blocks that should have detached grows about exponentially with time: six states
#: at about these shares then leave the least to be done again, and hardly a seed begins at zero.
HOLDING = (0.998, 0.96, 0.85, 0.65, 0.4, 0.2)
#: A threshold must exceed the running maximum by this much, against differences in rounding.
_SLACK = 1e-12
#: A threshold that is never reached, and can be squared.
_NEVER = 1e150


@dataclass(frozen=True, eq=False)
class Prelude:
    """Stored states of one scene; k of them, one per share in `HOLDING` at most.

    In the kernels' units, blocks row by row. Valid for the conditions it was computed under, and
    refused under any other.
    """

    conditions: str  #: what the motion depends on, see `conditions`
    samples: NDArray[np.int64]  #: (k,) sample intervals gone by
    fields: Array  #: (k, 4, blocks without contact) displacement and velocity
    peak: Array  #: (k, blocks in contact) running maximum of |F_mot|²
    ledger: Array  #: (k, 3)
    force: Array  #: (2, samples of the last state) components of ΣF_s
    code_version: str = ""  #: that made it, where a command has computed it

    @property
    def surface(self) -> str:
        """Pattern, edges and direction of its scene, as `surface` writes them."""
        return json.dumps(json.loads(self.conditions)[:4])

    @property
    def constants(self) -> dict[str, Any]:
        """Constants of the material that was loaded, by name."""
        return dict(json.loads(self.conditions)[4])

    def save(self, path: Path) -> None:
        """Write whole or not at all, as .npz."""
        parts: dict[str, Any] = {name: _apart(part) for name, part in vars(self).items()}
        with whole_file(path) as partial, partial.open("wb") as file:
            np.savez_compressed(file, **parts)

    @classmethod
    def read(cls, path: Path) -> "Prelude":
        """Read what `save` wrote.

        Raises
        ------
        ValueError
            With one sentence, where it is not as it was written, or is none.
        """
        try:
            return cls(**{name: _together(part) for name, part in read_arrays(path).items()})
        except (TypeError, ValueError):
            raise ValueError(f"{path} is no prelude, or damaged; {MENDING}") from None

    def start(self, state: State, constants: Constants, latest: float) -> tuple[int, Samples]:
        """Move `state`, at rest so far, on to the latest stored state that is valid for it.

        No further than `latest` sample intervals. Returns the sample intervals gone by and their
        samples; none if no stored state will do.
        """
        blocks, grid = state.blocks, constants.grid
        bound = unpadded(blocks.static, grid) > 0.0
        coefficients = (unpadded(field, grid)[bound] for field in (blocks.static, blocks.dynamic))
        threshold = strengths(state.law, *coefficients) ** 2
        holds = (self.peak * (1.0 + _SLACK) <= threshold).all(axis=1)
        fit = np.flatnonzero(holds & (self.samples <= latest))
        if not fit.size:
            return 0, Samples.empty(0)
        last = int(fit[-1])
        for field, stored in zip(blocks[:4], self.fields[last], strict=True):
            unpadded(field, grid)[~bound] = stored
        close_edges(blocks.ux, blocks.uy, grid)
        state.ledger[:] = self.ledger[last]
        skipped = int(self.samples[last])
        force_x, force_y = self.force[:, :skipped].copy()
        return skipped, Samples(force_x, force_y, np.zeros(skipped, np.int64))


def _apart(part: Any) -> NDArray[Any]:
    """Bytes of floating-point numbers by their place, (8, ...): leading ones repeat, others never.

    The file is half as large.
    """
    whole = np.asarray(part)
    if whole.dtype != np.float64:
        return whole
    return np.moveaxis(np.ascontiguousarray(whole)[..., None].view(np.uint8), -1, 0)


def _together(stored: NDArray[Any]) -> Any:
    """What `_apart` has taken apart, to the bit."""
    if stored.dtype.kind == "U":
        return str(stored)
    if stored.dtype != np.uint8:
        return stored
    return np.ascontiguousarray(np.moveaxis(stored, 0, -1)).view(np.float64)[..., 0]


def surface(
    contact: NDArray[np.bool_], towards: tuple[float, float], periodic: bool = False
) -> str:
    """Pattern, edges and direction as text."""
    mask = np.packbits(contact).tobytes().hex()
    return json.dumps([contact.shape, periodic, mask, towards])


def conditions(
    contact: NDArray[np.bool_], setup: Setup, towards: tuple[float, float], periodic: bool
) -> str:
    """All that the motion before the first detachment depends on, as text."""
    pulled = json.loads(surface(contact, towards, periodic))
    how = setup.integrator, setup.step, setup.every
    return json.dumps([*pulled, dict(setup.material.items()), *how])


def compute_prelude(
    contact: ArrayLike,
    material: Material = PAPER,
    direction: str | float = "x",
    integrator: str = INTEGRATOR,
    step: float = STEP,
    sample_interval: float = SAMPLE_INTERVAL,
    cores: int = 1,
    periodic: bool = False,
    mu_static: ArrayLike | None = None,
) -> Prelude:
    """Load a surface whose blocks never let go, until most seeds would have let one go.

    What comes out is shared by `simulate` among all seeds. Arguments and errors are those of
    `simulate`; where `mu_static` is not drawn, the only state that is kept is the last before a
    block lets go.
    """
    ones = np.ones(np.shape(contact))
    mask, _, _ = checked_surface(contact, ones, ones, periodic)
    setup, towards = Setup(material, integrator, step, sample_interval), heading(direction)
    strongest = material.mu_static if mu_static is None else np.max(np.asarray(mu_static)[mask])
    setup.check_length(mask, float(strongest))
    nothing = np.zeros(mask.shape)
    state, constants = prepare(
        mask, ones, nothing, material, towards, INTEGRATORS[integrator], step, True, periodic
    )
    advance, every = on_cores(integrator, cores), setup.every
    blocks, peak = state.blocks, state.peak
    assert peak is not None
    bound, load = blocks.static > 0.0, float(blocks.static.max())
    blocks.static[bound] = _NEVER
    kept: dict[int, tuple[int, Array, Array, Array]] = {}
    record, holding = [Samples.empty(0)], 1.0
    while holding >= HOLDING[-1]:
        done, taken = (len(record) - 1) * _BETWEEN, Samples.empty(_BETWEEN)
        fields = np.array([unpadded(field, constants.grid)[~mask] for field in blocks[:4]])
        # takes the place of an earlier state that as many of the shares may start from
        passed = sum(holding < share for share in HOLDING)
        kept[passed] = done, fields, peak[bound], state.ledger.copy()
        _, broken, _ = advance(state, constants, done * every, _BETWEEN * every, every, taken)
        if broken >= 0:  # a spring fails before blocks let go: realisations will find out
            break
        record.append(taken)
        needed = np.sqrt(peak[bound]) / load
        if mu_static is None:
            # where coefficients are correlated the share is higher, and states are a little early
            holding = math.exp(log_share_above(needed, material).sum())
        else:
            holding = float((needed < np.asarray(mu_static)[mask]).all())
    samples, moving, peaks, ledgers = map(np.array, zip(*kept.values(), strict=True))
    force = np.concatenate([(taken.force_x, taken.force_y) for taken in record], axis=1)
    return Prelude(
        conditions=conditions(mask, setup, towards, periodic),
        samples=samples,
        fields=moving,
        peak=peaks,
        ledger=ledgers,
        force=force[:, : samples[-1]],
    )
