"""Pillars of one length scale: edges first, the force maximum late, and what their size changes.

Section 3.2 of the paper.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import pillar_map, pillar_ring, repeatability
from springblock.claims import ranges
from springblock.claims.ranges import within
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import (
    SMALLEST,
    Quantity,
    along_x,
    before_peak,
    compared,
    difference,
    families,
    family_place,
    first_patch,
    found_on,
    from_edge,
    in_files,
    in_order,
    in_rows,
    in_table,
    interval,
    isolated,
    lags,
    mean,
    means_of_runs,
    over_runs,
    pillars_of,
    place,
    position,
    proportion,
    relative_lag,
    share_of,
    static_friction,
)
from springblock.io.records import Record
from springblock.io.rows import select
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
_CORED_PILLARS = f"realisations of pillars with n_p of {_CORE} or more"
_BROAD_PILLARS = f"realisations of pillars with n_p of {_BROAD} or more"
_HIGH = 0.95  #: of the largest force, where the width of its peak is taken
_PRECURSORS = "share of the contact blocks that detach before t_max"
_WIDTH = "time with a force above 95 % of its maximum over t_max"
_DURATION = "time between a tenth and nine tenths of the detachments over t_max"
_RELEVANT = 6  #: n_p from which on the paper finds precursors numerically relevant
_EXAMPLE = 20  #: n_p of the paper's example of a pillar, figure 5
_LARGE = 60  #: n_p of the paper's example of very large pillars
_SMALL = "realisations of the flat surface, of pillars with n_p <= 3 and of larger ones"
_LARGEST = f"realisations of pillars with n_p of {_LARGE} or more"
_BOTH = "realisations of the flat surface and of pillars with n_p of 6 or more"
_SIZES = "realisations of pillars of three sizes or more, from n_p = 3 or less on"
_LENGTHS = f"{_SIZES}, and the table of correlation lengths"


@claim("All pillars are alike", "3.2", 4, "realisations of several pillars with n_p of 4 or more")
def pillars_alike(evidence: Evidence) -> Iterator[Finding]:
    """With a margin of n_s/2 all pillars have the same average statistical properties for
    n_p >= 4.
    """
    name = "share of the variance of a pillar's mean t_det that its place explains (jackknife)"
    for scene, runs in along_x(evidence.records, 1, SMALLEST).items():
        times = np.array([[part.mean() for part in pillars_of(r.t_det, scene)] for r in runs])
        if times.shape[1] >= 2:
            by_place = Estimate.of(repeatability(times), len(times))
            yield found_on(scene, name, by_place, ranges.ALIKE)


def _outer_rings(evidence: Evidence) -> Iterator[tuple[Scene, int, dict[str, int]]]:
    """The edge of pillars and the ring inside it: scene, distance from the edge, and its case."""
    for scene in along_x(evidence.records, 1, SMALLEST):
        for depth in (0, 1):
            if 2 * (depth + 1) < scene.n_p:
                yield scene, depth, {"distance from the edge": depth}


def ring_times(runs: Sequence[Run], scene: Scene, depth: int) -> dict[str, Array]:
    """Mean t_det/t_max of parts of a ring and of the centre of a pillar, (k,), in claimed order."""
    times, last = pillar_map(runs, scene.pattern), (scene.n_p - 1) // 2
    ring = pillar_ring(scene.n_p, depth)
    centre = np.logical_or.reduce(list(pillar_ring(scene.n_p, last).values()))
    parts = {name: ring[side] for side, name in _RING.items()} | {"centre": centre}
    return {name: times[:, mask].mean(axis=1) for name, mask in parts.items()}


@claim("Order of detachment on a pillar", "3.2", 5, _PILLARS)
def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    """Corners detach first, then boundaries perpendicular to the sliding direction, then parallel
    ones; the same on the blocks adjacent to them; the centre comes last.
    """
    for scene, depth, case in _outer_rings(evidence):
        parts = ring_times(evidence.records[scene], scene, depth)
        yield from in_order(scene, parts, **case)


@claim("The order of detachment never changes", "3.2", 5, _PILLARS)
def always_in_order(evidence: Evidence) -> Iterator[Finding]:
    """The described detachment sequence always occurs, independently of statistical properties.

    Tested: in more than nine tenths of the realisations.
    """
    # in each realisation the mean over its pillars counts
    name = "share of the realisations in which all parts detach in this order"
    for scene, depth, case in _outer_rings(evidence):
        parts = ring_times(evidence.records[scene], scene, depth)
        ordered = np.all(np.diff(np.stack(list(parts.values())), axis=0) > 0.0, axis=0)
        yield found_on(scene, name, proportion(ordered), ranges.NEARLY_ALL, **case)


@claim("Edges detach before the force maximum", "3.2", 5, _PILLARS)
def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    """The detachments on the borders and on the blocks adjacent to them occur before the maximum of
    the friction force.

    Tested: more than nine tenths of these blocks.
    """
    for scene, depth, case in _outer_rings(evidence):
        runs = evidence.records[scene]
        by_peak = [np.mean(pillars_of(run.t_det < run.t_max, scene), axis=0) for run in runs]
        detached = np.array(by_peak)  # share of the pillars, (k, n_p, n_p)
        for side, mask in pillar_ring(scene.n_p, depth).items():
            name = f"share of the {_RING[side]} detached before t_max"
            share = mean(detached[:, mask].mean(axis=1))
            yield found_on(scene, name, share, ranges.NEARLY_ALL, **case)


def near_border(run: Record) -> float:
    """Share of the precursors that lie on the border of a pillar or beside it."""
    early = np.stack(pillars_of(run.t_det < run.t_max, run.scene))
    return share_of(np.broadcast_to(from_edge(run.scene.n_p) < _BORDER, early.shape), early)


@claim("Precursors are a region around the edge of pillars", "3.2", 5, _BROAD_PILLARS)
def region_of_precursors(evidence: Evidence) -> Iterator[Finding]:
    """The sliding precursors are not only a few isolated blocks, but a whole region localized
    around the edge of the pillar.

    Tested: most lie within two blocks of the edge, and less than half are isolated.
    """
    for scene, runs in along_x(evidence.records, 1, _BROAD).items():
        for what, quantity, claimed in (
            ("on the border or beside it", near_border, ranges.MOST),
            ("isolated", isolated, ranges.FEWER_THAN_HALF),
        ):
            name = f"share of the blocks detached before t_max that are {what}"
            yield from means_of_runs({scene: runs}, name, quantity, claimed)


def inside(run: Record) -> Array:
    """t_det of the pillars without their borders, (pillars, n_p - 4, n_p - 4) s."""
    inner = slice(_BORDER, -_BORDER)
    return np.stack([part[inner, inner] for part in pillars_of(run.t_det, run.scene)])


@claim("Detachment waves start near the edge of pillars", "3.2", 5, _BROAD_PILLARS)
def nucleation_near_edge(evidence: Evidence) -> Iterator[Finding]:
    """Detachment waves are triggered from nucleation points located near the edge.

    Tested: in the outer quarter of what the border, two blocks wide, encloses.
    """
    name = (
        f"share of places inside the border that are nearer to it than the {_PATCH} x {_PATCH} "
        "blocks detaching first"
    )

    def first(run: Record) -> float:
        return float(np.mean([first_patch(pillar, _PATCH) for pillar in inside(run)]))

    broad = along_x(evidence.records, 1, _BROAD)
    return means_of_runs(broad, name, first, _OUTER_QUARTER)


@claim("The centre of pillars detaches last", "3.2", 5, _CORED_PILLARS)
def centre_last(evidence: Evidence) -> Iterator[Finding]:
    """The waves propagate towards the central part of the pillar, which is the last part
    detaching.
    """
    name = "t_det/t_max of the middle minus that of what lies between it and the border"
    for scene, runs in along_x(evidence.records, 1, _CORE).items():
        times = np.stack([(inside(run) / run.t_max).mean(axis=0) for run in runs])
        size = times.shape[-1]
        middle = np.zeros((size, size), bool)  # half as wide as the inside
        middle[size // 4 : size - size // 4, size // 4 : size - size // 4] = True
        lag = mean(times[:, middle].mean(axis=1) - times[:, ~middle].mean(axis=1))
        yield found_on(scene, name, lag, ranges.POSITIVE)


@claim("t_max > t_avg on pillars", "3.2", 6, _PILLARS)
def peak_after_average(evidence: Evidence) -> Iterator[Finding]:
    """The force peak always occurs after the average detachment time.

    Tested: on average, and in more than nine tenths of the realisations.
    """
    for scene, rows in along_x(evidence.summaries, 1, SMALLEST).items():
        lag, source, case = lags(rows), in_table(scene), place(scene)
        average, each = ({**case, "looked at": what} for what in ("the mean", "each realisation"))
        yield Finding(average, "t_max - t_avg", mean(lag), ranges.POSITIVE, source, "s")
        name = "share of the realisations in which t_max > t_avg"
        yield Finding(each, name, proportion(lag > 0.0), ranges.NEARLY_ALL, source)


def warning(run: Run) -> float:
    """Time from the first detachment to t_max, over t_max: for how long there are precursors.

    Absolute times grow with the normal force on a block, which is larger on pillars.
    """
    return 1.0 - float(np.nanmin(run.t_det)) / run.t_max


def width(run: Run) -> float:
    """Time during which the force exceeds 95 % of its maximum, over t_max."""
    samples = np.count_nonzero(run.force > _HIGH * run.force.max())
    return float(samples * (run.time[1] - run.time[0]) / run.t_max)


def duration(run: Run) -> float:
    """Time between a tenth and nine tenths of the first detachments, over t_max."""
    early, late = np.nanquantile(run.t_det, (0.1, 0.9))
    return float(late - early) / run.t_max


@claim("Pillars with n_p <= 3 behave like a flat surface", "3.2", 6, _SMALL)
def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    """For n_p <= 3 the transition to sliding is similar to that of a non-patterned surface. Static
    friction, which the paper allows to differ, is left out.

    Tested: off by less than half of what pillars with n_p = 20 are off by.
    """
    quantities: Mapping[str, Quantity] = {
        "(t_max - t_avg)/t_max": relative_lag,
        "precursors": before_peak,
        "width of the force peak": width,
    }
    for family in families(evidence.records):
        flat = Scene(family[0].n_blocks)
        larger = next((s for s in family if s.n_p >= _EXAMPLE), None)
        if flat not in evidence.records or larger is None:
            continue
        for scene in (s for s in family if s.n_p < SMALLEST):
            for name, quantity in quantities.items():
                samples = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, larger)]
                yield Finding(
                    place(scene) | {"quantity": name},
                    f"position between the flat surface, 0, and n_p = {larger.n_p}",
                    position(*samples),
                    within(0.5),
                    in_files(scene, flat, larger),
                )


def _above_flat(evidence: Evidence, quantities: Mapping[str, Quantity]) -> Iterator[Finding]:
    """What pillars have more of than the flat surface."""
    for scene in along_x(evidence.records, 1, _RELEVANT):
        flat = Scene(scene.n_blocks)
        for name, quantity in quantities.items() if flat in evidence.records else ():
            statistic = f"{name}, minus that of the flat surface"
            yield compared(evidence, place(scene), statistic, quantity, scene, flat)


@claim("More and earlier precursors on pillars", "3.2", 6, _BOTH)
def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    """For n_p >= 6 the sliding precursors are numerically relevant and occur for a larger time
    interval before t_max.
    """
    time = "time from the first detachment to t_max over t_max"
    return _above_flat(evidence, {_PRECURSORS: before_peak, time: warning})


@claim("Rounded force peak on pillars", "3.2", 6, _BOTH)
def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force is no longer a sharp peak, and becomes rounded."""
    return _above_flat(evidence, {_WIDTH: width})


