"""Unit cells of one pillar or stripe: what the theory predicts, and the simulation of the same."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from tqdm import tqdm

from springblock.io.rows import Row
from springblock.io.schemas import SCENE, column, numbers, texts
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.resolution import DECAY, ZONE
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import limit
from springblock.theory.layer import PLAIN, Cell, Groups, stripe, with_springs

#: Standard deviation of mu_static under Coulomb friction. Without it, rounding decides which
#: blocks slip together, and single runs differ by up to 0.01.
SCATTER = 1e-3
#: Widths in lambda of stripes, and of squares in l_z.
_WIDTHS, _SIZES = (3, 4, 5, 6, 7, 8, 10, 14), (2, 3, 4, 6, 8, 10, 15)
#: Blocks per l_z of stripes and of squares.
_FINE, _COARSE = 8, 4


@dataclass(frozen=True)
class Series:
    """Cells that differ in the width a only, and a constant or a gap."""

    shape: str  #: "across" or "along" the sliding direction, or "square"
    what: str = "d_c = 100 nm"  #: what differs from the plain series
    material: Material = PLAIN
    gap: float = 1.0  #: b/a
    widths: tuple[float, ...] = ()  #: in lambda, or in l_z of squares
    sides: tuple[int, int] = (1, 1)  #: of pillars along sliding and across it, over their width
    is_staggered: bool = False  #: whether every second row is shifted by half a period
    wave: float = 0.0  #: of mu_static over its mean, one pillar long along sliding
    pillars: int = 1  #: along a side
    seeds: tuple[int, ...] = (0,)
    step: float = 0.5  #: over the longest stable one
    predicted: bool = True

    @property
    def is_square(self) -> bool:
        """Whether cells are of square pillars."""
        return self.shape == "square"

    @property
    def groups(self) -> Groups:
        """Groups of the theory."""
        share = 1.0 / (1.0 + self.gap)
        along = "y" if self.shape == "along" else "x"
        return Groups.of(self.material, along, share**2 if self.is_square else share)

    @property
    def unit(self) -> float:
        """Unit of the widths, m."""
        return self.material.thickness if self.is_square else self.groups.decay

    @property
    def blocks(self) -> list[int]:
        """Widths in blocks: multiples of four, so that halves of pillars and gaps are whole."""
        widths = self.widths or (_SIZES if self.is_square else _WIDTHS)
        return [4 * round(w * self.unit / self.material.spacing / 4.0) for w in widths]

    def prediction(self, n: int) -> float:
        """Return static friction of pillars of n blocks by the theory."""
        groups, unit = self.groups, self.material.spacing / self.groups.decay
        if not self.is_square:
            gap = round(self.gap * n)
            return groups.friction(stripe(n * unit, gap * unit, *groups.numbers).excess)
        contact, strength = self.cell(n)
        drop = 1.0 + (strength - 1.0) * (1.0 + groups.residual)
        to_middle = [-side * n // 2 for side in reversed(self.sides)]  # of a pillar
        contact, drop = np.roll(contact, to_middle, (0, 1)), np.roll(drop, to_middle, (0, 1))
        quarter = np.s_[: contact.shape[0] // 2, : contact.shape[1] // 2]
        layer = self.material.thickness / self.material.spacing
        cell = Cell(contact[quarter], layer, drop[quarter])
        return groups.friction(cell.excess(*groups.numbers))

    def setup(self) -> Setup:
        """Return the setup, with its step rounded to a digit."""
        step = float(f"{self.step * limit('leapfrog', self.material):.1g}")
        return Setup(self.material, step=step, sample_interval=20.0 * step)

    def cell(self, n: int) -> tuple[NDArray[np.bool_], Array]:
        """Return the contact of a periodic cell, and mu_static over its mean, (N_y, N_x).

        Pillars are n blocks wide; stripes run along y.
        """
        x, y = (np.arange(side * (n + round(self.gap * n))) < side * n for side in self.sides)
        contact = np.outer(y if self.is_square else 3 * [True], x)
        if self.is_staggered:
            contact = np.vstack([contact, np.roll(contact, len(x) // 2, axis=1)])
        phase = (np.arange(len(x)) + 0.5) / (self.sides[0] * n) - 0.5
        strength = 1.0 + self.wave * np.cos(2.0 * np.pi * phase)
        return contact, np.broadcast_to(strength, contact.shape)

    def surface(self, n: int, seed: int) -> Surface:
        """Return periodic cells with pillars or stripes of n blocks."""
        (contact, strength), times = self.cell(n), (self.pillars, self.pillars)
        drawn = Surface.draw(np.tile(contact, times), seed, self.material, periodic=True)
        mu_static = np.tile(strength, times) * drawn.mu_static
        return Surface(drawn.contact, mu_static, drawn.mu_dynamic, periodic=True)


def _varied(shape: str) -> Iterator[Series]:
    """Yield the series of a shape that the predictions are for."""
    per_layer = _COARSE if shape == "square" else _FINE
    plain = replace(PLAIN, spacing=PLAIN.thickness / per_layer)
    for d_c in (1e-7, 5e-8, 2e-7):
        yield Series(shape, f"d_c = {1e9 * d_c:g} nm", replace(plain, slip_distance=d_c))
    for l_z in (5e-6, 2e-5):
        layer = replace(plain, thickness=l_z, spacing=l_z / per_layer)
        yield Series(shape, f"l_z = {1e6 * l_z:g} µm", layer)
    for mu_d in (0.3, 0.45, 0.75):
        wide = (4, 6, 8, 10, 15, 20) if shape == "square" and mu_d < 0.5 else ()
        yield Series(shape, f"mu_d = {mu_d:g}", replace(plain, mu_dynamic=mu_d), widths=wide)
    for gap in (0.5, 2.0):
        yield Series(shape, f"b/a = {gap:g}", plain, gap)
    for factor in (0.5, 2.0):
        yield Series(shape, f"K_s x {factor:g}", with_springs(plain, math.sqrt(factor)))
    if shape == "square":
        other = partial(Series, shape, material=plain, widths=(3, 4, 6, 8, 10))
        yield other("twice as long along sliding", sides=(2, 1))
        yield other("twice as long across sliding", sides=(1, 2))
        yield other("staggered", is_staggered=True)
        yield other("mu_s with a wave of 10 %", wave=0.1)


def _lattices() -> Iterator[Series]:
    """Yield finer lattices: squares, and stripes whose process zone is short."""
    for spacing in (5e-6, 2.5e-6, 1.25e-6):
        fine = replace(PLAIN, spacing=spacing)
        yield Series("square", "lattice", fine, widths=(4, 6, 10), predicted=spacing > 2e-6)
    coulomb = replace(
        PLAIN, law="coulomb", slip_distance=0.0, healing="instant", mu_static_std=SCATTER
    )
    series = partial(Series, "square", "Coulomb", widths=(4, 8, 16), seeds=tuple(range(10)))
    for spacing in (1e-5, 5e-6, 2.5e-6):
        yield series(replace(coulomb, spacing=spacing), predicted=False)
    for spacing, d_c in product((5e-6, 2.5e-6, 1.25e-6, 6.25e-7), (2e-8, 3e-8, 5e-8, 1e-7)):
        zone = replace(PLAIN, spacing=spacing, slip_distance=d_c)
        yield Series("across", "lattice", zone, widths=(4.0825, 6.532, 9.798))
    for shape, mu_d in product(("across", "along"), (0.3, 0.6, 0.75)):
        yield Series(shape, "lattice", _coarsest(shape, mu_d), widths=(4, 6, 10))


def _coarsest(shape: str, mu_d: float) -> Material:
    """Return a material at both limits of the rule of resolution for stripes."""
    plain = replace(PLAIN, mu_dynamic=mu_d)
    groups = Series(shape, material=plain).groups
    spacing = groups.decay / DECAY
    share = (2.0 * ZONE / (DECAY * math.pi)) ** 2  # kappa/(1 - kappa) where c_0 is ZONE l
    d_c = plain.slip_distance * share / (1.0 + share) / groups.kappa
    return replace(plain, spacing=spacing, slip_distance=d_c)


def _healing() -> Iterator[Series]:
    """Yield what healing and damping change, and pawls of 80 µm between grooves of 20 µm."""
    for healing, gamma in product(("none", "instant"), (1e6, 5e3)):
        plain = replace(PLAIN, healing=healing, gamma=gamma)
        for d_c in (2e-8, 1e-7):
            fine = replace(plain, spacing=1.25e-6, slip_distance=d_c)
            yield Series("across", "healing", fine, widths=(4, 6, 10))
            pawls = replace(fine, spacing=1e-6)
            yield Series("along", "pawls", pawls, 0.25, (8e-5 / (PLAIN.thickness * 0.5**0.5),))
        square = replace(plain, spacing=2.5e-6)
        yield Series("square", "healing", square, widths=(4, 6, 10, 15))


def _disorder() -> Iterator[Series]:
    """Yield the paper's scatter and damping, and disorder that is correlated over l_z."""
    drawn = replace(PLAIN, spacing=2.5e-6, mu_static_std=0.1, mu_dynamic_std=0.05)
    series = partial(Series, "square", predicted=False)
    fast = replace(drawn, spacing=1.25e-6, gamma=Material.gamma, slider_velocity=2.5e-3)
    own: dict[str, Any] = {"widths": (3, 4, 6, 8, 10, 15), "seeds": tuple(range(20)), "step": 0.8}
    yield series("disorder, independent", fast, **own)
    own = {"widths": (2, 4, 6, 10, 15), "seeds": (0, 1, 2, 3), "pillars": 2}
    yield series("disorder, correlated", replace(drawn, correlation_length=1e-5), **own)


