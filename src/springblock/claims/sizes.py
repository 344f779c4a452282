"""How the transition depends on the size of pillars (section 3.2 of the paper)."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from operator import attrgetter, itemgetter

import numpy as np

from springblock.claims.rule import Claim, Estimate, Evidence, Finding
from springblock.claims.samples import (
    COMPARABLE,
    INF,
    NEGATIVE,
    NEGLIGIBLE,
    POSITIVE,
    SMALLEST,
    Sample,
    before_peak,
    difference,
    families,
    family_place,
    in_files,
    in_rows,
    in_table,
    interval,
    mean,
    over_rows,
    over_runs,
    place,
    position,
    scenes_along_x,
)
from springblock.io.records import Record
from springblock.io.rows import select
from springblock.model.scene import Scene
from springblock.simulation.run import Run

Quantities = Mapping[str, Callable[[Record], float]]  #: of a realisation, by their names

_HIGH = 0.95  #: share of the largest force that the width of its peak is taken at
_WIDTH = "time with a force above 95 % of its maximum over t_max"
_DURATION = "time between a tenth and nine tenths of the detachments over t_max"
_RELEVANT = 6  #: n_p from which on the paper finds precursors numerically relevant
_EXAMPLE = 20  #: n_p of the paper's example of a pillar, figure 5
_LARGE = 60  #: n_p of the paper's example of very large pillars
_BOTH = "realisations of the flat surface and of pillars with n_p of 6 or more"
_SIZES = "realisations of pillars of three sizes or more, from n_p = 3 or less on"


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


def relative_lag(run: Run) -> float:
    """t_max - t_avg over t_max."""
    return (run.t_max - run.t_avg) / run.t_max


def small_pillars(evidence: Evidence) -> Iterator[Finding]:
    """Pillars with n_p <= 3 are off the flat surface by less than half of the paper's example."""
    quantities: Quantities = {
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
                    (-0.5, 0.5),
                    in_files(scene, flat, larger),
                )


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
    return _above_flat(evidence, {share: before_peak, time: warning})


def rounded_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of pillars is wider than that of the flat surface."""
    return _above_flat(evidence, {_WIDTH: width})


def _of_several_sizes(scenes: Iterable[Scene]) -> list[list[Scene]]:
    """Families of three sizes or more, the smallest of which the paper takes for flat surfaces."""
    found = [family for family in families(scenes) if len(family) >= 3]
    return [family for family in found if family[0].n_p < SMALLEST]


def _lowest(samples: Mapping[Scene, Sample]) -> Scene:
    """Scene with the lowest mean."""
    return min(samples, key=lambda scene: mean(samples[scene]).value)


def intermediate_size(evidence: Evidence) -> Iterator[Finding]:
    """Both the smallest and the largest pillars stick better than some between them.

    The latter are chosen by the same means: small differences would be overrated.
    """
    rows = evidence.summaries
    for family in _of_several_sizes(rows):
        samples = {s: over_rows(itemgetter("static_friction"), rows[s]) for s in family}
        lowest = _lowest({scene: samples[scene] for scene in family[1:-1]})
        for end in (family[0], family[-1]):
            yield Finding(
                family_place(end),
                f"static friction at n_p = {end.n_p} minus the lowest of those between, at n_p = "
                f"{lowest.n_p}",
                difference(samples[end], samples[lowest]),
                POSITIVE,
                in_table(end, lowest),
            )


def sharper_again(evidence: Evidence) -> Iterator[Finding]:
    """The force peak of the largest pillars is narrower than where static friction is lowest."""
    records = evidence.records
    for family in _of_several_sizes(records):
        *smaller, largest = family
        lowest = _lowest({s: over_runs(attrgetter("static_friction"), records[s]) for s in smaller})
        samples = [over_runs(width, records[s]) for s in (largest, lowest)]
        yield Finding(
            family_place(largest),
            f"{_WIDTH}, at n_p = {largest.n_p} minus that at n_p = {lowest.n_p}",
            difference(*samples),
            NEGATIVE,
            in_files(largest, lowest),
        )


def _largest_there(
    evidence: Evidence, name: str, quantity: Callable[[Record], float]
) -> Iterator[Finding]:
    """Where static friction is lowest, a quantity is larger than on other pillars."""
    records = evidence.records
    for family in _of_several_sizes(records):
        lowest = _lowest({s: over_runs(attrgetter("static_friction"), records[s]) for s in family})
        for other in (scene for scene in family if scene != lowest):
            samples = [over_runs(quantity, records[scene]) for scene in (lowest, other)]
            yield Finding(
                family_place(other) | {"n_p": other.n_p},
                f"{name}, at n_p = {lowest.n_p}, where static friction is lowest, minus that here",
                difference(*samples),
                POSITIVE,
                in_files(lowest, other),
            )


def longest_transition(evidence: Evidence) -> Iterator[Finding]:
    """Detachments take longest where static friction is lowest."""
    return _largest_there(evidence, _DURATION, duration)


def roundest_peak(evidence: Evidence) -> Iterator[Finding]:
    """The force peak is widest where static friction is lowest."""
    return _largest_there(evidence, _WIDTH, width)


def most_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Precursors are most where static friction is lowest."""
    name = "share of the contact blocks that detach before t_max"
    return _largest_there(evidence, name, before_peak)


