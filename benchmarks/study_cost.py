"""Where the CPU time of the whole study goes, from the benchmark files that Snakemake leaves."""

import csv
from collections import Counter, defaultdict
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.timing import Row
from springblock.plotting import declarations

FOLDER = Path(__file__).parents[1] / "results/benchmarks"


def rows() -> Iterator[Row]:
    """Total CPU time by kind of job, and the largest memory of a job."""
    seconds: dict[str, float] = defaultdict(float)
    jobs: Counter[str] = Counter()
    memory = 0.0
    for file in FOLDER.rglob("*.tsv"):
        with file.open(newline="") as lines:
            job = next(csv.DictReader(lines, delimiter="\t"))
        kind = _kind(file.relative_to(FOLDER))
        jobs[kind] += 1
        # Snakemake samples the CPU time, and has none of a job that ends before the first sample
        seconds[kind] += _number(job["cpu_time"]) or _number(job["s"])
        memory = max(memory, _number(job["max_rss"]))
    if not jobs:
        yield Row("study", "all jobs", "s", np.nan, note="the study has not been run")
        return
    total = sum(seconds.values())
    here = partial(Row, "study", unit="s", reference=total)
    sampled = f"{jobs.total()} jobs; Snakemake's samples miss the last seconds of a job"
    yield here("all jobs", values=total, note=sampled)
    for kind, each in sorted(seconds.items(), key=lambda item: -item[1]):
        yield here(kind, values=each, note=f"jobs: {jobs[kind]}")
    yield Row("study", "largest memory of a job", "MB", memory)


def _kind(file: Path) -> str:
    """Kind of job that left this file, by its name; a step of the study's or figures."""
    drawn = file.stem in declarations() or file.stem.startswith(("film_", "sweep_"))
    if drawn:
        return "figures"
    if file.parts[0] in ("accuracy", "surfaces"):
        return file.parts[0]
    return "simulate" if file.stem.startswith("batch-") else file.stem


def _number(text: str) -> float:
    """Zero for what Snakemake writes where it has no number."""
    try:
        return float(text)
    except ValueError:
        return 0.0
