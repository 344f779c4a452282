"""What the pages say is what the code writes, knows and has computed."""

import csv
import re
from collections import Counter
from pkgutil import resolve_name

import click
import pytest

import springblock
from springblock import Material, Realisation
from springblock.__main__ import main
from springblock.model.scene import FIELDS
from springblock.study.findings.page import FILE
from studies import ROOT

FILES = [ROOT / file for file in ("README.md", "CONTRIBUTING.md", "config/README.md")]
FILES += sorted(ROOT.glob("docs/**/*.md"))
PAGES = {str(file.relative_to(ROOT)): file.read_text(encoding="utf-8") for file in FILES}


def symbols(heading):
    """Rows of the tables of symbols below a heading: the name in the code, and what follows it."""
    section = PAGES["docs/model.md"].split(f"## {heading}\n")[1].split("\n## ")[0]
    return re.findall(r"^\| .*? \| `(\w+)` \| (\S+) \| (.*?) \|$", section, re.MULTILINE)


def test_the_symbols_of_the_model_are_those_of_the_code():
    """Every constant with its unit and the paper's value, and all that follows from them."""
    constants, paper = dict(Material().items()), Material()
    units = {name: each.metadata["unit"] for name, each in FIELDS.items()}
    given, derived = symbols("Symbols")[: len(constants)], symbols("Symbols")[len(constants) :]
    assert [name for name, _, _ in given] == list(constants)
    for name, unit, value in given:
        assert unit == units[name]
        expected = constants[name]
        assert value == expected if isinstance(expected, str) else float(value) == expected
    properties = {name for name, value in vars(Material).items() if isinstance(value, property)}
    assert {name for name, _, _ in derived} == properties
    for name, _, value in derived:
        assert float(value.rpartition("|")[2]) == pytest.approx(getattr(paper, name), rel=5e-4)
    for name, _, _ in symbols("Observables"):
        assert hasattr(Realisation, name) or name in Realisation.__dataclass_fields__


def test_pages_count_the_verdicts_of_registered_tests():
    with (ROOT / "docs/registration/confirmed.csv").open(encoding="utf-8", newline="") as file:
        registered = Counter(row["verdict"] for row in csv.DictReader(file))
    names = ("reproduced", "reproduced in part", "not reproduced", "not settled")
    for place in ("docs/claims.md", "docs/registration/README.md"):
        text = " ".join(PAGES[place].split())
        said = re.search(r"gave,?[^.]* \d+ reproduced[^.]* not settled\.", text)
        counts = re.findall(r"(\d+) (?:reproduced|in part|not)", said[0])
        assert list(map(int, counts)) == [registered[name] for name in names]


def test_the_readme_has_the_findings_that_reports_show():
    (found,) = re.findall(r"<!-- findings.*?-->\n(.*?)<!-- end", PAGES["README.md"], re.DOTALL)
    assert found == FILE.read_text(encoding="utf-8")


def anchors(text):
    """Places of a page that a link may name: its headings, as GitHub writes them, and its terms."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    words = (re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings)
    return {*words, *re.findall(r'<a id="([^"]+)">', text)}


@pytest.mark.parametrize("page", PAGES)
def test_links_between_pages_lead_to_files_and_headings(page):
    text = re.sub(r"^```.*?^```", "", PAGES[page], flags=re.DOTALL | re.MULTILINE)
    for link in re.findall(r'(?:\]\(|href="|src=")([^)"\s]+)', text):
        if not link.startswith("https://"):
            name, _, anchor = link.partition("#")
            target = (ROOT / page).parent / name if name else ROOT / page
            assert target.exists(), link
            assert not anchor or anchor in anchors(target.read_text(encoding="utf-8")), link


def test_commands_that_pages_show_are_known_with_their_options():
    """Those of the README, the lesson and pages of tasks are run as well."""
    context, shown = click.Context(main), 0
    for text in PAGES.values():
        lines = text.replace("\\\n", " ")
        for name, words in re.findall(r"(?:^ *|`)springblock (\w+)([^`\n]*)", lines, re.MULTILINE):
            command = main.get_command(context, name)
            assert command, name
            known = {option for each in command.params for option in each.opts} | {"--help"}
            assert set(re.findall(r"(?<!\S)--[\w-]+", words)) <= known, name
            shown += 1
    assert shown > 20


def test_every_public_name_is_in_the_reference():
    paths = re.findall(r"^::: (.+)$", PAGES["docs/api.md"], re.MULTILINE)
    shown = [path.rsplit(".", 1) for path in paths]
    found = {name: resolve_name(f"{module}:{name}") for module, name in shown}
    assert found == {name: getattr(springblock, name) for name in springblock.__all__}