SERIES = {
    **{shape: list(_varied(shape)) for shape in ("across", "along", "square")},
    "lattices": list(_lattices()),
    "healing": list(_healing()),
    "disorder": list(_disorder()),
}

CELLS = pa.schema(
    [
        *texts(
            shape="across or along the sliding direction for stripes, or square",
            what="what differs from the plain series",
        ),
        *numbers("m", width="width of a pillar or stripe"),
        *numbers("1", gap="gap over width", kappa="k d_c over the drop of stress"),
        *numbers("m", decay="decay length lambda", process_zone="length of the weakening zone"),
        *map(SCENE.field, Setup().constants),
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        *numbers(
            "1",
            predicted="static friction by the theory; NaN if not computed",
            simulated="static friction in the simulation",
            switches="switches to sliding up to the peak, per block that has detached by then",
            prominence="prominence of the second load peak over the largest force",
        ),
    ]
)


def measure(part: str) -> Iterator[Row]:
    """Yield the rows of a part of `SERIES` as they are computed."""
    for series in tqdm(SERIES[part.removeprefix("continuum-")], desc=part, unit="series"):
        for n in series.blocks:
            predicted = series.prediction(n) if series.predicted else math.nan
            setup, along = series.setup(), "y" if series.shape == "along" else "x"
            contact = series.surface(n, 0).contact
            prelude = compute_prelude(contact, setup, along, periodic=True)
            for seed in series.seeds:
                run = simulate(series.surface(n, seed), setup, along, prelude=prelude)
                last = int(np.argmax(run.force)) + 1
                yield known(series, n) | {
                    "seed": seed,
                    "predicted": predicted,
                    "simulated": run.static_friction,
                    "switches": run.switches[:last].sum() / max(run.detachments[:last].sum(), 1),
                    "prominence": run.prominence,
                }


def known(series: Series, n: int) -> Row:
    """Return the columns of a cell with pillars of n blocks that are known before its run."""
    groups = series.groups
    return series.setup().constants | {
        "shape": series.shape,
        "what": series.what,
        "width": n * series.material.spacing,
        "gap": series.gap,
        "kappa": groups.kappa,
        "decay": groups.decay,
        "process_zone": groups.process_zone,
    }


def lowest_point(widths: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Return the minimum of the parabola, over log a, through the lowest value and two beside it.

    At an end of the range it is the lowest value itself.
    """
    i = int(np.argmin(values))
    if i in (0, len(values) - 1):
        return float(widths[i]), float(values[i])
    a, b, c = np.polyfit(np.log(widths[i - 1 : i + 2]), values[i - 1 : i + 2], 2)
    return math.exp(-b / (2.0 * a)), float(c - b * b / (4.0 * a))
