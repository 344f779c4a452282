"""Grooved pillars of many lengths: what the load peaks and friction follow (section 3.3)."""

from collections.abc import Iterator
from itertools import groupby
from operator import attrgetter

import numpy as np

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import samples_interval
from springblock.claims import ranges
from springblock.claims.grooves import with_both_peaks
from springblock.claims.loading import magnitude, relative
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import in_files, over_runs, scenes_along_x, static_friction
from springblock.simulation.run import Array, Run

_FEWEST = 3  #: surfaces that a trend needs
_MANIPULATED = (0.01, ranges.INF)  #: change over static friction
_GROOVES = "surfaces with grooves of several lengths along the sliding direction"


def peak_interval(run: Run, first: int, second: int) -> float:
    """Time from the first load peak to the second over t_avg."""
    return float(run.time[second] - run.time[first]) / run.t_avg


def trend(x: Array, samples: list[Array], statistic: str) -> Estimate:
    """Slope, or share of the variance explained, of a line through the means of samples; BCa.

    Samples are drawn from anew, each for itself. NaN where one of them is a single number.
    """

    def of_means(*parts: Array, axis: int = -1) -> Array:
        means = np.stack([part.mean(axis=axis) for part in parts], axis=-1)
        places, values = x - x.mean(), means - means.mean(axis=-1, keepdims=True)
        slope = values @ places / (places @ places)
        if statistic == "slope":
            return slope
        return slope**2 * (places @ places) / (values**2).sum(axis=-1)

    fewest = min(map(len, samples))
    return Estimate.of(samples_interval(samples, of_means), fewest) if fewest >= 2 else UNKNOWN


@claim("The lengths control the interval between the load peaks", "3.3", 9, f"three {_GROOVES}")
def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """The time interval between the first and the second peak is controlled by the difference
    between the length scales.

    Tested: it grows with n_p - n_p2, which explains most of its variance, on surfaces where most
    runs have two peaks.
    """
    found = dict(with_both_peaks(evidence, peak_interval))
    x = np.array([float(scene.n_p - scene.n_p2) for scene in found])
    if len(set(x)) < _FEWEST:
        return
    case, source, samples = {"surfaces": len(found)}, in_files(*found), list(found.values())
    yield Finding(
        case | {"looked at": "slope"},
        "change of the time between the load peaks over t_avg with n_p - n_p2",
        trend(x, samples, "slope"),
        ranges.POSITIVE,
        source,
        "1/block",
    )
    yield Finding(
        case | {"looked at": "control"},
        "share of the variance of the time between the load peaks, of surface means, that a line "
        "in n_p - n_p2 explains",
        trend(x, samples, "explained"),
        ranges.MOST,
        source,
    )


@claim("The length of pillars changes static friction", "3.3", 9, f"two {_GROOVES}")
def pillar_length_matters(evidence: Evidence) -> Iterator[Finding]:
    """The global static friction can be manipulated by modifying the pillar length.

    Tested: it changes by more than 1 % from the shortest to the longest pillars.
    """
    scenes = sorted(scenes_along_x(evidence.records, 2), key=lambda s: (s.n_p2, s.n_s2, s.n_p))
    for (n_p2, n_s2), group in groupby(scenes, key=attrgetter("n_p2", "n_s2")):
        alike = list({scene.n_p: scene for scene in group}.values())
        if len(alike) < 2:
            continue
        shortest, longest = alike[0], alike[-1]
        last, first = (over_runs(static_friction, evidence.records[s]) for s in (longest, shortest))
        yield Finding(
            {"n_p2": n_p2, "n_s2": n_s2},
            f"change of static friction from n_p = {shortest.n_p} to {longest.n_p}, over the first",
            magnitude(relative(last, first, first)),
            _MANIPULATED,
            in_files(shortest, longest),
        )
