"""The quick study through Slurm, with crashes, beside a local run: `make test-slurm`."""

import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.slurm.cluster import Cluster, Failed, one_node, wait
from tests.studies import Study

LIMIT = 900  #: s for one run of Snakemake
SLURM = ("--workflow-profile", "slurm")
#: What is made through crashes: realisations and their table, in four submissions.
PART = (*SLURM, "--", "aggregate")
RESULTS = "results/quick"
STARTED: list[subprocess.Popen[str]] = []


def start(study: Study, *options: str) -> subprocess.Popen[str]:
    """Start the quick study, whose words go to a file."""
    log = (study / "snakemake.log").open("ab")
    running = study.start(*options, configuration=("config/quick.yaml",), stdout=log)
    STARTED.append(running)
    return running


def said(study: Study) -> str:
    """All that Snakemake has said of a study."""
    return (study / "snakemake.log").read_text(errors="replace")


def succeed(study: Study, running: subprocess.Popen[str]) -> None:
    """Wait until Snakemake ends, which must be with success."""
    if running.wait(LIMIT):
        raise Failed(f"Snakemake fails:\n{said(study)[-3000:]}")


def start_batches(cluster: Cluster, study: Study) -> subprocess.Popen[str]:
    """Start a study, and wait until Slurm runs a submission of batches."""
    running, logs = start(study, *PART), study / RESULTS / "logs"
    wait(
        "a batch to run",
        lambda: bool(cluster.jobs("--states=R") and any(logs.rglob("batch-*.log"))),
        patience=600.0,
    )
    return running


def undisturbed(cluster: Cluster, study: Study) -> None:
    """Run the whole study."""
    succeed(study, start(study, *SLURM))


def killed_snakemake(cluster: Cluster, study: Study) -> None:
    """Kill Snakemake while Slurm works for it; go on by the documented commands."""
    running = start_batches(cluster, study)
    running.kill()
    running.wait()
    succeed(study, start(study, "--unlock"))
    if not start(study, *PART).wait(LIMIT):
        raise Failed("Snakemake starts although jobs of the killed run are left")
    refusal = re.findall(r"cancel them: (scancel --name=\S+)", said(study))
    if not refusal:
        raise Failed(f"nothing is said of the jobs that are left:\n{said(study)[-3000:]}")
    print(f"  the next start is refused until: {refusal[-1]}", flush=True)
    subprocess.run(refusal[-1].split(), check=True)
    wait("jobs to end", lambda: not cluster.jobs())
    succeed(study, start(study, *PART))


def killed_controller(cluster: Cluster, study: Study) -> None:
    """Kill slurmctld, and start it again after forty seconds; the run goes on by itself."""
    running = start_batches(cluster, study)
    time.sleep(10.0)  # Slurm stores its state every five seconds, and holds jobs started since then
    cluster.kill("slurmctld")
    time.sleep(40.0)
    cluster.start_controller()
    succeed(study, running)


def check(study: Study, local: Study) -> None:
    """Compare all numbers of tables and batches with those of the local run, to the bit."""
    found, expected = (each.numbers(RESULTS, "**/*.parquet") for each in (study, local))
    differing = sorted(name for name in found if found[name] != expected.get(name))
    if differing or not found:
        raise Failed(f"These differ from the local run: {', '.join(differing) or 'there are none'}")
    print(f"  {len(found)} tables and batches are those of the local run, to the bit", flush=True)


def main() -> None:
    """Run all of it; the exit status says whether it has passed."""
    folder = Path(tempfile.mkdtemp(prefix="springblock-studies-"))
    try:
        with one_node() as cluster:
            local = Study.begun(folder / "local")
            succeed(local, start(local, "--cores", "all"))
            for way in (undisturbed, killed_snakemake, killed_controller):
                print(way.__doc__, flush=True)
                study, begun = Study.begun(folder / way.__name__), time.monotonic()
                way(cluster, study)
                print(f"  {time.monotonic() - begun:.0f} s", flush=True)
                check(study, local)
    except (Failed, subprocess.SubprocessError) as reason:
        sys.exit(f"{reason}.")
    finally:
        for running in STARTED:
            running.kill()
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
