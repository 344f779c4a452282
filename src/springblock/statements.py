"""The statements of the paper that the study can test, each with the statistic that tests it.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. Where the paper compares in
words ("similar", "uniform", "the same"), the claimed range says how close is close enough.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from itertools import groupby, pairwise
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.accuracy import standard_error
from springblock.claims import Case, Claim, Evidence, Finding, Row
from springblock.realisation import STEP
from springblock.run import Array, Run
from springblock.scene import Scene
from springblock.statistics import (
    Interval,
    load_peaks,
    mean_interval,
    pillar_map,
    pillar_ring,
    ratio_interval,
    repeatability,
)
from springblock.tables import Record

Sample = Mapping[int, float]  #: a number per realisation, by its seed
Summaries = Mapping[int, Row]
Mask = NDArray[np.bool_]

INF = float("inf")
POSITIVE, NEGATIVE = (0.0, INF), (-INF, 0.0)

_SMALLEST = 4  #: n_p of the smallest pillars with a stress distribution of their own, section 3.2
_CORE = 10  #: blocks from the edges of a flat surface to its core
_ALIKE = 0.1  #: share of the variance that place may explain where the paper calls it uniform
_SMALL = 0.2  #: difference in standard deviations that is called small (Cohen 1988)
_HIGH = 0.95  #: share of the largest force that the width of its peak is taken at
_FAR = 3  #: blocks, the paper's lower bound of the correlation length
_FEW = 10  #: n_p below which the paper finds l_c difficult to estimate
_CLOSE = 0.1  #: difference between correlation functions that look the same
_SLIDING_ALONG = "x"


# Scenes and samples


def _scenes(scenes: Iterable[Scene], level: int, smallest: int = 0) -> list[Scene]:
    """Scenes of so many levels that slide along x, by N, n_s/n_p and n_p."""
    found = [s for s in scenes if s.level == level and s.n_p >= smallest]
    along = [s for s in found if s.direction == _SLIDING_ALONG]
    return sorted(along, key=lambda s: (s.n_blocks, _ratio(s), s.n_p, s.n_p2, s.n_s2))


def _ratio(scene: Scene) -> Fraction:
    return Fraction(scene.n_s, scene.n_p) if scene.n_p else Fraction(0)


def _families(scenes: Iterable[Scene]) -> Iterator[list[Scene]]:
    """Pillars of all sizes on surfaces of one size, as far apart in proportion to their own."""
    for _, family in groupby(_scenes(scenes, 1), key=lambda s: (s.n_blocks, _ratio(s))):
        yield list(family)


def _flat(scenes: Iterable[Scene], n_blocks: int) -> Scene | None:
    return next((s for s in _scenes(scenes, 0) if s.n_blocks == n_blocks), None)


def place(scene: Scene) -> dict[str, int]:
    """Return the lengths that tell this scene from others."""
    lengths = {key: getattr(scene, key) for key in ("n_p", "n_s", "n_p2", "n_s2")}
    return {"N": scene.n_blocks} | {key: value for key, value in lengths.items() if value}


def _in_table(*scenes: Scene) -> str:
    return "; ".join(f"tables/realisations: {scene.folder}" for scene in scenes)


def _in_files(*scenes: Scene) -> str:
    return "; ".join(f"realisations/{scene.folder}" for scene in scenes)


def lag(rows: Summaries) -> dict[int, float]:
    """t_max - t_avg, s."""
    return {seed: row["t_max"] - row["t_avg"] for seed, row in rows.items()}


def static_friction(rows: Summaries) -> dict[int, float]:
    """Static friction coefficient."""
    return {seed: row["static_friction"] for seed, row in rows.items()}


def mean(sample: Sample) -> Interval:
    """Mean of a sample with its interval."""
    return mean_interval(list(sample.values()))


def difference(first: Sample, second: Sample) -> Interval:
    """Mean of first - second over the seeds that both have: realisations are paired."""
    return mean_interval([first[seed] - second[seed] for seed in sorted(first.keys() & second)])


def position(sample: Sample, zero: Sample, one: Sample) -> Interval:
    """Where the mean of `sample` lies from that of `zero`, 0, to that of `one`, 1; paired."""
    seeds = sorted(sample.keys() & zero.keys() & one.keys())
    return ratio_interval(
        [sample[seed] - zero[seed] for seed in seeds], [one[seed] - zero[seed] for seed in seeds]
    )


def over_runs(function: Callable[[Record], float], runs: Iterable[Record]) -> dict[int, float]:
    """A number per realisation, by its seed."""
    return {run.seed: function(run) for run in runs}


# What a single run shows


def neighbours(field: Array, outside: float) -> Array:
    """Values of the eight neighbours, (8, N, N), with `outside` beyond the edges."""
    padded, (rows, columns) = np.pad(field, 1, constant_values=outside), field.shape
    shifts = [(y, x) for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.stack([padded[y : y + rows, x : x + columns] for y, x in shifts])


def isolated(run: Run, until: float) -> float:
    """Share of the blocks detached before `until` t_max that had eight resting neighbours then.

    Blocks that never detach, NaN, count as resting.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_det), axis=0)
    return float(alone[run.t_det < until * run.t_max].mean())


