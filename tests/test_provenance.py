"""What a step's digest depends on, and which way data moves through the package."""

import ast
import re
from itertools import chain
from pathlib import Path

import pytest

import springblock
from springblock import provenance
from springblock.cli import COMMANDS
from springblock.provenance import digest_of_data

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
        provenance._of.cache_clear()
        provenance.digest.cache_clear()
        return provenance.digest(step)

    monkeypatch.setattr(provenance, "_ROOT", tmp_path)
    yield written
    provenance._of.cache_clear()
    provenance.digest.cache_clear()


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
    before, after = (digest_of("solver/law.py", text, "compile") for text in texts)
    assert (before != after) == is_another


@pytest.mark.parametrize(
    ("name", "steps"),
    [
        ("pages/accuracy.md", {"accuracy.md"}),
        ("pages/claims.md", {"claims.md"}),
        ("report/page.html", {"report"}),
        ("report/page.css", {"report"}),
        ("report/page.js", {"report"}),
        ("plotting/captions.toml", {"plot", "report"}),
    ],
)
def test_a_sentence_changes_the_digest_of_its_page_alone(digest_of, name, steps):
    for step in provenance.STEPS:
        before, after = (digest_of(name, text, step) for text in "ab")
        assert (before != after) == (step in steps), step


def test_a_remark_changes_the_pages_and_a_form_the_verdicts(digest_of):
    old, *others = (
        f"[onset]\ntitle = 'It begins'\nsection = '1'\nform = '{form}'\nremark = '{remark}'"
        for form, remark in (("general", "a"), ("general", "b"), ("universal", "a"))
    )
    pages = {"claims.md", "report"}
    for text, expected in zip(others, (pages, pages | {"claims"}), strict=True):
        found = {
            step
            for step in provenance.STEPS
            if "claims" in provenance.STEPS[step]
            if len({digest_of("claims/statements.toml", each, step) for each in (old, text)}) == 2
        }
        assert found == expected


@pytest.mark.parametrize("part", sorted(set(chain.from_iterable(provenance.STEPS.values()))))
def test_what_a_digest_covers_exists(part):
    assert list(ROOT.glob(part.split()[0]))


def test_versions_are_compared_by_their_digests():
    version = provenance.code_version("simulate")
    assert version.endswith("+" + provenance.digest("simulate"))
    assert provenance.same_code(version, "0.1.0+" + provenance.digest("simulate"))
    assert not provenance.same_code(version, provenance.code_version("analyse"))


def imports(file):
    """Modules of this package that a source file imports, at its top or inside a function."""
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("springblock"):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name.startswith("springblock"))


def floors():
    """Folders and modules of the package, in the order of the map in CONTRIBUTING.md."""
    text = (Path(__file__).parents[1] / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`[a-z].+?) \| ", text, re.MULTILINE)
    return {name: i for i, row in enumerate(rows) for name in re.findall(r"`(\w+)(?:/|\.py)`", row)}


def test_the_map_of_the_package_has_every_folder():
    found = {path.stem for path in ROOT.iterdir() if path.is_dir() or path.suffix == ".py"}
    assert floors().keys() == found - {"__init__", "__main__", "__pycache__"}


@pytest.mark.parametrize("file", sorted(ROOT.rglob("*/*.py")), ids=str)
def test_data_moves_one_way(file):
    """No folder imports from one below it in the map."""
    places = floors()
    here = places[file.relative_to(ROOT).parts[0]]
    for name in imports(file):
        part = name.split(".")[1]
        assert part not in places or places[part] <= here, f"{file} imports {name}"


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


#: The configuration reaches jobs as their parameters; physics changes the realisations first.
ELSEWHERE = {"study", "model", "solver", "simulation"}


@pytest.mark.parametrize("step", provenance.STEPS)
def test_the_digest_of_a_step_covers_all_that_it_imports(step):
    folders = [part for part in provenance.STEPS[step] if "." not in part]
    files = closure(file for folder in folders for file in (ROOT / folder).rglob("*.py"))
    needed = {path.relative_to(ROOT).parts[0] for path in files if path.parent != ROOT}
    assert needed - ELSEWHERE <= {*folders}


def jobs():
    """Each command of the rules with the steps whose digests its jobs have."""
    found = {"plot": {"plot"}, "figure": {"plot"}}  # by `params.command`
    found |= {"simulate": {"simulate"}, "prelude": {"simulate"}}  # by the names of folders
    found["make"] = {"accuracy", "mechanism", "continuum"}  # by `PLANNED.step`
    found["make"] |= {step for step in provenance.STEPS if step.endswith(".md")}
    for file in sorted((ROOT.parents[1] / "workflow/rules").glob("*.smk")):
        for rule in file.read_text().split("\n\n\n"):
            command = re.search(r'"springblock (\w+)', rule)
            if command:
                steps = re.findall(r'code=code\("([\w.]+)"\)', rule)
                found.setdefault(command[1], set()).update(steps)
    found["aggregate"].add("accuracy")  # only to warn
    del found["compile"]  # whose file is empty
    return found


def used_by(function, module):
    """Modules of the package that a function of a module uses, itself or by another function."""
    imported, functions, found, left = {}, {}, set(), [function]
    for node in module.body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("springblock"):
            imported |= {alias.asname or alias.name: node.module for alias in node.names}
        if isinstance(node, ast.FunctionDef):
            functions[node.name] = node
    while left:
        for node in ast.walk(functions.pop(left.pop())):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("springblock."):
                found.add(node.module)
            if isinstance(node, ast.Name):
                found |= {imported[node.id]} if node.id in imported else set()
                left += [node.id] if node.id in functions and node.id not in left else []
    return {name.split(".")[1] for name in found if name.count(".")}


@pytest.mark.parametrize(("command", "steps"), jobs().items(), ids=jobs())
def test_what_a_job_computes_is_in_the_digest_of_its_step(command, steps):
    """Neither the command line nor files, which only arrange, nor the physics before."""
    place, function = COMMANDS[command].split(":")
    module = ast.parse((ROOT / "cli" / f"{place.split('.')[-1]}.py").read_bytes())
    covered = {folder for step in steps for folder in provenance.STEPS[step]}
    arranging = {"cli", "files", "provenance", "model", "io", "simulation"}
    assert used_by(function, module) - arranging <= covered


def test_the_command_line_computes_nothing():
    """NumPy counts what a command says at its end, and spaces the values of a range."""
    for file in sorted((ROOT / "cli").glob("*.py")):
        used = {
            node.names[0].name
            for node in ast.walk(ast.parse(file.read_bytes()))
            if isinstance(node, ast.Import)
        }
        assert "scipy" not in used
        assert "numpy" not in used or file.stem in {"simulate", "mask", "options"}, file


def test_a_job_takes_its_digests_from_the_plan_and_compares_its_sources(monkeypatch):
    """A comment changes the bytes of a source, and not the digest of its meaning."""
    usual = provenance.made_by("simulate")
    monkeypatch.setenv(provenance.PLAN, provenance.planned("0123"))
    assert provenance.made_by("simulate") == usual
    assert provenance.of_study("simulate") == usual | {"study": "0123"}
    monkeypatch.setattr(provenance, "_sources", lambda step: "other bytes")
    with pytest.raises(ValueError, match="the code changed while the study ran"):
        provenance.made_by("simulate")


def test_the_order_of_keys_does_not_change_a_configuration():
    one, other = {"step": 1e-8, "seeds": 3}, {"seeds": 3, "step": 1e-8}
    assert digest_of_data(one) == digest_of_data(other)
    assert digest_of_data(one) != digest_of_data({"step": 1e-8})
