"""What a study has found, in words, from its tables: right for any study, large or small."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from springblock.analysis.statistics import Interval, difference_interval, mean_interval
from springblock.beyond.question import by_scene, number
from springblock.io.rows import Row
from springblock.model.scene import Scene
from springblock.plotting.caption import surface_in_words
from springblock.plotting.style import MICRO

Runs = Mapping[Scene, Sequence[Row]]  #: rows of the table `realisations`, by scene


class Headline(NamedTuple):
    """What was found on a subject, in one or a few sentences, and the figure that shows it."""

    subject: str
    text: str
    figure: str = ""


def main_runs(rows: Iterable[Row]) -> dict[Scene, list[Row]]:
    """Realisations with the paper's pattern and the study's constants, on the commonest N.

    Some sizes of pillars need an N up to a tenth larger, which their period divides.
    """
    by_constants = by_scene(rows, Scene.from_row)
    found = {scene: own for scene, own in by_constants.items() if not scene.varied}
    sizes = Counter(scene.n_blocks for scene in found for _ in found[scene])
    common = max(sizes, key=lambda size: sizes[size], default=0)
    return {s: rows for s, rows in found.items() if common <= s.n_blocks <= 1.1 * common}


def headlines(runs: Runs) -> list[Headline]:
    """Say what became of static friction, of its time and of grooves, and of energy."""
    told = [_friction(runs), _order(runs), _grooves(runs), _energy(runs)]
    return [headline for headline in told if headline]


def sizes(runs: Runs, lengths: Sequence[Row]) -> list[list[str]]:
    """Return rows for the flat surface and for pillars of each size, as far apart as wide.

    They hold the surface, the number of runs, static friction, t_max - t_avg in µs, and l_c along
    x and along y in blocks, empty where it was not measured.
    """
    return [
        [
            f"n_p = n_s = {scene.n_p}" if scene.n_p else "flat",
            str(len(rows)),
            number(mean_interval(_static(rows))),
            number(_lag(rows), factor=MICRO),
            *(_l_c(scene, side, lengths) for side in "xy"),
        ]
        for scene, rows in _family(runs).items()
    ]


def grooves(runs: Runs) -> list[list[str]]:
    """Return rows for patterns of grooves that were pulled both along them and across.

    They hold the surface, both numbers of runs, static friction along the grooves and across them,
    and the difference.
    """
    return [
        [
            surface_in_words(along.lengths),
            f"{len(runs[along])}, {len(runs[across])}",
            number(mean_interval(_static(runs[along]))),
            number(mean_interval(_static(runs[across]))),
            number(difference),
        ]
        for along, across, difference in _along_and_across(runs)
    ]


def _along_and_across(runs: Runs) -> list[tuple[Scene, Scene, Interval]]:
    """Return grooved pillars by direction, and the mean difference of friction, seed by seed."""
    found = []
    for along in runs:
        across = replace(along, direction="y")
        if along.level == 2 and along.direction == "x" and across in runs:
            first, second = (
                {row["seed"]: row["static_friction"] for row in runs[each]}
                for each in (along, across)
            )
            common = sorted(first.keys() & second.keys())
            difference = mean_interval([first[seed] - second[seed] for seed in common])
            found.append((along, across, difference))
    return found


def _family(runs: Runs) -> dict[Scene, Sequence[Row]]:
    """Flat surfaces and pillars with n_s = n_p that slide along x, by size."""
    plain = [s for s in runs if s.lengths.keys() <= {"n_p", "n_s"} and s.direction == "x"]
    simple = [s for s in plain if s.n_s == s.n_p]
    return {scene: runs[scene] for scene in sorted(simple, key=lambda scene: scene.n_p)}


def _friction(runs: Runs) -> Headline | None:
    """Static friction of flat surfaces and pillars."""
    scenes = list(_family(runs))
    if len(scenes) < 2 or scenes[0].n_p:
        return None
    flat, *pillars = scenes
    lowest = min(pillars, key=lambda scene: float(mean_interval(_static(runs[scene])).mean))
    text = f"Static friction is {_stated(runs[flat])} on a flat surface, and "
    text += f"{_stated(runs[lowest])} on pillars of n_p = {lowest.n_p}, "
    text += "the lowest mean of those simulated" if pillars[1:] else "the only ones simulated"
    text += f": {_told(runs[lowest], runs[flat])}."
    if (largest := pillars[-1]) != lowest:
        text += f" On the largest, n_p = {largest.n_p}, it is {_stated(runs[largest])}: "
        text += f"{_told(runs[largest], runs[lowest])}."
    return Headline("Friction and the size of pillars", text, "figure_6")


def _order(runs: Runs) -> Headline | None:
    """Whether the force peaks before or after the mean detachment."""
    kinds: dict[str, list[Scene]] = {}
    for scene, rows in _family(runs).items():
        kind = _sign(_lag(rows), "before", "after", "not told from")
        kinds.setdefault(kind, []).append(scene)
    if not kinds:
        return None
    first, *others = [f"{kind} {{}} on {_listed(scenes)}" for kind, scenes in kinds.items()]
    told = [first.format("the mean first detachment"), *(other.format("it") for other in others)]
    text = f"The time of the largest force is {'; '.join(told)}."
    return Headline("Force and detachments", text, "figure_6")


def _listed(scenes: Sequence[Scene]) -> str:
    """Name flat surfaces and pillars."""
    pillars = ", ".join(str(scene.n_p) for scene in scenes if scene.n_p)
    flat = ["the flat surface"] * (not scenes[0].n_p)
    return " and ".join(flat + [f"pillars of n_p = {pillars}"] * bool(pillars))


def _grooves(runs: Runs) -> Headline | None:
    """Static friction along grooves and across them."""
    words = ("lower", "higher", "not told apart")
    found = Counter(_sign(difference, *words) for _, _, difference in _along_and_across(runs))
    if not found:
        return None
    told = ", ".join(f"{word} on {number}" for word, number in found.items())
    which = "Static friction along the grooves, compared with that across them, is"
    return Headline("Grooves", f"{which} {told} of {found.total()} grooved surfaces.", "figure_9")


def _energy(runs: Runs) -> Headline | None:
    """How well the balance of energy closes."""
    errors = [abs(row["energy_error"]) for rows in runs.values() for row in rows]
    if not errors:
        return None
    closes = f"closes to {max(errors):.1e} of the slider's work or better"
    return Headline("Energy", f"The balance of energy of all {len(errors)} realisations {closes}.")


def _static(rows: Sequence[Row]) -> list[float]:
    return [row["static_friction"] for row in rows]


def _lag(rows: Sequence[Row]) -> Interval:
    return mean_interval([row["t_max"] - row["t_avg"] for row in rows])


def _sign(difference: Interval, negative: str, positive: str, unknown: str) -> str:
    """Return the word for what an interval tells of a sign."""
    if difference.high < 0.0:
        return negative
    return positive if difference.low > 0.0 else unknown


def _told(first: Sequence[Row], second: Sequence[Row]) -> str:
    """Say by how much static friction is lower or higher on the first surface."""
    difference = difference_interval(_static(first), _static(second))
    word = _sign(difference, "lower", "higher", "")
    if not word:
        return f"not told apart by their difference, {number(difference)}"
    low, high = sorted(map(abs, (difference.low, difference.high)))
    return f"{word} by {number(Interval(abs(difference.mean), low, high))}"


def _stated(rows: Sequence[Row]) -> str:
    return f"{number(mean_interval(_static(rows)))} ({len(rows)} run{'s' * (len(rows) > 1)})"


def _l_c(scene: Scene, side: str, lengths: Sequence[Row]) -> str:
    """Correlation length of a scene's sides, if the table has it."""
    for row in lengths:
        if row["side"] == side and Scene.from_row(row) == scene:
            return number(Interval(row["l_c"], row["ci_low"], row["ci_high"]))
    return ""
