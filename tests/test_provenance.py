"""Which sources a result depends on."""

import ast
import re
from pathlib import Path

import pytest

import springblock
from springblock.provenance import code_version, digest, files
from springblock.provenance import imports as imported

ROOT = Path(springblock.__file__).parent


def names(*modules):
    return {file.name for file in files(*modules)}


def test_a_simulation_depends_on_the_solver_and_on_no_figure():
    found = names("springblock.cli.simulate")
    assert {"leapfrog.py", "rk4.py", "friction.py", "springs.py", "pattern.py"} <= found
    assert not any(name.startswith("figure_") for name in found)


def test_a_figure_depends_on_itself_and_not_on_the_solver():
    found = names("springblock.cli.figure", "springblock.plotting.paper.figure_3")
    assert {"figure_3.py", "style.py", "tables.py"} <= found
    assert not {"figure_2.py", "leapfrog.py", "realisation.py"} & found


def test_the_error_study_depends_on_each_of_its_own_modules():
    kinds = names("springblock.cli.stability")
    assert {"block.py", "cases.py", "load.py", "overflow.py", "pull.py", "reference.py"} <= kinds
    assert {"rest.py", "schemes.py", "size.py", "step.py", "surface.py", "table.py"} <= kinds
    compared = names("springblock.cli.measure")
    assert {"work_precision.py", "reference.py", "plain_rk4.py", "leapfrog.py"} <= compared
    assert not {"page.py", "block.py"} & compared


def test_the_report_depends_on_its_template():
    found = names("springblock.cli.report")
    assert {"page.html", "page.css", "page.js", "findings.py"} <= found
    assert "page.html" not in names("springblock.cli.claims")


def test_the_digest_tells_modules_apart_and_is_part_of_the_version():
    assert digest("springblock.model.material") != digest("springblock.model.pattern")
    assert code_version("springblock.model.material").endswith(
        "+" + digest("springblock.model.material")
    )


@pytest.mark.parametrize("file", sorted(ROOT.rglob("*.py")), ids=lambda file: file.stem)
def test_imports_are_those_that_python_sees(file):
    statements = list(ast.walk(ast.parse(file.read_bytes())))
    plain = {
        alias.name for node in statements if isinstance(node, ast.Import) for alias in node.names
    }
    froms = [node for node in statements if isinstance(node, ast.ImportFrom) and node.module]
    members = {f"{node.module}.{alias.name}" for node in froms for alias in node.names}
    seen = plain | members | {node.module for node in froms}
    assert imported(file) == {name for name in seen if name.split(".")[0] == "springblock"}


def rooms():
    """Place of each room in the map of CONTRIBUTING.md, and all rooms of the package."""
    text = (Path(__file__).parents[1] / "CONTRIBUTING.md").read_text()
    rows = re.findall(r"^\| (`.+) \| .+ \|$", text, re.MULTILINE)
    places = {name: i for i, row in enumerate(rows) for name in re.findall(r"`(\w+)/?`", row)}
    return places, {path.stem for path in ROOT.glob("[a-z]*") if path.name != "__pycache__"}


def test_the_map_names_every_room():
    places, found = rooms()
    assert places.keys() == found


def test_no_room_imports_what_comes_after_it():
    places, _ = rooms()
    for path in ROOT.rglob("*.py"):
        room = path.relative_to(ROOT).parts[0].removesuffix(".py")
        used = {name.split(".")[1] for name in imported(path) if name.count(".")} & places.keys()
        assert all(places[name] <= places[room] for name in used if room in places), (path, used)
