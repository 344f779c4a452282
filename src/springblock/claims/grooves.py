"""Grooved pillars: two length scales, two load peaks (section 3.3 of the paper)."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from operator import attrgetter

import numpy as np

from springblock.claims.rule import Claim, Evidence, Finding, Range
from springblock.claims.samples import (
    INF,
    POSITIVE,
    Mask,
    difference,
    in_files,
    in_order,
    mean,
    over_runs,
    place,
    scenes_along_x,
)
from springblock.run import Run
from springblock.scene import Scene
from springblock.statistics import (
    common_curve,
    load_peak_number,
    load_peaks,
    mean_interval,
    pillar_map,
)
from springblock.tables import Record

_PEAKS = {"along": (1.5, 2.5), "across": (0.5, 1.5)}  #: load peaks when sliding that way
_GROOVES = "realisations of a grooved surface"
_WAYS = "realisations of a grooved surface that slides along and across its grooves"


def second_peak(run: Run) -> float:
    """Force at the second load peak minus that at the first, over P l² N²; NaN without."""
    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return float("nan")
    return float(run.force[peaks[1]] - run.force[peaks[0]]) / run.normal_force


def resting_core(run: Record) -> float:
    """Share of the blocks off the edges yet to detach at the lowest force between load peaks."""
    peaks, contact = load_peaks(run.force, 0.0), run.scene.pattern.contact
    if len(peaks) < 2:
        return float("nan")
    between = peaks[0] + int(np.argmin(run.force[peaks[0] : peaks[1]]))
    core = contact & ~edge(contact)
    return float(np.mean(~(run.t_det[core] <= run.time[between])))  # NaN: never


def edge(contact: Mask) -> Mask:
    """Contact blocks beside a block, in one of the four directions, that is not in contact."""
    padded = np.pad(contact, 1)
    inside = padded[2:, 1:-1] & padded[:-2, 1:-1] & padded[1:-1, 2:] & padded[1:-1, :-2]
    return contact & ~inside


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


def _grooved(evidence: Evidence, level: int = 2) -> list[tuple[dict[str, int], Scene, Scene]]:
    """Grooved surfaces that were slid both along and across: lengths and both scenes.

    Those that look the same from both sides are left out: they have no along and across.
    """
    pairs = []
    for along in scenes_along_x(evidence.records, level):
        across, contact = replace(along, direction="y"), along.pattern.contact
        if across in evidence.records and not np.array_equal(contact, contact.T):
            pairs.append((place(along), along, across))
    return pairs


def _peak_numbers(evidence: Evidence, level: int) -> Iterator[Finding]:
    """Two load peaks along the grooves and one across, on patterns of so many levels."""
    for lengths, *scenes in _grooved(evidence, level):
        for scene, (name, claimed) in zip(scenes, _PEAKS.items(), strict=True):
            curve = common_curve(evidence.records[scene])
            yield Finding(
                lengths,
                f"load peaks of the mean force when sliding {name} the grooves",
                load_peak_number(curve.friction),
                claimed,
                in_files(scene),
            )


def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Two load peaks along the grooves, one across."""
    return _peak_numbers(evidence, 2)


def further_levels(evidence: Evidence) -> Iterator[Finding]:
    """The same on surfaces with a third level."""
    return _peak_numbers(evidence, 3)


def _with_both_peaks(
    evidence: Evidence, name: str, quantity: Callable[[Record], float], claimed: Range
) -> Iterator[Finding]:
    """A quantity of the runs along grooves that have two load peaks."""
    for scene in scenes_along_x(evidence.records, 2):
        sample = over_runs(quantity, evidence.records[scene])
        if sample:
            statistic = f"{name}, in the {len(sample)} runs that have both"
            yield Finding(place(scene), statistic, mean(sample), claimed, in_files(scene))


def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The second load peak is the higher one when sliding along the grooves."""
    name = "force at the second load peak minus that at the first, over the normal force"
    return _with_both_peaks(evidence, name, second_peak, POSITIVE)


def rest_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks most of the core has yet to let go."""
    name = (
        "share of the blocks off the edges yet to detach at the lowest force between the load peaks"
    )
    return _with_both_peaks(evidence, name, resting_core, (0.5, INF))


def edges_before_core(evidence: Evidence) -> Iterator[Finding]:
    """The edges let go before the rest, sliding along or across the grooves."""
    for lengths, *scenes in _grooved(evidence):
        for scene, name in zip(scenes, _PEAKS, strict=True):
            contact = scene.pattern.contact
            edges = edge(contact)
            later = [
                (run.t_det[contact & ~edges].mean() - run.t_det[edges].mean()) / run.t_max
                for run in evidence.records[scene]
            ]
            yield Finding(
                lengths | {"sliding": f"{name} the grooves"},
                "t_det/t_max of the core minus that of the edges",
                mean_interval(later),
                POSITIVE,
                in_files(scene),
            )


def grooved_order(evidence: Evidence) -> Iterator[Finding]:
    """Transverse sides, external longitudinal ones, those along the grooves, the inside."""
    for scene in scenes_along_x(evidence.records, 2):
        times = pillar_map(evidence.records[scene], scene.pattern)
        parts = {name: times[:, mask].mean(axis=1) for name, mask in grooved_parts(scene).items()}
        yield from in_order(place(scene), parts, in_files(scene))


def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    """Static friction across the grooves exceeds that along them."""
    for lengths, along, across in _grooved(evidence):
        friction = attrgetter("static_friction")
        samples = [over_runs(friction, evidence.records[s]) for s in (across, along)]
        yield Finding(
            lengths,
            "static friction across the grooves minus that along them",
            difference(*samples),
            POSITIVE,
            in_files(across, along),
        )


CLAIMS = (
    Claim(
        "Two load peaks along grooves, one across",
        "3.3",
        "Two load peaks appear only if the grooves are aligned with the sliding direction.",
        _WAYS,
        two_peaks,
    ),
    Claim(
        "The second load peak sets static friction",
        "3.3",
        "The global static friction is determined by the force reached at the second load peak.",
        f"{_GROOVES} with two load peaks",
        second_peak_decides,
    ),
    Claim(
        "The core rests between the load peaks",
        "4",
        "In the phase between load peaks the internal regions are still at rest.",
        f"{_GROOVES} with two load peaks",
        rest_between_peaks,
    ),
    Claim(
        "Edges detach before the core of grooved pillars",
        "3.3",
        "Edge regions and internal core have distinct dynamics; the boundary regions detach first.",
        _WAYS,
        edges_before_core,
    ),
    Claim(
        "Order of detachment on a grooved pillar",
        "3.3",
        "Transversal sides detach first, then the external longitudinal ones, then the internal "
        "ones along the grooves, then the internal regions of the pawls.",
        _GROOVES,
        grooved_order,
    ),
    Claim(
        "The effects remain with a further level",
        "3.3",
        "We expect that these effects remain present when adding further hierarchical levels. "
        "Tested: two load peaks along grooves, one across.",
        f"{_WAYS}, with a third level",
        further_levels,
    ),
    Claim(
        "Static friction is greater across grooves than along",
        "1",
        "Static friction is greater when the grooves are perpendicular to the sliding direction. "
        "A result of the authors' paper of 2018, J. Mech. Phys. Solids 112, 50 (arXiv:1706.08055), "
        "for grooves that cross the whole surface; here they divide pillars.",
        _WAYS,
        across_sticks_better,
    ),
)
