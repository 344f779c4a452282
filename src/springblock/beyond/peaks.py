"""Load peaks over the grooves' widths and the sliding direction, with pillars and without."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from springblock.analysis.statistics import Interval, lesser_prominence, mean_interval
from springblock.beyond.question import Ensembles, Question, number
from springblock.beyond.resampling import difference
from springblock.io.rows import markdown_table
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run, friction

_ANGLES = {"x": 0.0, "y": 90.0}  #: degrees from grooves along x


class Grooves(NamedTuple):
    """Widths of pawls and grooves, blocks, on pillars of n_p blocks or on none, n_p = 0."""

    n_p: int
    n_s2: int
    n_p2: int


def angle(direction: str) -> float:
    """Degrees between a sliding direction and grooves along x."""
    return float(_ANGLES.get(direction, direction))


def prominences(runs: Sequence[Run]) -> Array:
    """Prominence of the lesser load peak of each realisation, % of its largest force, (k,)."""
    return np.array([100.0 * lesser_prominence(friction(run)) for run in runs])


def by_grooves(ensembles: Ensembles) -> dict[Grooves, dict[float, Array]]:
    """Prominences in %, by widths and by the angle between sliding and grooves."""
    found: dict[Grooves, dict[float, Array]] = {}
    for scene, runs in ensembles.items():
        if _is_one(scene):
            angles = found.setdefault(Grooves(scene.n_p, scene.n_s2, scene.n_p2), {})
            angles[angle(scene.direction)] = prominences(runs)
    return {grooves: dict(sorted(found[grooves].items())) for grooves in sorted(found)}


def _is_one(scene: Scene) -> bool:
    """Whether it has grooves alone or grooves on the paper's pillars, of the study's material."""
    return bool(scene.n_p2) and not scene.n_p3 and not scene.varied


def along_and_across(angles: Mapping[float, Array]) -> Interval:
    """Prominence along the grooves minus that across them, %."""
    return difference(angles[0.0], angles[90.0])


def _answers(ensembles: Ensembles) -> Iterator[str]:
    found = {
        key: angles for key, angles in by_grooves(ensembles).items() if {0.0, 90.0} <= {*angles}
    }
    if not found:
        return
    shown = sorted({angle for angles in found.values() for angle in angles})
    shown = [angle for angle in shown if all(angle in angles for angles in found.values())]
    contrasts = {key: along_and_across(angles) for key, angles in found.items()}
    for words, keys in (
        ("on pillars", [key for key in found if key.n_p]),
        ("over the whole surface", [key for key in found if not key.n_p]),
    ):
        more = sum(bool(contrasts[key].low > 0.0) for key in keys)
        less = sum(bool(contrasts[key].high < 0.0) for key in keys)
        yield (
            f"**Grooves {words}**: the lesser load peak is more prominent along the grooves than "
            f"across them on {more} of {len(keys)} surfaces, less on {less}."
        )
    yield from _hierarchy(found)
    header = ["n_p", "n_s2", "n_p2", *(f"{angle:g}°" for angle in shown), "0° minus 90°"]
    lines = []
    for key, angles in found.items():
        values = [number(mean_interval(angles[angle])) for angle in shown]
        lines.append([*map(str, key), *values, number(contrasts[key])])
    yield markdown_table(header, lines)


def _hierarchy(found: Mapping[Grooves, Mapping[float, Array]]) -> Iterator[str]:
    """What pillars do to the same grooves, when sliding along them."""
    pairs = [(found[key], found.get(Grooves(0, key.n_s2, key.n_p2))) for key in found if key.n_p]
    contrasts = [difference(on[0.0], off[0.0]) for on, off in pairs if off]
    if contrasts:
        more = sum(bool(each.low > 0.0) for each in contrasts)
        less = sum(bool(each.high < 0.0) for each in contrasts)
        yield (
            "**Hierarchy**: along the same grooves it is more prominent on pillars than over the "
            f"whole surface in {more} of {len(contrasts)} cases, less in {less}."
        )


QUESTION = Question(
    "When has sliding two load peaks?",
    """A load peak is a maximum of the force that reaches 90 % of the largest. Its prominence is how
far the force falls before it rises to a higher one, in percent of the largest force, run by run;
that of the second most prominent peak is shown, 0 where there is one peak alone. Grooves are n_s2
blocks wide and pawls n_p2, on pillars of n_p blocks (0: over the whole surface), at angles between
sliding direction and grooves. A prominence cannot be negative: small ones are what scatter leaves,
and the difference between the directions along and across says more. Its interval is that of one
surface; of many surfaces a few differ by chance.""",
    "groups peaks and grooves",
    _answers,
)
