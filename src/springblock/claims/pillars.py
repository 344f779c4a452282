"""Square pillars: edges first, the force maximum late (section 3.2 of the paper)."""

from collections.abc import Iterator, Sequence

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import pillar_map, pillar_ring, repeatability
from springblock.claims import ranges
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import (
    SMALLEST,
    along_x,
    first_patch,
    found_on,
    from_edge,
    in_order,
    in_table,
    isolated,
    lags,
    mean,
    means_of_runs,
    pillars_of,
    place,
    proportion,
    share_of,
)
from springblock.io.records import Record
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
    within = slice(_BORDER, -_BORDER)
    return np.stack([part[within, within] for part in pillars_of(run.t_det, run.scene)])


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