def lonely(run: Run) -> float:
    """Share of the blocks detaching before t_max around which no other has by then."""
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return float(alone[run.t_det < run.t_max].mean())


def precursors(run: Run) -> float:
    """Share of all detaching blocks that detach before t_max."""
    times = run.t_det[np.isfinite(run.t_det)]
    return float(np.mean(times < run.t_max))


def warning(run: Run) -> float:
    """Time from the first detachment to t_max, s: for how long there are precursors."""
    return run.t_max - float(np.nanmin(run.t_det))


def width(run: Run) -> float:
    """Time during which the force exceeds 95 % of its maximum, over t_max."""
    samples = np.count_nonzero(run.force > _HIGH * run.force.max())
    return float(samples * (run.time[1] - run.time[0]) / run.t_max)


def relative_lag(run: Run) -> float:
    """t_max - t_avg over t_max."""
    return (run.t_max - run.t_avg) / run.t_max


def second_peak(run: Run) -> float:
    """Force at the last load peak minus that at the first, over P l² N²; NaN below two."""
    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return float("nan")
    return float(run.force[peaks[-1]] - run.force[peaks[0]]) / run.normal_force


def resting_core(run: Run, core: Mask) -> float:
    """Share of the `core` that is yet to detach at the lowest force between the load peaks."""
    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return float("nan")
    between = peaks[0] + int(np.argmin(run.force[peaks[0] : peaks[1]]))
    return float(np.mean(run.t_det[core] > run.time[between]))


def load_peak_number(run: Run) -> float:
    """Number of load peaks that stand out by 1 % of the largest force."""
    return float(len(load_peaks(run.force, 0.0)))


# Flat surfaces, section 3.1


