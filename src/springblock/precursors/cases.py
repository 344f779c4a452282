"""Periodic stripes: first detachments beside their edges, by the theory and in the simulation."""

from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from tqdm import tqdm

from springblock.analysis.statistics import Interval, mean_interval
from springblock.continuum.cases import PLAIN, with_springs
from springblock.io.rows import Row, limits
from springblock.io.schemas import SETUP, column, numbers, texts
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.precursors.chain import (
    Edge,
    avalanche_length,
    damped_loads,
    first_loads,
    one_sided_correlation,
)
from springblock.precursors.correlation import EdgeCorrelation, reach
from springblock.precursors.front import Front
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import limit

#: Quantities by name, with their intervals.
Measured = dict[str, Interval]

SHAPES = ("along", "across")  #: of edges, to the sliding direction
PAPER = Material()
#: Blocks along an edge, and width of stripes and gaps in blocks under Coulomb friction.
_LONG, _WIDE = 120, 10
#: Of the time that the strongest block needs; standard deviations of the load of passage. Later
#: detachments beside edges do not happen.
_MORE, _DEVIATIONS = 1.05, 6.0
#: Seeds of the chain, chains of a seed, and of a sample, whose differences give errors.
_SEEDS, _CHAINS, _SAMPLE = 10, 400, 40
#: c(1) from which the blocks of an edge go together, and the length then.
_TOGETHER, _NONE = 0.999, Interval(*map(np.array, 3 * [np.nan]))
#: Distances of c(r): in blocks, and along fronts in m.
BLOCKS, DISTANCES = (1, 2, 3, 6), (5e-6, 1e-5, 1.5e-5, 2e-5)
WIDTH = 8e-5  #: m of stripes and gaps under slip weakening
_NAMES = [f"c_{1e6 * r:.0f}_um" for r in DISTANCES]
_FINE = 2.5e-7  #: m between points from which the reach of a front is read


@dataclass(frozen=True)
class Avalanches:
    """Stripes under Coulomb friction, which differ from the paper's constants in one."""

    shape: str
    what: str = "paper"
    material: Material = PAPER
    seeds: int = 60

    @cached_property
    def edge(self) -> Edge:
        """Elasticity of an edge."""
        return Edge.of(self.material, self.shape, _WIDE, _WIDE)

    @property
    def exact(self) -> Row:
        """T₁, the length of an avalanche, and c(r) of the chain that hands on to one side."""
        share, r = float(self.edge.transfer[0]), np.array(BLOCKS)
        c = one_sided_correlation(self.material, share, r)
        return {
            "edge": self.shape,
            "what": self.what,
            "t_1": share,
            "length": avalanche_length(self.material, share),
            **{f"one_sided_{r}": float(each) for r, each in zip(BLOCKS, c, strict=True)},
        }

    def predicted(self, seeds: int = _SEEDS) -> Measured:
        """Return `of_times` of the chain, whose loads stand for times."""
        edge, shape = self.edge, (_CHAINS, _LONG)
        loads = damped_loads if edge.overdamps(self.material) else first_loads
        chains = [loads(edge.transfer, self.material, shape, seed) for seed in range(seeds)]
        return self.of_times(np.reshape(chains, (-1, _SAMPLE, 1, _LONG)), edge.overload)

    @property
    def setup(self) -> Setup:
        """A fifth of the longest stable step, as the paper's material with 2e-8 s."""
        return setup_with(self.material, 0.2)

    @property
    def contact(self) -> NDArray[np.bool_]:
        """One stripe along y; the sliding direction is that of `direction`."""
        return np.tile(np.arange(2 * _WIDE) < _WIDE, (_LONG, 1))

    def simulated(self) -> Measured:
        """Return `of_times` of the blocks at both edges."""
        return self.of_times(first_times(self, [0, _WIDE - 1]), self.loading_time)

    @property
    def loading_time(self) -> float:
        """Time at which a block far from edges bears its normal force, s."""
        return self.setup.loading_time(self.contact, 1.0)

    def duration(self, surface: Surface) -> float:
        """Return the time at which the strongest block would detach at an edge, and more, s."""
        return _MORE * surface.strongest * self.loading_time / self.edge.overload

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


