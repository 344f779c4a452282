"""Scenes that claims are about, samples of one number per realisation, and findings from them."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import groupby, pairwise
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.analysis.estimate import UNKNOWN, Estimate, Proportion
from springblock.analysis.statistics import (
    difference_interval,
    mean_interval,
    proportion_interval,
    samples_interval,
)
from springblock.claims import ranges
from springblock.claims.rule import Case, Evidence, Finding, Range, Records, describe
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

T = TypeVar("T")
Mask = NDArray[np.bool_]
Quantity = Callable[[Record], float]  #: of a realisation

SMALLEST = 4  #: n_p of the smallest pillars with a stress distribution of their own, section 3.2
ALONG = "x"  #: the paper's sliding direction
static_friction: Quantity = attrgetter("static_friction")


def along_x(table: Mapping[Scene, T], level: int, smallest: int = 0) -> dict[Scene, T]:
    """Scenes of so many levels, the first pillars, that slide along x, by N, n_s/n_p and n_p.

    Those with constants of their own are left out.
    """
    found = [s for s in table if s.level == level and s.n_p >= smallest and not s.varied]
    along = [s for s in found if s.direction == ALONG and (s.n_p > 0) == (level > 0)]
    along.sort(key=lambda s: (s.n_blocks, ratio(s), s.n_p, s.n_p2, s.n_s2))
    return {scene: table[scene] for scene in along}


def ratio(scene: Scene) -> Fraction:
    """n_s/n_p; 0 for a flat surface."""
    return Fraction(scene.n_s, scene.n_p) if scene.n_p else Fraction(0)


def families(table: Mapping[Scene, Any], smallest: int = 0) -> Iterator[list[Scene]]:
    """Pillars of all sizes on surfaces of one size, as far apart in proportion to their own."""
    groups = groupby(along_x(table, 1, smallest), key=family_place)
    return (list(family) for _, family in groups)


def place(scene: Scene) -> dict[str, int | str]:
    """Return what tells this scene from others, but for its direction and constants."""
    return {"N": scene.n_blocks, **scene.names}


def family_place(scene: Scene) -> dict[str, int | str]:
    """Return what the pillars of a family have in common."""
    return {"N": scene.n_blocks, "n_s/n_p": str(ratio(scene))}


def pillars_of(field: NDArray[Any], scene: Scene) -> list[NDArray[Any]]:
    """Parts of a field over the surface, (N, N), that lie on each pillar, (n_p, n_p)."""
    size = scene.n_p
    return [field[y : y + size, x : x + size] for y, x in scene.pattern.origins]


def in_files(*scenes: Scene, folder: str = "realisations") -> str:
    """Name the folders that hold the realisations, or the preludes, of these scenes."""
    return "; ".join(f"{folder}/{scene.folder}" for scene in scenes)


def in_table(*scenes: Scene) -> str:
    """Name the rows of the table of realisations that hold these scenes."""
    return "; ".join(f"tables/realisations: {scene.folder}" for scene in scenes)


def in_rows(table: str, scene: Scene, **more: str | int) -> str:
    """Name rows of a table of correlations of this scene."""
    keys = {**place(scene), "direction": scene.direction, **more}
    return f"tables/{table}: {describe(keys)}"


def over_runs(quantity: Quantity, runs: Iterable[Record]) -> Array:
    """A number per realisation, (k,), without those in which it is not defined, NaN."""
    values = np.array([quantity(run) for run in runs], dtype=float)
    return values[np.isfinite(values)]


def lags(rows: Iterable[Row]) -> Array:
    """t_max - t_avg of each realisation, (k,) s, from rows of the table `realisations`."""
    return np.array([row["t_max"] - row["t_avg"] for row in rows])


def interval(row: Row, value: str, limits: str = "ci") -> Estimate:
    """A value of a row with its interval."""
    low, high = float(row[f"{limits}_low"]), float(row[f"{limits}_high"])
    return Estimate(float(row[value]), low, high, row["realisations"])


def mean(sample: ArrayLike) -> Estimate:
    """Mean of a sample, (k,), with its interval; NaN for an empty one."""
    values = np.asarray(sample)
    return Estimate.of(mean_interval(values), len(values)) if len(values) else UNKNOWN


def proportion(flags: NDArray[np.bool_]) -> Estimate:
    """Proportion of the realisations, (k,), in which something is so, with its exact interval."""
    return Proportion.of(proportion_interval(int(np.sum(flags)), len(flags)), len(flags))


def difference(first: Array, second: Array) -> Estimate:
    """Mean of a sample minus that of one of another surface: both are independent (Welch).

    The same seeds do not help: realisations of different surfaces are hardly correlated.
    """
    fewest = min(len(first), len(second))
    return Estimate.of(difference_interval(first, second), fewest) if fewest else UNKNOWN


def compared(
    evidence: Evidence,
    case: Case,
    statistic: str,
    quantity: Quantity,
    first: Scene,
    second: Scene,
    claimed: Range = ranges.POSITIVE,
) -> Finding:
    """Mean of a quantity over the realisations of one scene minus that over those of another."""
    samples = (over_runs(quantity, evidence.records[scene]) for scene in (first, second))
    return Finding(case, statistic, difference(*samples), claimed, in_files(first, second))


def relative(first: Array, second: Array, base: Array) -> Estimate:
    """Mean of a sample minus that of another, over that of a third, whose error is left out."""
    apart, scale = difference(first, second), mean(base).value
    if not scale:
        return UNKNOWN
    return Estimate(apart.value / scale, apart.ci_low / scale, apart.ci_high / scale, apart.n)


def magnitude(estimate: Estimate) -> Estimate:
    """The same seen from the other side, where it is negative."""
    if not estimate.value < 0.0:
        return estimate
    return Estimate(-estimate.value, -estimate.ci_high, -estimate.ci_low, estimate.n)


def position(sample: Array, zero: Array, one: Array) -> Estimate:
    """Where the mean of `sample` lies from that of `zero`, 0, to that of `one`, 1; BCa.

    The interval is NaN where those of `zero` and `one` cannot be told apart.
    """
    samples = sample, zero, one
    scale, fewest = difference(one, zero), min(map(len, samples))
    if fewest < 2 or scale.ci_low <= 0.0 <= scale.ci_high:
        return UNKNOWN

    def relative_place(*parts: Array, axis: int) -> Array:
        middle, start, end = (part.mean(axis=axis) for part in parts)
        return (middle - start) / (end - start)

    return Estimate.of(samples_interval(samples, relative_place), fewest)


def found_on(
    scene: Scene,
    statistic: str,
    estimate: Estimate,
    claimed: Range,
    unit: str = "1",
    /,
    **more: Any,
) -> Finding:
    """Finding that rests on the realisations of a scene; `more` says which part of it."""
    return Finding(place(scene) | more, statistic, estimate, claimed, in_files(scene), unit)


def means_of_runs(
    records: Records, statistic: str, quantity: Quantity, claimed: Range, unit: str = "1"
) -> Iterator[Finding]:
    """Mean of a quantity over the realisations of each scene."""
    for scene, runs in records.items():
        yield found_on(scene, statistic, mean(over_runs(quantity, runs)), claimed, unit)


def in_order(
    scene: Scene, parts: Mapping[str, Array], time: str = "t_max", /, **more: Any
) -> Iterator[Finding]:
    """Each part of a pillar detaches before the next; mean t_det over `time` of each, (k,)."""
    for (early, before), (late, after) in pairwise(parts.items()):
        statistic = f"t_det/{time} of the {late} minus that of the {early}"
        yield found_on(scene, statistic, mean(after - before), ranges.POSITIVE, **more)


def before_peak(run: Run) -> float:
    """Share of all detaching blocks that detach before t_max."""
    times = run.t_det[np.isfinite(run.t_det)]
    return float(np.mean(times < run.t_max))


def relative_lag(run: Run) -> float:
    """t_max - t_avg over t_max."""
    return (run.t_max - run.t_avg) / run.t_max


def neighbours(field: Array, outside: float) -> Array:
    """Values of the eight neighbours, (8, N, N), with `outside` beyond the edges."""
    padded, (rows, columns) = np.pad(field, 1, constant_values=outside), field.shape
    shifts = [(y, x) for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.stack([padded[y : y + rows, x : x + columns] for y, x in shifts])


def isolated(run: Run, until: float = 1.0) -> float:
    """Share of the blocks detached before `until` t_max that had eight resting neighbours then.

    Blocks that never detach, NaN, count as resting.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_det), axis=0)
    return share_of(alone, run.t_det < until * run.t_max)


