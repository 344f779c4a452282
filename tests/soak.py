"""Ten times the quick study, killed at a random moment and taken up again: `make soak`.

Not a test of every day: it takes ten times as long as `make quick`. Each round begins from nothing,
is killed with all its jobs (SIGKILL) at a moment drawn uniformly from the time that an undisturbed
study took, goes on with the same command, and must end in the same tables to the bit.
"""

import argparse
import os
import signal
import subprocess
import sys
import time
from itertools import count
from pathlib import Path

import numpy as np

from springblock.analysis.comparison import compare
from springblock.io.parquet import load

ROOT = Path(__file__).parents[1]
TARGETS = ("aggregate", "correlations", "claims")


def study(results: Path) -> subprocess.Popen[bytes]:
    """Begin the quick study, in a process group of its own, on one core."""
    words = ["--cores", "1", "--configfile", "config/quick.yaml", "--config", f"results={results}"]
    return subprocess.Popen(
        [sys.executable, "-m", "snakemake", "--quiet", "all", *words, "--", *TARGETS],
        cwd=ROOT,
        start_new_session=True,
    )


def killed(results: Path, after: float) -> bool:
    """Kill a study after so many seconds; whether it was still running."""
    run = study(results)
    try:
        run.wait(after)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        return True
    return False


def same_tables(first: Path, second: Path) -> bool:
    """Whether all tables hold the same, to the bit."""
    names = sorted(file.name for file in (first / "tables").glob("*.parquet"))
    assert names == sorted(file.name for file in (second / "tables").glob("*.parquet"))
    tables = ([load(folder / "tables" / name) for name in names] for folder in (first, second))
    return all(compare(one, other).same for one, other in zip(*tables, strict=True))


def main() -> None:
    """Run all rounds; exit with 1 where one of them ends in other tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--folder", type=Path, default=Path("results/soak"))
    given = parser.parse_args()
    begin = time.monotonic()
    assert study(given.folder / "undisturbed").wait() == 0
    whole = time.monotonic() - begin
    print(f"undisturbed: {whole:.0f} s", flush=True)
    kills, equal, rng = 0, 0, np.random.default_rng(2022)
    for i in count():
        if kills == given.rounds:
            break
        results, after = given.folder / f"round-{i}", rng.uniform(0.0, whole)
        if not killed(results, after):  # it was quicker than the undisturbed one
            continue
        kills += 1
        files = sum(1 for _ in (results / "realisations").rglob("*.parquet"))
        same = study(results).wait() == 0 and same_tables(given.folder / "undisturbed", results)
        equal += same
        how = f"killed after {after:.0f} s with {files} batches"
        print(f"round {i}: {how}, tables {'equal' if same else 'differ'}", flush=True)
    print(f"tables equal {equal} times of {given.rounds}")
    sys.exit(equal < given.rounds)


if __name__ == "__main__":
    main()
