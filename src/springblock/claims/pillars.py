"""Pillars of one length scale: edges first, the force maximum late, and what their size changes.

Section 3.2 of the paper; all pillars have n_s = n_p.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import pillar_map, pillar_ring, repeatability
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import Quantity, found_on, mean_over, over_runs, share_over
from springblock.claims.surfaces import Mask, pillars, pillars_of
from springblock.io.records import Record
from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_BORDER = 2  #: blocks from the edge: those on the border and those beside them
_BROAD = 20  #: n_p from which on most blocks of a pillar are not of its border
_CORE = 10  #: n_p from which on a pillar has an inside in which places differ
_PATCH = 3  #: blocks, side of the patch that counts as a nucleation point
#: Parts of a ring in the paper's order; for sliding along x the edges across are the sides along y.
_RING = {"corners": "corners", "y": "edges across", "x": "edges along"}
_OUTER_QUARTER = (-ranges.INF, 0.25)  #: of a pillar's inside, near the edge
_PILLARS = "realisations of pillars with n_p of 4 or more"
_SEVERAL = "realisations of several pillars with n_p of 4 or more"
_CORED_PILLARS = f"realisations of pillars with n_p of {_CORE} or more"
_BROAD_PILLARS = f"realisations of pillars with n_p of {_BROAD} or more"
_PRECURSORS = "share of the contact blocks that detach before t_max"
_SUPPORTED = "time with a force above 95 % of its maximum"
_WIDTH = f"{_SUPPORTED} over t_max"
_DURATION = "time between a tenth and nine tenths of the detachments"
_RELEVANT = 6  #: n_p from which on the paper finds precursors numerically relevant
_LARGE = 60  #: n_p of the paper's example of very large pillars
_SMALL = "realisations of the flat surface, of pillars with n_p <= 3 and of larger ones"
_LARGEST = f"realisations of pillars with n_p of {_LARGE} or more"
_BOTH = "realisations of the flat surface and of pillars with n_p of 6 or more"
_SIZES = "realisations of pillars of three sizes or more, from n_p = 3 or less on"
_SCATTER = "mu_static_std"
_COMPARED = (3, 6, 10, 20, 30)  #: n_p of pillars whose thresholds scatter less and more
_SCATTERS = f"realisations of pillars with n_p of {', '.join(map(str, _COMPARED))} and more scatter"

_broad = partial(pillars, smallest=_BROAD)
_large = partial(pillars, smallest=_LARGE)


@claim("All pillars are alike", "3.2", 4, _SEVERAL, "universal")
def pillars_alike(evidence: Evidence) -> Iterator[Finding]:
    """With a margin of n_s/2 all pillars have the same average statistical properties for
    n_p >= 4.

    Tested: place explains less than a fifth of the variance of a pillar's mean t_det.
    """
    name = "share of the variance of a pillar's mean t_det that its place explains (jackknife)"
    for scene, runs in pillars(evidence.records).items():
        times = np.array([[part.mean() for part in pillars_of(r.t_det, scene)] for r in runs])
        if times.shape[1] >= 2:
            by_place = Estimate.of(repeatability(times), len(times))
            yield found_on(scene, name, by_place, ranges.ALIKE)


def _rings(n_p: int) -> Iterator[tuple[str, dict[str, Mask]]]:
    """The border of a pillar and the ring inside it, where they have parts.

    Each with masks over the pillar, (n_p, n_p), of its parts and of the centre, in claimed order.
    """
    centre = np.logical_or.reduce(list(pillar_ring(n_p, (n_p - 1) // 2).values()))
    for depth, name in enumerate(("border", "ring inside it")):
        if 2 * (depth + 1) < n_p:
            ring = pillar_ring(n_p, depth)
            parts = {called: ring[side] for side, called in _RING.items()}
            yield name, parts | {"centre": centre}


@claim("Order of detachment on a pillar", "3.2", 5, _PILLARS)
def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    """Corners detach first, then boundaries perpendicular to the sliding direction, then parallel
    ones; the same on the blocks adjacent to them; the centre comes last.

    Tested: on average over pillars and realisations.
    """
    for scene, runs in pillars(evidence.records).items():
        maps = pillar_map(runs, scene.pattern)
        for ring, parts in _rings(scene.n_p):
            times = {f"{n} ({ring})": maps[:, mask].mean(axis=1) for n, mask in parts.items()}
            yield from samples.in_order(scene, times)


@claim("The order of detachment never changes", "3.2", 5, _PILLARS, "universal")
@share_over(pillars, "share of the pillars whose parts detach in this order", ranges.NEARLY_ALL)
def always_in_order(run: Record) -> float:
    """The described detachment sequence always occurs, independently of statistical properties.

    Tested: on more than nine tenths of the single pillars.
    """
    rings = [list(parts.values()) for _, parts in _rings(run.scene.n_p)]
    ordered = [
        all(np.all(np.diff([pillar[part].mean() for part in parts]) > 0.0) for parts in rings)
        for pillar in pillars_of(run.t_det, run.scene)
    ]
    return float(np.mean(ordered))


@claim("Edges detach before the force maximum", "3.2", 5, _PILLARS)
@share_over(
    pillars,
    "share of the blocks on the border or beside it that detach before t_max",
    ranges.NEARLY_ALL,
)
def edges_before_peak(run: Record) -> float:
    """The detachments on the borders and on the blocks adjacent to them occur before the maximum of
    the friction force.

    Tested: more than nine tenths of these blocks. With a bound below 0.74 it would hold for n_p of
    7 and more.
    """
    early = np.stack(pillars_of(run.t_det < run.t_max, run.scene))
    return float(early[:, surfaces.from_edge(run.scene.n_p) < _BORDER].mean())


def near_border(run: Record) -> float:
    """Share of the precursors that lie on the border of a pillar or beside it."""
    early = np.stack(pillars_of(run.t_det < run.t_max, run.scene))
    border = surfaces.from_edge(run.scene.n_p) < _BORDER
    return samples.share_of(np.broadcast_to(border, early.shape), early)


@claim("Precursors are a region around the edge of pillars", "3.2", 5, _BROAD_PILLARS)
def region_of_precursors(evidence: Evidence) -> Iterator[Finding]:
    """The sliding precursors are not only a few isolated blocks, but a whole region localized
    around the edge of the pillar.

    Tested: most lie within two blocks of the edge, and less than half are isolated.
    """
    for scene, runs in _broad(evidence.records).items():
        for what, quantity, claimed in (
            ("on the border or beside it", near_border, ranges.MOST),
            ("isolated", samples.isolated, ranges.FEWER_THAN_HALF),
        ):
            name = f"share of the blocks detached before t_max that are {what}"
            yield found_on(scene, name, samples.share(over_runs(quantity, runs)), claimed)


def inside(run: Record) -> Array:
    """t_det of the pillars without their borders, (pillars, n_p - 4, n_p - 4) s."""
    inner = slice(_BORDER, -_BORDER)
    return np.stack([part[inner, inner] for part in pillars_of(run.t_det, run.scene)])


@claim("Detachment waves start near the edge of pillars", "3.2", 5, _BROAD_PILLARS)
@share_over(
    _broad,
    f"share of places inside the border that are nearer to it than the {_PATCH} x {_PATCH} blocks "
    "detaching first",
    _OUTER_QUARTER,
)
def nucleation_near_edge(run: Record) -> float:
    """Detachment waves are triggered from nucleation points located near the edge.

    Tested: in the outer quarter of what the border, two blocks wide, encloses. The same for borders
    of 1 to 4 blocks and patches of 2 to 5; on the flat surface the first patch lies half way.
    """
    return float(np.mean([samples.first_patch(pillar, _PATCH) for pillar in inside(run)]))


@claim("The centre of pillars detaches last", "3.2", 5, _CORED_PILLARS)
def centre_last(evidence: Evidence) -> Iterator[Finding]:
    """The waves propagate towards the central part of the pillar, which is the last part
    detaching.
    """
    name = "t_det/t_max of the middle minus that of what lies between it and the border"
    for scene, runs in pillars(evidence.records, _CORE).items():
        times = np.stack([(inside(run) / run.t_max).mean(axis=0) for run in runs])
        wide = times.shape[-1]
        middle = np.zeros((wide, wide), bool)  # half as wide as the inside
        middle[wide // 4 : wide - wide // 4, wide // 4 : wide - wide // 4] = True
        later = samples.mean(times[:, middle].mean(axis=1) - times[:, ~middle].mean(axis=1))
        yield found_on(scene, name, later, ranges.POSITIVE)


@claim("t_max > t_avg on pillars", "3.2", 6, _PILLARS, "universal")
@mean_over(pillars, "t_max - t_avg", ranges.POSITIVE, unit="s")
def peak_after_average(run: Record) -> float:
    """The force peak always occurs after the average detachment time.

    Tested: on average over realisations, for every size of pillars.
    """
    return run.t_max - run.t_avg


@claim("The main front comes after t_max on very large pillars", "3.2", 6, _LARGEST)
@share_over(
    _large, "share of the blocks inside the border that detach after t_max", ranges.NEARLY_ALL
)
def front_after_peak(run: Record) -> float:
    """On very large pillars, e.g. n_p = 60, the central part is involved in the main detachment
    front after the time t_max.

    Tested: more than nine tenths of the blocks off the border detach after t_max.
    """
    return float(np.mean(inside(run) > run.t_max))


def warning(run: Run) -> float:
    """Time from the first detachment to t_max, over t_max: for how long there are precursors.

    Absolute times grow with the normal force on a block, which is larger on pillars.
    """
    return 1.0 - float(np.nanmin(run.t_det)) / run.t_max


@claim("Pillars with n_p <= 3 behave like a flat surface", "3.2", 6, _SMALL)
def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    """For n_p <= 3 the transition to sliding is similar to that of a non-patterned surface. Static
    friction, which the paper allows to differ, is left out.

    Tested: nearer to the flat surface than to the smallest pillars of n_p >= 6, from which on the
    paper finds another transition.
    """
    quantities: Mapping[str, Quantity] = {
        "(t_max - t_avg)/t_max": samples.relative_lag,
        "precursors": samples.before_peak,
        "width of the force peak": samples.width,
    }
    small = [scene for scene in pillars(evidence.records, 0) if scene.n_p < surfaces.SMALLEST]
    examples = list(pillars(evidence.records, _RELEVANT))[:1]
    for flat, larger, scene in product(surfaces.flat(evidence.records), examples, small):
        for name, quantity in quantities.items():
            three = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, larger)]
            away = samples.magnitude(samples.position(*three))
            statistic = f"{name}: distance from the flat surface, over that of n_p = {larger.n_p}"
            claimed, beside = ranges.FEWER_THAN_HALF, (flat, larger)
            yield found_on(scene, statistic, away, claimed, beside=beside)


def _above_flat(evidence: Evidence, quantities: Mapping[str, Quantity]) -> Iterator[Finding]:
    """What pillars have more of than the flat surface."""
    flats = surfaces.flat(evidence.records)
    for flat, scene in product(flats, pillars(evidence.records, _RELEVANT)):
        for name, quantity in quantities.items():
            statistic = f"{name}, minus that of the flat surface"
            yield samples.compared(evidence, statistic, quantity, scene, flat)


@claim("More and earlier precursors on pillars", "3.2", 6, _BOTH)
def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    """For n_p >= 6 the sliding precursors are numerically relevant and occur for a larger time
    interval before t_max.
    """
    time = "time from the first detachment to t_max over t_max"
    return _above_flat(evidence, {_PRECURSORS: samples.before_peak, time: warning})


@claim("Rounded force peak on pillars", "3.2", 6, _BOTH)
def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force is no longer a sharp peak, and becomes rounded."""
    return _above_flat(evidence, {_WIDTH: samples.width})