def _of_several_sizes(table: Mapping[Scene, Any]) -> list[list[Scene]]:
    """Families of three sizes or more, the smallest of which the paper takes for flat surfaces."""
    found = [family for family in families(table) if len(family) >= 3]
    return [family for family in found if family[0].n_p < SMALLEST]


def _in_table(evidence: Evidence, scene: Scene) -> Array:
    """Static friction of each realisation, (k,), from the table of realisations."""
    return np.array([row["static_friction"] for row in evidence.summaries[scene]])


def _lowest_in_table(evidence: Evidence, scenes: Iterable[Scene]) -> Scene:
    """Scene with the lowest mean static friction, from the table of realisations."""
    return min(scenes, key=lambda scene: mean(_in_table(evidence, scene)).value)


def _lowest(evidence: Evidence, scenes: Iterable[Scene]) -> Scene:
    """Scene with the lowest mean static friction, from its realisations."""
    runs = evidence.records
    return min(scenes, key=lambda scene: mean(over_runs(static_friction, runs[scene])).value)


@claim("Lowest static friction at an intermediate n_p", "3.2", 6, _SIZES)
def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    """The smallest static friction is obtained for a specific intermediate value of n_p; for very
    large pillars it increases again.
    """
    # those between are chosen by the same means: small differences would be overrated
    for family in _of_several_sizes(evidence.summaries):
        lowest = _lowest_in_table(evidence, family[1:-1])
        for end in (family[0], family[-1]):
            yield Finding(
                family_place(end),
                f"static friction at n_p = {end.n_p} minus the lowest of those between, at n_p = "
                f"{lowest.n_p}",
                difference(_in_table(evidence, end), _in_table(evidence, lowest)),
                ranges.POSITIVE,
                in_table(end, lowest),
            )


