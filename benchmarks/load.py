"""What many small jobs cost the workflow: flat surfaces with N = 24, one realisation a job.

    python -m benchmarks.load 5000 --dry-run    # plans as many jobs
    python -m benchmarks.load 300               # runs them; options are Snakemake's

Some ten jobs more are the other surfaces of config/examples/small.yaml. docs/scaling.md has what it
prints.
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


def measured(jobs: int, *options: str) -> str:
    """Run Snakemake in a folder of its own, and say what it took."""
    with tempfile.TemporaryDirectory() as name:
        folder, begun = Path(name), time.monotonic()
        for part in ("Snakefile", "workflow", "config", "profiles"):
            (folder / part).symlink_to(ROOT / part)
        flat = {"seeds": jobs, "duration": 2e-6}  # ten samples: next to nothing is simulated
        many = {"realisations_per_job": 1, "scenes": {"flat": flat}}
        (folder / "many.yaml").write_text(yaml.safe_dump(many))
        command = [sys.executable, "-m", "snakemake", "--quiet", "all", *options]
        files = ["--configfile", "config/examples/small.yaml", "many.yaml"]
        subprocess.run([*command, *files, "--", "aggregate"], cwd=folder, check=True)
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
