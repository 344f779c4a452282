"""Pillars of one length scale: the order of detachment, and the effect of pillar size.

Section 3.2 of the paper; all pillars have n_s = n_p.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise, product
from operator import attrgetter

import numpy as np

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.estimate import AnyOf, Estimate
from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import pillar_map, pillar_ring
from springblock.io.records import Record
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.run import Run
from springblock.study.claims import rule, samples, surfaces
from springblock.study.claims.rule import Case, Evidence, Finding, tests_statement
from springblock.study.claims.samples import Quantity, on_each, over_runs, share_on_each
from springblock.study.claims.surfaces import Mask, case_of, core, pillars, pillars_of

#: Parts of a ring in the paper's order of detachment, for sliding along x.
_RING = {"corners": "corners", "y": "edges along y", "x": "edges along x"}
_PRECURSORS = "the share of contact blocks that detach before t_max"
_WIDTH = "the width of the force peak"
_RELEVANT = 6  #: n_p from which on the paper finds precursors “numerically relevant”
_LARGE = 60  #: n_p of the paper's example of very large pillars
_SCATTER = "mu_static_std"
_COMPARED = (3, 6, 10, 20, 30)  #: n_p of pillars whose thresholds scatter less and more


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


def _in_order(scene: Scene, runs: Sequence[Record], case: Case) -> Iterator[Finding]:
    """Yield the mean delay of each part of a pillar after the one before, for each ring."""
    maps = pillar_map(runs, scene.pattern)
    for ring, parts in _rings(scene.n_p):
        names = [f"{name} ({ring})" for name in _RING.values()] + ["centre"]
        times = [maps[:, mask].mean(axis=1) for mask in parts.values()]
        for (early, before), (late, after) in pairwise(zip(names, times, strict=True)):
            statistic = f"t_det/t_max of the {late} minus that of the {early}"
            later = samples.mean(after - before)
            yield Finding(case, statistic, later, rule.POSITIVE, [scene])


@tests_statement
def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    for scene, runs in pillars(evidence.records).items():
        yield from _in_order(scene, runs, case_of(scene))


def in_order(run: Record) -> float:
    """Return the share of pillars whose parts detach in the paper's order, by mean t_det."""
    rings = [list(parts.values()) for _, parts in _rings(run.scene.n_p)]
    ordered = [
        all(np.all(np.diff([pillar[part].mean() for part in parts]) > 0.0) for parts in rings)
        for pillar in pillars_of(run.t_det, run.scene)
    ]
    return float(np.mean(ordered))


@tests_statement
def always_in_order(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of pillars whose parts detach in this order (mean t_det)"
    every, claimed = pillars(evidence.records), rule.NEARLY_ALL
    yield from share_on_each(every, name, in_order, claimed, part="single pillars")
    for scatter, scenes in _by_scatter(evidence).items():
        own = surfaces.own_constants(evidence.records, scenes[0])
        for scene in (s for s in scenes if own and s.n_p >= surfaces.SMALLEST):
            case = case_of(scene, part="mean times", constant=_SCATTER, constant_value=scatter)
            yield from _in_order(scene, evidence.records[scene], case)


def border(run: Run) -> Mask:
    """Return the blocks on the border of pillars and those adjacent to it, (N, N)."""
    return run.contact & ~core(core(run.contact))


def early_near_border(run: Run) -> float:
    """Return the share of the blocks in the two outermost rings that detach before t_max."""
    return samples.share_of(run.t_det < run.t_max, border(run))


def near_border(run: Run) -> float:
    """Return the share of the precursors in the two outermost rings of pillars."""
    return samples.share_of(border(run), run.t_det < run.t_max)


@tests_statement
def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    blocks = "the share of blocks on the border or adjacent to it that detach before t_max"
    every, claimed = pillars(evidence.records), rule.NEARLY_ALL
    yield from share_on_each(every, blocks, early_near_border, claimed, part="single blocks")
    for scene, runs in every.items():
        *_, (ring, parts) = _rings(scene.n_p)
        last = samples.mean(pillar_map(runs, scene.pattern)[:, parts[_RING["x"]]].mean(axis=1))
        case, name = case_of(scene, part="mean times"), f"t_det/t_max of the edges along x ({ring})"
        yield Finding(case, name, last, (-rule.INF, 1.0), [scene])


@tests_statement
def region_of_precursors(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of the blocks detached before t_max that are"
    where = f"{name} on the border or adjacent to it", near_border, rule.MOST
    alone = f"{name} isolated", samples.isolated, rule.FEWER_THAN_HALF
    for (scene, runs), one in product(pillars(evidence.records).items(), (where, alone)):
        yield from share_on_each({scene: runs}, *one)


@tests_statement
def peak_after_average(evidence: Evidence) -> Iterator[Finding]:
    return on_each(pillars(evidence.records), "t_max - t_avg", samples.lag, rule.POSITIVE, "s")


def warning(run: Run) -> float:
    """Return the time from the first detachment to t_max, over t_max."""
    return 1.0 - run.t_first / run.t_max


@tests_statement
def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    quantities: Mapping[str, Quantity] = {
        "(t_max - t_avg)/t_max": samples.relative_lag,
        "the share of precursors": samples.before_peak,
        _WIDTH: samples.width,
    }
    over = "minus that on the flat surface, over this difference at larger n_p (magnitudes)"
    small = [scene for scene in pillars(evidence.records, 0) if scene.n_p < surfaces.SMALLEST]
    larger = pillars(evidence.records)
    for flat, scene, other in product(surfaces.flat(evidence.records), small, larger):
        case, source = Case(scene.n_p, other.n_p), [scene, flat, other]
        for name, quantity in quantities.items():
            three = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, other)]
            away = abs(samples.position(*three))
            yield Finding(case, f"{name} {over}", away, rule.FEWER_THAN_HALF, source)