def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Precursors come one by one; up to t_max and up to a tenth of t_max before it."""
    for scene in _scenes(evidence.records, 0):
        for until in (0.9, 1.0):
            shares = over_runs(partial(isolated, until=until), evidence.records[scene])
            yield Finding(
                {"N": scene.n_blocks, "t/t_max below": until},
                "share of the blocks detached by then that let go while all eight neighbours were "
                "at rest since the start",
                mean(shares),
                (0.5, INF),
                _in_files(scene),
            )


def not_all_nucleate(evidence: Evidence) -> Iterator[Finding]:
    """Some precursors stay alone until the force maximum, others do not."""
    for scene in _scenes(evidence.records, 0):
        yield Finding(
            place(scene),
            "share of the blocks detached before t_max around which no other had",
            mean(over_runs(lonely, evidence.records[scene])),
            (0.0, 1.0),
            _in_files(scene),
        )


def peak_before_average(evidence: Evidence) -> Iterator[Finding]:
    """t_max < t_avg on flat surfaces."""
    for scene in _scenes(evidence.summaries, 0):
        interval = mean(lag(evidence.summaries[scene]))
        yield Finding(place(scene), "t_max - t_avg", interval, NEGATIVE, _in_table(scene), "s")


def uniform(evidence: Evidence) -> Iterator[Finding]:
    """Place does not matter: within the core, and at the outermost blocks against the core."""
    for scene in _scenes(evidence.records, 0):
        n = scene.n_blocks
        from_edge = np.minimum(np.arange(n), np.arange(n)[::-1])
        depth = np.minimum.outer(from_edge, from_edge)
        core = depth >= min(_CORE, n // 4)
        times = np.stack([run.t_det for run in evidence.records[scene]])
        yield Finding(
            {"N": n, "part": "core"},
            "share of the variance of t_det that place explains (jackknife)",
            repeatability(times[:, core]),
            (-INF, _ALIKE),
            _in_files(scene),
        )
        late = [(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times]
        yield Finding(
            {"N": n, "part": "outermost blocks"},
            "mean t_det minus that of the core",
            mean_interval(late),
            (-_SMALL, _SMALL),
            _in_files(scene),
            "standard deviations of t_det",
        )


# Square pillars, section 3.2


def pillars_alike(evidence: Evidence) -> Iterator[Finding]:
    """It does not matter where on the surface a pillar stands."""
    for scene in _scenes(evidence.records, 1, _SMALLEST):
        starts, size = scene.pattern.origins, scene.n_p
        if len(starts) < 2:
            continue
        times = [
            [run.t_det[y : y + size, x : x + size].mean() for y, x in starts]
            for run in evidence.records[scene]
        ]
        yield Finding(
            place(scene),
            "share of the variance of a pillar's mean t_det that its place explains (jackknife)",
            repeatability(np.array(times)),
            (-INF, _ALIKE),
            _in_files(scene),
        )


def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    """Pillars with n_p <= 3 lie closer to the flat surface than to the next larger ones."""
    quantities: dict[str, Callable[[Record], float]] = {
        "(t_max - t_avg)/t_max": relative_lag,
        "precursors": precursors,
        "width of the force peak": width,
        "static friction": attrgetter("static_friction"),
    }
    for family in _families(evidence.records):
        flat = _flat(evidence.records, family[0].n_blocks)
        larger = next((s for s in family if s.n_p >= _SMALLEST), None)
        if flat is None or larger is None:
            continue
        scenes = [s for s in family if s.n_p < _SMALLEST]
        for scene in scenes:
            for name, quantity in quantities.items():
                samples = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, larger)]
                yield Finding(
                    place(scene) | {"quantity": name},
                    f"position between the flat surface, 0, and n_p = {larger.n_p}",
                    position(*samples),
                    (-0.5, 0.5),
                    _in_files(scene, flat, larger),
                )


def ring_times(runs: Sequence[Run], scene: Scene, depth: int) -> dict[str, Array]:
    """Mean t_det/t_max of parts of a ring and of the centre of a pillar, (k,), in claimed order.

    For sliding along x the edges across are the sides along y.
    """
    times, last = pillar_map(runs, scene.pattern), (scene.n_p - 1) // 2
    ring = pillar_ring(scene.n_p, depth)
    centre = np.logical_or.reduce(list(pillar_ring(scene.n_p, last).values()))
    parts = {
        "corners": ring["corners"],
        "edges across": ring["y"],
        "edges along": ring["x"],
        "centre": centre,
    }
    return {name: times[:, mask].mean(axis=1) for name, mask in parts.items()}


def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    """Corners, edges across, edges along, centre; on the edge and on the ring inside it."""
    for scene in _scenes(evidence.records, 1, _SMALLEST):
        for depth in (0, 1):
            if 2 * (depth + 1) >= scene.n_p:
                continue
            parts = ring_times(evidence.records[scene], scene, depth)
            for (early, before), (late, after) in pairwise(parts.items()):
                yield Finding(
                    place(scene) | {"distance from the edge": depth},
                    f"t_det/t_max of the {late} minus that of the {early}",
                    mean_interval(after - before),
                    POSITIVE,
                    _in_files(scene),
                )


def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    """All parts of the edge let go before the force maximum, and so do the blocks beside it."""
    for scene in _scenes(evidence.records, 1, _SMALLEST):
        for depth in (0, 1):
            if 2 * (depth + 1) >= scene.n_p:
                continue
            parts = ring_times(evidence.records[scene], scene, depth)
            for name in list(parts)[:-1]:
                yield Finding(
                    place(scene) | {"distance from the edge": depth},
                    f"t_det/t_max of the {name}",
                    mean_interval(parts[name]),
                    (-INF, 1.0),
                    _in_files(scene),
                )


def peak_after_average(evidence: Evidence) -> Iterator[Finding]:
    """t_max > t_avg on pillars, for each size and distance."""
    for scene in _scenes(evidence.summaries, 1, _SMALLEST):
        interval = mean(lag(evidence.summaries[scene]))
        yield Finding(place(scene), "t_max - t_avg", interval, POSITIVE, _in_table(scene), "s")


def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    """On pillars precursors are more, and begin longer before t_max, than on a flat surface."""
    for scene in _scenes(evidence.records, 1, 6):
        flat = _flat(evidence.records, scene.n_blocks)
        if flat is None:
            continue
        runs, reference = evidence.records[scene], evidence.records[flat]
        yield Finding(
            place(scene),
            "share of the contact blocks that detach before t_max, minus that of the flat surface",
            difference(over_runs(precursors, runs), over_runs(precursors, reference)),
            POSITIVE,
            _in_files(scene, flat),
        )
        yield Finding(
            place(scene),
            "t_max minus the first detachment time, minus that of the flat surface",
            difference(over_runs(warning, runs), over_runs(warning, reference)),
            POSITIVE,
            _in_files(scene, flat),
            "s",
        )


def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of pillars is wider than that of the flat surface."""
    for scene in _scenes(evidence.records, 1, 6):
        flat = _flat(evidence.records, scene.n_blocks)
        if flat is None:
            continue
        samples = [over_runs(width, evidence.records[s]) for s in (scene, flat)]
        yield Finding(
            place(scene),
            "time with a force above 95 % of its maximum over t_max, minus that of the flat "
            "surface",
            difference(*samples),
            POSITIVE,
            _in_files(scene, flat),
        )