def negligible_edges(evidence: Evidence) -> Iterator[Finding]:
    """On very large pillars next to nothing detaches before t_max."""
    for scene in scenes_along_x(evidence.records, 1, _LARGE):
        yield Finding(
            place(scene),
            "share of the contact blocks that detach before t_max",
            mean(over_runs(before_peak, evidence.records[scene])),
            (-INF, NEGLIGIBLE),
            in_files(scene),
        )


def size_like_length(evidence: Evidence) -> Iterator[Finding]:
    """n_p where static friction is lowest, over l_c on the largest pillars of the family."""
    rows, tables = evidence.summaries, evidence.correlation_length
    for family in _of_several_sizes(rows):
        lowest = _lowest({s: over_rows(itemgetter("static_friction"), rows[s]) for s in family})
        broad = [s for s in family if s in tables and s.n_p >= _EXAMPLE]
        fits = select(tables[broad[-1]], side="x") if broad else []
        if not fits:
            continue
        l_c, n_p = interval(fits[0], "tail", "tail_low", "tail_high"), lowest.n_p
        yield Finding(
            family_place(lowest),
            f"n_p = {n_p}, where static friction is lowest, over l_c at n_p = {broad[-1].n_p}",
            Estimate(n_p / l_c.value, n_p / l_c.high, n_p / l_c.low, l_c.runs),
            (1.0 / COMPARABLE, COMPARABLE),
            f"{in_table(lowest)}; {in_rows('correlation_length', broad[-1], side='x')}",
        )


CLAIMS = (
    Claim(
        "Pillars with n_p <= 3 behave like a flat surface",
        "3.2",
        "For n_p <= 3 the transition to sliding is similar to that of a non-patterned surface. "
        "Static friction, which the paper allows to differ, is left out. Tested: off by less than "
        "half of what pillars with n_p = 20 are off by.",
        "realisations of the flat surface, of pillars with n_p <= 3 and of larger ones",
        small_pillars,
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
    Claim(
        "Precursors are negligible on very large pillars",
        "3.2",
        "For very large pillars, e.g. n_p = 60, the region characterized by sliding precursors "
        "becomes negligible with respect to the surface area of the central part. Tested: less "
        "than a tenth of the blocks. The two outermost rings alone are 13 % at n_p = 60.",
        f"realisations of pillars with n_p of {_LARGE} or more",
        negligible_edges,
    ),
    Claim(
        "Static friction is lowest where n_p is about l_c",
        "3.2",
        "When the characteristic correlation length is comparable to the total length of the "
        "pillars, static friction is smallest. Tested: within a factor of two.",
        f"{_SIZES}, and the table of correlation lengths",
        size_like_length,
    ),
    Claim(
        "The most precursors where static friction is lowest",
        "3.2",
        "An optimal length scale of the pillars maximizes the occurrence of sliding precursors, so "
        "that the static friction is minimized.",
        _SIZES,
        most_precursors,
    ),
    Claim(
        "The roundest force peak where static friction is lowest",
        "3.2",
        "This explains why the smallest static friction is obtained for a specific intermediate "
        "value of n_p, and the force peak at the transition is considerably more rounded.",
        _SIZES,
        roundest_peak,
    ),
    Claim(
        "The longest transition where static friction is lowest",
        "3.2",
        "In the intermediate regime the detachments are distributed over a longer time interval "
        "around the maximum of the friction force: a longer duration of the transition.",
        _SIZES,
        longest_transition,
    ),
)