@tests_statement
def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    time = "the time between the first detachment and t_max, over t_max"
    flats, larger = surfaces.flat(evidence.records), pillars(evidence.records, _RELEVANT)
    for flat, scene in product(flats, larger):
        for name, quantity in ((_PRECURSORS, samples.before_peak), (time, warning)):
            statistic = f"{name}, minus that on the flat surface"
            yield samples.compared(evidence, statistic, quantity, (scene, flat))


def _lowest(evidence: Evidence, scenes: Iterable[Scene]) -> Lowest:
    """Return the scene with the lowest mean static friction, and those that may have the lowest."""
    return lowest({s: over_runs(samples.static_friction, evidence.records[s]) for s in scenes})


def _of_all_sizes(evidence: Evidence) -> list[Scene]:
    """Return pillars by size, if there are three sizes or more, the smallest with n_p <= 3."""
    found = list(pillars(evidence.records, 0))
    return found if len(found) >= 3 and found[0].n_p < surfaces.SMALLEST else []


@tests_statement
def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    scenes = _of_all_sizes(evidence)
    # The same runs determine the size of the minimum, which overrates small differences.
    for end in (scenes[0], scenes[-1]) if scenes else ():
        best = _lowest(evidence, scenes[1:-1]).place
        name = f"static friction at n_p = {end.n_p} minus that at n_p = {best.n_p}, the lowest mean"
        pair = end, best
        yield samples.compared(evidence, name, samples.static_friction, pair, case=Case())


@tests_statement
def negligible_edges(evidence: Evidence) -> Iterator[Finding]:
    large = pillars(evidence.records, _LARGE)
    return share_on_each(large, _PRECURSORS, samples.before_peak, rule.NEGLIGIBLE)


def _by_scatter(evidence: Evidence) -> dict[float, list[Scene]]:
    """Return pillars by the scatter of mu_static, where all sizes to be compared are there."""
    groups: dict[float, list[Scene]] = {}
    for scene in evidence.records:
        others = surfaces.own_constants(evidence.records, scene).keys() - {_SCATTER}
        if scene.level == 1 and scene.n_p == scene.n_s in _COMPARED and not others:
            groups.setdefault(scene.mu_static_std, []).append(scene)
    return {s: scenes for s, scenes in sorted(groups.items()) if len(scenes) == len(_COMPARED)}


@tests_statement
def size_like_length(evidence: Evidence) -> Iterable[Finding]:
    """Compare the size of lowest static friction with l_c, for each scatter and each fit."""
    found = []
    for scatter, scenes in _by_scatter(evidence).items():
        own = surfaces.own_constants(evidence.records, scenes[0])
        candidates = scenes if own else _of_all_sizes(evidence)
        sizes = [scene.n_p for scene in _lowest(evidence, candidates).alike]
        broad = max(scenes, key=attrgetter("n_p"))
        runs, behind = evidence.records[broad], dict.fromkeys([*candidates, broad])
        fit = Correlation(side_times(runs, broad.pattern, surfaces.ALONG)).length()
        where = f"l_c at n_p = {broad.n_p}, with {_SCATTER} = {scatter:g}"
        minimum = f"n_p = {' or '.join(map(str, sizes))}"
        name = f"the size of lowest static friction ({minimum}) over {where}"
        for curve, fitted in ((surfaces.PLAIN, fit.fitted), (surfaces.SCALED, fit.tail)):
            value, low, high = map(float, fitted)
            ratios = [Estimate(n_p / value, n_p / high, n_p / low, len(runs)) for n_p in sizes]
            any_size, case = AnyOf.these(*ratios), Case(fit=curve)
            found.append(Finding(case, name, any_size, rule.COMPARABLE, behind))
    return sorted(found, key=attrgetter("case.fit"))  # all scatters are one case


def _over_t_avg(quantity: Quantity, runs: Iterable[Record]) -> Array:
    """Return a time over t_avg, (k,); t_max is the time of either of two load peaks."""
    return over_runs(lambda run: quantity(run) * run.t_max / run.t_avg, runs)


@tests_statement
def rounder_and_longer(evidence: Evidence) -> Iterator[Finding]:
    """Compare pillars of lowest static friction with the smallest and the largest.

    If several sizes may have the lowest friction, the interval encloses the differences of all; it
    has no upper end for these sizes themselves, and where the intervals differ in sign.
    """
    scenes, records = _of_all_sizes(evidence), evidence.records
    candidates = _lowest(evidence, scenes).alike if scenes else []
    sizes = " or ".join(str(scene.n_p) for scene in candidates)
    there = f"over t_avg, at the n_p of lowest static friction ({sizes}), minus that at n_p ="
    quantities = {_WIDTH: samples.width, "the duration of the transition": samples.lasting}
    ends = [scene for scene in scenes[:1] + scenes[-1:] if candidates != [scene]]
    for (name, quantity), other in product(quantities.items(), ends):
        sample = _over_t_avg(quantity, records[other])
        others = (_over_t_avg(quantity, records[each]) for each in candidates if each != other)
        found = [samples.difference(each, sample) for each in others]
        joint = AnyOf.these(*found)
        if other in candidates or (found[1:] and joint.ci_low <= 0.0 < joint.ci_high):
            # which candidate it is decides, not the number of realisations
            joint = AnyOf.these(*found, replace(found[0], ci_high=rule.INF))
        case = case_of(other, part=name.removeprefix("the "))
        statistic, behind = f"{name}, {there} {other.n_p}", [*candidates, other]
        yield Finding(case, statistic, joint, rule.POSITIVE, behind)
