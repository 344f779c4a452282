"""The quick study through Slurm: its tables are those of a local run, after crashes as well.

`make test-slurm` starts it.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

import pyarrow.parquet as pq

from tests.slurm.cluster import CannotStart, Cluster, one_node, wait

ROOT = Path(__file__).parents[2]
LIMIT = 1800  #: s for all of it
QUICK = ("--configfile", "config/quick.yaml")
SLURM = ("--workflow-profile", "slurm")
#: What is made through crashes: realisations and their table, in four submissions.
PART = ("--", "aggregate")
RESULTS = Path("results/quick")

Tables = dict[str, str]
STARTED: list[subprocess.Popen[bytes]] = []


class Failed(Exception):
    """What a test has found."""


def copied(folder: Path) -> Path:
    """Copy all that the study consists of into a folder."""
    for part in ("src", "workflow", "config", "profiles"):
        shutil.copytree(ROOT / part, folder / part)
    shutil.copy(ROOT / "Snakefile", folder)
    return folder


def start(study: Path, *options: str) -> subprocess.Popen[bytes]:
    """Start Snakemake in a copy of the study, with the copy's own package."""
    paths = [str(study / "src"), *filter(None, [os.environ.get("PYTHONPATH")])]
    running = subprocess.Popen(
        [sys.executable, "-m", "snakemake", *QUICK, *options],
        cwd=study,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        stdout=(study / "snakemake.log").open("ab"),
        stderr=subprocess.STDOUT,
    )
    STARTED.append(running)
    return running


def written(study: Path) -> str:
    """All that Snakemake has said in a copy of the study."""
    return (study / "snakemake.log").read_text(errors="replace")


def succeed(study: Path, running: subprocess.Popen[bytes]) -> None:
    """Wait until Snakemake ends, which must be with success."""
    if running.wait():
        raise Failed(f"Snakemake fails:\n{written(study)[-3000:]}")


def tables(study: Path) -> Tables:
    """Every table and batch of a study, to the last bit of its numbers, without its metadata."""
    files = sorted((study / RESULTS).rglob("*.parquet"))
    return {str(file.relative_to(study)): repr(pq.read_table(file).to_pydict()) for file in files}


def undisturbed(cluster: Cluster, study: Path) -> None:
    """Run the whole study."""
    begun = time.monotonic()
    succeed(study, start(study, *SLURM))
    seconds = time.monotonic() - begun
    ended = [dict(re.findall(r"(\w+)=(\S*)", line)) for line in cluster.finished()]
    held = sum(_elapsed(job) for job in ended)
    files = list((study / RESULTS / "benchmarks").rglob("*.tsv"))
    over = held - sum(float(file.read_text().splitlines()[1].split("\t")[0]) for file in files)
    print(
        f"  {len(files)} jobs in {len(ended)} submissions, {seconds:.0f} s of wall time; "
        f"submissions ran for {held:.0f} s\n  overhead: {over:.0f} s, "
        f"{over / len(ended):.1f} s a submission, {over / len(files):.1f} s a job",
        flush=True,
    )


def _elapsed(job: dict[str, str]) -> float:
    begun, ended = (datetime.fromisoformat(job[key]) for key in ("StartTime", "EndTime"))
    return (ended - begun).total_seconds()


def killed_snakemake(cluster: Cluster, study: Path) -> None:
    """Kill Snakemake while Slurm works for it; go on by the documented commands."""
    running = start(study, *SLURM, *PART)
    wait("a batch to run", in_a_batch(cluster, study), patience=600.0)
    running.kill()
    running.wait()
    print(f"  left in Slurm: {len(cluster.jobs())} job", flush=True)
    succeed(study, start(study, "--unlock"))
    if not start(study, *SLURM, *PART).wait():
        raise Failed("Snakemake starts although jobs of the killed run are left")
    refusal = re.findall(r"cancel them: (scancel --name=\S+)", written(study))
    if not refusal:
        raise Failed(f"nothing is said of the jobs that are left:\n{written(study)[-3000:]}")
    print(f"  the next start is refused until: {refusal[-1]}", flush=True)
    subprocess.run(refusal[-1].split(), check=True)
    wait("jobs to end", lambda: not cluster.jobs())
    succeed(study, start(study, *SLURM, *PART))


def killed_controller(cluster: Cluster, study: Path) -> None:
    """Kill slurmctld, and start it again after forty seconds; the run goes on by itself."""
    running = start(study, *SLURM, *PART)
    wait("a batch to run", in_a_batch(cluster, study), patience=600.0)
    cluster.kill("slurmctld")
    time.sleep(40.0)
    cluster.start_controller()
    succeed(study, running)


def in_a_batch(cluster: Cluster, study: Path) -> Callable[[], bool]:
    """Whether the submission of batches runs."""
    logs = study / RESULTS / "logs"
    return lambda: bool(cluster.jobs("--states=R") and any(logs.rglob("seeds-*.log")))


def check(study: Path, local: Tables) -> None:
    """Compare what a study has left with the local run."""
    found = tables(study)
    if not found or found.items() - local.items():
        names = ", ".join(name for name, _ in sorted(found.items() - local.items()))
        raise Failed(f"These differ from the local run: {names or 'there are none'}")
    print(f"  {len(found)} tables and batches are those of the local run, to the bit", flush=True)


def main() -> None:
    """Run all of it; the exit status says whether it has passed."""
    signal.signal(signal.SIGALRM, _too_long)
    signal.alarm(LIMIT)
    folder = Path(tempfile.mkdtemp(prefix="springblock-studies-"))
    try:
        with one_node() as cluster:
            local = copied(folder / "local")
            succeed(local, start(local, "--cores", "all"))
            expected = tables(local)
            for way in (undisturbed, killed_snakemake, killed_controller):
                print(f"{way.__doc__}", flush=True)
                study = copied(folder / way.__name__)
                way(cluster, study)
                check(study, expected)
    except (CannotStart, Failed, TimeoutError) as reason:
        sys.exit(f"{reason}.")
    finally:
        for running in STARTED:
            running.kill()
        shutil.rmtree(folder, ignore_errors=True)


def _too_long(*_: object) -> None:
    raise TimeoutError(f"It takes more than {LIMIT} s")


if __name__ == "__main__":
    main()
