# The configuration, checked and expanded, and functions that several rules share.

import logging
import os
import re
import sys
from itertools import chain
from pathlib import Path
from shlex import quote

import yaml
from snakemake.exceptions import WorkflowError
from snakemake.utils import update_config

from springblock.cli import sentence
from springblock.provenance import configuration_digest, digest
from springblock.study import configuration as study
from springblock.study import cost, events, record
from springblock.study.written import LOADER, check_file

with open(workflow.source_path("../schemas/config.schema.yaml")) as file:
    SCHEMA = study.with_constants(yaml.load(file, LOADER))

# Snakemake has not loaded the defaults for a module with `config`, or in another folder.
if workflow.modifier.skip_configfile or not Path(DEFAULTS).exists():
    with open(workflow.source_path(f"../../{DEFAULTS}")) as file:
        given, config = config, yaml.load(file, LOADER)
    update_config(config, given)


def checked(step, *given):
    """Call a function, and report in one sentence why the study cannot be run."""
    try:
        return step(*given)
    except Exception as error:
        raise WorkflowError(f"The study cannot be run: {sentence(error)}.") from None


for file in workflow.configfiles if workflow.is_main_process else []:
    checked(check_file, Path(file))
config = checked(study.completed, config)
checked(study.check, config, SCHEMA)
RESULTS = str(Path(config["results"]))  # without a slash at the end

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


def law(wildcards):
    """The law of friction, whose name changes with its file and the data that it reads."""
    return str(SETUPS[wildcards.scene].material.law)


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


if workflow.is_main_process:
    watched = events.Events(
        workflow, config, lambda: record.contents(config, ENSEMBLE, SETUPS, NEEDED, SPARE)
    )
    logging.getLogger("snakemake.logging").addFilter(watched)