@claim("Sharper transition of very large pillars", "3.2", 6, _SIZES)
def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    """For very large pillars the transition is sharper than where static friction is lowest."""
    for *smaller, largest in _of_several_sizes(evidence.records):
        lowest = _lowest(evidence, smaller)
        name = f"{_WIDTH}, at n_p = {largest.n_p} minus that at n_p = {lowest.n_p}"
        case, less = family_place(largest), ranges.NEGATIVE
        yield compared(evidence, case, name, width, largest, lowest, less)


@claim("Precursors are negligible on very large pillars", "3.2", 6, _LARGEST)
def negligible_edges(evidence: Evidence) -> Iterator[Finding]:
    """For very large pillars, e.g. n_p = 60, the region characterized by sliding precursors becomes
    negligible with respect to the surface area of the central part.

    Tested: less than a tenth of the blocks. The two outermost rings alone are 13 % at n_p = 60.
    """
    large = along_x(evidence.records, 1, _LARGE)
    return means_of_runs(large, _PRECURSORS, before_peak, ranges.NEGLIGIBLE)


@claim("Static friction is lowest where n_p is about l_c", "3.2", 7, _LENGTHS)
def size_like_length(evidence: Evidence) -> Iterator[Finding]:
    """When the characteristic correlation length is comparable to the total length of the pillars,
    static friction is smallest.

    Tested: within a factor of two.
    """
    tables = evidence.correlation_length
    for family in _of_several_sizes(evidence.summaries):
        lowest = _lowest_in_table(evidence, family)
        broad = [s for s in family if s in tables and s.n_p >= _EXAMPLE]
        fits = select(tables[broad[-1]], side="x") if broad else []
        if not fits:
            continue
        l_c, n_p = interval(fits[0], "tail", "tail"), lowest.n_p
        yield Finding(
            family_place(lowest),
            f"n_p = {n_p}, where static friction is lowest, over l_c at n_p = {broad[-1].n_p}",
            Estimate(n_p / l_c.value, n_p / l_c.ci_high, n_p / l_c.ci_low, l_c.n),
            ranges.COMPARABLE,
            f"{in_table(lowest)}; {in_rows('correlation_length', broad[-1], side='x')}",
        )


