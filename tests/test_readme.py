"""What the README shows can be run as it stands there."""

import os
import re
import subprocess
import sys
import textwrap
from collections import Counter
from pathlib import Path

from springblock.accuracy.conventions import ENERGY_TOLERANCE
from springblock.cli import main
from springblock.model.scene import Scene
from springblock.plotting.runs import film

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = ("claims", "beyond")


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


def run(command):
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    subprocess.run(command.split(), cwd=ROOT, env={**os.environ, "PATH": path}, check=True)


def test_commands_that_plan_or_explain_run():
    commands = re.findall(r"snakemake -n \w+|springblock \w+ --help", README)
    assert len(commands) >= 2
    for command in commands:
        run(command)


def test_the_grid_of_ones_own_can_be_planned(tmp_path):
    lines = re.search(r"^    results: .*\n(    .*\n)+", README, re.MULTILINE)
    (tmp_path / "mine.yaml").write_text(textwrap.dedent(lines[0]))
    assert "`snakemake --configfile mine.yaml -- figure_6`" in README
    run(f"snakemake --configfile {tmp_path / 'mine.yaml'} -n -- figure_6")


def test_findings_are_those_of_the_pages():
    """Each value with its interval stands in a page of results, and verdicts are as many."""
    pages = {name: (ROOT / f"docs/{name}.md").read_text(encoding="utf-8") for name in PAGES}
    found = re.findall(r"[-\d.]+ \[[-\d.]+, +[-\d.]+\]", README)
    assert len(found) == 12
    assert [value for value in found if not any(value in page for page in pages.values())] == []
    summary = re.findall(r"^\| \[\d+\. .*? \| \*\*([a-z ]+)\*\*", pages["claims"], re.MULTILINE)
    verdicts = Counter(summary)
    said = re.search(
        r"Of (\d+) statements (\d+) are\s+reproduced, (\d+) depend on .*, (\d+) are not reproduced "
        r"and (\d+) are not settled",
        README,
    )
    names = ("reproduced", "depends on", "not reproduced", "not settled")
    assert [int(number) for number in said.groups()] == [
        verdicts.total(),
        *(verdicts[name] for name in names),
    ]
