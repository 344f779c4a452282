"""What the README, the pages and the notebook show runs as it stands there, with these answers.

`python tests/test_examples.py` runs the notebook and the gallery and keeps what they show. Jupyter
is not needed for that: what a cell shows is what it prints and its last expression.
"""

import ast
import base64
import hashlib
import io
import os
import re
import shlex
from contextlib import redirect_stdout

import nbformat
import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure
from nbformat.v4 import new_output

from springblock import Material, Setup, Surface, read, simulate
from springblock.__main__ import main
from springblock.model.scene import Scene
from springblock.plotting import film
from studies import ROOT, Study

NOTEBOOK = ROOT / "docs/tour.ipynb"
#: A box and its language; one that says `skip` needs what a test does not have.
BOX = re.compile(r"^```(sh|python|yaml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")
#: Scene whose fields are kept.
WATCHED = "pillars-4-4-x-*"
#: What the tests run in place of longer studies of the pages.
SHORTER = {
    "surface.md": {"--spacing 2.5e-6 --seeds 6": "--spacing 1e-5 --seeds 2"},
    "law.md": {
        "--seeds 5": "--seeds 2",
        "seeds: 3, material: {d_0": "seeds: 1, material: {d_0",
    },
    "study.md": {
        "[2.5e-4, 5.0e-4, 1.0e-3]}\n    direction: [x, y]": "[5.0e-4, 1.0e-3]}\n    direction: [x]",
        "2.5e-4,5e-4,1e-3 --direction x,y": "5e-4,1e-3",
        "seeds: 10": "seeds: 3",
        "--seeds 10": "--seeds 3",
    },
    "design.md": {
        "18e-3, 7": "5e-3, 2",
        "seeds, found = 4": "seeds, found = 2",
        "(1.5e-3, 3e-3, 4.5e-3, 6e-3, 9e-3, 13.5e-3)": "(1.5e-3, 3e-3)",
        "bounds=(4.5e-3, 13.5e-3)": "bounds=(3e-3, 4e-3)",
        '"maxiter": 14': '"maxiter": 2',
        "blocks = 214": "blocks = 120",
        "[(4, 24), (6, 16)]": "[(10, 14), (8, 9)]",
        "popsize=4": "popsize=1",
        "maxiter=4": "maxiter=0",
        "seeds=4": "seeds=2",
    },
    "measured.md": {"measured.yaml\n": "measured.yaml -n\n"},
}
#: Single runs on patterned surfaces agree between processors to half a percent.
SCATTER = 0.02


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A folder with the workflow, to work in."""
    monkeypatch.setattr(film, "FRAMES", 20)  # quicker
    monkeypatch.chdir(tmp_path)
    return Study.begun(tmp_path)


def run_line(line, study):
    """Run one command as in the activated environment; `springblock` without another Python."""
    program, *words = shlex.split(line)
    if program == "springblock":
        main(words, standalone_mode=False)
    else:
        assert words[0] == "--configfile"
        study.run(*words[1:], configuration=())  # which begin with its files


def follow(page, study):
    """Do all that a page shows: commands, files of a configuration, Python; returns its names."""
    names, text = {}, (ROOT / "docs" / page).read_text(encoding="utf-8")
    for long, short in SHORTER.get(page, {}).items():
        assert long in text
        text = text.replace(long, short)
    for language, box in BOX.findall(text):
        if language == "sh":
            for line in box.replace("\\\n", " ").splitlines():
                run_line(line, study)
        elif file := re.match(r"# (config/examples/\w+\.py)\n", box):
            assert box == f"# {file[1]}\n" + (study / file[1]).read_text(encoding="utf-8")
        elif language == "yaml":
            (study / re.match(r"# (\w+\.yaml)\n", box)[1]).write_text(box, encoding="utf-8")
        else:
            exec(box, names)
    return names


def test_the_readme_can_be_followed(study):
    """Its run in Python and that of its commands are the same surface and seed."""
    readme, names = (ROOT / "README.md").read_text(encoding="utf-8"), {}
    for line in re.findall(r"^    (springblock .*)$", readme, re.MULTILINE):
        run_line(line, study)
    for example in re.findall(r"```python\n(.*?)```", readme, re.DOTALL):
        exec(example, names)
    assert (study / "run.gif").exists()
    assert (study / "run.png").exists()
    [stored] = read("run.parquet")
    assert stored.static_friction == pytest.approx(names["run"].static_friction, rel=1e-12)


def test_the_page_on_surfaces_can_be_followed(study):
    names = follow("surface.md", study)
    assert names["stored"].scene == Scene(24, 4, 4)
    for file in ("surface.png", "dimples.gif", "sizes.png"):
        assert (study / file).exists()
    for file in ("fields.nc", "own.nc"):
        with xarray.open_dataset(file) as data:
            assert data.slip.shape == (2, 24, 24)


def test_the_page_on_laws_can_be_followed(study):
    names = follow("law.md", study)
    assert names["run"].static_friction > 0.5
    assert names["state"].heat > 0.0
    assert (study / "results/small/figures/sweep_weakening.png").exists()


def test_the_page_on_studies_can_be_followed(study):
    names = follow("study.md", study)
    made = {file.name for file in (study / "results/small/figures").iterdir()}
    assert {"figure_6.png", "surfaces.png", "sweep_speed.pdf"} <= made
    own = {file.stem for file in (study / "results/mine/figures").iterdir()}
    assert own == {"surfaces", "sweep_slider_velocity"}
    report = (study / "results/mine/report.html").read_text(encoding="utf-8")
    assert "slider_velocity (m/s)" in report
    assert set(names["table"].n_p) == {0, 4, 10, 12}
    assert len(names["runs"]) == 3
    assert max(names["early"]) < 0.5
    assert (study / "mine.pdf").exists()
    [watched] = study.folder.glob(f"results/small/fields/{WATCHED}.nc")
    with xarray.open_dataset(watched) as data:
        assert data.slip.shape == (2, 24, 24)


@pytest.mark.filterwarnings("ignore:spacing")  # where the pressure on squares is high
def test_the_design_can_be_followed_and_finds_better_surfaces(study):
    """Also on small samples small pillars are worse, and a surface slides in two steps."""
    names = follow("design.md", study)
    assert names["gain"].low > 0.05
    assert names["longest"].fun < -1e-4
    assert (study / "design.png").exists()


def test_the_lesson_can_be_followed_and_its_answers_are_right(study):
    """Numbers by hand are those of the runs: to a slip of 0.3 µs, a sample, or the scatter."""
    names = follow("lesson.md", study)
    one, force = names["one"], names["force"]
    assert one.t_det[0, 0] == pytest.approx(400e-6 / 3, rel=1e-9)
    assert force[one.time > one.t_det[0, 0]].min() == pytest.approx(0.2, abs=0.002)
    assert force.max() == pytest.approx(1.0, abs=0.002)
    assert names["along"] == pytest.approx([120e-6, 120.15e-6], abs=0.15e-6)
    assert names["later"] == pytest.approx([120e-6, 146.67e-6], abs=0.3e-6)
    for strong, is_precursor in ((1.3, False), (1.4, True)):
        both = Surface([[1, 1]], [[0.9, strong]], 0.6)
        until = simulate(both, Setup(Material(gamma=0.0)), duration=1.5e-4)
        assert (until.t_max > 1.01 * until.t_det.min()) == is_precursor
    pair, thick = names["pair"], Material(gamma=0.0, thickness=2e-5)
    assert np.ptp(pair(1.37, thick)) < 0.5e-6 < np.ptp(pair(1.40, thick))
    assert names["friction"] == pytest.approx([0.79, 0.93], abs=0.01)
    assert names["precursors"] == pytest.approx([0.05, 0.005], abs=0.005)
    pillar = names["pillar"]
    assert pillar[names["edge"]].mean() < 0.9 * pillar[names["middle"]].mean()
    sizes = [np.mean([run.static_friction for run in read(f"p{n}.parquet")]) for n in (2, 6, 30)]
    assert sizes == pytest.approx([0.82, 0.65, 0.70], abs=0.01)


def test_the_page_on_a_measured_surface_can_be_followed(study):
    """Its scan is the file described, and 1/40 of the paper's lengths does not change friction."""
    pytest.importorskip("SurfaceTopography")  # not in `make test-versions`
    scan = ROOT / "config/examples/sbs_pmma.nid"
    described = scan.with_suffix(".md").read_text(encoding="utf-8")
    assert hashlib.sha256(scan.read_bytes()).hexdigest() in described
    names = follow("measured.md", study)
    run, [paper] = names["run"], read("paper.parquet")
    assert run.static_friction == pytest.approx(0.66, rel=SCATTER)
    assert paper.static_friction == pytest.approx(run.static_friction, rel=1e-9)
    assert paper.t_max == pytest.approx(40 * run.t_max, rel=1e-9)
    assert [mask.sum() for mask in names["masks"]] == [706, 1411, 2822]
    assert (study / "measured.png").exists()


