"""The page of claims, written from their table."""

import math
from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path

import numpy as np

from springblock.claims import register
from springblock.io.rows import Row, markdown_table

_SECTIONS = {
    "1": "Introduction",
    "2": "Model",
    "3.1": "Non-patterned surface",
    "3.2": "Single-scale patterned surfaces",
    "3.3": "Multiscale patterned surfaces",
    "4": "Discussion and relevance to seismic phenomena",
    "5": "Conclusions",
}

Part = tuple[int, list[Row]]  #: a statement's number, and its rows

#: The rule, what the intervals are, and what is not tested.
_PAGE = Path(__file__).with_name("page.md")


def page(table: Sequence[Row]) -> str:
    """Write the page from the rows of the table `claims`."""
    numbered = numbered_parts(table)
    return _PAGE.read_text(encoding="utf-8").format(
        summary="\n\n".join(_contents(numbered)),
        changes=register.changes(table),
        sections="\n\n".join(_section(*part) for part in numbered),
    )


def numbered_parts(table: Sequence[Row]) -> list[Part]:
    """Rows of each statement, beside its number on the page."""
    parts = groupby(table, key=itemgetter("claim"))
    return [(number, list(part)) for number, (_, part) in enumerate(parts, 1)]


def _contents(numbered: Sequence[Part]) -> list[str]:
    """Tables of statements and verdicts, section by section."""
    earlier, parts = register.verdicts(), []
    header = ["statement", "form", "verdict", "earlier seeds", "1.0.0", "what decided it"]
    for section, group in groupby(numbered, key=lambda part: part[1][0]["section"]):
        lines = []
        for number, part in group:
            first, heading = part[0], f"{number}. {part[0]['claim']}"
            before = earlier.get(first["claim"], {})
            link, verdict = f"[{heading}](#{anchor(heading)})", f"**{first['verdict']}**"
            old = [before.get(name, "") or "–" for name in ("verdict", "verdict_1_0_0")]
            lines.append([link, first["form"], verdict, *old, decided(part)])
        parts += [f"### Section {section}: {_SECTIONS[section]}", markdown_table(header, lines)]
    return parts


def anchor(heading: str) -> str:
    """The anchor that Markdown gives to a heading."""
    kept = "".join(c for c in heading.lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def decided(part: Sequence[Row]) -> str:
    """Where a statement holds and fails, and the finding that decided its verdict.

    That is the one nearest to failing, the one that fails most clearly, or the open one that needs
    the most realisations.
    """
    first = part[0]
    if first["verdict"] == "not tested":
        return f"{first['rests_on'].capitalize()}."
    kind, choose, key = {
        "reproduced": ("holds", min, _clearness),
        "reproduced in part": ("fails", max, _clearness),
        "not reproduced": ("fails", max, _clearness),
        "not settled": ("open", max, lambda row: np.nan_to_num(row["needed"], nan=-1.0)),
    }[first["verdict"]]
    found = choose((row for row in part if row["outcome"] == kind), key=key)
    sentence = _in_words(found, part)
    if first["verdict"] == "not settled":
        sentence += f"; {_needed(found)}"
    return f"{first['boundary']} {sentence}.".strip()


def _clearness(row: Row) -> float:
    """Distance from the nearest edge of the claimed range, in the arm that points there."""
    value, low, high = row["value"], row["together_low"], row["together_high"]
    ways = []
    for limit in (row["claimed_low"], row["claimed_high"]):
        if math.isfinite(limit):
            arm = value - low if limit < value else high - value
            ways.append(abs(value - limit) / arm if arm > 0.0 else math.inf)
    return min(ways)


def _in_words(row: Row, part: Sequence[Row]) -> str:
    """A finding, with what tells its case from those of the statement's others."""
    common = set.intersection(*(set(other["case"].split(", ")) for other in part))
    case = ", ".join(key for key in row["case"].split(", ") if key not in common)
    told_apart = f" ({case})" if case else ""
    first, *rest = row["statistic"].split(" ")
    statistic = " ".join([first.capitalize() if first.isalpha() else first, *rest])
    return f"{statistic}{told_apart} is {_value(row)}, claimed {_range(row)}"


def _needed(row: Row) -> str:
    """How many realisations would settle an open finding."""
    wanted = row["needed"]
    if math.isnan(wanted):
        return "no interval"
    if math.isinf(wanted):
        return "no number of realisations settles it"
    digits = 10 ** max(0, len(str(int(wanted))) - 2)
    return f"about {math.ceil(wanted / digits) * digits} realisations would settle it"


def _section(number: int, part: Sequence[Row]) -> str:
    first = part[0]
    lines = [
        f"## {number}. {first['claim']}",
        f"{first['statement']} (section {first['section']})",
        f"Verdict on this {first['form']} statement: **{first['verdict']}**. {first['boundary']}",
    ]
    if first["verdict"] == "not tested":
        lines[-1] += f"{first['rests_on'].capitalize()}."
    else:
        together = f" together, {100.0 - 5.0 / len(part):.4g} % alone" if part[1:] else ""
        value = f"value [95 % interval{together}]"
        header = ["case", "statistic", value, "claimed", "outcome"]
        lines.append(markdown_table(header, [_cells(row) for row in part]))
        sources = dict.fromkeys(name for row in part for name in row["rests_on"].split("; "))
        lines.append("\n".join(["Rests on", "", *(f"- {source}" for source in sources)]))
    return "\n\n".join(lines)


def _cells(row: Row) -> list[str]:
    outcome = row["outcome"]
    if outcome == "open":
        outcome += f": {_needed(row)}"
    return [row["case"], row["statistic"], _value(row), _range(row), outcome]


def _value(row: Row) -> str:
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{row['value']:.3g} [{row['together_low']:.3g}, {row['together_high']:.3g}]{unit}"


def _range(row: Row) -> str:
    low, high = row["claimed_low"], row["claimed_high"]
    if math.isinf(high):
        return f"> {low:.3g}"
    return f"< {high:.3g}" if math.isinf(low) else f"{low:.3g} to {high:.3g}"
