"""What a user of the solver installs: `pip install .`, without what the study needs besides."""

import re
import subprocess
import sys
import tomllib

import pytest
import yaml

from studies import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
#: How packages are imported that are called otherwise.
MODULES = {"pyyaml": "yaml", "markdown-it-py": "markdown_it"}

USE = """
import sys

class Withhold:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {withheld!r}:
            raise ModuleNotFoundError(name)


sys.meta_path.insert(0, Withhold())

import click

from springblock import Pattern, Surface, plot, simulate
from springblock.cli import COMMANDS, main

run = simulate(Surface.draw(Pattern.pillars(6, 2, 1).contact, seed=0), duration=4e-6)
plot(run).savefig({folder!r} + "/run.png")
for command in (
    *(f"{{command}} --help" for command in COMMANDS),
    "simulate --n-blocks 6 --duration 4e-6 --output {folder}/run.parquet",
    "info {folder}/run.parquet",
    "plot {folder}/run.parquet --output {folder}/a.pdf",
    "show --n-blocks 6 --n-p 2 --n-s 1 --output {folder}/b.pdf",
    "animate {folder}/run.parquet --output {folder}/c.gif",
    "table {folder}/run.parquet --output {folder}/table.csv",
    "compare {folder}/run.parquet {folder}/run.parquet",
):
    main(command.split(), standalone_mode=False)
try:
    main("animate {folder}/run.parquet --output {folder}/c.mp4".split(), standalone_mode=False)
except click.ClickException as refusal:
    assert "springblock[mp4]" in str(refusal)
else:
    raise AssertionError("there is nothing that could write it")
"""


def named(requirements):
    names = [requirement.split(">=")[0] for requirement in requirements]
    return {MODULES.get(name, name.replace("-", "_")) for name in names}


def test_the_solver_and_its_commands_need_nothing_of_the_study(tmp_path):
    withheld = set().union(*map(named, PROJECT["optional-dependencies"].values()))
    assert {"snakemake", "imageio_ffmpeg"} <= withheld
    script = USE.format(withheld=withheld, folder=str(tmp_path))
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert {"run.png", "a.pdf", "b.pdf", "c.gif"} <= {file.name for file in tmp_path.iterdir()}


@pytest.mark.parametrize(
    ("module", "slow"),
    [
        ("springblock", {"matplotlib", "numba", "pandas", "PIL", "pyarrow", "scipy", "tqdm"}),
        ("springblock.study.results", {"matplotlib", "pandas", "scipy"}),  # read in a dry run
    ],
)
def test_nothing_slow_is_imported_before_it_is_needed(module, slow):
    script = f"import sys, {module}; print(*sys.modules)"
    loaded = subprocess.check_output([sys.executable, "-c", script], text=True).split()
    assert module in loaded
    assert not slow & {*loaded}


def test_no_result_rests_on_docstrings():
    """Which `python -OO` removes."""
    files = (ROOT / "src").rglob("*.py")
    assert [file for file in files if "__doc__" in file.read_text(encoding="utf-8")] == []


def test_every_description_of_the_software_says_the_same():
    """What is installed, what is cited and deposited, and the head of what has changed."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    latest, date = re.findall(r"^## \[(\d+\.\d+\.\d+)\] - (\S+)$", changes, re.MULTILINE)[0]
    assert str(cited["date-released"]) == date
    assert PROJECT["version"] == cited["version"] == latest
    assert PROJECT["license"] == cited["license"]
    assert PROJECT["keywords"] == cited["keywords"]
    assert [each["name"] for each in PROJECT["authors"]] == [
        each["name"] for each in cited["authors"]
    ]
    assert PROJECT["urls"]["Publication"].endswith(cited["references"][0]["doi"])