def test_the_gallery_can_be_followed_and_makes_its_pictures(study):
    """Each scene alone: none needs a name of another one."""
    page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
    boxes = [box for _, box in BOX.findall(page)]
    assert len(boxes) == 10
    for box in boxes:
        assert box.count("\n") <= 9
        exec(box, {})
    made = {f"gallery/{file.name}" for file in study.folder.glob("*.png")}
    assert made == set(re.findall(r"!\[.*?\]\((.*?)\)", page))


def run_cell(source, names):
    """Run one cell, but for Jupyter's own commands; returns what Jupyter would show of it."""
    tree, printed = ast.parse(re.sub(r"^%.*$", "", source, flags=re.MULTILINE)), io.StringIO()
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    outputs, value = [], None
    with redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    if printed.getvalue():
        outputs.append(new_output("stream", name="stdout", text=printed.getvalue()))
    if value is None:
        return outputs
    data = {"text/plain": repr(value)}
    if isinstance(value, Figure):
        picture = io.BytesIO()
        value.savefig(picture, format="png", dpi=80, metadata={"Software": None})
        text = f"<Figure size {value.bbox.width:.0f}x{value.bbox.height:.0f}>"
        data = {"image/png": base64.b64encode(picture.getvalue()).decode(), "text/plain": text}
    return [*outputs, new_output("display_data", data=data)]