def share_of(blocks: Mask, among: Mask) -> float:
    """Share of the blocks `among` that are `blocks`, too; NaN where there are none."""
    return float(blocks[among].mean()) if among.any() else float("nan")


def rates(run: Run, width: float) -> Array:
    """First detachments within `width` s around each sample, (n,)."""
    samples = max(1, round(width / (run.time[1] - run.time[0])))
    counts: Array = np.convolve(run.detachments.astype(float), np.ones(samples), mode="same")
    return counts


def from_edge(size: int) -> NDArray[np.intp]:
    """Distance of each block of a square from its edge, (size, size)."""
    from_end = np.minimum(np.arange(size), np.arange(size)[::-1])
    return np.minimum.outer(from_end, from_end)


def first_patch(times: Array, size: int) -> float:
    """Where the patch of `size` by `size` blocks lies that detaches first, (n, n) s.

    The fraction of all such patches that lie nearer to the edge, and half of those just as near:
    1/2 on average if every place is as good, 0 at the edge, 1 at the centre.
    """
    windows = np.lib.stride_tricks.sliding_window_view(times, (size, size)).mean(axis=(-2, -1))
    depth = from_edge(len(windows))
    here = depth.flat[np.argmin(windows)]
    return float(np.mean(depth < here) + 0.5 * np.mean(depth == here))
