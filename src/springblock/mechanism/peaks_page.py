"""The part of the page that says when grooves have two load peaks."""

from collections.abc import Iterator, Sequence
from textwrap import fill

import numpy as np

from springblock.analysis.statistics import Interval, mean_interval, prominence
from springblock.io.rows import Row, markdown_table, select
from springblock.mechanism.elasticity import Array
from springblock.mechanism.pawls import TWO_PEAKS, pawl
from springblock.model.material import Material

_WIDE = (6, 10)  #: blocks, pawls on which the surfaces of training have two load peaks
_MEASURED_TWO = 1.0  #: %, prominence of the lesser load peak, at least
_ALONG = {"x": "along", "y": "across"}
_SURFACE = ("n_p", "n_s2", "n_p2", "varied", "direction")
_TEXT = """## When do grooves have two load peaks?

The edges of pawls bear more than their core and let go first. Sliding along the grooves, edge
blocks push each other on: of what one of them loses, {along.shared:.0%} goes to others of its edge,
so that the edges let go nearly at once, the load falls, and the core carries it to a second peak.
Sliding across the grooves it is {across.shared:.0%}; the edges let go one by one over the whole
scatter of $\\mu_s$, and the slider makes up for each.

### The forces on edges and core

Pawls of 8 blocks between grooves of 2 on a pillar of 58: means over {seeds} seeds with 95 % t
intervals of the mean force per block over $F_n$. Edges are the blocks in contact beside one
without, {edge_share:.0%} of them; the figure `mechanism_budget` has the curves. In the overshoot
model time is the slider's way over its velocity, and the core's largest force is that until each
block has let go once. The load falls by the prominence of its lesser peak, every 6 µs.

{budget}

### A prediction

With the coefficients of friction, four numbers of an endless groove decide (`mechanism/pawls.py`):
R, the mean stress over that on edges; G, what the load loses per block in contact if each edge
block bears 1 less; J, the share of what an edge block loses that others of its edge take up; and w,
the standard deviation of $\\mu_s$. The load falls when edges let go faster than the slider loads
what still holds,

$$ (J R + G)(\\mu_s - \\mu_d) > \\sqrt{{2\\pi}} R w, $$

and rises to a second peak if the rows next to the edges, which take up most of the rest, then hold
more than at this minimum. For pawls of 8 between grooves of 2, R = {along.mean:.2f},
G = {along.lost:.2f} and J = {along.shared:.2f} along the grooves; {across.mean:.2f},
{across.lost:.2f} and {across.shared:.2f} across. The prediction is a prominence of the lesser peak,
the fall before it in percent of the first. It is linear in the share of edge blocks that have let
go, which no theory demands; this form was chosen because it orders the surfaces of
`docs/beyond.md`, section 2. So was the prominence beyond which two peaks are predicted,
{threshold} %, since it is up to four times too small there.

What it says of {surfaces} other surfaces, sliding along the grooves and across them, was fixed in
`tests/mechanism/predicted.csv` before any of them was simulated. Two load peaks are measured where
the mean prominence over {peak_seeds} seeds is 1 % or more:

{confusion}

{verdict}

It holds for the paper's coefficients and is no guide to others. Across the grooves it expects one
peak throughout; two are measured there on narrow pawls and with little scatter. What it misses
along them may be overshoot. Edge blocks that slip to $(2\\mu_d - \\mu_s) F_n$ hand on twice as
much, and the rows next to them come to $c \\mu_s + 2 T (\\mu_s - \\mu_d)$, with c their stress over
that on edges and T the share that they take up: along grooves of 2 {swept[1]:.2f} with the paper's
coefficients, {swept[0]:.2f} with $\\mu_d$ = 0.5, more than $\\mu_s$ = 1. The edges then take the
core with them, and one peak is left; {swept[2]:.2f} with $\\mu_d$ = 0.7 leaves even a core of two
rows. This was seen after the test, is no part of the prediction, and has not been tested itself.

Prominences in percent, with 95 % t intervals where measured; n_p = 0: grooves over the whole
surface.

{table}"""


