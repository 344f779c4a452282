"""The page of statements, written from the table `claims`."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path

import numpy as np

from springblock.claims import table_in
from springblock.claims.rule import capitalised, phrase
from springblock.io.rows import Row, listed, markdown_table

_SECTIONS = {
    "1": "Introduction",
    "2": "Model",
    "3.1": "Non-patterned surface",
    "3.2": "Single-scale patterned surfaces",
    "3.3": "Multiscale patterned surfaces",
    "4": "Discussion and relevance to seismic phenomena",
    "5": "Conclusions",
}

_VERDICTS = ("reproduced", "reproduced in part", "not reproduced", "not settled", "not tested")

Part = tuple[int, list[Row]]  #: a statement's number, and its rows

#: The rule, the intervals, and the statements that are not tested.
_PAGE = Path(__file__).with_name("page.md")
#: Why the test of a statement is not the one that was registered; statements by name.
CHANGED = dict(table_in("reasons.md"))


def page(table: Sequence[Row]) -> str:
    """Write the page from the rows of the table `claims`."""
    numbered = numbered_parts(table)
    first, *others = [f"{n} {verdict}" for verdict, n in counted(numbered).items()]
    return _PAGE.read_text(encoding="utf-8").format(
        total=len(numbered),
        tally=listed([first.replace(" ", " are ", 1), *others]),
        summary="\n\n".join(_contents(numbered)),
        sections="\n\n".join(_section(*part) for part in numbered),
    )


def counted(numbered: Iterable[Part]) -> dict[str, int]:
    """Count the verdicts that occur, from reproduced to not tested."""
    found = Counter(part[0]["verdict"] for _, part in numbered)
    return {verdict: found[verdict] for verdict in _VERDICTS if found[verdict]}


def numbered_parts(table: Sequence[Row]) -> list[Part]:
    """Return the rows of each statement with its number on the page."""
    parts = groupby(table, key=itemgetter("claim"))
    return [(number, list(part)) for number, (_, part) in enumerate(parts, 1)]


def _contents(numbered: Sequence[Part]) -> list[str]:
    """Tables of statements and verdicts, section by section."""
    parts = []
    header = ["statement", "form", "verdict", "test", "deciding finding", "claimed"]
    for section, group in groupby(numbered, key=lambda part: part[1][0]["section"]):
        lines = []
        for number, part in group:
            first, heading = part[0], f"{number}. {part[0]['claim']}"
            link, verdict = f"[{heading}](#{anchor(heading)})", f"**{first['verdict']}**"
            mark = "changed" if first["claim"] in CHANGED else "registered"
            found = _deciding(part)
            said, claimed = _missing(first), "–"
            if found:
                said, claimed = f"{_in_words(found, part)}.", _range(found)
            lines.append([link, first["form"], verdict, mark, said, claimed])
        parts += [f"### Section {section}: {_SECTIONS[section]}", markdown_table(header, lines)]
    return parts


def anchor(heading: str) -> str:
    """Return the anchor that Markdown gives to a heading."""
    kept = "".join(c for c in heading.lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def decided(part: Sequence[Row]) -> str:
    """Write where a statement holds and fails, and the finding that decided its verdict."""
    found = _deciding(part)
    if found is None:
        return _missing(part[0])
    settled = f"; {_needed(found)}" if found["outcome"] == "open" else ""
    sentence = f"{_in_words(found, part)} (claimed: {_range(found)}){settled}."
    return f"{part[0]['boundary']} {sentence}".strip()


def _missing(row: Row) -> str:
    return f"{row['rests_on'].capitalize()}."


def _deciding(part: Sequence[Row]) -> Row | None:
    """Return the finding that decided the verdict, None without any.

    That is the one with the smallest margin, the clearest failure, or the open one that needs the
    most realisations.
    """
    if part[0]["verdict"] == "not tested":
        return None
    kind, choose, key = {
        "reproduced": ("holds", min, _clearness),
        "reproduced in part": ("fails", max, _clearness),
        "not reproduced": ("fails", max, _clearness),
        "not settled": ("open", max, lambda row: np.nan_to_num(row["needed"], nan=-1.0)),
    }[part[0]["verdict"]]
    return choose((row for row in part if row["outcome"] == kind), key=key)


def _clearness(row: Row) -> tuple[float, float]:
    """Return the margin to the nearest limit over the arm of the interval, and the margin itself.

    Exact values have no arm, and the margin alone orders them.
    """
    value, low, high = row["value"], row["together_low"], row["together_high"]
    ways = []
    for limit in (row["claimed_low"], row["claimed_high"]):
        if math.isfinite(limit):
            arm = value - low if limit < value else high - value
            margin = abs(value - limit)
            ways.append((margin / arm if arm > 0.0 else math.inf, margin))
    return min(ways)


def _in_words(row: Row, part: Sequence[Row]) -> str:
    """Write a finding as a sentence, with the keys of its case that distinguish it."""
    statistic, all_keys = row["statistic"], [_keys(other) for other in part]
    where = [key for key in _keys(row) if not all(key in keys for keys in all_keys)]
    new = [pair for pair in where if not _says(statistic, *pair)]
    subject = f"{' '.join(phrase(*pair) for pair in new)}, {statistic}" if new else statistic
    return f"{capitalised(subject)}{',' if ',' in statistic else ''} is {_value(row)}"


def _says(statistic: str, key: str, value: str) -> bool:
    return f"{key} = {value}" in statistic or (value[0].isalpha() and value in statistic)


def _needed(row: Row) -> str:
    """Write how many realisations would settle an open finding."""
    wanted = row["needed"]
    if math.isnan(wanted):
        return "no interval"
    if math.isinf(wanted):
        return "more realisations would not settle it"
    digits = 10 ** max(0, len(str(int(wanted))) - 2)
    return f"about {math.ceil(wanted / digits) * digits} realisations would settle it"


def _section(number: int, part: Sequence[Row]) -> str:
    first = part[0]
    quoted, tested, criterion = first["statement"].partition(" Test: ")
    lines = [f"## {number}. {first['claim']}", f"{quoted} (section {first['section']})"]
    lines += [f"Test: {criterion}"] if tested else []
    why = CHANGED.get(first["claim"])
    lines.append(f"Changed after registration: {why}." if why else "Registered before its data.")
    lines.append(
        f"**{first['verdict'].capitalize()}** ({first['form']} statement). {decided(part)}"
    )
    if first["verdict"] != "not tested":
        lines += _opened(part)
    return "\n\n".join(lines)


def _opened(part: Sequence[Row]) -> list[str]:
    """Return the data and, if there are several findings, a collapsible list of them."""
    sources = dict.fromkeys(name for row in part for name in row["rests_on"].split("; "))
    data = f"Data: {', '.join(f'`{source}`' for source in sources)}"
    if not part[1:]:
        return [data]
    shared = len({row["statistic"] for row in part}) == 1
    title = f"{len(part)} findings" + (f": {part[0]['statistic']}" if shared else "")
    level = f"{100.0 - 5.0 / len(part):.4g} % interval, 95 % jointly"
    value = "value (exact)" if all(map(_is_exact, part)) else f"value [{level}]"
    header = ["case", "" if shared else "statistic", value, "claimed", "outcome"]
    columns = zip(header, *map(_cells, part), strict=True)
    filled = (each for each in columns if each[0] and any(each[1:]))  # the title has the statistic
    titles, *lines = zip(*filled, strict=True)
    table = markdown_table(titles, lines)
    return [f"<details><summary>{title}</summary>", table, data, "</details>"]


def _cells(row: Row) -> list[str]:
    needed = f": {_needed(row)}" if row["outcome"] == "open" else ""
    outcome = f"{row['outcome']}{needed}"
    case = " ".join(phrase(*key) for key in _keys(row))
    return [case, row["statistic"], _value(row), _range(row), outcome]


def _keys(row: Row) -> list[list[str]]:
    """Return the keys and values of a case."""
    return [key.split(" = ", 1) for key in row["case"].split(", ") if key]


def _value(row: Row) -> str:
    limits = f" [{row['together_low']:.3g}, {row['together_high']:.3g}]"
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return f"{row['value']:.3g}{'' if _is_exact(row) else limits}{unit}"


def _is_exact(row: Row) -> bool:
    return row["realisations"] == 0


def _range(row: Row) -> str:
    low, high = row["claimed_low"], row["claimed_high"]
    if math.isinf(high):
        return f"> {low:.3g}"
    return f"< {high:.3g}" if math.isinf(low) else f"{low:.3g} to {high:.3g}"
