"""Square pillars: edges first, the force maximum late (section 3.2 of the paper)."""

from collections.abc import Iterator, Sequence

import numpy as np

from springblock.analysis.statistics import pillar_map, pillar_ring, repeatability
from springblock.claims.rule import Case, Claim, Estimate, Evidence, Finding
from springblock.claims.samples import (
    ALIKE,
    INF,
    MOST,
    NEARLY_ALL,
    POSITIVE,
    SMALLEST,
    Mask,
    first_patch,
    in_files,
    in_order,
    in_table,
    isolated,
    mean,
    over_rows,
    over_runs,
    place,
    scenes_along_x,
    share,
)
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_BORDER = 2  #: blocks from the edge: those on the border and those beside them
_BROAD = 20  #: n_p from which on most blocks of a pillar are not of its border
_CORE = 10  #: n_p from which on a pillar has an inside in which places differ
_PATCH = 3  #: blocks, side of the patch that counts as a nucleation point
_QUARTER = 0.25  #: outer part of a pillar's inside that is near the edge
_PILLARS = "realisations of pillars with n_p of 4 or more"


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
            Estimate.of(repeatability(np.array(times)), len(times)),
            (-INF, ALIKE),
            in_files(scene),
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


def always_in_order(evidence: Evidence) -> Iterator[Finding]:
    """Corners, edges across, edges along, centre: in each realisation, mean over its pillars."""
    for scene, case, parts in _outer_rings(evidence):
        ordered = np.all(np.diff(np.stack(list(parts.values())), axis=0) > 0.0, axis=0)
        yield Finding(
            case,
            "share of the realisations in which all parts detach in this order",
            share(ordered),
            (NEARLY_ALL, INF),
            in_files(scene),
        )


def detached_by_peak(runs: Sequence[Run], scene: Scene) -> Array:
    """Share of the pillars on which a block has detached before t_max, (k, n_p, n_p)."""
    size = scene.n_p
    return np.array(
        [
            np.mean(
                [
                    run.t_det[y : y + size, x : x + size] < run.t_max
                    for y, x in scene.pattern.origins
                ],
                axis=0,
            )
            for run in runs
        ]
    )


def edges_before_peak(evidence: Evidence) -> Iterator[Finding]:
    """Nearly all of the edge has let go at the force maximum, and so have the blocks beside it."""
    names = {"corners": "corners", "y": "edges across", "x": "edges along"}
    for scene, case, _ in _outer_rings(evidence):
        detached = detached_by_peak(evidence.records[scene], scene)
        for side, mask in pillar_ring(scene.n_p, int(case["distance from the edge"])).items():
            yield Finding(
                case,
                f"share of the {names[side]} detached before t_max",
                mean(detached[:, mask].mean(axis=1)),
                (NEARLY_ALL, INF),
                in_files(scene),
            )


def border(scene: Scene) -> Mask:
    """Blocks on the borders of pillars or beside those, (N, N)."""
    field, size = np.zeros(scene.contact.shape, bool), scene.n_p
    from_edge = np.minimum(np.arange(size), np.arange(size)[::-1])
    for y, x in scene.pattern.origins:
        pillar = np.minimum.outer(from_edge, from_edge) < _BORDER
        field[y : y + size, x : x + size] = pillar
    return field


