"""The quick study, killed ten times at a random moment and taken up again: `make soak`.

Each round begins from nothing, is killed with all its jobs (SIGKILL) at a moment drawn uniformly
from the time that an undisturbed study took, is unlocked, goes on with the same command, and must
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


def start(study: Study) -> subprocess.Popen[str]:
    """Start the quick study on one core."""
    options = ("--cores", "1", "--quiet", "all", "--", "aggregate", "correlations", "claims")
    return study.start(*options, configuration=("config/quick.yaml",), stdout=None, stderr=None)


def finished(study: Study) -> dict[str, str]:
    """Run a study to its end, and return the numbers of its tables."""
    if start(study).wait():
        sys.exit(f"The study in {study.folder} failed.")
    return study.numbers("results/quick")


def killed(study: Study, after: float) -> bool:
    """Kill a study after so many seconds; whether it was still running."""
    run = start(study)
    try:
        run.wait(after)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        subprocess.run(study.command("--unlock"), cwd=study, env=study.environment, check=True)
        return True
    return False


def main() -> None:
    """Run all rounds; exit with 1 where one of them ends in other tables."""
    folder, rng = Path(tempfile.mkdtemp(prefix="springblock-soak-")), np.random.default_rng(2022)
    begin = time.monotonic()
    expected = finished(Study.begun(folder / "undisturbed"))
    assert expected
    whole = time.monotonic() - begin
    print(f"undisturbed: {whole:.0f} s; studies are in {folder}", flush=True)
    equal = kills = tries = 0
    while kills < ROUNDS:
        study, after = Study.begun(folder / f"round-{tries}"), rng.uniform(0.0, whole)
        tries += 1
        if killed(study, after):  # otherwise it was quicker than the undisturbed one
            kills += 1
            same = finished(study) == expected
            equal += same
            tables = "equal" if same else "differ"
            print(f"{kills}: killed after {after:.0f} s, tables {tables}", flush=True)
    print(f"tables equal {equal} times of {ROUNDS}")
    sys.exit(equal < ROUNDS)


if __name__ == "__main__":
    main()