def _lowest(evidence: Evidence, scenes: Iterable[Scene]) -> Scene:
    """Scene with the lowest mean static friction."""
    return min(scenes, key=lambda scene: float(samples.friction(evidence, scene).mean()))


def _of_all_sizes(evidence: Evidence) -> list[Scene]:
    """Pillars by size, if there are three or more, the smallest of n_p <= 3."""
    found = list(pillars(evidence.records, 0))
    return found if len(found) >= 3 and found[0].n_p < surfaces.SMALLEST else []


@claim("Lowest static friction at an intermediate n_p", "3.2", 6, _SIZES)
def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    """The smallest static friction is obtained for a specific intermediate value of n_p; for very
    large pillars it increases again.
    """
    scenes = _of_all_sizes(evidence)
    # those between are chosen by the same means: small differences would be overrated
    for end in (scenes[0], scenes[-1]) if scenes else ():
        lowest = _lowest(evidence, scenes[1:-1])
        name = f"static friction at n_p = {end.n_p} minus the lowest between, at n_p = {lowest.n_p}"
        yield samples.compared(evidence, name, samples.static_friction, end, lowest, case={})


@claim("Sharper transition of very large pillars", "3.2", 6, _SIZES)
def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    """For very large pillars the transition is sharper than where static friction is lowest."""
    scenes = _of_all_sizes(evidence)
    if scenes:
        lowest, largest = _lowest(evidence, scenes[:-1]), scenes[-1]
        name = f"{_WIDTH}, at n_p = {largest.n_p} minus that at n_p = {lowest.n_p}"
        yield samples.compared(
            evidence, name, samples.width, largest, lowest, ranges.NEGATIVE, case={}
        )