def peaks_section(peaks: Sequence[Row], budget: Sequence[Row]) -> str:
    """Write the section from the tables `mechanism_peaks` and `mechanism_budget`."""
    paper = Material()
    surfaces = [_Surface(rows) for rows in _grouped(peaks)]
    tested = [each for each in surfaces if not each.trained]
    return _TEXT.format(
        along=pawl(8, 2, False, paper),
        across=pawl(8, 2, True, paper),
        seeds=len({row["seed"] for row in budget}),
        edge_share=budget[0]["edge_share"],
        budget=_budget(budget),
        threshold=TWO_PEAKS,
        surfaces=len(tested) // 2,
        peak_seeds=min(len(each.rows) for each in surfaces),
        confusion=_confusion(tested),
        verdict=_verdict(tested),
        swept=[_swept(mu_d) for mu_d in (0.5, 0.6, 0.7)],
        table=_table(tested),
    )


class _Surface:
    """One surface, sliding one way, with the rows of its seeds."""

    def __init__(self, rows: Sequence[Row]) -> None:
        first = rows[0]
        self.rows, self.trained, self.direction = rows, first["trained"], first["direction"]
        self.name = tuple(first[key] for key in _SURFACE[:-1])
        self.constants = first["varied"]
        self.predicted = first["predicted"]
        self.measured = mean_interval([row["measured"] for row in rows])
        self.has_two = bool(self.measured.mean >= _MEASURED_TWO)
        self.should_have_two = bool(self.predicted > TWO_PEAKS)
        self.is_clear = not self.measured.low < _MEASURED_TWO < self.measured.high


def _grouped(rows: Sequence[Row]) -> list[list[Row]]:
    keys = list(dict.fromkeys(tuple(row[key] for key in _SURFACE) for row in rows))
    return [select(rows, **dict(zip(_SURFACE, key, strict=True))) for key in keys]


def _swept(mu_d: float) -> float:
    """Stress on rows next to edges that have overshot, of grooves of 2 along sliding, over F_n."""
    of, mu_s = pawl(8, 2, False, Material()), Material().mu_static
    return of.next_to * mu_s + 2.0 * of.handed_on * (mu_s - mu_d)


def _kinds(tested: Sequence[_Surface]) -> Iterator[tuple[str, list[_Surface]]]:
    """Yield surfaces by direction and by what constants they have of their own."""
    words = {"": "the paper's", "mu_dynamic": "other $\\mu_d$", "mu_static_std": "other w"}
    for start, constants in words.items():
        for direction, way in _ALONG.items():
            here = [each for each in tested if each.direction == direction]
            found = [each for each in here if each.constants.partition("=")[0] == start]
            yield f"{constants}, {way}", found


def _confusion(tested: Sequence[_Surface]) -> str:
    lines = []
    for name, found in (*_kinds(tested), ("all", tested)):
        both = [(each.should_have_two, each.has_two) for each in found]
        ways = ((True, True), (True, False), (False, True), (False, False))
        lines.append([name, *(str(both.count(way)) for way in ways)])
    header = ["constants, direction", "two: predicted and measured", "predicted alone"]
    return markdown_table([*header, "measured alone", "one: predicted and measured"], lines)