def _lowest(samples: Mapping[Scene, Sample]) -> Scene:
    """Scene with the lowest mean."""
    return min(samples, key=lambda scene: float(mean(samples[scene]).mean))


def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    """Both the smallest and the largest pillars stick better than the ones that stick least."""
    for family in _families(evidence.summaries):
        if len(family) < 3:
            continue
        samples = {scene: static_friction(evidence.summaries[scene]) for scene in family}
        lowest = _lowest(samples)
        for end in (family[0], family[-1]):
            yield Finding(
                {"N": end.n_blocks, "n_s/n_p": str(_ratio(end))},
                f"static friction at n_p = {end.n_p} minus the lowest, at n_p = {lowest.n_p}",
                difference(samples[end], samples[lowest]),
                POSITIVE,
                _in_table(end, lowest),
            )


def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of the largest pillars is narrower than where static friction is lowest."""
    for family in _families(evidence.records):
        runs, largest = evidence.records, family[-1]
        lowest = _lowest({s: over_runs(attrgetter("static_friction"), runs[s]) for s in family})
        if len(family) < 3 or largest == lowest:
            continue
        samples = [over_runs(width, runs[s]) for s in (largest, lowest)]
        yield Finding(
            {"N": largest.n_blocks, "n_s/n_p": str(_ratio(largest))},
            f"time with a force above 95 % of its maximum over t_max, at n_p = {largest.n_p} "
            f"minus that at n_p = {lowest.n_p}",
            difference(*samples),
            NEGATIVE,
            _in_files(largest, lowest),
        )


# Correlation along the sides of pillars, section 3.2

_LENGTHS = ("n_p", "n_s", "n_p2", "n_s2")


def _interval(row: Row, name: str) -> Interval:
    return Interval(*(np.array(row[key]) for key in (name, "ci_low", "ci_high")))


def apart(first: Interval, second: Interval) -> Interval:
    """First - second; the errors add up, since tables do not say how they are correlated."""
    return Interval(first.mean - second.mean, first.low - second.high, first.high - second.low)


def _surfaces(rows: Iterable[Row], level: int, smallest: int = _SMALLEST) -> list[dict[str, int]]:
    """Lengths of the surfaces in a table of so many levels, sliding along x."""
    along = [row for row in rows if row["direction"] == _SLIDING_ALONG and row["n_p"] >= smallest]
    found = {tuple(row[key] for key in _LENGTHS) for row in along}
    surfaces = [dict(zip(_LENGTHS, lengths, strict=True)) for lengths in sorted(found)]
    return [s for s in surfaces if (s["n_p"] > 0) + (s["n_p2"] > 0) == level]


def _find(rows: Iterable[Row], **wanted: Any) -> Row | None:
    """The row with these values that slides along x; None without one."""
    wanted = {"direction": _SLIDING_ALONG, **wanted}
    return next((r for r in rows if all(r[key] == value for key, value in wanted.items())), None)


def _lengths(surface: Case) -> dict[str, Any]:
    return {key: value for key, value in surface.items() if value}


def _row_of(table: str, surface: Case, **more: Any) -> str:
    keys = ", ".join(f"{k} = {v}" for k, v in (_lengths(surface) | more).items())
    return f"tables/{table}: {keys}, direction = x"


def long_along_short_across(evidence: Evidence) -> Iterator[Finding]:
    """c_x is larger than c_y three blocks away; c_y falls below 1/e within one block."""
    rows = evidence.correlation
    for surface in _surfaces(rows, 1):
        along, across = (_find(rows, **surface, side=side, r=_FAR) for side in ("x", "y"))
        near = _find(rows, **surface, side="y", r=1)
        if along is None or across is None or near is None:
            continue
        both = (_interval(row, "correlation") for row in (along, across))
        yield Finding(
            _lengths(surface),
            f"c_x(r = {_FAR}) - c_y(r = {_FAR}) (sum of both intervals)",
            apart(*both),
            POSITIVE,
            _row_of("correlation", surface, r=_FAR),
        )
        yield Finding(
            _lengths(surface),
            "c_y(r = 1)",
            _interval(near, "correlation"),
            (-INF, float(np.exp(-1.0))),
            _row_of("correlation", surface, r=1, side="y"),
        )


def exponential(evidence: Evidence) -> Iterator[Finding]:
    """c_x(r) stays close to exp(-r/l_c) wherever that was fitted; the worst r is shown."""
    for surface in _surfaces(evidence.correlation_length, 1, _FEW):
        fit = _find(evidence.correlation_length, **surface, side="x")
        if fit is None:
            continue
        curve = [row for row in evidence.correlation if _on_side_along(row, surface)]
        fitted = [row for row in curve if max(1, fit["r_low"]) <= row["r"] <= fit["r_high"]]
        gaps = [
            apart(_interval(row, "correlation"), Interval(*[np.exp(-row["r"] / fit["l_c"])] * 3))
            for row in fitted
        ]
        if not gaps:
            continue
        worst = int(np.argmax([abs(gap.mean) for gap in gaps]))
        r = fitted[worst]["r"]
        yield Finding(
            _lengths(surface),
            f"c_x(r) - exp(-r/l_c), the largest in the range of the fit, at r = {r}",
            gaps[worst],
            (-_CLOSE, _CLOSE),
            _row_of("correlation", surface, r=r, side="x"),
        )


def _on_side_along(row: Row, surface: Case) -> bool:
    wanted = {**surface, "side": "x", "direction": _SLIDING_ALONG}
    return all(row[key] == value for key, value in wanted.items())


def three_blocks(evidence: Evidence) -> Iterator[Finding]:
    """l_c of c_x is three blocks or more."""
    for surface in _surfaces(evidence.correlation_length, 1, _FEW):
        fit = _find(evidence.correlation_length, **surface, side="x")
        if fit is not None:
            source = _row_of("correlation_length", surface, side="x")
            interval = _interval(fit, "l_c")
            yield Finding(_lengths(surface), "l_c of c_x", interval, (_FAR, INF), source, "blocks")


def growing_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c of the largest pillars is larger than that of the smallest it can be estimated for."""
    rows = evidence.correlation_length
    surfaces = _surfaces(rows, 1, _FEW)
    surfaces.sort(key=lambda s: (Fraction(s["n_s"], s["n_p"]), s["n_p"]))
    for ratio, family in groupby(surfaces, key=lambda s: Fraction(s["n_s"], s["n_p"])):
        ends = [_find(rows, **surface, side="x") for surface in family]
        first, last = ends[0], ends[-1]
        if first is None or last is None or first is last:
            continue
        yield Finding(
            {"n_s/n_p": str(ratio)},
            f"l_c at n_p = {last['n_p']} minus l_c at n_p = {first['n_p']} (sum of both intervals)",
            apart(_interval(last, "l_c"), _interval(first, "l_c")),
            POSITIVE,
            f"tables/correlation_length: n_p = {first['n_p']} and {last['n_p']}, side = x",
            "blocks",
        )


