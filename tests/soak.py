"""The quick study, killed ten times at a random moment and continued: `make soak`.

Each round begins from nothing, is killed with all its jobs (SIGKILL) at a moment drawn uniformly
from the time that an undisturbed study took, is unlocked, continues with the same command, and must
end in the same tables to the bit. It takes ten times as long as `make quick`.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from studies import Study

ROUNDS = 10


def start(study: Study, *options: str) -> subprocess.Popen[str]:
    """Start the quick study on one core."""
    options = (*options, "--cores", "1", "--quiet", "all")
    targets = ("aggregate", "correlations", "claims_table")
    quick = ("config/quick.yaml",)
    return study.start(*options, configuration=quick, targets=targets, stdout=None, stderr=None)


def finished(study: Study) -> dict[str, str]:
    """Run a study to its end, and return the numbers of its tables."""
    if start(study).wait():
        sys.exit(f"The study in {study.folder} failed.")
    return study.numbers("results/quick") or sys.exit("The study has left no tables.")


def main() -> None:
    """Run all rounds; exit with 1 if one of them ends in other tables."""
    folder, rng = Path(tempfile.mkdtemp(prefix="springblock-soak-")), np.random.default_rng(2022)
    begin = time.monotonic()
    expected = finished(Study.begun(folder / "undisturbed"))
    whole = time.monotonic() - begin
    print(f"undisturbed: {whole:.0f} s; studies are in {folder}", flush=True)
    kills = equal = tries = 0
    while kills < ROUNDS:
        study, after = Study.begun(folder / f"round-{tries}"), rng.uniform(0.0, whole)
        run = start(study)
        tries += 1
        time.sleep(after)
        if run.poll() is not None:
            continue  # it was quicker than the undisturbed one
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        start(study, "--unlock").wait()
        same = finished(study) == expected
        kills, equal = kills + 1, equal + same
        print(f"killed after {after:.0f} s: tables {'equal' if same else 'differ'}", flush=True)
    print(f"tables equal {equal} times of {ROUNDS}")
    sys.exit(equal < ROUNDS)


if __name__ == "__main__":
    main()
