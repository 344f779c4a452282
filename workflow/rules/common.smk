# The configuration, checked and expanded, and functions that several rules share.

import logging
import os
import re
import shutil
import subprocess
import sys
import time
from itertools import chain
from pathlib import Path
from shlex import quote
from types import SimpleNamespace

import yaml
from snakemake.exceptions import WorkflowError
from snakemake_interface_logger_plugins.common import LogEvent

from springblock.provenance import configuration_digest, digest
from springblock.study import configuration as study
from springblock.study import cost, record
from springblock.study.written import LOADER, check_file

with open(workflow.source_path("../schemas/config.schema.yaml")) as file:
    SCHEMA = yaml.load(file, LOADER)

try:
    for file in workflow.configfiles if workflow.is_main_process else []:
        check_file(Path(file))
    config = study.completed(config)
    study.check(config, SCHEMA)
    RESULTS = str(Path(config["results"]))  # without a slash at the end
    if workflow.is_main_process:
        record.refuse_unknown(Path(RESULTS), config)
except (TypeError, ValueError) as error:
    raise WorkflowError(f"The study cannot be run: {error}.") from None

BEGUN = time.time()
OWN = study.is_own(config)
SETUP = study.setup(config)
CONFIGURATION = configuration_digest(config)
#: Groups of scenes, each a list of ensembles; the ensemble and the setup of each folder.
ENSEMBLES = study.ensembles(config)
ENSEMBLE = {ensemble.scene.folder: ensemble for ensemble in chain.from_iterable(ENSEMBLES.values())}
SETUPS = {folder: SETUP.vary(dict(ensemble.scene.varied)) for folder, ensemble in ENSEMBLE.items()}

# Jobs find `springblock` beside the Python that runs Snakemake, in an activated environment or not; on
# a cluster that is the same path on every node, on a file system that they share.
os.environ.update(PATH=os.pathsep.join([str(Path(sys.executable).parent), *os.get_exec_path()]))


wildcard_constraints:
    scene="|".join(map(re.escape, ENSEMBLE)),


def code(step):
    """The digest of the code of a step of `provenance.STEPS`: jobs run again when it changes."""
    return lambda wildcards: digest(step)


def ensembles(groups):
    """Ensembles of those groups that the study has, each once."""
    return list(dict.fromkeys(chain.from_iterable(ENSEMBLES.get(group, []) for group in groups)))


def batches(members):
    """Files of the realisations of these ensembles."""
    return [
        f"{RESULTS}/realisations/{ensemble.scene.folder}/batch-{i}.parquet"
        for ensemble in members
        for i in ensemble.batches(config["realisations_per_job"])
    ]


def seeds(wildcards):
    """Seeds of a batch."""
    return ENSEMBLE[wildcards.scene].batches(config["realisations_per_job"])[int(wildcards.batch)]


def scene(wildcards):
    """The scene of a job, as options of its command."""
    return ENSEMBLE[wildcards.scene].scene.arguments


def own_files(wildcards):
    """Files of the mask, the coefficients and the law of a scene."""
    of_study = {"law": getattr(SETUP.material.law, "file", None)}
    files = of_study | ENSEMBLE[wildcards.scene].scene.files
    return [str(file) for file in files.values() if file]


def duration(wildcards):
    """The duration of a run, as an option; without it a run ends after the force peak."""
    seconds = ENSEMBLE[wildcards.scene].duration
    return "" if seconds is None else f"--duration {seconds}"


def runs_of(wildcards):
    """Number of runs of a job; a prelude counts as one."""
    return len(seeds(wildcards)) if hasattr(wildcards, "batch") else 1


def work(wildcards):
    """Scene, setup, duration and number of runs of a job."""
    ensemble = ENSEMBLE[wildcards.scene]
    return ensemble.scene, SETUPS[wildcards.scene], ensemble.duration, runs_of(wildcards)


def snapshots(wildcards):
    """Times at which the displacements of a scene are stored, as options."""
    return " ".join(f"--snapshot {time}" for time in ENSEMBLE[wildcards.scene].snapshot_times)


def memory(wildcards, attempt):
    """MB to request, more in each attempt; a snapshot needs as much as a realisation."""
    ensemble = ENSEMBLE[wildcards.scene]
    stored = runs_of(wildcards) * (1 + len(ensemble.snapshot_times))
    return attempt * cost.memory(ensemble.scene, stored)


def minutes(wildcards, attempt):
    """Minutes to request, more in each attempt."""
    return attempt * cost.minutes(*work(wildcards))


class Announced(logging.Handler):
    """Adds up the expected times of the jobs of a dry run, and prints the sum at its end."""

    def __init__(self):
        super().__init__()
        self.times = []

    def emit(self, record):
        if getattr(record, "event", None) == LogEvent.JOB_INFO:
            self.times.append(expected(record.rule_name, SimpleNamespace(**record.wildcards)))

    def close(self):
        super().close()
        if self.times and workflow.dryrun:
            print(f"These jobs take {cost.in_words(self.times, workflow.cores)}.", file=sys.stderr)


def expected(name, wildcards):
    """CPU time in s that a job of this name is expected to take."""
    if name in ("prelude", "simulate_batch"):
        return cost.expected(*work(wildcards))
    return cost.expected_of(name)


if workflow.is_main_process:
    logging.getLogger("snakemake.logging").addHandler(Announced())


def begin():
    """Record configuration and code before the first job; dry runs do not call this."""
    refuse_orphans()
    try:
        record.begin(Path(RESULTS), config, touched=workflow.touch)
    except (OSError, ValueError) as error:
        raise WorkflowError(f"The study cannot be run: {error}.") from None


def tell_errors():
    """Print the errors in the logs of this run's jobs, which the quiet profile does not show."""
    for file in sorted(Path(RESULTS, "logs").rglob("*.log")):
        said = file.read_text(errors="replace") if file.stat().st_mtime >= BEGUN else ""
        for line in [line for line in said.splitlines() if "Error" in line][-1:]:
            print(f"{file}: {line}", file=sys.stderr)


def refuse_orphans():
    """Refuse to start while Slurm has jobs of a killed run of this folder, which write the same files."""
    if not shutil.which("squeue"):
        return
    command = ["squeue", "--me", "--noheader", "--format=%j|%Z"]
    listed = subprocess.run(command, capture_output=True, text=True).stdout
    jobs = [line.split("|", 1) for line in listed.splitlines()]
    names = {name for name, folder in jobs if Path(folder) == Path.cwd()}
    orphans = sorted(name for name in names if name.startswith("springblock_"))
    if orphans:
        raise WorkflowError(
            "Slurm still has jobs of a run of this folder that was killed. "
            f"Wait until they end, or cancel them: scancel --name={','.join(orphans)}"
        )
