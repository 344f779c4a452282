"""What many small jobs cost the workflow: flat surfaces with N = 12, one realisation a job.

    python -m benchmarks.load 5000 --dry-run    # plans as many jobs
    python -m benchmarks.load 300               # runs them; options are Snakemake's

docs/scaling.md has what it prints.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
DURATION = 2e-6  #: s, ten samples: next to nothing is simulated


def configuration(jobs: int) -> dict[str, object]:
    """Many realisations of one small surface, one a job, and the one of each that a study needs."""
    paper = yaml.safe_load((ROOT / "config/config.yaml").read_text())
    one = {"direction": ["x"], "seeds": 1}
    ours = {
        "flat": {**one, "seeds": jobs, "duration": DURATION},
        "pillars": {**one, "n_p": [3], "n_s": [3]},
        "grooves": {**one, "n_p": [5], "n_s": [7], "n_p2": [1], "n_s2": [1]},
    }
    scenes = {"scenes": dict.fromkeys(paper["scenes"]) | ours}
    without = {part: dict.fromkeys(paper[part]) for part in ("beyond", "more")}
    return {"n_blocks": 12, "realisations_per_job": 1, "accuracy": False, **scenes, **without}


def measured(jobs: int, *options: str) -> str:
    """Run Snakemake in a folder of its own, and say what it took."""
    with tempfile.TemporaryDirectory() as name:
        folder, begun = Path(name), time.monotonic()
        for part in ("Snakefile", "workflow", "config", "profiles"):
            (folder / part).symlink_to(ROOT / part)
        (folder / "many.yaml").write_text(yaml.safe_dump(configuration(jobs)))
        command = [sys.executable, "-m", "snakemake", "--configfile", "many.yaml", "--quiet", "all"]
        subprocess.run([*command, *options, "--", "aggregate"], cwd=folder, check=True)
        wall = time.monotonic() - begun
        entries = [len(folders) + len(files) for _, folders, files in os.walk(folder)]
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = (used.ru_utime + used.ru_stime) / jobs
    return (
        f"{jobs} jobs: {wall:.0f} s, {cpu:.3f} CPU s a job, {sum(entries)} files and folders, "
        f"{max(entries)} in the largest folder, {used.ru_maxrss} (kB on Linux) of memory"
    )


if __name__ == "__main__":
    print(measured(int(sys.argv[1]), *sys.argv[2:]))
