"""Pillars of one length scale: the order of detachment, and the effect of pillar size.

Section 3.2 of the paper; all pillars have n_s = n_p.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import product
from operator import attrgetter

import numpy as np

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.estimate import AnyOf, Estimate
from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import pillar_map, pillar_ring, repeatability
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Case, Evidence, Finding
from springblock.claims.samples import Quantity, found_on, mean_over, over_runs, share_over
from springblock.claims.surfaces import Mask, pillars, pillars_of
from springblock.io.records import Record
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.run import Run

_OUTER = 2  #: outermost rings: the border and the blocks adjacent to it
_BROAD = 20  #: n_p from which on the outermost rings enclose most blocks
_PATCH = 3  #: side of the patch taken as a nucleation point, blocks
#: Parts of a ring in the paper's order of detachment, for sliding along x.
_RING = {"corners": "corners", "y": "edges along y", "x": "edges along x"}
_PRECURSORS = "the share of contact blocks that detach before t_max"
_WIDTH = "the width of the force peak"
_RELEVANT = 6  #: n_p from which on the paper finds precursors “numerically relevant”
_LARGE = 60  #: n_p of the paper's example of very large pillars
_SCATTER = "mu_static_std"
_COMPARED = (3, 6, 10, 20, 30)  #: n_p of pillars whose thresholds scatter less and more

_broad = partial(pillars, smallest=_BROAD)
_large = partial(pillars, smallest=_LARGE)


def pillars_alike(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of the variance of a pillar's mean t_det explained by position (jackknife)"
    for scene, runs in pillars(evidence.records).items():
        times = np.array([[part.mean() for part in pillars_of(r.t_det, scene)] for r in runs])
        if times.shape[1] >= 2:
            by_place = Estimate.of(repeatability(times), len(times))
            yield found_on(scene, name, by_place, ranges.ALIKE)


def _rings(n_p: int) -> Iterator[tuple[str, dict[str, Mask]]]:
    """Yield the border of a pillar and the second ring, as far as the pillar has them.

    Each with masks over the pillar, (n_p, n_p), of its parts and of the centre, in the paper's
    order of detachment.
    """
    centre = np.logical_or.reduce(list(pillar_ring(n_p, (n_p - 1) // 2).values()))
    for depth, name in enumerate(("border", "second ring")):
        if 2 * (depth + 1) < n_p:
            ring = pillar_ring(n_p, depth)
            parts = {called: ring[side] for side, called in _RING.items()}
            yield name, parts | {"centre": centre}


def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    for scene, runs in pillars(evidence.records).items():
        maps = pillar_map(runs, scene.pattern)
        for ring, parts in _rings(scene.n_p):
            names = [f"{name} ({ring})" for name in _RING.values()] + ["centre"]
            means = [maps[:, mask].mean(axis=1) for mask in parts.values()]
            times = dict(zip(names, means, strict=True))
            yield from samples.in_order(scene, times)


@share_over(
    pillars, "the share of pillars whose parts detach in this order (mean t_det)", ranges.NEARLY_ALL
)
def always_in_order(run: Record) -> float:
    rings = [list(parts.values()) for _, parts in _rings(run.scene.n_p)]
    ordered = [
        all(np.all(np.diff([pillar[part].mean() for part in parts]) > 0.0) for parts in rings)
        for pillar in pillars_of(run.t_det, run.scene)
    ]
    return float(np.mean(ordered))


def early_near_border(run: Record) -> float:
    """Return the share of the blocks in the two outermost rings that detach before t_max."""
    early = np.stack(pillars_of(run.t_det < run.t_max, run.scene))
    return float(early[:, surfaces.from_edge(run.scene.n_p) < _OUTER].mean())


def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    blocks = "the share of blocks on the border or adjacent to it that detach before t_max"
    for scene, runs in pillars(evidence.records).items():
        case = replace(surfaces.case_of(scene), part="single blocks")
        share = samples.share(over_runs(early_near_border, runs))
        yield found_on(scene, blocks, share, ranges.NEARLY_ALL, case=case)
    for scene, runs in pillars(evidence.records).items():
        case = replace(surfaces.case_of(scene), part="mean times")
        *_, (ring, parts) = _rings(scene.n_p)
        last = pillar_map(runs, scene.pattern)[:, parts[_RING["x"]]].mean(axis=1)
        name = f"t_det/t_max of the edges along x ({ring})"
        yield found_on(scene, name, samples.mean(last), (-ranges.INF, 1.0), case=case)


def near_border(run: Record) -> float:
    """Return the share of the precursors on the border of a pillar or adjacent to it."""
    early = np.stack(pillars_of(run.t_det < run.t_max, run.scene))
    border = surfaces.from_edge(run.scene.n_p) < _OUTER
    return samples.share_of(np.broadcast_to(border, early.shape), early)


def region_of_precursors(evidence: Evidence) -> Iterator[Finding]:
    for scene, runs in pillars(evidence.records).items():
        for what, quantity, claimed in (
            ("on the border or adjacent to it", near_border, ranges.MOST),
            ("isolated", samples.isolated, ranges.FEWER_THAN_HALF),
        ):
            name = f"the share of the blocks detached before t_max that are {what}"
            yield found_on(scene, name, samples.share(over_runs(quantity, runs)), claimed)


def inside(run: Record) -> Array:
    """Return t_det inside the outermost rings, (pillars, n_p - 4, n_p - 4) s."""
    inner = slice(_OUTER, -_OUTER)
    return np.stack([part[inner, inner] for part in pillars_of(run.t_det, run.scene)])


@share_over(
    _broad,
    "the share of positions enclosed by the two outermost rings that lie further out than the "
    f"first {_PATCH} x {_PATCH} patch to detach",
    (-ranges.INF, 0.25),
)
def nucleation_near_edge(run: Record) -> float:
    return float(np.mean([samples.first_patch(pillar, _PATCH) for pillar in inside(run)]))


def centre_last(evidence: Evidence) -> Iterator[Finding]:
    around = "the area between it and the two outermost rings"
    name = f"t_det/t_max of the central part minus that of {around}"
    for scene, runs in pillars(evidence.records, 10).items():
        times = np.stack([(inside(run) / run.t_max).mean(axis=0) for run in runs])
        wide = times.shape[-1]
        middle = surfaces.from_edge(wide) >= wide // 4
        later = samples.mean(times[:, middle].mean(axis=1) - times[:, ~middle].mean(axis=1))
        yield found_on(scene, name, later, ranges.POSITIVE)


@mean_over(pillars, "t_max - t_avg", ranges.POSITIVE, unit="s")
def peak_after_average(run: Record) -> float:
    return run.t_max - run.t_avg


@share_over(
    _large,
    "the share of blocks enclosed by the two outermost rings that detach after t_max",
    ranges.NEARLY_ALL,
)
def front_after_peak(run: Record) -> float:
    return float(np.mean(inside(run) > run.t_max))


def warning(run: Run) -> float:
    """Return the time from the first detachment to t_max, over t_max.

    Absolute times grow with the normal force on a block, which is larger on pillars.
    """
    return 1.0 - float(np.nanmin(run.t_det)) / run.t_max


def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    quantities: Mapping[str, Quantity] = {
        "(t_max - t_avg)/t_max": samples.relative_lag,
        "the share of precursors": samples.before_peak,
        _WIDTH: samples.width,
    }
    small = [scene for scene in pillars(evidence.records, 0) if scene.n_p < surfaces.SMALLEST]
    larger = pillars(evidence.records)
    for flat, scene, other in product(surfaces.flat(evidence.records), small, larger):
        case = Case(n_p=scene.n_p, against_n_p=other.n_p)
        for name, quantity in quantities.items():
            three = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, other)]
            away = samples.magnitude(samples.position(*three))
            statistic = (
                f"{name} minus that on the flat surface, over this difference at larger n_p "
                "(magnitudes)"
            )
            claimed, beside = ranges.FEWER_THAN_HALF, (flat, other)
            yield found_on(scene, statistic, away, claimed, case=case, beside=beside)


def _above_flat(evidence: Evidence, quantities: Mapping[str, Quantity]) -> Iterator[Finding]:
    """Yield the excess of each quantity on pillars over that on the flat surface."""
    flats = surfaces.flat(evidence.records)
    for flat, scene in product(flats, pillars(evidence.records, _RELEVANT)):
        for name, quantity in quantities.items():
            statistic = f"{name}, minus that on the flat surface"
            yield samples.compared(evidence, statistic, quantity, scene, flat)


def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    time = "the time between the first detachment and t_max, over t_max"
    return _above_flat(evidence, {_PRECURSORS: samples.before_peak, time: warning})


def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    return _above_flat(evidence, {f"{_WIDTH}, over t_max": samples.width})


def _lowest(evidence: Evidence, scenes: Iterable[Scene]) -> Lowest:
    """Return the scene with the lowest mean static friction, and those that may have the lowest."""
    return lowest({scene: samples.friction(evidence, scene) for scene in scenes})


def _of_all_sizes(evidence: Evidence) -> list[Scene]:
    """Return pillars by size, if there are three sizes or more, the smallest with n_p <= 3."""
    found = list(pillars(evidence.records, 0))
    return found if len(found) >= 3 and found[0].n_p < surfaces.SMALLEST else []


def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    scenes = _of_all_sizes(evidence)
    # The same runs determine the size of the minimum, which overrates small differences.
    for end in (scenes[0], scenes[-1]) if scenes else ():
        best = _lowest(evidence, scenes[1:-1]).place
        name = f"static friction at n_p = {end.n_p} minus that at n_p = {best.n_p}, the lowest mean"
        yield samples.compared(evidence, name, samples.static_friction, end, best, case=Case())


def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    scenes = _of_all_sizes(evidence)
    if scenes:
        best, largest = _lowest(evidence, scenes[:-1]).place, scenes[-1]
        name = f"{_WIDTH}, over t_max, at n_p = {largest.n_p} minus that at n_p = {best.n_p}"
        narrower, case = ranges.NEGATIVE, Case()
        yield samples.compared(evidence, name, samples.width, largest, best, narrower, case)


@share_over(_large, _PRECURSORS, ranges.NEGLIGIBLE)
def negligible_edges(run: Record) -> float:
    return samples.before_peak(run)


def _by_scatter(evidence: Evidence) -> dict[float, list[Scene]]:
    """Return pillars by the scatter of mu_static, where all sizes to be compared are there."""
    groups: dict[float, list[Scene]] = {}
    for scene in evidence.records:
        others = surfaces.own_constants(evidence.records, scene).keys() - {_SCATTER}
        if scene.level == 1 and scene.n_p == scene.n_s in _COMPARED and not others:
            groups.setdefault(scene.mu_static_std, []).append(scene)
    return {s: scenes for s, scenes in sorted(groups.items()) if len(scenes) == len(_COMPARED)}


def size_like_length(evidence: Evidence) -> Iterator[Finding]:
    found = _sizes_over_length(evidence)
    yield from sorted(found, key=attrgetter("case.fit"))  # all scatters are one case


def _sizes_over_length(evidence: Evidence) -> Iterator[Finding]:
    """Yield the size of lowest static friction over l_c for each scatter and each fit."""
    for scatter, scenes in _by_scatter(evidence).items():
        broad = max(scenes, key=lambda s: s.n_p)
        own = surfaces.own_constants(evidence.records, broad)
        candidates = scenes if own else _of_all_sizes(evidence)
        runs = evidence.records[broad]
        sizes = [scene.n_p for scene in _lowest(evidence, candidates).alike]
        fit = Correlation(side_times(runs, broad.pattern, surfaces.ALONG)).length()
        minimum = f"n_p = {' or '.join(map(str, sizes))}"
        name = (
            f"the size of lowest static friction ({minimum}) over l_c at n_p = {broad.n_p}, with "
            f"{_SCATTER} = {scatter:g}"
        )
        for curve, fitted in ((ranges.PLAIN, fit.fitted), (ranges.SCALED, fit.tail)):
            value, low, high = map(float, fitted)
            ratios = [Estimate(n_p / value, n_p / high, n_p / low, len(runs)) for n_p in sizes]
            source = surfaces.in_files(*dict.fromkeys([*candidates, broad]))
            yield Finding(Case(fit=curve), name, AnyOf.these(*ratios), ranges.COMPARABLE, source)


def _over_t_avg(quantity: Quantity) -> Quantity:
    """Divide a time by t_avg in place of t_max.

    Where there are two load peaks, t_max is that of either.
    """
    return lambda run: quantity(run) * run.t_max / run.t_avg


def _larger_there(
    evidence: Evidence, name: str, quantity: Quantity, every: bool = False
) -> Iterator[Finding]:
    """Yield a quantity where static friction is lowest minus that on other pillars.

    The others are the smallest and the largest pillars, or those of `every` size. If several sizes
    may have the lowest friction, the interval encloses those of all; it has no upper end for these
    sizes themselves, and where the intervals differ in sign.
    """
    scenes = _of_all_sizes(evidence)
    candidates = _lowest(evidence, scenes).alike if scenes else []
    sizes = " or ".join(str(scene.n_p) for scene in candidates)
    there = f"{name}, at the n_p of lowest static friction ({sizes})"
    others = scenes if every else scenes[:1] + scenes[-1:]
    for other in (scene for scene in others if candidates != [scene]):
        sample = over_runs(quantity, evidence.records[other])
        there_too = [over_runs(quantity, evidence.records[s]) for s in candidates if s != other]
        found = [samples.difference(each, sample) for each in there_too]
        joint = AnyOf.these(*found)
        if other in candidates or (found[1:] and joint.ci_low <= 0.0 < joint.ci_high):
            # which candidate it is decides, not the number of realisations
            joint = AnyOf.these(*found, replace(found[0], ci_high=ranges.INF))
        source = surfaces.in_files(*candidates, other)
        statistic = f"{there}, minus that at n_p = {other.n_p}"
        yield Finding(surfaces.case_of(other), statistic, joint, ranges.POSITIVE, source)


def most_precursors(evidence: Evidence) -> Iterator[Finding]:
    return _larger_there(evidence, _PRECURSORS, samples.before_peak, every=True)


def roundest_peak(evidence: Evidence) -> Iterator[Finding]:
    return _larger_there(evidence, f"{_WIDTH}, over t_avg", _over_t_avg(samples.width))


def longest_transition(evidence: Evidence) -> Iterator[Finding]:
    name = "the duration of the transition, over t_avg"
    return _larger_there(evidence, name, _over_t_avg(samples.lasting))