# Grooved pillars, section 3.3


def _grooved(evidence: Evidence, level: int = 2) -> list[tuple[dict[str, int], Scene, Scene]]:
    """Grooved surfaces that were slid both along and across: lengths and both scenes."""
    pairs = []
    for along in _scenes(evidence.records, level):
        across = next((s for s in evidence.records if _turned(s, along)), None)
        if across is not None:
            pairs.append((place(along), along, across))
    return pairs


def _turned(scene: Scene, along: Scene) -> bool:
    return (
        scene.direction == "y"
        and scene.folder.rpartition("/")[0] == (along.folder.rpartition("/")[0])
    )


def _peak_numbers(evidence: Evidence, level: int) -> Iterator[Finding]:
    for lengths, *scenes in _grooved(evidence, level):
        for scene, name, claimed in zip(
            scenes, ("along", "across"), ((1.5, 2.5), (0.5, 1.5)), strict=True
        ):
            yield Finding(
                lengths,
                f"load peaks of a run when sliding {name} the grooves, mean number",
                mean(over_runs(load_peak_number, evidence.records[scene])),
                claimed,
                _in_files(scene),
            )


def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Two load peaks along the grooves, one across."""
    return _peak_numbers(evidence, 2)


def further_levels(evidence: Evidence) -> Iterator[Finding]:
    """The same on surfaces with a third level."""
    return _peak_numbers(evidence, 3)


def _present(sample: Sample) -> dict[int, float]:
    return {seed: value for seed, value in sample.items() if np.isfinite(value)}


def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The second load peak is the higher one when sliding along the grooves."""
    for scene in _scenes(evidence.records, 2):
        sample = _present(over_runs(second_peak, evidence.records[scene]))
        if sample:
            yield Finding(
                place(scene),
                "force at the last load peak minus that at the first, over the normal force, in "
                "runs with several",
                mean(sample),
                POSITIVE,
                _in_files(scene),
            )


