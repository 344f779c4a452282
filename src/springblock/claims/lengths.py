"""Grooved pillars of many lengths: what the load peaks and friction follow (section 3.3)."""

from collections.abc import Iterator
from itertools import groupby
from operator import attrgetter
from typing import Any

import numpy as np

from springblock.claims.grooves import both_peaks
from springblock.claims.loading import magnitude, relative
from springblock.claims.rule import Claim, Estimate, Evidence, Finding
from springblock.claims.samples import (
    INF,
    MOST,
    POSITIVE,
    in_files,
    mean,
    over_runs,
    scenes_along_x,
)
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_FEW = 3  #: surfaces that a trend needs
_CHANGES = 0.01  #: share of static friction by which it is manipulated
_GROOVES = "surfaces with grooves of several lengths along the sliding direction"


def apart(run: Run) -> float:
    """Time from the first load peak to the last over t_avg; NaN with less than two."""
    peaks = both_peaks(run)
    return float(run.time[peaks[1]] - run.time[peaks[0]]) / run.t_avg if peaks else float("nan")


def trend(x: Array, samples: list[Array], statistic: str) -> Estimate:
    """Slope, or share of the variance explained, of a line through the means of samples; BCa.

    Samples are drawn from anew, each for itself. NaN where one of them is a single number.
    """
    from scipy.stats import bootstrap  # slow to load, and few claims need it

    def of_means(*parts: Array, axis: int = -1) -> Array:
        means = np.stack([part.mean(axis=axis) for part in parts], axis=-1)
        places, values = x - x.mean(), means - means.mean(axis=-1, keepdims=True)
        slope = values @ places / (places @ places)
        if statistic == "slope":
            return slope
        return slope**2 * (places @ places) / (values**2).sum(axis=-1)

    if min(map(len, samples)) < 2:
        return mean({})
    options: dict[str, Any] = {"rng": np.random.default_rng(0), "n_resamples": 2000}
    found = bootstrap(samples, of_means, method="BCa", vectorized=True, **options)
    limits = found.confidence_interval
    value = float(of_means(*samples))
    return Estimate(value, float(limits.low), float(limits.high), min(map(len, samples)))


def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """The load peaks are further apart where the lengths are, on a line."""
    found: dict[Scene, Array] = {}
    for scene in scenes_along_x(evidence.records, 2):
        sample = over_runs(apart, evidence.records[scene])
        if len(sample) > MOST * len(evidence.records[scene]):
            found[scene] = np.array(list(sample.values()))
    x = np.array([float(scene.n_p - scene.n_p2) for scene in found])
    if len(set(x)) < _FEW:
        return
    case, source = {"surfaces": len(found)}, in_files(*found)
    yield Finding(
        case | {"looked at": "slope"},
        "change of the time between the load peaks over t_avg with n_p - n_p2",
        trend(x, list(found.values()), "slope"),
        POSITIVE,
        source,
        "1/block",
    )
    yield Finding(
        case | {"looked at": "control"},
        "share of the variance of the time between the load peaks, of surface means, that a line "
        "in n_p - n_p2 explains",
        trend(x, list(found.values()), "explained"),
        (MOST, INF),
        source,
    )


def pillar_length_matters(evidence: Evidence) -> Iterator[Finding]:
    """Static friction changes with the length of the pillars, at the same pawls and grooves."""
    scenes = sorted(scenes_along_x(evidence.records, 2), key=lambda s: (s.n_p2, s.n_s2, s.n_p))
    for (n_p2, n_s2), group in groupby(scenes, key=attrgetter("n_p2", "n_s2")):
        alike = list({scene.n_p: scene for scene in group}.values())
        if len(alike) < 2:
            continue
        friction = attrgetter("static_friction")
        last, first = (over_runs(friction, evidence.records[s]) for s in (alike[-1], alike[0]))
        yield Finding(
            {"n_p2": n_p2, "n_s2": n_s2},
            f"change of static friction from n_p = {alike[0].n_p} to {alike[-1].n_p}, over the "
            "first",
            magnitude(relative(last, first, first)),
            (_CHANGES, INF),
            in_files(alike[0], alike[-1]),
        )


CLAIMS = (
    Claim(
        "The lengths control the interval between the load peaks",
        "3.3",
        "The time interval between the first and the second peak is controlled by the difference "
        "between the length scales. Tested: it grows with n_p - n_p2, which explains most of its "
        "variance, on surfaces where most runs have two peaks.",
        f"three {_GROOVES}",
        interval_follows_lengths,
    ),
    Claim(
        "The length of pillars changes static friction",
        "3.3",
        "The global static friction can be manipulated by modifying the pillar length. Tested: it "
        "changes by more than 1 % from the shortest to the longest pillars.",
        f"two {_GROOVES}",
        pillar_length_matters,
    ),
)