def _largest_there(evidence: Evidence, name: str, quantity: Quantity) -> Iterator[Finding]:
    """Where static friction is lowest, a quantity is larger than on other pillars."""
    for family in _of_several_sizes(evidence.records):
        lowest = _lowest(evidence, family)
        there = f"{name}, at n_p = {lowest.n_p}, where static friction is lowest, minus that here"
        for other in (scene for scene in family if scene != lowest):
            case = family_place(other) | {"n_p": other.n_p}
            yield compared(evidence, case, there, quantity, lowest, other)


@claim("The most precursors where static friction is lowest", "3.2", 6, _SIZES)
def most_precursors(evidence: Evidence) -> Iterator[Finding]:
    """An optimal length scale of the pillars maximizes the occurrence of sliding precursors, so
    that the static friction is minimized.
    """
    return _largest_there(evidence, _PRECURSORS, before_peak)


@claim("The roundest force peak where static friction is lowest", "3.2", 6, _SIZES)
def roundest_peak(evidence: Evidence) -> Iterator[Finding]:
    """This explains why the smallest static friction is obtained for a specific intermediate value
    of n_p, and the force peak at the transition is considerably more rounded.
    """
    return _largest_there(evidence, _WIDTH, width)


@claim("The longest transition where static friction is lowest", "3.2", 6, _SIZES)
def longest_transition(evidence: Evidence) -> Iterator[Finding]:
    """In the intermediate regime the detachments are distributed over a longer time interval around
    the maximum of the friction force: a longer duration of the transition.
    """
    return _largest_there(evidence, _DURATION, duration)
