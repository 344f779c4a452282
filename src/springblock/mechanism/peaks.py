"""Load peaks of pawls and grooves: predicted by `pawls`, and measured in the full model.

The prediction was chosen on the surfaces of `docs/beyond.md`, section 2; those of `TRAINING` are
among them. `tests/mechanism/predicted.csv` holds what it said of the other surfaces before any of
them was simulated.
"""

from collections.abc import Iterator
from typing import NamedTuple

import pyarrow as pa
from tqdm import tqdm

from springblock.analysis.statistics import prominence
from springblock.io.rows import Row
from springblock.io.schemas import SCENE, SETUP, column
from springblock.mechanism import pawls
from springblock.model.asperities import draw_friction
from springblock.model.scene import Scene
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.run import friction
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

SEEDS = 5
_SIDE = 120  #: blocks along a side, or the multiple of the period next to it

SCHEMA = pa.schema(
    [
        *SCENE,
        *SETUP,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        column("trained", pa.bool_(), "1", "whether the prediction was chosen on this surface"),
        column("predicted", pa.float64(), "%", "prominence of the lesser load peak, predicted"),
        column("measured", pa.float64(), "%", "the same in the full model"),
    ]
)


class Grooves(NamedTuple):
    """Pawls of n_p2 blocks between grooves of n_s2, on a pillar of n_p or, 0, without pillars."""

    n_p2: int
    n_s2: int
    n_p: int = 0
    varied: tuple[tuple[str, float], ...] = ()  #: constants other than the paper's

    def scene(self, direction: str) -> Scene:
        """Return the surface, sliding along the grooves, "x", or across, "y"."""
        period = self.n_p2 + self.n_s2
        if not self.n_p:
            lengths = {"n_blocks": period * round(_SIDE / period)}
        else:
            apart = _SIDE // 2 if 2 * self.n_p <= _SIDE else _SIDE
            lengths = {"n_blocks": _SIDE, "n_p": self.n_p, "n_s": apart - self.n_p}
        own = {"n_p2": self.n_p2, "n_s2": self.n_s2, "direction": direction}
        return Scene(**lengths, **own, varied=self.varied)  # type: ignore[arg-type]


TRAINING = [Grooves(n_p2, 2) for n_p2 in (2, 4, 8, 10, 13, 18, 28)]
TRAINING += [Grooves(n_p2, 6) for n_p2 in (2, 4, 6, 9, 14, 24)]
TEST = [Grooves(n_p2, 1) for n_p2 in (5, 7, 11)]
TEST += [Grooves(n_p2, 2) for n_p2 in (3, 5, 6, 7, 9, 12, 16)]
TEST += [Grooves(n_p2, 3) for n_p2 in (4, 5, 6, 7, 9, 12, 17)]
TEST += [Grooves(n_p2, 4) for n_p2 in (6, 8, 11, 16)]
TEST += [Grooves(n_p2, 6) for n_p2 in (5, 7, 8)]
TEST += [Grooves(n_p2, 30 - n_p, n_p) for n_p2, n_p in ((7, 27), (12, 27), (6, 26))]
TEST += [Grooves(n_p2, 60 - n_p, n_p) for n_p2, n_p in ((7, 57), (12, 57), (6, 56), (16, 56))]
TEST += [
    Grooves(n_p2, 2, varied=(("mu_dynamic", value),))
    for value in (0.5, 0.7)
    for n_p2 in (4, 8, 13, 18, 28)
]
TEST += [Grooves(8, 2, 58, (("mu_dynamic", value),)) for value in (0.5, 0.7)]
TEST += [Grooves(n_p2, 2, varied=(("mu_static_std", w),)) for w in (0.05, 0.2) for n_p2 in (8, 13)]


def surfaces() -> Iterator[tuple[Grooves, str]]:
    """Yield each surface, sliding along its grooves and across them."""
    for grooves in (*TRAINING, *TEST):
        for direction in "xy":
            yield grooves, direction


def predicted(grooves: Grooves, direction: str) -> float:
    """Return the prominence of the lesser load peak that elasticity predicts, %."""
    material = Setup().vary(dict(grooves.varied)).material
    return pawls.prominence(grooves.n_p2, grooves.n_s2, direction == "y", material)


def peaks_rows(part: int, parts: int) -> Iterator[Row]:
    """Yield one row per seed on every surface of one of so many parts."""
    for grooves, direction in tqdm(list(surfaces())[part::parts], unit="surface"):
        scene, setup = grooves.scene(direction), Setup().vary(dict(grooves.varied))
        same = scene.row | setup.constants
        same |= {"trained": grooves in TRAINING, "predicted": predicted(grooves, direction)}
        contact, material = scene.contact, setup.material
        prelude = compute_prelude(contact, material, direction)
        for seed in range(SEEDS):
            drawn = draw_friction(scene.shape, seed, material)
            run = simulate(contact, *drawn, material, direction, prelude=prelude)
            measured = 100.0 * prominence(friction(run))
            yield same | {"seed": seed, "measured": measured}