def rest_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks most of the core has yet to let go."""
    for scene in _scenes(evidence.records, 2):
        core = ~edge(scene.pattern.contact) & scene.pattern.contact
        runs = evidence.records[scene]
        sample = _present(over_runs(partial(resting_core, core=core), runs))
        if sample:
            yield Finding(
                place(scene),
                "share of the blocks off the edges yet to detach at the lowest force between the "
                "load peaks, in runs with several",
                mean(sample),
                (0.5, INF),
                _in_files(scene),
            )


def edge(contact: Mask) -> Mask:
    """Contact blocks beside a block, in one of the four directions, that is not in contact."""
    padded = np.pad(contact, 1)
    inside = padded[2:, 1:-1] & padded[:-2, 1:-1] & padded[1:-1, 2:] & padded[1:-1, :-2]
    return contact & ~inside


def edges_before_core(evidence: Evidence) -> Iterator[Finding]:
    """The edges let go before the rest, sliding along or across the grooves."""
    for lengths, *scenes in _grooved(evidence):
        for scene, name in zip(scenes, ("along", "across"), strict=True):
            contact = scene.pattern.contact
            edges = edge(contact)
            runs = evidence.records[scene]
            later = [
                (run.t_det[contact & ~edges].mean() - run.t_det[edges].mean()) / run.t_max
                for run in runs
            ]
            yield Finding(
                lengths | {"sliding": f"{name} the grooves"},
                "t_det/t_max of the core minus that of the edges",
                mean_interval(later),
                POSITIVE,
                _in_files(scene),
            )


def grooved_parts(scene: Scene) -> dict[str, Mask]:
    """Masks over a grooved pillar, [y_p, x_p], of its parts in the order of the paper."""
    (y, x), size = scene.pattern.origins[0], scene.n_p
    contact = scene.pattern.contact[y : y + size, x : x + size]
    edges, (rows, columns) = edge(contact), np.indices(contact.shape)
    transverse = contact & ((columns == 0) | (columns == size - 1))
    external = contact & ~transverse & ((rows == 0) | (rows == size - 1))
    internal = edges & ~transverse & ~external
    return {
        "transverse sides": transverse,
        "external longitudinal sides": external,
        "sides along the grooves": internal,
        "inside of the pawls": contact & ~edges,
    }


def grooved_order(evidence: Evidence) -> Iterator[Finding]:
    """Transverse sides, external longitudinal ones, those along the grooves, the inside."""
    for scene in _scenes(evidence.records, 2):
        times = pillar_map(evidence.records[scene], scene.pattern)
        parts = {name: times[:, mask].mean(axis=1) for name, mask in grooved_parts(scene).items()}
        for (early, before), (late, after) in pairwise(parts.items()):
            yield Finding(
                place(scene),
                f"t_det/t_max of the {late} minus that of the {early}",
                mean_interval(after - before),
                POSITIVE,
                _in_files(scene),
            )


def same_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c on grooved pillars lies within a block of that on whole ones of about their size."""
    rows = evidence.correlation_length
    whole = _surfaces(rows, 1, _FEW)
    for surface in _surfaces(rows, 2):
        like = min(whole, key=lambda s: abs(s["n_p"] - surface["n_p"]), default=None)
        pair = [_find(rows, **s, side="x") for s in (surface, like) if s is not None]
        fits = [row for row in pair if row is not None]
        if len(fits) == 2:
            yield Finding(
                _lengths(surface),
                f"l_c on grooved pillars minus l_c at n_p = {fits[1]['n_p']} without grooves "
                "(sum of both intervals)",
                apart(*(_interval(row, "l_c") for row in fits)),
                (-1.0, 1.0),
                f"{_row_of('correlation_length', surface, side='x')} and n_p = {fits[1]['n_p']}",
                "blocks",
            )


