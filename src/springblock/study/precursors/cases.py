"""Periodic stripes: first detachments beside their edges, by the theory and in the simulation."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from tqdm import tqdm

from springblock.analysis.statistics import Interval, mean_interval
from springblock.io.rows import Row, limits
from springblock.io.schemas import SCENE, column, numbers, texts
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import limit
from springblock.theory.chain import Edge, damped_loads, first_loads
from springblock.theory.correlation import EdgeCorrelation, reach
from springblock.theory.front import Front
from springblock.theory.layer import PLAIN, with_springs

#: Quantities by name, with their intervals.
Measured = dict[str, Interval]

SHAPES = ("along", "across")  #: of edges, to the sliding direction
PAPER = Material()
#: Distances of c(r): in blocks, and along fronts in m.
BLOCKS, DISTANCES = range(1, 7), (5e-6, 1e-5, 1.5e-5, 2e-5)
WIDTH = 8e-5  #: m of stripes and gaps under slip weakening
_LONG, _WIDE = 120, 10  #: blocks along an edge and across a stripe under Coulomb friction
#: Seeds of the chain, chains of a seed, and of a sample, whose differences give errors.
_SEEDS, _CHAINS, _SAMPLE = 10, 400, 40
#: c(1) from which the blocks of an edge go together, and the length then.
_TOGETHER, _NONE = 0.999, Interval(*map(np.array, 3 * [np.nan]))
_LATEST = 6.0  #: standard deviations beyond the mean load, after which no block detaches
_FINE = 2.5e-7  #: m between points from which the reach of a front is read


@dataclass(frozen=True)
class Stripe:
    """A periodic cell of one stripe along y and a gap of the same width."""

    shape: str
    what: str  #: differs from the paper's constants, or from 2.5 µm, 10 µm and 100 nm
    material: Material
    seeds: int
    wide: int  #: blocks
    long: int  #: blocks
    share: float  #: step over the longest stable one without damping

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Blocks of the stripe, (long, 2 wide)."""
        return np.tile(np.arange(2 * self.wide) < self.wide, (self.long, 1))

    @property
    def setup(self) -> Setup:
        """Setup of the simulation."""
        step = self.share * limit("leapfrog", replace(self.material, gamma=0.0))
        return Setup(self.material, step=float(f"{step:.1g}"))

    @property
    def loading_time(self) -> float:
        """Time at which a block far from edges bears its normal force, s."""
        return self.setup.loading_time(self.contact, 1.0)

    def first_times(self, row: int, latest: float) -> Array:
        """Return first detachments of a row and its mirror image, (k, 2, 1, long) s.

        Runs end when a block far from edges would bear `latest` normal forces.
        """
        direction = "y" if self.shape == "along" else "x"
        prelude = compute_prelude(self.contact, self.setup, direction, periodic=True)
        times = []
        for seed in range(self.seeds):
            surface = Surface.draw(self.contact, seed, self.material, periodic=True)
            run = simulate(
                surface, self.setup, direction, latest * self.loading_time, prelude=prelude
            )
            times.append(run.t_det[:, [row, self.wide - 1 - row]].T[:, None])
        return np.stack(times)


class Avalanches(Stripe):
    """A stripe under Coulomb friction, of ten blocks."""

    @cached_property
    def edge(self) -> Edge:
        """Elasticity of an edge."""
        return Edge.of(self.material, self.shape, self.wide, self.wide)

    @property
    def handed(self) -> float:
        """T₁, of its drop, that a block hands on to its neighbour."""
        return float(self.edge.transfer[0])

    def predicted(self, seeds: int = _SEEDS) -> Measured:
        """Return `of_times` of the chain, whose loads stand for times."""
        edge, shape = self.edge, (_CHAINS, self.long)
        loads = damped_loads if edge.overdamps(self.material) else first_loads
        chains = [loads(edge.transfer, self.material, shape, seed) for seed in range(seeds)]
        return self.of_times(np.reshape(chains, (-1, _SAMPLE, 1, self.long)), edge.overload)

    def simulated(self) -> Measured:
        """Return `of_times` of the blocks at both edges."""
        latest = self.material.mu_static + _LATEST * self.material.mu_static_std
        times = self.first_times(0, latest / self.edge.overload)
        return self.of_times(times, self.loading_time)

    def of_times(self, times: Array, unit: float) -> Measured:
        """Return c(r) and l_c in blocks, and the mean of times (k, edges, 1, n) over their unit.

        No length can be read where all blocks of an edge go together.
        """
        found = EdgeCorrelation(times)
        return {
            **{f"c_{r}": Interval(*(each[r] for each in found.interval)) for r in BLOCKS},
            "l_c": found.length().fitted if found.mean[1] < _TOGETHER else _NONE,
            "load": mean_interval(times.mean(axis=(1, 2, 3)) / unit),
        }


