"""What a step's digest depends on, and which way data moves through the package."""

import ast
import re
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import springblock
from springblock import provenance
from springblock.provenance import ANALYSE, COMPILE, SIMULATE
from springblock.study.results import FIGURES, PAGES, TABLES, found
from studies import ROOT as REPOSITORY

ROOT = Path(springblock.__file__).parent
SOURCE = '''"""A module."""

def force(x):
    """Return a force."""
    if x < 0.0:
        raise ValueError(f"x is {x}")
    return 2.0 * x[:2]  # linear
'''


@pytest.fixture
def digest_of(tmp_path, monkeypatch):
    """Return the digest of a step after a file is written into a package that has no other."""

    def written(name, text, step):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
        clear()
        return provenance.digest(step)

    def clear():
        for each in (provenance.digest, provenance._of, provenance._of_module):
            each.cache_clear()

    monkeypatch.setattr(provenance, "_ROOT", tmp_path)
    yield written
    clear()


@pytest.mark.parametrize(
    ("old", "new", "is_another"),
    [
        ("  # linear", "  # Hooke", False),
        ("Return a force.", "Return another description.", False),
        ("x is {x}", "x must not be negative", False),
        ("2.0 * x[:2]", "(2.0\n            * x[:2])", False),
        ("2.0", "2.5", True),
        ("x < 0.0", "x <= 0.0", True),
        ("x < 0.0", "x < 0", True),
        ("    return", "    check(x)\n    return", True),
        ("* x", "* -x", True),
        ("force(x)", "force(x, y=0)", True),
        ("x[:2]", "x[2:]", True),
    ],
)
def test_formulas_and_nothing_else_change_a_digest(digest_of, old, new, is_another):
    """Neither do comments, docstrings, the wording of errors, nor layout."""
    assert old in SOURCE
    texts = (SOURCE, SOURCE.replace(old, new))
    before, after = (digest_of("solver/law.py", text, COMPILE) for text in texts)
    assert (before != after) == is_another


def test_a_remark_changes_no_verdict_and_a_form_does(digest_of):
    old, remark, form = (
        f"[onset]\ntitle = 'It begins'\nsection = '1'\nform = '{form}'\nremark = '{remark}'"
        for form, remark in (("general", "a"), ("general", "b"), ("universal", "a"))
    )
    (words,) = TABLES["claims"].words
    first, second, third = (
        digest_of(words.split()[0], text, (words,)) for text in (old, remark, form)
    )
    assert first == second != third


def test_a_caption_changes_the_digest_of_its_figure_and_of_nothing_else():
    other = replace(FIGURES["figure_2"], caption="Another caption.")
    assert other.digest != FIGURES["figure_2"].digest
    assert len({each.digest for each in (*FIGURES.values(), *PAGES.values())}) == len(
        FIGURES
    ) + len(PAGES)


def test_versions_are_compared_by_their_digests():
    version = provenance.code_version(SIMULATE)
    assert version.endswith("+" + provenance.digest(SIMULATE))
    assert provenance.same_code(version, "0.1.0+" + provenance.digest(SIMULATE))
    assert not provenance.same_code(version, provenance.code_version(ANALYSE))


def imports(file):
    """Modules of this package that a source file imports, at its top or inside a function."""
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("springblock"):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name.startswith("springblock"))


def floors():
    """Folders and modules of the package, in the order of the map in CONTRIBUTING.md."""
    text = (REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`[a-z].+?) \| ", text, re.MULTILINE)
    return {name: i for i, row in enumerate(rows) for name in re.findall(r"`(\w+)(?:/|\.py)`", row)}


def test_data_moves_one_way():
    """No folder imports from one below it in the map, which has all, and no chapter another."""
    places = floors()
    found = {path.relative_to(ROOT).parts[0].removesuffix(".py") for path in ROOT.rglob("*.py")}
    assert places.keys() == found - {"__init__", "__main__"}
    chapters = {table.chapter for table in TABLES.values() if table.made}
    chapters |= {figure.drawn.partition(".")[0] for figure in FIGURES.values()} - {"springblock"}
    for file in ROOT.rglob("*/*.py"):
        folder, *rest = file.relative_to(ROOT).parts
        for _, part, *inner in (name.split(".") for name in imports(file)):
            assert part not in places or places[part] <= places[folder], f"{file}: {part}"
            if folder == "study" and rest[0] in chapters:
                assert part != "study" or inner[0] == rest[0], f"{file}: {inner}"


def closure(files):
    """Source files and all that they import, directly or not."""
    found, left = set(), list(files)
    while left:
        file = left.pop()
        if file not in found:
            found.add(file)
            parts = (name.split(".")[1:] for name in imports(file))
            places = [ROOT.joinpath(*p[:i]) for p in parts for i in range(1, len(p) + 1)]
            sources = [q for p in places for q in (p.with_suffix(".py"), p / "__init__.py")]
            left += [path for path in sources if path.is_file()]
    return found


@pytest.mark.parametrize("name", [name for name, table in TABLES.items() if table.made])
def test_the_digest_of_a_table_covers_all_that_computes_it(name):
    """But for the physics before, where it is computed from realisations, whose names have it."""
    table = TABLES[name]
    files = closure([Path(sys.modules[found(table.made).__module__].__file__)])
    needed = {path.relative_to(ROOT) for path in files if path.parent != ROOT}
    covered = {*table.code, *(() if table.parts else SIMULATE)}
    assert all((ROOT / part.split()[0]).exists() for part in covered)
    for file in needed:
        folders = {str(parent) for parent in file.parents} | {str(file)}
        assert folders & covered or file == Path("study/__init__.py"), file
