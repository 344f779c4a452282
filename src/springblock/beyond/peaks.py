"""Load peaks against widths of grooves and sliding direction, with pillars and without."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import pandas as pd

from springblock.analysis.statistics import PROMINENT, Interval, mean_interval, number, prominence
from springblock.beyond.question import UNCHANGED, Ensembles, direction, grouped
from springblock.io.records import Record
from springblock.io.rows import markdown_table
from springblock.model.direction import degrees
from springblock.simulation.run import friction

NEEDS = "groups peaks and grooves"
_TWO = 100.0 * PROMINENT  #: %


class Grooves(NamedTuple):
    """Widths of pawls and grooves, blocks, on pillars of n_p blocks or on none, n_p = 0."""

    n_p: int
    n_s2: int
    n_p2: int


def prominences(runs: Sequence[Record]) -> pd.Series:
    """Return the prominence of the lesser load peak, % of the largest force, by seed."""
    return pd.Series({run.seed: 100.0 * prominence(friction(run)) for run in runs})


def by_grooves(ensembles: Ensembles) -> dict[Grooves, dict[float, pd.Series]]:
    """Prominences by widths and by the angle between sliding and grooves.

    Grooves are alone or on pillars, with the study's material; of surfaces of several sizes the one
    with the most realisations is used.
    """
    found = grouped(
        (Grooves(scene.n_p, scene.n_s2, scene.n_p2), degrees(scene.direction), prominences(runs))
        for scene, runs in sorted(ensembles.items(), key=lambda item: len(item[1]))
        if scene.n_p2 and not scene.n_p3 and not scene.varied
    )
    return dict(sorted(found.items()))


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    found = {at: angles for at, angles in by_grooves(ensembles).items() if {0.0, 90.0} <= {*angles}}
    if not found:
        return
    shown = sorted(set.intersection(*(set(angles) for angles in found.values())))
    contrasts = {key: _difference(angles[0.0], angles[90.0]) for key, angles in found.items()}
    more, less = _significant(list(contrasts.values()))
    along = {key: mean_interval(angles[0.0]) for key, angles in found.items()}
    one_peak = [key for key in found if max(found[key][way].mean() for way in (0.0, 90.0)) < _TWO]
    without, _ = _significant([contrasts[key] for key in one_peak])
    low = f"on {without} of these, its prominence is below {_TWO:g} % in both directions"
    small = f" ({low})" if without else ""
    most = max(found, key=lambda key: float(along[key].mean))
    alike = [key for key in found if direction(along[most], along[key]) == UNCHANGED]
    place = f"on pillars of {most.n_p} blocks" if most.n_p else "over the whole surface"
    rank = ", not significantly larger than on some of the others" if alike[1:] else ""
    yield (
        "**The lesser load peak is significantly more prominent when sliding along the grooves "
        f"than across them** on {more} of {len(found)} surfaces{small}, and less prominent on "
        f"{less or 'none'}. For sliding along the grooves, its prominence is largest "
        f"with pawls of {most.n_p2} and grooves of {most.n_s2} blocks {place}: "
        f"{number(along[most], ' %')} of the largest force{rank}."
    )
    pairs = [(on, off) for on in found if on.n_p and (off := on._replace(n_p=0)) in found]
    if pairs:
        apart = {(on, off): _difference(found[on][0.0], found[off][0.0]) for on, off in pairs}
        two = [apart[both] for both in pairs if min(along[each].mean for each in both) > _TWO]
        more, less = _significant(list(apart.values()))
        yield (
            f"Hierarchy: in each of {len(pairs)} pairs, two surfaces have the same grooves, one "
            "with pillars and one without. For sliding along the grooves, the lesser peak is "
            f"significantly more prominent on the surface with pillars in {more} pairs, and less "
            f"prominent in {less or 'none'}. In {len(two)} pairs, the prominence of the lesser "
            f"peak exceeds {_TWO:g} % on both surfaces; the difference is significant in "
            f"{sum(_significant(two)) or 'none'} of these. The "
            "surfaces of a pair also differ in the number of blocks in contact; the more there "
            "are, the smaller are fluctuations of the force."
        )
    header = ["n_p", "n_s2", "n_p2", *(f"{angle:g}°" for angle in shown), "0° minus 90°"]
    lines = []
    for key, angles in found.items():
        values = [number(mean_interval(angles[angle])) for angle in shown]
        lines.append([*map(str, key), *values, number(contrasts[key])])
    yield markdown_table(header, lines)


def _difference(first: pd.Series, second: pd.Series) -> Interval:
    """Return the mean difference over seeds that both have, with the same friction coefficients."""
    return mean_interval((first - second).dropna())


def _significant(differences: Sequence[Interval]) -> tuple[int, int]:
    """Count the differences significantly above zero, and those below."""
    above = [bool(each.low > 0.0) for each in differences]
    below = [bool(each.high < 0.0) for each in differences]
    return sum(above), sum(below)