class Passage(Stripe):
    """A stripe under slip weakening, whose front passes the first row beyond a depth of l_z."""

    handed = math.nan  #: nothing drops

    @property
    def depth(self) -> float:
        """Depth of the centres of the row, m."""
        return self.material.thickness + self.material.spacing / 2.0

    @cached_property
    def front(self) -> Front:
        """Front at that depth."""
        return Front.of(self.material, self.shape, self.depth, WIDTH, WIDTH)

    def predicted(self) -> Measured:
        """Return c(r) at `DISTANCES`, the reach of c(r) in m, and standard deviation over mean."""
        r = np.arange(0.0, WIDTH, _FINE)
        return self.named(r, [self.front.correlation(r)] * 3) | {
            "scatter": Interval(*[np.array(self.front.scatter)] * 3)
        }

    def simulated(self) -> Measured:
        """Return the same, of the rows on both sides."""
        drop = self.material.mu_static - self.material.mu_dynamic
        load = drop * (self.front.load + self.front.groups.residual)
        latest = load * (1.0 + _LATEST * self.front.scatter)
        row = round(self.material.thickness / self.material.spacing)
        found = EdgeCorrelation(self.first_times(row, latest))
        r = self.material.spacing * np.arange(float(len(found.mean)))
        return self.named(r, found.interval) | {"scatter": found.scatter}

    def named(self, r: Array, c: Sequence[Array]) -> Measured:
        """Return c(r) and its limits at `DISTANCES`, and their reach."""
        at = {f"c_{1e6 * each:.0f}_um": round(each / r[1]) for each in DISTANCES}
        columns = {name: Interval(*(each[n] for each in c)) for name, n in at.items()}
        return columns | {"reach": Interval(*(np.array(reach(r, each)) for each in c))}


def _avalanches() -> Iterator[Avalanches]:
    """Yield stripes under Coulomb friction, with a step of 2e-8 s on the paper's lattice."""
    others = {f"scatter = {std:g}": {"mu_static_std": std} for std in _SCATTERS}
    others |= {"mu_d = 0.8": {"mu_dynamic": 0.8}, "l_z x 0.5": {"thickness": 5e-6}}
    others |= {f"l = {1e6 * each:g} µm": {"spacing": each} for each in _SPACINGS}
    others |= {"gamma = 4e7 1/s": {"gamma": 4e7}}
    materials = {"paper": PAPER} | {what: PAPER.vary(one) for what, one in others.items()}
    materials |= {f"K_s x {k:g}": with_springs(PAPER, k**0.5) for k in (0.5, 2.0)}
    for (what, material), shape in product(materials.items(), SHAPES):
        yield Avalanches(shape, what, material, 60, _WIDE, _LONG, 0.2)


def _passages() -> Iterator[Passage]:
    """Yield stripes under slip weakening, with the paper's disorder, pulled five times as fast."""
    std = {name: getattr(PAPER, name) for name in ("mu_static_std", "mu_dynamic_std")}
    fast = replace(PLAIN, **std, slider_velocity=5.0 * PAPER.slider_velocity)
    for shape, spacing, xi, d_c in product(SHAPES, _SPACINGS, _LENGTHS, _SLIPS):
        material = replace(fast, spacing=spacing, correlation_length=xi, slip_distance=d_c)
        what = f"l = {1e6 * spacing:g} µm, ξ = {1e6 * xi:g} µm, d_c = {1e9 * d_c:g} nm"
        wide = round(WIDTH / spacing)
        yield Passage(shape, what, material, 20, wide, 2 * wide, 0.5)


def _unusual(passage: Passage) -> int:
    """Return how many of l, ξ and d_c are not the second of their values."""
    material, usual = passage.material, (_SPACINGS[1], _LENGTHS[1], _SLIPS[1])
    own = material.spacing, material.correlation_length, material.slip_distance
    return sum(a != b for a, b in zip(own, usual, strict=True))


_SCATTERS = (0.02, 0.03, 0.05, 0.07, 0.15, 0.2, 0.3)
_SPACINGS, _LENGTHS, _SLIPS = (5e-6, 2.5e-6, 1.25e-6), (5e-6, 1e-5, 2e-5), (5e-8, 1e-7, 2e-7)
AVALANCHES, PASSAGES = list(_avalanches()), list(_passages())
#: Cells by the parts of the table.
CELLS: dict[str, Sequence[Avalanches | Passage]] = {
    "precursors-paper": [each for each in AVALANCHES if each.what == "paper"],
    "precursors-avalanches": [each for each in AVALANCHES if each.what != "paper"],
    "precursors-fronts": [each for each in PASSAGES if _unusual(each) <= 1],
}

PRECURSORS = pa.schema(
    [
        *texts(
            edge="along or across the sliding direction",
            what="what differs from the paper's constants, or spacing, disorder and d_c",
            quantity="c_R: correlation of first detachments R blocks apart, or R µm; l_c in "
            "blocks; load: mean load of detachment over that of a block far from edges; reach: "
            "distance in m where c is 1/e; scatter: standard deviation over mean of the load",
        ),
        *numbers("1", t_1="share of its drop that a block hands to its neighbour; NaN of fronts"),
        *numbers(
            "of its quantity: 1, blocks or m",
            predicted="by the theory",
            simulated="in the simulation",
            simulated_low="lower limit of its 95 % interval",
            simulated_high="upper limit",
        ),
        *map(SCENE.field, Setup().constants),
        column("seeds", pa.int64(), "1", "number of realisations"),
    ]
)


def measure(part: str) -> Iterator[Row]:
    """Yield the rows of a part of `CELLS` as they are computed."""
    for cell in tqdm(CELLS[part], desc=part, unit="cell"):
        predicted = cell.predicted()
        known = cell.setup.constants | {"edge": cell.shape, "what": cell.what}
        known |= {"seeds": cell.seeds, "t_1": cell.handed}
        for quantity, found in cell.simulated().items():
            theory = {"quantity": quantity, "predicted": float(predicted[quantity].mean)}
            yield known | theory | limits("simulated", found)
