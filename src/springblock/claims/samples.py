"""Scenes that claims are about, and samples: one number per realisation, by its seed."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from fractions import Fraction
from itertools import groupby, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.claims.rule import Case, Evidence, Finding, Range, Row, describe
from springblock.run import Array
from springblock.scene import Scene
from springblock.statistics import Interval, mean_interval, ratio_interval
from springblock.tables import Record

Mask = NDArray[np.bool_]
Sample = Mapping[int, float]  #: a number per realisation, by its seed

INF = float("inf")
POSITIVE, NEGATIVE = (0.0, INF), (-INF, 0.0)

SMALLEST = 4  #: n_p of the smallest pillars with a stress distribution of their own, section 3.2
ALIKE = 0.2  #: share of the variance that place may explain where the paper calls it uniform
ALONG = "x"  #: the paper's sliding direction


def scenes_along_x(scenes: Iterable[Scene], level: int, smallest: int = 0) -> list[Scene]:
    """Scenes of so many levels that slide along x, by N, n_s/n_p and n_p."""
    found = [s for s in scenes if s.level == level and s.n_p >= smallest]
    along = [s for s in found if s.direction == ALONG]
    return sorted(along, key=lambda s: (s.n_blocks, ratio(s), s.n_p, s.n_p2, s.n_s2))


def ratio(scene: Scene) -> Fraction:
    """n_s/n_p; 0 for a flat surface."""
    return Fraction(scene.n_s, scene.n_p) if scene.n_p else Fraction(0)


def families(scenes: Iterable[Scene], smallest: int = 0) -> Iterator[list[Scene]]:
    """Pillars of all sizes on surfaces of one size, as far apart in proportion to their own."""
    groups = groupby(scenes_along_x(scenes, 1, smallest), key=family_place)
    return (list(family) for _, family in groups)


def place(scene: Scene) -> dict[str, int]:
    """Return the lengths that tell this scene from others."""
    return {"N": scene.n_blocks, **scene.lengths}


def family_place(scene: Scene) -> dict[str, int | str]:
    """Return what the pillars of a family have in common."""
    return {"N": scene.n_blocks, "n_s/n_p": str(ratio(scene))}


def in_table(*scenes: Scene) -> str:
    """Name the rows of the table of realisations that hold these scenes."""
    return "; ".join(f"tables/realisations: {scene.folder}" for scene in scenes)


def in_files(*scenes: Scene) -> str:
    """Name the folders that hold the realisations of these scenes."""
    return "; ".join(f"realisations/{scene.folder}" for scene in scenes)


def in_rows(table: str, scene: Scene, **more: str | int) -> str:
    """Name rows of a table of correlations of this scene."""
    keys = {**place(scene), "direction": scene.direction, **more}
    return f"tables/{table}: {describe(keys)}"


def select(rows: Iterable[Row], **wanted: Any) -> list[Row]:
    """Rows that hold these values."""
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def interval(row: Row, value: str, low: str = "ci_low", high: str = "ci_high") -> Interval:
    """A value of a row with its interval."""
    return Interval(*(np.array(row[key]) for key in (value, low, high)))


def over_rows(function: Callable[[Row], float], rows: Iterable[Row]) -> dict[int, float]:
    """A number per realisation, by its seed, from rows of the table `realisations`."""
    return {row["seed"]: function(row) for row in rows}


def lags(evidence: Evidence, level: int, smallest: int, claimed: Range) -> Iterator[Finding]:
    """t_max - t_avg, s, of each scene along x of the table `realisations`."""
    for scene in scenes_along_x(evidence.summaries, level, smallest):
        lag = over_rows(lambda row: row["t_max"] - row["t_avg"], evidence.summaries[scene])
        yield Finding(place(scene), "t_max - t_avg", mean(lag), claimed, in_table(scene), "s")


def mean(sample: Sample) -> Interval:
    """Mean of a sample with its interval; NaN for an empty one."""
    if not sample:
        return Interval(*np.full(3, np.nan))
    return mean_interval(list(sample.values()))


def difference(first: Sample, second: Sample) -> Interval:
    """Mean of first - second over the seeds that both have: realisations are paired."""
    return mean({seed: first[seed] - second[seed] for seed in sorted(first.keys() & second)})


def position(sample: Sample, zero: Sample, one: Sample) -> Interval:
    """Where the mean of `sample` lies from that of `zero`, 0, to that of `one`, 1; paired.

    The interval is NaN where those of `zero` and `one` cannot be told apart.
    """
    seeds = sorted(sample.keys() & zero.keys() & one.keys())
    place = ratio_interval(
        [sample[seed] - zero[seed] for seed in seeds], [one[seed] - zero[seed] for seed in seeds]
    )
    scale = difference(one, zero)
    if scale.low <= 0.0 <= scale.high:
        return Interval(place.mean, np.array(np.nan), np.array(np.nan))
    return place


def in_order(case: Case, parts: Mapping[str, Array], rests_on: str) -> Iterator[Finding]:
    """Each part of a pillar detaches before the next; mean t_det/t_max of each, (k,)."""
    for (early, before), (late, after) in pairwise(parts.items()):
        statistic = f"t_det/t_max of the {late} minus that of the {early}"
        yield Finding(case, statistic, mean_interval(after - before), POSITIVE, rests_on)


def over_runs(function: Callable[[Record], float], runs: Iterable[Record]) -> dict[int, float]:
    """A number per realisation, by its seed, without those in which it is not defined, NaN."""
    values = {run.seed: function(run) for run in runs}
    return {seed: value for seed, value in values.items() if np.isfinite(value)}