def _verdict(tested: Sequence[_Surface]) -> str:
    papers = [each for each in tested if not each.constants]
    others = [each for each in tested if each.constants]
    wrong = [each for each in papers if each.should_have_two != each.has_two]
    close = sum(not each.is_clear for each in wrong)
    along = [each for each in papers if each.direction == "x" and not each.name[0]]
    two, one = (sorted({each.name[2] for each in along if each.has_two == it}) for it in (1, 0))
    return fill(
        f"**It is right in {_score(tested)}**, in brackets what one peak everywhere would be; "
        f"that the surfaces of `docs/beyond.md` have two along the grooves on pawls of {_WIDE[0]} "
        f"to {_WIDE[1]} blocks, taken as a rule for all, would be right in {_by_width(tested)}. "
        "What the prediction adds to such a rule is the reason: "
        f"with the paper's constants in {_score(papers)}, where 1 % lies within the interval of "
        f"what is measured in {close} of the {len(wrong)} misses, and with other coefficients in "
        f"{_score(others)}. In words: with the paper's constants grooves along the sliding "
        "direction have two load peaks if pawls are wide "
        "enough for a core and narrow enough for edges to count. Over the whole surface two are "
        f"measured for pawls of {_list(two)} blocks, one for pawls of {_list(one)}; the same width "
        "can have either with grooves of another width.",
        width=100,
    )


def _by_width(surfaces: Sequence[_Surface]) -> int:
    """How often a rule of width alone is right."""
    two = [each.direction == "x" and _WIDE[0] <= each.name[2] <= _WIDE[1] for each in surfaces]
    return sum(each.has_two == found for each, found in zip(surfaces, two, strict=True))


def _score(surfaces: Sequence[_Surface]) -> str:
    hits = sum(each.should_have_two == each.has_two for each in surfaces)
    single = sum(not each.has_two for each in surfaces)
    return f"{hits} [{single}] of {len(surfaces)} cases"


def _list(values: Sequence[int]) -> str:
    return ", ".join(map(str, values))


def _table(tested: Sequence[_Surface]) -> str:
    lines = []
    for name in sorted({each.name for each in tested}, key=lambda name: (name[3], name)):
        cells = []
        for each in (each for each in tested if each.name == name):
            missed = "" if each.should_have_two == each.has_two else " (miss)"
            cells += [f"{each.predicted:.2f}", f"{written(each.measured, 2)}{missed}"]
        lines.append([*map(str, name), *cells])
    header = [f"{what} {way}" for way in _ALONG.values() for what in ("predicted", "measured")]
    return markdown_table(["n_p", "n_s2", "n_p2", "constants", *header], lines)


def _budget(rows: Sequence[Row]) -> str:
    lines = []
    for direction, way in _ALONG.items():
        for model, name in (("simulation", "full model"), ("overshooting", "overshoot")):
            runs = [
                _milestones(select(rows, direction=direction, model=model, seed=seed))
                for seed in sorted({row["seed"] for row in rows})
            ]
            found = [mean_interval(values) for values in np.transpose(runs)]
            digits = (2, 0, 2, 2, 0, 1)
            cells = [written(each, n) for each, n in zip(found, digits, strict=True)]
            lines.append([way, name, *cells])
    header = ["edges, at most", "at (µs)", "edges later", "core, at most", "at (µs)"]
    return markdown_table(["grooves", "model", *header, "load falls by (%)"], lines)


def _milestones(rows: Sequence[Row]) -> Array:
    """Return the largest force on edges and its time, their force and that on the core when the
    latter is largest, the time of that, and the prominence of the lesser load peak, (6,).

    Per block over F_n, in µs, and in percent.
    """
    load = np.array([row["edge"] + row["core"] + row["free"] for row in rows])
    share = rows[0]["edge_share"]
    edges = np.array([row["edge"] for row in rows]) / share
    core = np.array([row["core"] for row in rows]) / (1.0 - share)
    time = [1e6 * row["time"] for row in rows]
    first, last = int(np.nanargmax(edges)), int(np.nanargmax(core))
    fall = 100.0 * prominence(load[np.isfinite(load)])
    return np.array([edges[first], time[first], edges[last], core[last], time[last], fall])


def written(interval: Interval, digits: int) -> str:
    """Return a mean with its interval, as pages have it."""
    mean, low, high = (f"{value:.{digits}f}" for value in interval)
    return f"{mean} [{low}, {high}]"
