"""Square pillars: edges first, the force maximum late (section 3.2 of the paper)."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import attrgetter, itemgetter

import numpy as np

from springblock.claims.rule import Case, Claim, Evidence, Finding
from springblock.claims.samples import (
    ALIKE,
    INF,
    NEGATIVE,
    POSITIVE,
    SMALLEST,
    Sample,
    difference,
    families,
    family_place,
    in_files,
    in_order,
    in_table,
    lags,
    mean,
    over_rows,
    over_runs,
    place,
    position,
    scenes_along_x,
)
from springblock.run import Array, Run
from springblock.scene import Scene
from springblock.statistics import mean_interval, pillar_map, pillar_ring, repeatability
from springblock.tables import Record

Quantities = Mapping[str, Callable[[Record], float]]  #: of a realisation, by their names

_HIGH = 0.95  #: share of the largest force that the width of its peak is taken at
_WIDTH = "time with a force above 95 % of its maximum over t_max"
_RELEVANT = 6  #: n_p from which on the paper finds precursors numerically relevant
_PILLARS = "realisations of pillars with n_p of 4 or more"
_BOTH = "realisations of the flat surface and of pillars with n_p of 6 or more"
_SIZES = "realisations of pillars of three sizes or more"


def precursors(run: Run) -> float:
    """Share of all detaching blocks that detach before t_max."""
    times = run.t_det[np.isfinite(run.t_det)]
    return float(np.mean(times < run.t_max))


def warning(run: Run) -> float:
    """Time from the first detachment to t_max, over t_max: for how long there are precursors.

    Absolute times grow with the normal force on a block, which is larger on pillars.
    """
    return 1.0 - float(np.nanmin(run.t_det)) / run.t_max


def width(run: Run) -> float:
    """Time during which the force exceeds 95 % of its maximum, over t_max."""
    samples = np.count_nonzero(run.force > _HIGH * run.force.max())
    return float(samples * (run.time[1] - run.time[0]) / run.t_max)


def relative_lag(run: Run) -> float:
    """t_max - t_avg over t_max."""
    return (run.t_max - run.t_avg) / run.t_max


def pillars_alike(evidence: Evidence) -> Iterator[Finding]:
    """It does not matter where on the surface a pillar stands."""
    for scene in scenes_along_x(evidence.records, 1, SMALLEST):
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
            (-INF, ALIKE),
            in_files(scene),
        )


def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    """Pillars with n_p <= 3 lie closer to the flat surface than to the next larger ones."""
    quantities: Quantities = {
        "(t_max - t_avg)/t_max": relative_lag,
        "precursors": precursors,
        "width of the force peak": width,
    }
    for family in families(evidence.records):
        flat = Scene(family[0].n_blocks)
        larger = next((s for s in family if s.n_p >= SMALLEST), None)
        if flat not in evidence.records or larger is None:
            continue
        for scene in (s for s in family if s.n_p < SMALLEST):
            for name, quantity in quantities.items():
                samples = [over_runs(quantity, evidence.records[s]) for s in (scene, flat, larger)]
                yield Finding(
                    place(scene) | {"quantity": name},
                    f"position between the flat surface, 0, and n_p = {larger.n_p}",
                    position(*samples),
                    (-0.5, 0.5),
                    in_files(scene, flat, larger),
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


def _outer_rings(evidence: Evidence) -> Iterator[tuple[Scene, Case, dict[str, Array]]]:
    """The edge of pillars and the ring inside it: scene, case and times of the parts."""
    for scene in scenes_along_x(evidence.records, 1, SMALLEST):
        for depth in (0, 1):
            if 2 * (depth + 1) < scene.n_p:
                case = place(scene) | {"distance from the edge": depth}
                yield scene, case, ring_times(evidence.records[scene], scene, depth)


def detachment_order(evidence: Evidence) -> Iterator[Finding]:
    """Corners, edges across, edges along, centre; on the edge and on the ring inside it."""
    for scene, case, parts in _outer_rings(evidence):
        yield from in_order(case, parts, in_files(scene))


def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    """All parts of the edge let go before the force maximum, and so do the blocks beside it."""
    for scene, case, parts in _outer_rings(evidence):
        for name in list(parts)[:-1]:
            yield Finding(
                case,
                f"t_det/t_max of the {name}",
                mean_interval(parts[name]),
                (-INF, 1.0),
                in_files(scene),
            )


def peak_after_average(evidence: Evidence) -> Iterator[Finding]:
    """t_max > t_avg on pillars, for each size and distance."""
    return lags(evidence, 1, SMALLEST, POSITIVE)


def _above_flat(evidence: Evidence, quantities: Quantities) -> Iterator[Finding]:
    """What pillars have more of than the flat surface."""
    for scene in scenes_along_x(evidence.records, 1, _RELEVANT):
        flat = Scene(scene.n_blocks)
        if flat not in evidence.records:
            continue
        for name, quantity in quantities.items():
            samples = [over_runs(quantity, evidence.records[s]) for s in (scene, flat)]
            yield Finding(
                place(scene),
                f"{name}, minus that of the flat surface",
                difference(*samples),
                POSITIVE,
                in_files(scene, flat),
            )


def many_precursors(evidence: Evidence) -> Iterator[Finding]:
    """On pillars precursors are more, and begin longer before t_max, than on a flat surface."""
    share = "share of the contact blocks that detach before t_max"
    time = "time from the first detachment to t_max over t_max"
    return _above_flat(evidence, {share: precursors, time: warning})


def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of pillars is wider than that of the flat surface."""
    return _above_flat(evidence, {_WIDTH: width})