def run_notebook(notebook):
    """Run all cells in order, and store their outputs."""
    names = {}
    code = (cell for cell in notebook.cells if cell.cell_type == "code")
    for number, cell in enumerate(code, start=1):
        cell.outputs = run_cell(cell.source, names)
        cell.execution_count = number


def test_the_notebook_shows_what_it_has_shown(tmp_path, monkeypatch):
    """Words to the letter; numbers within what processors tell apart, the smallest not at all."""
    monkeypatch.chdir(tmp_path)  # where no study is
    stored, now = (nbformat.read(NOTEBOOK, as_version=4) for _ in range(2))
    nbformat.validate(stored)
    run_notebook(now)
    before, after = (
        [output for cell in notebook.cells for output in cell.get("outputs", [])]
        for notebook in (stored, now)
    )
    for one, other in zip(before, after, strict=True):
        assert ("image/png" in one.get("data", {})) == ("image/png" in other.get("data", {}))
        expected, found = (each.get("text") or each.data["text/plain"] for each in (one, other))
        assert NUMBER.sub("#", found) == NUMBER.sub("#", expected)
        numbers = [list(map(float, NUMBER.findall(text))) for text in (found, expected)]
        assert numbers[0] == pytest.approx(numbers[1], rel=SCATTER, abs=5e-3)
    assert NOTEBOOK.stat().st_size < 400_000


if __name__ == "__main__":
    page = nbformat.read(NOTEBOOK, as_version=4)
    os.chdir("/")  # where no study is
    run_notebook(page)
    nbformat.write(page, NOTEBOOK)
    os.chdir(ROOT / "docs/gallery")
    for _, scene in BOX.findall((ROOT / "docs/gallery.md").read_text(encoding="utf-8")):
        exec(scene, {})
