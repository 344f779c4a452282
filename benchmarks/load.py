"""What many small jobs cost the workflow: N = 12, one realisation a job, on all cores.

    python -m benchmarks.load                    # plans 5,000 and 20,000 of them
    python -m benchmarks.load --run 300          # and runs as many
    python -m benchmarks.load --bare 300 5000    # or has jobs that only make their file

docs/scaling.md has what it prints.
"""

import argparse
import os
import subprocess
import sys
import sysconfig
import tempfile
import time
import venv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import psutil
import yaml

ROOT = Path(__file__).parents[1]
PLANNED = (5_000, 20_000)
_BETWEEN = 0.2  #: s between two samples
_DURATION = 2e-6  #: s, ten samples: next to nothing is simulated
#: Stands for springblock where only Snakemake's own share is looked at.
_ONLY_THE_FILE = """\
#!/bin/bash
while [ $# -gt 0 ]; do [ "$1" = --output ] && : > "$2"; shift; done
exit 0
"""


@dataclass
class Load:
    """What one call of Snakemake has taken."""

    what: str
    jobs: int
    wall: float = 0.0  #: s
    own: float = 0.0  #: CPU time of Snakemake's own process, s
    of_jobs: float = 0.0  #: CPU time of the processes that it has started, s
    memory: float = 0.0  #: largest resident set of its own process, MB
    files: int = 0  #: that are left, folders among them
    largest: int = 0  #: entries of the largest folder that is the study's
    metadata: int = 0  #: entries of Snakemake's own largest folder

    def __str__(self) -> str:
        share = self.own / (self.own + self.of_jobs)
        return (
            f"| {self.what} | {self.jobs:,} | {self.wall:.0f} | {1e3 * self.own / self.jobs:.1f} "
            f"| {self.of_jobs / self.jobs:.2f} | {share:.0%} | {self.memory:.0f} | {self.files:,} "
            f"| {self.largest:,} | {self.metadata:,} |"
        )


HEAD = """\
| | jobs | wall, s | Snakemake, CPU ms a job | job, CPU s | Snakemake's share | its memory, MB \
| files and folders | largest folder | of .snakemake |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"""


def configuration(jobs: int) -> dict[str, object]:
    """Many realisations of one small surface, one a job, and the one of each that a study needs."""
    paper = yaml.safe_load((ROOT / "config/config.yaml").read_text())
    one = {"direction": ["x"], "seeds": 1}
    ours = {
        "flat": {**one, "seeds": jobs, "duration": _DURATION},
        "pillars": {**one, "n_p": [3], "n_s": [3]},
        "grooves": {**one, "n_p": [5], "n_s": [7], "n_p2": [1], "n_s2": [1]},
    }
    return {
        "n_blocks": 12,
        "realisations_per_job": 1,
        "accuracy": False,
        "scenes": dict.fromkeys(paper["scenes"]) | ours,
        "beyond": dict.fromkeys(paper["beyond"]),
        "more": dict.fromkeys(paper["more"]),
    }


def bare(folder: Path) -> str:
    """Return a Python of the same packages, whose jobs only make their file."""
    venv.create(folder, symlinks=True)
    packages = Path(sysconfig.get_path("purelib", vars={"base": str(folder)}))
    ours = sysconfig.get_path("purelib")
    (packages / "ours.pth").write_text(f"import site; site.addsitedir({ours!r})\n")
    command = folder / "bin/springblock"
    command.write_text(_ONLY_THE_FILE)
    command.chmod(0o755)
    return str(folder / "bin/python")


def measured(folder: Path, jobs: int, *options: str, python: str = sys.executable) -> Load:
    """Call Snakemake in a folder of its own, and watch it."""
    for part in ("Snakefile", "workflow", "config", "profiles"):
        (folder / part).symlink_to(ROOT / part)
    (folder / "many.yaml").write_text(yaml.safe_dump(configuration(jobs)))
    how = "run" if python == sys.executable else "run, bare"
    load = Load("planned" if "--dry-run" in options else how, jobs)
    begun = time.monotonic()
    command = [python, "-m", "snakemake", "--configfile", "many.yaml", "--cores", "all"]
    with (folder / "log").open("wb") as log:
        process = subprocess.Popen(
            [*command, *options, "--", "aggregate"], cwd=folder, stdout=log, stderr=log
        )
        _watch(psutil.Process(process.pid), load)
    if process.wait():
        raise SystemExit((folder / "log").read_text()[-2000:])
    load.wall = time.monotonic() - begun
    found = dict(_entries(folder))
    load.files = sum(found.values())
    of_snakemake = {path for path in found if ".snakemake" in path.parts}
    load.largest = max(found[path] for path in found.keys() - of_snakemake)
    load.metadata = max((found[path] for path in of_snakemake), default=0)
    return load


def _watch(process: psutil.Process, load: Load) -> None:
    while process.status() != psutil.STATUS_ZOMBIE:
        with process.oneshot():
            times, memory = process.cpu_times(), process.memory_info().rss / 2**20
        load.own = times.user + times.system
        load.of_jobs = times.children_user + times.children_system
        load.memory = max(load.memory, memory)
        time.sleep(_BETWEEN)


def _entries(folder: Path) -> Iterator[tuple[Path, int]]:
    for path, folders, files in os.walk(folder):
        yield Path(path), len(folders) + len(files)


def main() -> None:
    """Print a row for each number of jobs."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--plan", type=int, nargs="*", default=PLANNED, metavar="JOBS")
    parser.add_argument("--run", type=int, nargs="*", default=(), metavar="JOBS")
    parser.add_argument("--bare", type=int, nargs="*", default=(), metavar="JOBS")
    chosen = parser.parse_args()
    print(HEAD, flush=True)
    for jobs in chosen.plan:
        with tempfile.TemporaryDirectory() as folder:
            print(measured(Path(folder), jobs, "--dry-run", "--quiet", "all"), flush=True)
    for jobs in chosen.run:
        with tempfile.TemporaryDirectory() as folder:
            print(measured(Path(folder), jobs), flush=True)
    for jobs in chosen.bare:
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as home:
            print(measured(Path(folder), jobs, python=bare(Path(home))), flush=True)


if __name__ == "__main__":
    main()
