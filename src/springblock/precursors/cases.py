"""Periodic stripes whose edges slip: what the theory predicts of their first detachments."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from tqdm import tqdm

from springblock.analysis.statistics import Interval
from springblock.continuum.cases import PLAIN, with_springs
from springblock.io.rows import Row, limits
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.precursors.chain import (
    Edge,
    avalanche_length,
    damped_loads,
    first_loads,
    one_sided_correlation,
)
from springblock.precursors.correlation import EdgeCorrelation, reach
from springblock.precursors.front import Front

SHAPES = ("along", "across")  #: of edges, to the sliding direction
PAPER = Material()
#: Blocks along an edge, and width of stripes and gaps in blocks under Coulomb friction.
_LONG, _WIDE = 120, 10
#: Samples of the chain, each of some chains, whose differences give errors.
_SAMPLES, _CHAINS = 100, 40
#: Distances of c(r): in blocks, and along fronts in m.
BLOCKS, DISTANCES = (1, 2, 3, 6), (5e-6, 1e-5, 1.5e-5, 2e-5)
WIDTH = 8e-5  #: m of stripes and gaps under slip weakening
_FINE = 2.5e-7  #: m between points from which the reach of a front is read


@dataclass(frozen=True)
class Avalanches:
    """Stripes under Coulomb friction, which differ from the paper's constants in one."""

    shape: str
    what: str = "paper"
    material: Material = PAPER

    @property
    def known(self) -> Row:
        """Columns that are known without drawing."""
        edge, r = Edge.of(self.material, self.shape, _WIDE, _WIDE), np.array(BLOCKS)
        share = float(edge.transfer[0])
        exact = one_sided_correlation(self.material, share, r)
        return {
            "edge": self.shape,
            "what": self.what,
            "t_1": share,
            "length": avalanche_length(self.material, share),
            **{f"one_sided_{r}": float(c) for r, c in zip(BLOCKS, exact, strict=True)},
        }

    def chain(self, samples: int = _SAMPLES) -> Row:
        """Return c(r), l_c in blocks, and the mean load over that of a block far from edges."""
        edge = Edge.of(self.material, self.shape, _WIDE, _WIDE)
        loads = damped_loads if edge.overdamps(self.material) else first_loads
        chains = [
            loads(edge.transfer, self.material, (_CHAINS, _LONG), seed) for seed in range(samples)
        ]
        found = EdgeCorrelation(np.stack(chains)[:, :, None])
        return measured(found) | {"load": float(np.mean(chains)) / edge.overload}


@dataclass(frozen=True)
class Passage:
    """Stripes under slip weakening, whose front passes the first row beyond a depth of l_z."""

    shape: str
    spacing: float  #: l, m
    xi: float  #: correlation length of the disorder, m
    slip_distance: float  #: d_c, m

    @property
    def material(self) -> Material:
        """The continuum's material with the paper's disorder, pulled faster to save time."""
        return replace(
            PLAIN,
            spacing=self.spacing,
            slip_distance=self.slip_distance,
            correlation_length=self.xi,
            mu_static_std=PAPER.mu_static_std,
            mu_dynamic_std=PAPER.mu_dynamic_std,
            slider_velocity=5.0 * PAPER.slider_velocity,
        )

    @property
    def depth(self) -> float:
        """Depth of the centres of the row, m."""
        return PLAIN.thickness + self.spacing / 2.0

    @property
    def known(self) -> Row:
        """Return what the theory predicts."""
        front = Front.of(self.material, self.shape, self.depth, WIDTH, WIDTH)
        fine = np.arange(0.0, WIDTH, _FINE)
        return {
            "edge": self.shape,
            "spacing": self.spacing,
            "xi": self.xi,
            "slip_distance": self.slip_distance,
            "depth": self.depth,
            **along_front(front.correlation(np.array(DISTANCES))),
            "reach": reach(fine, front.correlation(fine)),
            "scatter": front.scatter,
        }


def measured(correlation: EdgeCorrelation) -> Row:
    """Return c(r) in blocks, and l_c in blocks, with their intervals."""
    mean, low, high = correlation.interval
    columns: Row = {}
    for r in BLOCKS:
        columns |= limits(f"c_{r}", Interval(mean[r], low[r], high[r]))
    return columns | limits("l_c", correlation.length().fitted)


def along_front(c: Array) -> Row:
    """Return c(r) at `DISTANCES`, named by their µm."""
    return {f"c_{1e6 * r:.0f}_um": float(each) for r, each in zip(DISTANCES, c, strict=True)}


def _coulomb() -> Iterator[Avalanches]:
    """Yield stripes under Coulomb friction."""
    others = {f"scatter = {std:g}": {"mu_static_std": std} for std in _SCATTERS}
    others |= {"mu_d = 0.8": {"mu_dynamic": 0.8}, "l_z x 0.5": {"thickness": 5e-6}}
    others |= {f"l = {1e6 * each:g} µm": {"spacing": each} for each in _SPACINGS}
    others |= {"gamma = 4e7 1/s": {"gamma": 4e7}}
    materials = {"paper": PAPER} | {what: PAPER.vary(one) for what, one in others.items()}
    materials |= {f"K_s x {k:g}": with_springs(PAPER, k**0.5) for k in (0.5, 2.0)}
    for (what, material), shape in product(materials.items(), SHAPES):
        yield Avalanches(shape, what, material)


_SCATTERS = (0.02, 0.03, 0.05, 0.07, 0.15, 0.2, 0.3)
_SPACINGS = (5e-6, 2.5e-6, 1.25e-6)
AVALANCHES = list(_coulomb())
PASSAGES = [
    Passage(*each) for each in product(SHAPES, _SPACINGS, (5e-6, 1e-5, 2e-5), (5e-8, 1e-7, 2e-7))
]


def predictions() -> dict[str, list[Row]]:
    """Return the rows of `docs/registration/chain.csv` and of `front.csv`; takes minutes."""
    chain = [each.known | each.chain() for each in tqdm(AVALANCHES, unit="cell")]
    return {"chain": chain, "front": [each.known for each in PASSAGES]}
