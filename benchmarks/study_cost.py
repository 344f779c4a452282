"""Where the CPU time of the whole study goes, from the benchmark files that Snakemake leaves.

What the pipeline itself costs is measured beside: a job that simulates next to nothing, and the
planning of all jobs.
"""

import csv
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from benchmarks.peers.missing import Missing
from benchmarks.timing import Row, interleaved, missing, row
from springblock import draw_friction, simulate
from springblock.cli.simulate import batch_row
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import BATCH
from springblock.model.scene import Scene
from springblock.plotting import declarations
from springblock.simulation.setup import Setup

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "results"
N = 120
REPETITIONS = 3
BATCH_SIZE = 10  #: realisations in a file


@dataclass(frozen=True)
class Job:
    """One job of the study."""

    rule: str
    cpu_seconds: float
    memory: float  #: largest resident set, MB


def jobs(folder: Path) -> list[Job]:
    """Read all benchmark files under `folder`."""
    return [_job(path) for path in sorted(folder.glob("**/*.tsv"))]


def _job(path: Path) -> Job:
    with path.open(newline="") as file:
        measured = next(csv.DictReader(file, delimiter="\t"))
    return Job(
        rule=_rule(path),
        # Snakemake samples the CPU time, and has none of a job that ends before the first sample
        cpu_seconds=_number(measured["cpu_time"]) or _number(measured["s"]),
        memory=_number(measured["max_rss"]),
    )


def _number(text: str) -> float:
    """Zero for what Snakemake writes where it has no number."""
    try:
        return float(text)
    except ValueError:
        return 0.0


@cache
def _figures() -> frozenset[str]:
    return frozenset(declarations())


def _rule(path: Path) -> str:
    """Kind of job that left this file."""
    if path.stem.startswith("seeds-"):
        return "simulate"
    if path.stem.startswith("compile-"):
        return "compile"
    if path.parent.name == "surfaces":
        return "mask"
    if path.stem in _figures() or path.stem.startswith(("film_", "sweep_")):
        return "figures"
    if path.parent.name == "production" or path.stem == "production_table":
        return "production"
    tables = ("precision_table", "stability_table")
    if path.parent.name == "accuracy" or path.stem in tables:
        return "accuracy"
    return path.stem


def rows() -> Iterator[Row]:
    """The study's jobs, and what the pipeline adds."""
    # `make` leaves the errors at full size out
    done = [job for job in jobs(RESULTS / "benchmarks") if job.rule != "production"]
    yield from job_rows(done)
    yield from overhead_rows(done)


def job_rows(done: list[Job]) -> Iterator[Row]:
    """Total CPU time by kind of job, and memory."""
    if not done:
        why = Missing("the study has not been run")
        yield missing("study", "all jobs", "s", why)
        yield missing("study", "largest memory of a job", "MB", why)
        return
    total = sum(job.cpu_seconds for job in done)
    by_rule: dict[str, list[float]] = {}
    for job in done:
        by_rule.setdefault(job.rule, []).append(job.cpu_seconds)
    here = partial(row, "study", unit="s", reference=total)
    sampled = f"{len(done)} jobs; Snakemake's samples miss the last seconds of a job"
    yield here("all jobs", values=total, note=sampled)
    for rule, each in sorted(by_rule.items(), key=lambda item: -sum(item[1])):
        yield here(rule, values=sum(each), note=f"jobs: {len(each)}")
    largest = max(done, key=lambda job: job.memory)
    yield row("study", "largest memory of a job", "MB", largest.memory, note=largest.rule)


def overhead_rows(done: list[Job]) -> Iterator[Row]:
    """CPU time of what is not simulation, figures or statistics."""
    planning = "planning all jobs: snakemake -n"
    with tempfile.TemporaryDirectory() as folder:
        batch, rows_of_batch = Path(folder) / "batch.parquet", _batch()
        _write(batch, rows_of_batch)  # the first one imports what it needs
        writing = f"writing {BATCH_SIZE} realisations"
        runs: dict[str, Callable[[], object]] = {
            **_job_runs(Path(folder)),
            writing: partial(_write, batch, rows_of_batch),
            planning: partial(_python, "-m", "snakemake", "-n"),
        }
        try:
            seconds = interleaved(runs, REPETITIONS)
        except Missing as why:
            yield missing("study", "the pipeline's own", "s", why)
            return
    imports, simulating, job = (seconds[name] for name in ("imports", "simulating", "job"))
    yield row("study", "a job's imports", "s", imports, note="springblock simulate --help")
    yield row("study", "a job's compiled code", "s", simulating - imports, note="read from cache")
    yield row("study", "a job's table", "s", job - simulating, note="the first in a process")
    yield row("study", "a job without work", "s", job, note="the sum of these")
    yield row("study", writing, "s", seconds[writing], n_blocks=N, note="any further one")
    yield row("study", planning, "s", seconds[planning])
    if done:
        count = sum(one.rule in ("prelude", "simulate") for one in done)
        total = sum(one.cpu_seconds for one in done)
        note = f"{count} jobs without work, and the planning"
        own = count * job + seconds[planning]
        yield row("study", "the pipeline's own", "s", own, reference=total, note=note)


def _job_runs(folder: Path) -> dict[str, Callable[[], object]]:
    """A job that simulates next to nothing, and the same with less and less of it."""
    tiny = ("--n-blocks", "4", "--first-seed", "0", "--last-seed", "0", "--duration", "2e-7")
    output = ("--output", str(folder / "tiny.parquet"))
    alone = (
        "from springblock.cli.simulate import draw_friction, simulate;"
        "simulate([[True] * 4] * 4, *draw_friction(4, 0), duration=2e-7)"
    )
    return {
        "imports": partial(_python, "-m", "springblock", "simulate", "--help"),
        "simulating": partial(_python, "-c", alone),
        "job": partial(_python, "-m", "springblock", "simulate", *tiny, *output),
    }


def _batch() -> list[dict[str, object]]:
    """Rows of realisations of full size, cut short."""
    scene = Scene(N)
    contact = scene.pattern.contact
    run = simulate(contact, *draw_friction(N, seed=0), duration=2e-6)
    return [batch_row(scene, Setup(), seed, run) for seed in range(BATCH_SIZE)]


def _write(path: Path, batch: list[dict[str, object]]) -> None:
    write(rows_to_table(batch, BATCH), path, {})


def _python(*arguments: str) -> None:
    """Run Python as a job does; raises Missing where it fails."""
    outcome = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if outcome.returncode:
        raise Missing((outcome.stderr.strip().splitlines() or ["no message"])[-1])
