import os
import re
import sys
from itertools import accumulate, chain
from operator import or_
from pathlib import Path
from shlex import quote

import yaml
from snakemake.exceptions import WorkflowError

from springblock import Material, provenance as sources
from springblock.io import origin
from springblock.study import configuration as study, cost
from springblock.simulation.setup import Setup

with open(workflow.source_path("../schemas/config.schema.yaml")) as file:
    SCHEMA = yaml.safe_load(file)

config = study.completed(config)
try:
    study.check(config, SCHEMA)
except (TypeError, ValueError) as error:
    raise WorkflowError(f"The configuration cannot be used: {error}.") from None

RESULTS = str(Path(config["results"]))  # results/ would be a folder with two slashes after it
SETUP = Setup(
    Material(**config["material"]),
    **{key: config[key] for key in ("integrator", "step", "sample_interval")},
)
INTEGRATORS = SCHEMA["properties"]["integrator"]["enum"]
CORRELATIONS = expand(
    f"{RESULTS}/tables/{{table}}.parquet", table=["correlation", "correlation_length"]
)
#: Groups of scenes, each a list of ensembles.
ENSEMBLES = study.ensembles(config)
#: Groups of each part of the study, by the folder of its tables.
PARTS = {"": config["scenes"], "beyond/": config["beyond"], "more/": config["more"]}
#: Groups that it may draw on: its own, and those of the parts before it.
REACH = dict(zip(PARTS, accumulate(PARTS.values(), or_), strict=True))
#: The ensemble in each folder of realisations.
ENSEMBLE = {
    part: {each.scene.folder: each for group in groups for each in ENSEMBLES[group]}
    for part, groups in REACH.items()
}
EVERY = ENSEMBLE["more/"]
#: Cuts of measured surfaces by the name of the mask that they make.
CUTS = {
    ensemble.scene.mask.name: ensemble.scene.mask.cut
    for ensemble in EVERY.values()
    if ensemble.scene.mask and ensemble.scene.mask.cut
}

CONFIGURATION = sources.configuration_digest(config)
#: Code that realisations are computed with.
SIMULATING = sources.digest("springblock.cli.simulate")
#: What is made of code and conditions whose digests these files have in their names, by the file.
ORIGINS = {}

# Jobs find `springblock` beside the Python that runs Snakemake, in an activated environment or not; on
# a cluster that is the same path on every node, on a file system that they share.
os.environ.update(PATH=os.pathsep.join([str(Path(sys.executable).parent), *os.get_exec_path()]))


def made_of(name, *modules, code=None, **conditions):
    """File whose name changes with the code of these modules and with conditions."""
    code = code or sources.digest(*modules)
    file = origin.origin(RESULTS, name, code, conditions).as_posix()
    ORIGINS[file] = conditions
    return file


SCENE_ORIGIN = {
    folder: made_of(folder, code=SIMULATING, **study.conditions(config, ensemble))
    for folder, ensemble in EVERY.items()
}


def batches(members):
    """Files that hold the realisations of these ensembles, a thousand in a folder."""
    return [
        f"{RESULTS}/realisations/{ensemble.scene.folder}/{further(i)}"
        f"seeds-{batch[0]}-{batch[-1]}.parquet"
        for ensemble in members
        for i, batch in enumerate(ensemble.batches(config["realisations_per_job"]))
    ]


def further(i):
    """Folder within a scene's own for the batch of this number; none for the first thousand."""
    return f"more-{i // 1000}/" if i >= 1000 else ""


def ensembles(part, groups=None):
    """Ensembles of a part of the study, each once: of its own groups, or of these."""
    members = chain.from_iterable(ENSEMBLES.get(group, []) for group in groups or PARTS[part])
    return list(dict.fromkeys(ENSEMBLE[part][each.scene.folder] for each in members))


def tables_of(part):
    """Tables of a part, which must hold scenes; of correlations where some of these have sides."""
    if not ensembles(part):
        raise WorkflowError(
            f"{part.rstrip('/')} holds no scenes; config/config.yaml has some to begin with."
        )
    tables = ["realisations"]
    if any(ensemble.scene.sides for ensemble in ensembles(part)):
        tables += ["correlation", "correlation_length"]
    return [f"{RESULTS}/tables/{part}{table}.parquet" for table in tables]


def was_simulated(part):
    """Whether a part that is simulated upon request has been."""
    return bool(ensembles(part)) and Path(tables_of(part)[0]).exists()


def furthest(groups):
    """The part that has simulated most of these groups, or must."""
    return "more/" if was_simulated("more/") or set(groups) & set(PARTS["more/"]) else "beyond/"


def scene(wildcards):
    """The scene of a job, as options of its command."""
    return EVERY[wildcards.scene].scene.arguments


def own_files(wildcards):
    """Masks and coefficients that a scene is read from."""
    return [str(file) for file in EVERY[wildcards.scene].scene.files.values()]


def duration(wildcards):
    seconds = EVERY[wildcards.scene].duration
    return "" if seconds is None else f"--duration {seconds}"


def seeds_of(wildcards):
    """Number of realisations of a job; a prelude counts as one."""
    return int(wildcards.get("last", 0)) - int(wildcards.get("first", 0)) + 1


def memory(wildcards, attempt):
    """MB; more, if that was not enough."""
    return attempt * cost.memory(EVERY[wildcards.scene].scene, seeds_of(wildcards))


def minutes(wildcards, attempt):
    """Minutes; more, if that was not enough."""
    ensemble = EVERY[wildcards.scene]
    setup = SETUP.vary(dict(ensemble.scene.varied))
    return attempt * cost.minutes(ensemble.scene, setup, ensemble.duration, seeds_of(wildcards))


def correlations(table, part):
    """Files that hold a table of correlations for each ensemble of a part that has sides."""
    scenes = [ensemble.scene for ensemble in ensembles(part) if ensemble.scene.sides]
    return [f"{RESULTS}/correlations/{part}{scene.folder}/{table}.parquet" for scene in scenes]


def there_already(*files):
    """Those of these results that have been made, which belongs to no step of the study itself."""
    results = [Path(RESULTS, file) for file in files]
    return [str(file) for file in results if file.exists()]
