"""What the README shows can be run as it stands there."""

import os
import re
import subprocess
import sys
from pathlib import Path

from springblock.accuracy.residuals import ENERGY_TOLERANCE
from springblock.cli import main
from springblock.pictures import film
from springblock.scene import Scene

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_runs(tmp_path, monkeypatch):
    """One surface from the command line, and then in Python."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(film, "FRAMES", 20)  # quicker
    commands = re.findall(r"^    springblock (.* --output \S+|info .*)$", README, re.MULTILINE)
    names = ["show", "simulate", "plot", "animate", "simulate", "plot", "info"]
    assert [words.split()[0] for words in commands] == names
    for words in commands:
        main(words.split(), standalone_mode=False)
    names = {}
    for example in re.findall(r"```python\n(.*?)```", README, re.DOTALL):
        exec(example, names)
    assert names["stored"].scene == Scene(60, 10, 10)
    written = {"surface.png", "run.parquet", "run.png", "run.gif", "fast.parquet", "velocity.png"}
    assert {file.name for file in tmp_path.iterdir()} == written
    assert 0.5 < names["run"].static_friction < 1.0
    assert abs(names["run"].energy.relative_residual) < ENERGY_TOLERANCE


def test_commands_that_plan_or_explain_run():
    commands = re.findall(r"snakemake -n \w+|springblock \w+ --help", README)
    assert len(commands) >= 2
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    for command in commands:
        subprocess.run(command.split(), cwd=ROOT, env={**os.environ, "PATH": path}, check=True)