def region_of_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Of the precursors most are on the border or beside it, and most are not isolated."""
    for scene in scenes_along_x(evidence.records, 1, _BROAD):
        edges = border(scene)

        def near(run: Record, edges: Mask = edges) -> float:
            return float(np.mean(edges[run.t_det < run.t_max]))

        runs = evidence.records[scene]
        for name, sample, claimed in (
            ("on the border or beside it", over_runs(near, runs), (MOST, INF)),
            ("isolated", over_runs(lambda run: isolated(run, 1.0), runs), (-INF, MOST)),
        ):
            statistic = f"share of the blocks detached before t_max that are {name}"
            yield Finding(place(scene), statistic, mean(sample), claimed, in_files(scene))


def inside(run: Run, scene: Scene) -> Array:
    """t_det of the pillars without their borders, (pillars, n_p - 4, n_p - 4) s."""
    starts, size = scene.pattern.origins + _BORDER, scene.n_p - 2 * _BORDER
    return np.stack([run.t_det[y : y + size, x : x + size] for y, x in starts])


def nucleation_near_edge(evidence: Evidence) -> Iterator[Finding]:
    """Within the borders, the patch that detaches first lies in the outer quarter."""
    for scene in scenes_along_x(evidence.records, 1, _BROAD):
        first = [
            np.mean([first_patch(pillar, _PATCH) for pillar in inside(run, scene)])
            for run in evidence.records[scene]
        ]
        yield Finding(
            place(scene),
            f"share of places inside the border that are nearer to it than the {_PATCH} x {_PATCH} "
            "blocks detaching first",
            mean(np.array(first)),
            (-INF, _QUARTER),
            in_files(scene),
        )


def centre_last(evidence: Evidence) -> Iterator[Finding]:
    """The middle of a pillar, half as wide as its inside, detaches after the rest of this."""
    for scene in scenes_along_x(evidence.records, 1, _CORE):
        times = np.stack(
            [(inside(run, scene) / run.t_max).mean(axis=0) for run in evidence.records[scene]]
        )
        size = times.shape[-1]
        middle = np.zeros((size, size), bool)
        middle[size // 4 : size - size // 4, size // 4 : size - size // 4] = True
        yield Finding(
            place(scene),
            "t_det/t_max of the middle minus that of what lies between it and the border",
            mean(times[:, middle].mean(axis=1) - times[:, ~middle].mean(axis=1)),
            POSITIVE,
            in_files(scene),
        )


def peak_after_average(evidence: Evidence) -> Iterator[Finding]:
    """t_max > t_avg on pillars, for each size and distance: on average and in each realisation."""
    for scene in scenes_along_x(evidence.summaries, 1, SMALLEST):
        lag = over_rows(lambda row: row["t_max"] - row["t_avg"], evidence.summaries[scene])
        later = {seed: seconds > 0.0 for seed, seconds in lag.items()}
        source = in_table(scene)
        case = place(scene)
        average, each = ({**case, "looked at": what} for what in ("the mean", "each realisation"))
        yield Finding(average, "t_max - t_avg", mean(lag), POSITIVE, source, "s")
        name = "share of the realisations in which t_max > t_avg"
        yield Finding(each, name, share(later), (NEARLY_ALL, INF), source)


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
        "Order of detachment on a pillar",
        "3.2",
        "Corners detach first, then boundaries perpendicular to the sliding direction, then "
        "parallel ones; the same on the blocks adjacent to them; the centre comes last.",
        _PILLARS,
        detachment_order,
    ),
    Claim(
        "The order of detachment never changes",
        "3.2",
        "The described detachment sequence always occurs, independently of statistical properties. "
        "Tested: in more than nine tenths of the realisations.",
        _PILLARS,
        always_in_order,
    ),
    Claim(
        "Edges detach before the force maximum",
        "3.2",
        "The detachments on the borders and on the blocks adjacent to them occur before the "
        "maximum of the friction force. Tested: more than nine tenths of these blocks.",
        _PILLARS,
        edges_before_peak,
    ),
    Claim(
        "Precursors are a region around the edge of pillars",
        "3.2",
        "The sliding precursors are not only a few isolated blocks, but a whole region localized "
        "around the edge of the pillar. Tested: most lie within two blocks of the edge, and less "
        "than half are isolated.",
        f"realisations of pillars with n_p of {_BROAD} or more",
        region_of_precursors,
    ),
    Claim(
        "Detachment waves start near the edge of pillars",
        "3.2",
        "Detachment waves are triggered from nucleation points located near the edge. Tested: in "
        "the outer quarter of what the border, two blocks wide, encloses.",
        f"realisations of pillars with n_p of {_BROAD} or more",
        nucleation_near_edge,
    ),
    Claim(
        "The centre of pillars detaches last",
        "3.2",
        "The waves propagate towards the central part of the pillar, which is the last part "
        "detaching.",
        f"realisations of pillars with n_p of {_CORE} or more",
        centre_last,
    ),
    Claim(
        "t_max > t_avg on pillars",
        "3.2",
        "The force peak always occurs after the average detachment time. Tested: on average, and "
        "in more than nine tenths of the realisations.",
        _PILLARS,
        peak_after_average,
    ),
)