@dataclass(frozen=True)
class Passage:
    """Stripes under slip weakening, whose front passes the first row beyond a depth of l_z."""

    shape: str
    spacing: float  #: l, m
    xi: float  #: correlation length of the disorder, m
    slip_distance: float  #: d_c, m
    seeds: int = 20

    @property
    def what(self) -> str:
        """Correlation length of the disorder, and d_c; the spacing is in the setup."""
        return f"ξ = {1e6 * self.xi:g} µm, d_c = {1e9 * self.slip_distance:g} nm"

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
    def differs(self) -> int:
        """Number of l, xi and d_c that are not 2.5 µm, 10 µm and 100 nm."""
        usual = Passage(self.shape, 2.5e-6, PLAIN.thickness, PLAIN.slip_distance)
        return sum(a != b for a, b in zip(astuple(self), astuple(usual), strict=True))

    @property
    def depth(self) -> float:
        """Depth of the centres of the row, m."""
        return PLAIN.thickness + self.spacing / 2.0

    @cached_property
    def front(self) -> Front:
        """Front at that depth."""
        return Front.of(self.material, self.shape, self.depth, WIDTH, WIDTH)

    def predicted(self) -> Measured:
        """Return c(r) at `DISTANCES`, the reach of c(r) in m, and standard deviation over mean."""
        front, fine = self.front, np.arange(0.0, WIDTH, _FINE)
        c = dict(zip(_NAMES, front.correlation(np.array(DISTANCES)), strict=True))
        c |= {"reach": reach(fine, front.correlation(fine)), "scatter": front.scatter}
        return {name: Interval(*map(np.array, 3 * [value])) for name, value in c.items()}

    @property
    def setup(self) -> Setup:
        """Half of the longest stable step, as in the chapter on the continuum."""
        return setup_with(self.material, 0.5)

    @property
    def contact(self) -> NDArray[np.bool_]:
        """One stripe along y, twice as long as wide."""
        wide = round(WIDTH / self.spacing)
        return np.tile(np.arange(2 * wide) < wide, (2 * wide, 1))

    def simulated(self) -> Measured:
        """Return the same, of the rows on both sides."""
        row, wide = round(PLAIN.thickness / self.spacing), round(WIDTH / self.spacing)
        times = first_times(self, [row, wide - 1 - row])
        found = EdgeCorrelation(times)
        c = found.interval
        at = [round(r / self.spacing) for r in DISTANCES]
        r = self.spacing * np.arange(float(len(c.mean)))
        return {
            **{
                name: Interval(*(each[n] for each in c)) for name, n in zip(_NAMES, at, strict=True)
            },
            "reach": Interval(*(np.array(reach(r, each)) for each in c)),
            "scatter": found.scatter,
        }

    def duration(self, _: Surface) -> float:
        """Return the time at which the front has passed the row everywhere, s."""
        groups, material = self.front.groups, self.material
        load = (self.front.load + groups.residual) * (material.mu_static - material.mu_dynamic)
        latest = load * (1.0 + _DEVIATIONS * self.front.scatter)
        return latest * self.setup.loading_time(self.contact, 1.0)


Cell = Avalanches | Passage


def setup_with(material: Material, share: float) -> Setup:
    """Return a setup with a share of the longest stable step without damping."""
    step = share * limit("leapfrog", replace(material, gamma=0.0))
    return Setup(material, step=float(f"{step:.1g}"))


def first_times(cell: Cell, columns: Sequence[int]) -> Array:
    """Return first detachments of columns of a cell that slides, (k, columns, 1, n) s."""
    direction = "y" if cell.shape == "along" else "x"
    prelude = compute_prelude(cell.contact, cell.setup, direction, periodic=True)
    times = []
    for seed in range(cell.seeds):
        surface = Surface.draw(cell.contact, seed, cell.setup.material, periodic=True)
        run = simulate(surface, cell.setup, direction, cell.duration(surface), prelude=prelude)
        times.append(run.t_det[:, columns].T[:, None])
    return np.stack(times)


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
CELLS: dict[str, list[Cell]] = {
    "avalanches": list(AVALANCHES),
    "fronts": [each for each in PASSAGES if each.differs <= 1],
}

PRECURSORS = pa.schema(
    [
        *texts(
            edge="along or across the sliding direction",
            what="what differs from the paper's constants, or the disorder",
            quantity="c_R: correlation of first detachments R blocks apart, or R µm; l_c in "
            "blocks; load: mean load of detachment over that of a block far from edges; reach: "
            "distance in m where c is 1/e; scatter: standard deviation over mean of the load",
        ),
        *numbers(
            "of its quantity: 1, blocks or m",
            predicted="by the theory",
            simulated="in the simulation",
            low="lower limit of its 95 % interval",
            high="upper limit",
        ),
        *SETUP,
        column("seeds", pa.int64(), "1", "number of realisations"),
    ]
)


def measure(part: str) -> Iterator[Row]:
    """Yield the rows of a part of `CELLS` as they are computed."""
    for cell in tqdm(CELLS[part], desc=part, unit="cell"):
        predicted = cell.predicted()
        for quantity, (simulated, low, high) in cell.simulated().items():
            yield cell.setup.constants | {
                "edge": cell.shape,
                "what": cell.what,
                "quantity": quantity,
                "predicted": float(predicted[quantity].mean),
                "simulated": float(simulated),
                "low": float(low),
                "high": float(high),
                "seeds": cell.seeds,
            }


def predictions() -> dict[str, list[Row]]:
    """Return the rows of `chain.csv` and `front.csv` in `docs/registration`; takes minutes."""
    chain = []
    for cell in tqdm(AVALANCHES, unit="cell"):
        row = cell.exact
        for name, found in cell.predicted().items():
            row |= limits(name, found)
        chain.append(row)
    front = [
        {
            "edge": each.shape,
            "spacing": each.spacing,
            "xi": each.xi,
            "slip_distance": each.slip_distance,
            "depth": each.depth,
            **{name: float(found.mean) for name, found in each.predicted().items()},
        }
        for each in PASSAGES
    ]
    return {"chain": chain, "front": front}