@claim("Precursors are negligible on very large pillars", "3.2", 6, _LARGEST, "universal")
@share_over(_large, _PRECURSORS, ranges.NEGLIGIBLE)
def negligible_edges(run: Record) -> float:
    """For very large pillars, e.g. n_p = 60, the region characterized by sliding precursors becomes
    negligible with respect to the surface area of the central part.

    Tested: less than a tenth of the blocks. The two outermost rings alone are 13 % at n_p = 60.
    """
    return samples.before_peak(run)


def _by_scatter(evidence: Evidence) -> dict[float, list[Scene]]:
    """Pillars of the sizes compared, by the scatter of mu_static, where all sizes are there."""
    groups: dict[float, list[Scene]] = {}
    for scene in evidence.records:
        constants = dict(scene.varied)
        scatter = constants.pop(_SCATTER, Material().mu_static_std)
        if scene.level == 1 and scene.n_p == scene.n_s in _COMPARED and not constants:
            groups.setdefault(scatter, []).append(scene)
    return {s: scenes for s, scenes in sorted(groups.items()) if len(scenes) == len(_COMPARED)}


@claim("Static friction is lowest where n_p is about l_c", "3.2", 7, _SCATTERS)
def size_like_length(evidence: Evidence) -> Iterator[Finding]:
    """When the characteristic correlation length is comparable to the total length of the pillars,
    static friction is smallest.

    Tested: within a factor of two, for the paper's scatter of mu_static and for others, which
    change l_c; among pillars of 3, 6, 10, 20 and 30 blocks, whose steps no interval counts, and
    with l_c at n_p = 30, of exp(-r/l_c) and of A exp(-r/l_c).
    """
    for scatter, scenes in _by_scatter(evidence).items():
        lowest, broad = _lowest(evidence, scenes), max(scenes, key=lambda s: s.n_p)
        runs, n_p = evidence.records[broad], lowest.n_p
        fit = Correlation(side_times(runs, broad.pattern, surfaces.ALONG)).length()
        for amplitude, (value, low, high) in (("1", fit.fitted), ("free", fit.tail)):
            yield Finding(
                {_SCATTER: scatter, "A": amplitude},
                f"n_p = {n_p}, where static friction is lowest, over l_c at n_p = {broad.n_p}",
                Estimate(n_p / float(value), n_p / float(high), n_p / float(low), len(runs)),
                ranges.COMPARABLE,
                surfaces.in_files(*scenes),
            )