def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    """Static friction across the grooves exceeds that along them."""
    for lengths, along, across in _grooved(evidence):
        samples = [
            over_runs(attrgetter("static_friction"), evidence.records[scene])
            for scene in (across, along)
        ]
        yield Finding(
            lengths,
            "static friction across the grooves minus that along them",
            difference(*samples),
            POSITIVE,
            _in_files(across, along),
        )


# The model, section 2


def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The bias at h = 1e-8 s stays within the standard error of an ensemble, as in accuracy.md.

    Runge-Kutta with the friction of each stage is compared run by run: its error in static
    friction has no interval.
    """
    rows = [row for row in evidence.precision if row["step"] == STEP]
    paired = [row for row in rows if row["comparison"] == "paired"]
    plain = [row for row in rows if row["integrator"] == "plain rk4"]
    for row in paired + [r for r in plain if r["quantity"] == "static_friction"]:
        keys = {"comparison": "scatter", "scene": row["scene"], "quantity": row["quantity"]}
        scatter = [r for r in evidence.precision if all(r[k] == v for k, v in keys.items())]
        if not scatter:
            continue
        limit = standard_error(scatter[0])
        kind = "bias" if row["comparison"] == "paired" else "error"
        yield Finding(
            {key: row[key] for key in ("integrator", "scene", "quantity")},
            f"relative {kind} at h = {STEP:.0e} s",
            _interval(row, "error"),
            (-limit, limit),
            f"tables/work_precision: comparison = {row['comparison']}, step = {STEP:.0e}",
        )


FLAT = "realisations of the flat surface"
PILLARS = "realisations of pillars with n_p of 4 or more"
BOTH = "realisations of the flat surface and of pillars with n_p of 6 or more"
SIZES = "realisations of pillars of three sizes or more"
CORRELATION = "tables of correlation along the sides of pillars with n_p of 10 or more"
GROOVES = "realisations of a grooved surface"
WAYS = "realisations of a grooved surface that slides along and across its grooves"

STATEMENTS = (
    Claim(
        "Isolated precursors on flat surfaces",
        "3.1",
        "Slip precursors occur as single detachment events before the macroscopic sliding phase.",
        FLAT,
        isolated_precursors,
    ),
    Claim(
        "Not every precursor starts a front",
        "3.1",
        "Not all the precursors trigger a rupture wave front.",
        FLAT,
        not_all_nucleate,
    ),
    Claim(
        "t_max < t_avg on flat surfaces",
        "3.1",
        "The force maximum occurs before the average detachment time.",
        FLAT,
        peak_before_average,
    ),
    Claim(
        "Detachment times are uniform on flat surfaces",
        "3.2",
        "In repeated simulations the spatial distribution of the initial detachment time is "
        "uniform.",
        f"three {FLAT} or more",
        uniform,
    ),
    Claim(
        "All pillars are alike",
        "3.2",
        "With a margin of n_s/2 all pillars have the same average statistical properties for "
        "n_p >= 4.",
        "realisations of several pillars with n_p of 4 or more",
        pillars_alike,
    ),
    Claim(
        "Pillars with n_p <= 3 behave like a flat surface",
        "3.2",
        "For n_p <= 3 the transition to sliding is similar to that of a non-patterned surface. "
        "The paper says so of the transition; of static friction it allows that it differs.",
        "realisations of the flat surface, of pillars with n_p <= 3 and of larger ones",
        small_pillars,
    ),
    Claim(
        "Order of detachment on a pillar",
        "3.2",
        "Corners detach first, then boundaries perpendicular to the sliding direction, then "
        "parallel ones; the same on the blocks adjacent to them; the centre comes last.",
        PILLARS,
        detachment_order,
    ),
    Claim(
        "Edges detach before the force maximum",
        "3.2",
        "The detachments on the borders and on the blocks adjacent to them occur before the "
        "maximum of the friction force.",
        PILLARS,
        edges_before_peak,
    ),
    Claim(
        "t_max > t_avg on pillars",
        "3.2",
        "The force peak always occurs after the average detachment time.",
        PILLARS,
        peak_after_average,
    ),
    Claim(
        "More and earlier precursors on pillars",
        "3.2",
        "For n_p >= 6 the sliding precursors are numerically relevant and occur for a larger time "
        "interval before t_max.",
        BOTH,
        many_precursors,
    ),
    Claim(
        "Rounded force peak on pillars",
        "3.2",
        "The force is no longer a sharp peak, and becomes rounded.",
        BOTH,
        rounded_peak,
    ),
    Claim(
        "Lowest static friction at an intermediate n_p",
        "3.2",
        "The smallest static friction is obtained for a specific intermediate value of n_p; for "
        "very large pillars it increases again.",
        SIZES,
        intermediate_size,
    ),
    Claim(
        "Sharper transition of very large pillars",
        "3.2",
        "For very large pillars the transition is sharper than where static friction is lowest.",
        SIZES,
        sharper_again,
    ),
    Claim(
        "c_x has a long range, c_y a short one",
        "3.2",
        "While c_y(r) decreases rapidly, c_x(r) displays a correlation over a wide range.",
        CORRELATION,
        long_along_short_across,
    ),
    Claim(
        "Exponential decay of c_x",
        "3.2",
        "The correlation functions decrease exponentially, c_x(r) ~ exp(-r/l_c).",
        CORRELATION,
        exponential,
    ),
    Claim(
        "Correlation length of three blocks or more",
        "3.2",
        "l_c/l >= 3 where it can be estimated, for n_p of 10 or more.",
        CORRELATION,
        three_blocks,
    ),
    Claim(
        "Correlation length grows with n_p",
        "3.2",
        "l_c is slightly increasing with n_p.",
        f"{CORRELATION} and two sizes",
        growing_length,
    ),
    Claim(
        "Two load peaks along grooves, one across",
        "3.3",
        "Two load peaks appear only if the grooves are aligned with the sliding direction.",
        WAYS,
        two_peaks,
    ),
    Claim(
        "The second load peak sets static friction",
        "3.3",
        "The global static friction is determined by the force reached at the second load peak.",
        f"{GROOVES} with two load peaks",
        second_peak_decides,
    ),
    Claim(
        "The core rests between the load peaks",
        "4",
        "In the phase between load peaks the internal regions are still at rest.",
        f"{GROOVES} with two load peaks",
        rest_between_peaks,
    ),
    Claim(
        "Edges detach before the core of grooved pillars",
        "3.3",
        "Edge regions and internal core have distinct dynamics; the boundary regions detach first.",
        WAYS,
        edges_before_core,
    ),
    Claim(
        "Order of detachment on a grooved pillar",
        "3.3",
        "Transversal sides detach first, then the external longitudinal ones, then the internal "
        "ones along the grooves, then the internal regions of the pawls.",
        GROOVES,
        grooved_order,
    ),
    Claim(
        "Grooves leave the correlation length unchanged",
        "3.3",
        "The typical correlation length along the longitudinal edges is the same.",
        f"{CORRELATION}, with grooves and without",
        same_length,
    ),
    Claim(
        "The effects remain with a further level",
        "3.3",
        "We expect that these effects remain present when adding further hierarchical levels. "
        "Tested: two load peaks along grooves, one across.",
        f"{WAYS}, with a third level",
        further_levels,
    ),
    Claim(
        "Static friction is greater across grooves than along",
        "1",
        "Static friction is greater when the grooves are perpendicular to the sliding direction. "
        "A result of the authors' paper of 2018, J. Mech. Phys. Solids 112, 50 (arXiv:1706.08055), "
        "for grooves that cross the whole surface; here they divide pillars.",
        WAYS,
        across_sticks_better,
    ),
    Claim(
        "A step of 1e-8 s suffices",
        "2",
        "h = 1e-8 s reduces integration errors under the statistical uncertainty. Tested: bias "
        'within one standard error of an ensemble of 20. "plain rk4" is Runge-Kutta with the '
        "friction of each stage.",
        "the table `work_precision`",
        step_suffices,
    ),
)
