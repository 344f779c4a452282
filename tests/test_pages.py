"""What the pages in docs show in boxes can be run as it stands there, from the top to the end."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from springblock import Material, read, simulate
from springblock.cli import main
from springblock.plotting.runs import film
from test_workflow import ROOT, copied

#: A box and its language; one that says `skip` needs what a test does not have.
BOX = re.compile(r"^```(sh|python|yaml)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SKIPPED = re.compile(r"^```\w+ skip\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def page(name: str) -> str:
    return (ROOT / "docs" / name).read_text(encoding="utf-8")


def run_line(line: str, folder: Path) -> None:
    """Run one command as in the activated environment; `springblock` without another Python."""
    program, *words = shlex.split(line)
    if program == "springblock":
        main(words, standalone_mode=False)
        return
    assert program == "snakemake"
    here = {**os.environ, "PYTHONPATH": str(ROOT / "src")}  # whose kernels are compiled
    command = [sys.executable, "-m", "snakemake", *words]
    done = subprocess.run(command, cwd=folder, env=here, capture_output=True, text=True)
    assert done.returncode == 0, f"{line}\n{done.stderr}"


def follow(text: str, folder: Path) -> dict[str, object]:
    """Do all that a page shows: commands, files of a configuration, Python; returns its names."""
    names: dict[str, object] = {}
    for language, box in BOX.findall(text):
        if language == "sh":
            for line in box.replace("\\\n", " ").splitlines():
                run_line(line, folder)
        elif language == "yaml":
            name = re.match(r"# (\w+\.yaml)\n", box)
            assert name, "a configuration says how its file is called"
            (folder / name[1]).write_text(box, encoding="utf-8")
        else:
            exec(box, names)
    return names


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A copy of all that the study consists of, to work in."""
    monkeypatch.setattr(film, "FRAMES", 20)  # quicker
    monkeypatch.chdir(copied(tmp_path))
    return tmp_path


def test_the_howto_can_be_followed(folder):
    names = follow(page("howto.md"), folder)
    made = {file.name for file in (folder / "results/small/figures").iterdir()}
    assert {"figure_6.png", "surfaces.png", "sweep_speed.pdf"} <= made
    table = names["table"]
    assert set(table.n_p) == {0, 4, 10, 12}
    assert (names["half"] > 0.0).all()
    assert len(names["runs"]) == 3
    assert max(names["early"]) < 0.5
    assert names["run"].static_friction > 0.5
    assert (folder / "mine.pdf").exists()
    assert not list(folder.glob("long*checkpoint"))
    assert not (folder / "long.npz").exists()


def test_a_page_leaves_out_only_clusters():
    for name in ("howto.md", "lesson.md"):
        for box in SKIPPED.findall(page(name)):
            assert "--profile profiles/" in box


def test_the_lesson_can_be_followed_and_its_answers_are_right(folder):
    """Numbers by hand are those of the runs: to a slip of 0.3 µs, a sample, or the scatter."""
    names = follow(page("lesson.md"), folder)
    one, force = names["one"], names["force"]
    assert one.t_det[0, 0] == pytest.approx(400e-6 / 3, rel=1e-9)
    assert force[one.time > one.t_det[0, 0]].min() == pytest.approx(0.2, abs=0.002)
    assert force.max() == pytest.approx(1.0, abs=0.002)
    assert names["along"] == pytest.approx([120e-6, 120.15e-6], abs=0.15e-6)
    assert names["later"] == pytest.approx([120e-6, 133.33e-6], abs=0.3e-6)
    pair, thick = names["pair"], Material(gamma=0.0, thickness=2e-5)
    assert np.ptp(pair(1.37, thick)) < 0.5e-6 < np.ptp(pair(1.40, thick))
    assert names["friction"] == pytest.approx([0.79, 0.93], abs=0.01)
    assert names["precursors"] == pytest.approx([0.05, 0.005], abs=0.005)
    pillar = names["pillar"]
    assert pillar[names["edge"]].mean() < 0.9 * pillar[names["core"]].mean()
    sizes = [np.mean([run.static_friction for run in read(f"p{n}.parquet")]) for n in (2, 6, 30)]
    assert sizes == pytest.approx([0.82, 0.65, 0.70], abs=0.01)


def slips(run):
    """Times of drops of the force by more than a tenth of the load within two samples, s."""
    force = run.force / run.normal_force
    drops = np.flatnonzero(force[:-2] - force[2:] > 0.1)
    return run.time[drops[np.diff(drops, prepend=-9) > 2]]


@pytest.mark.parametrize(
    ("changed", "first", "apart", "lowest"),
    [
        ({"pressure": 2.5e4}, 66.7e-6, 53.3e-6, 0.2),
        ({"mu_dynamic": 0.8}, 133.3e-6, 53.3e-6, 0.6),
        ({"gamma": 1.6e7}, 133.3e-6, None, 0.602),
    ],
)
def test_the_answers_on_one_block_are_right(changed, first, apart, lowest):
    """Samples are 0.2 µs apart, and a slip takes 0.4."""
    material = Material(**changed)
    run = simulate([[1]], material.mu_static, material.mu_dynamic, material, duration=4e-4)
    times = slips(run)
    assert run.t_first == pytest.approx(first, abs=0.05e-6)
    assert (run.force / run.normal_force)[run.time > first].min() == pytest.approx(lowest, abs=2e-3)
    if apart is None:
        assert len(times) == 1
    else:
        assert np.diff(times) == pytest.approx(apart, abs=0.7e-6)