def _lowest_of(evidence: Evidence, scenes: list[Scene]) -> list[Scene]:
    """Scenes whose static friction cannot be told from the lowest, by a 95 % interval."""
    least = samples.friction(evidence, _lowest(evidence, scenes))
    more = {s: samples.difference(samples.friction(evidence, s), least) for s in scenes}
    return [scene for scene in scenes if not more[scene].ci_low > 0.0]


def _over_t_avg(quantity: Quantity) -> Quantity:
    """The same time over t_avg in place of t_max.

    Where there are two load peaks, t_max is that of the earlier one or of the later.
    """
    return lambda run: quantity(run) * run.t_max / run.t_avg


def _largest_there(evidence: Evidence, name: str, quantity: Quantity) -> Iterator[Finding]:
    """Where static friction is lowest, a quantity is larger than on other pillars.

    Where several sizes may have the lowest, the interval holds those of all of them, and of one
    of these sizes it is open above: it may be the one.
    """
    scenes = _of_all_sizes(evidence)
    lowest = _lowest_of(evidence, scenes) if scenes else []
    sizes = " or ".join(str(scene.n_p) for scene in lowest)
    there = f"{name}, at n_p = {sizes}, where static friction is lowest, minus that here"
    for other in (scene for scene in scenes if lowest != [scene]):
        sample = over_runs(quantity, evidence.records[other])
        others = [over_runs(quantity, evidence.records[s]) for s in lowest if s != other]
        found = [samples.difference(each, sample) for each in others]
        most = ranges.INF if other in lowest else max(each.ci_high for each in found)
        joint = replace(found[0], ci_low=min(each.ci_low for each in found), ci_high=most)
        source = surfaces.in_files(*lowest, other)
        yield Finding(surfaces.case_of(other), there, joint, ranges.POSITIVE, source)


