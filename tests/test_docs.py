"""The pages in docs are those that the code writes today, but for what was measured."""

import re
from pathlib import Path

import pytest

from precision import precision_rows, production_rows
from springblock import Material, Realisation
from springblock.accuracy.page import page as accuracy_page
from springblock.accuracy.stability.table import all_cases
from springblock.beyond import QUESTIONS
from springblock.beyond.page import page as beyond_page
from springblock.claims import CLAIMS
from springblock.claims.page import page as claims_page
from springblock.claims.rule import Evidence
from springblock.claims.table import rows
from springblock.io.schemas import SETUP
from springblock.report.dictionary import page as dictionary
from springblock.report.dictionary import tables

DOCS = Path(__file__).parents[1] / "docs"


def numberless(text):
    """Lines of the page on errors, which numbers and nothing else may tell apart.

    Where CPU time does not suffice for a single seed, the page says so in place of numbers.
    """
    measured = text.replace("no seed", "0 [0, 0]")
    return re.sub(r"[-+]?\d+(\.\d+)?(e[-+]\d+)?", "#", measured).splitlines()


def unmeasured(text):
    """Lines of the page on statements that hold for any study."""
    measured = ("|", "Verdict: ", "Rests on", "- preludes/", "- realisations/", "- tables/")
    return [line for line in text.splitlines() if line and not line.startswith(measured)]


def unanswered(text):
    """Lines of the page beyond the paper that hold for any study."""
    return [line for line in text.splitlines() if line and not line.startswith(("|", "**"))]


def test_the_page_on_errors_is_what_the_code_writes():
    stability = [{"family": case.family, "expected": "", "outcome": ""} for case in all_cases()]
    text = accuracy_page(precision_rows(), stability, [{"energy_error": 1e-5}], production_rows())
    assert numberless((DOCS / "accuracy.md").read_text()) == numberless(text)


def test_the_page_on_statements_is_what_the_code_writes():
    text = claims_page(rows(CLAIMS, Evidence()))
    assert unmeasured((DOCS / "claims.md").read_text()) == unmeasured(text)


def test_the_page_beyond_the_paper_is_what_the_code_writes():
    text = (DOCS / "beyond.md").read_text()
    assert unanswered(text) == unanswered(beyond_page(QUESTIONS, {}))
    assert "**Not answered**" not in text


def test_the_dictionary_of_tables_is_what_the_code_writes():
    assert (DOCS / "tables.md").read_text() == dictionary(tables())


def symbols(heading, text):
    """Rows of the tables of symbols below a heading: the name in the code, and what follows it."""
    section = text.split(f"## {heading}\n")[1].split("\n## ")[0]
    return re.findall(r"^\| .*? \| `(\w+)` \| (\S+) \| (.*?) \|$", section, re.MULTILINE)


def test_the_symbols_of_the_model_are_those_of_the_code():
    """Every constant with its unit and the paper's value, and all that follows from them."""
    rows = symbols("Symbols", (DOCS / "model.md").read_text(encoding="utf-8"))
    constants, paper = dict(Material().items()), Material()
    units = {column.name: column.metadata[b"unit"].decode() for column in SETUP}
    given, derived = rows[: len(constants)], rows[len(constants) :]
    assert [name for name, _, _ in given] == list(constants)
    for name, unit, value in given:
        assert unit == units[name]
        expected = constants[name]
        assert value == expected if isinstance(expected, str) else float(value) == expected
    properties = {name for name, value in vars(Material).items() if isinstance(value, property)}
    assert {name for name, _, _ in derived} == properties
    for name, _, value in derived:
        assert float(value.rpartition("|")[2]) == pytest.approx(getattr(paper, name), rel=5e-4)


def test_the_observables_of_the_model_are_those_of_a_run():
    rows = symbols("Observables", (DOCS / "model.md").read_text(encoding="utf-8"))
    assert len(rows) == 7
    for name, _, _ in rows:
        assert hasattr(Realisation, name) or name in Realisation.__dataclass_fields__


def test_numbers_of_the_model_are_those_of_the_pages_that_it_names():
    """In what depends on a choice; where tables are named beside a page, no page has them all."""
    text = (
        (DOCS / "model.md").read_text(encoding="utf-8").split("## What the paper leaves open\n")[1]
    )
    rows = [
        row
        for row in text.splitlines()
        if re.search(r"\(`(beyond|accuracy)\.md`(, \d)?\) \|$", row)
    ]
    found = 0
    for row in rows:
        if "tables `realisations`" in row:
            continue
        page = re.search(r"`(beyond|accuracy)\.md`", row)[1]
        numbers = (DOCS / f"{page}.md").read_text(encoding="utf-8").replace("+", "")
        for value in re.findall(r"-?[\d.]+ \[-?[\d.]+, -?[\d.]+\]", row):
            assert value in numbers
            found += 1
    assert found == 10