def _of_several_sizes(scenes: Iterable[Scene]) -> list[list[Scene]]:
    """Families of three sizes or more."""
    return [family for family in families(scenes) if len(family) >= 3]


def _lowest(samples: Mapping[Scene, Sample]) -> Scene:
    """Scene with the lowest mean."""
    return min(samples, key=lambda scene: float(mean(samples[scene]).mean))


def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    """Both the smallest and the largest pillars stick better than the ones that stick least.

    The latter are chosen by the same means: small differences would be overrated.
    """
    rows = evidence.summaries
    for family in _of_several_sizes(rows):
        samples = {s: over_rows(itemgetter("static_friction"), rows[s]) for s in family}
        lowest = _lowest(samples)
        for end in (family[0], family[-1]):
            yield Finding(
                family_place(end),
                f"static friction at n_p = {end.n_p} minus the lowest, at n_p = {lowest.n_p}",
                difference(samples[end], samples[lowest]),
                POSITIVE,
                in_table(end, lowest),
            )


def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of the largest pillars is narrower than where static friction is lowest."""
    records = evidence.records
    for family in _of_several_sizes(records):
        lowest = _lowest({s: over_runs(attrgetter("static_friction"), records[s]) for s in family})
        largest = family[-1]
        samples = [over_runs(width, records[s]) for s in (largest, lowest)]
        yield Finding(
            family_place(largest),
            f"{_WIDTH}, at n_p = {largest.n_p} minus that at n_p = {lowest.n_p}",
            difference(*samples),
            NEGATIVE,
            in_files(largest, lowest),
        )


CLAIMS = (
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
        "Static friction, which the paper allows to differ, is left out.",
        "realisations of the flat surface, of pillars with n_p <= 3 and of larger ones",
        small_pillars,
    ),
    Claim(
        "Order of detachment on a pillar",
        "3.2",
        "Corners detach first, then boundaries perpendicular to the sliding direction, then "
        "parallel ones; the same on the blocks adjacent to them; the centre comes last.",
        _PILLARS,
        detachment_order,
    ),
    Claim(
        "Edges detach before the force maximum",
        "3.2",
        "The detachments on the borders and on the blocks adjacent to them occur before the "
        "maximum of the friction force.",
        _PILLARS,
        edges_before_peak,
    ),
    Claim(
        "t_max > t_avg on pillars",
        "3.2",
        "The force peak always occurs after the average detachment time.",
        _PILLARS,
        peak_after_average,
    ),
    Claim(
        "More and earlier precursors on pillars",
        "3.2",
        "For n_p >= 6 the sliding precursors are numerically relevant and occur for a larger time "
        "interval before t_max.",
        _BOTH,
        many_precursors,
    ),
    Claim(
        "Rounded force peak on pillars",
        "3.2",
        "The force is no longer a sharp peak, and becomes rounded.",
        _BOTH,
        rounded_peak,
    ),
    Claim(
        "Lowest static friction at an intermediate n_p",
        "3.2",
        "The smallest static friction is obtained for a specific intermediate value of n_p; for "
        "very large pillars it increases again.",
        _SIZES,
        intermediate_size,
    ),
    Claim(
        "Sharper transition of very large pillars",
        "3.2",
        "For very large pillars the transition is sharper than where static friction is lowest.",
        _SIZES,
        sharper_again,
    ),
)