@claim("The most precursors where static friction is lowest", "3.2", 6, _SIZES, "universal")
def most_precursors(evidence: Evidence) -> Iterator[Finding]:
    """An optimal length scale of the pillars maximizes the occurrence of sliding precursors, so
    that the static friction is minimized.

    Tested: against all other sizes, whichever of those that may have the lowest friction has it.
    """
    return _largest_there(evidence, _PRECURSORS, samples.before_peak)


@claim("The roundest force peak where static friction is lowest", "3.2", 6, _SIZES, "universal")
def roundest_peak(evidence: Evidence) -> Iterator[Finding]:
    """This explains why the smallest static friction is obtained for a specific intermediate value
    of n_p, and the force peak at the transition is considerably more rounded.

    Tested: over t_avg, against all other sizes, whichever of those that may have the lowest
    friction has it.
    """
    return _largest_there(evidence, f"{_SUPPORTED} over t_avg", _over_t_avg(samples.width))


@claim("The longest transition where static friction is lowest", "3.2", 6, _SIZES, "universal")
def longest_transition(evidence: Evidence) -> Iterator[Finding]:
    """In the intermediate regime the detachments are distributed over a longer time interval around
    the maximum of the friction force: a longer duration of the transition.

    Tested: over t_avg, against all other sizes, whichever of those that may have the lowest
    friction has it.
    """
    return _largest_there(evidence, f"{_DURATION} over t_avg", _over_t_avg(samples.lasting))
