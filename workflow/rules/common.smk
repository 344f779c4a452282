# The configuration, checked, and what it asks for.
import os
import re
import sys
from pathlib import Path
from shlex import quote

import yaml
from snakemake.exceptions import WorkflowError
from snakemake.utils import update_config

from springblock.cli import sentence
from springblock.provenance import ANALYSE, COMPILE, MASK, PLAN, SIMULATE, digest
from springblock.study import configuration as study
from springblock.study.plan import Plan
from springblock.study.results import PAGES, PARTS, digest_of_report

with open(workflow.source_path("../schemas/config.schema.yaml")) as file:
    SCHEMA = yaml.load(file, study.LOADER)

# Snakemake has not loaded the defaults for a module with `config`, or in another folder.
if workflow.modifier.skip_configfile or not Path(DEFAULTS).exists():
    with open(workflow.source_path(f"../../{DEFAULTS}")) as file:
        given, config = config, yaml.load(file, study.LOADER)
    update_config(config, given)


def checked(step, *given):
    """Call a function, and report in one sentence why the study cannot be run."""
    try:
        return step(*given)
    except Exception as error:
        raise WorkflowError(f"The study cannot be run: {sentence(error)}.") from None


for file in workflow.configfiles if workflow.is_main_process else []:
    checked(study.refuse_repeated_keys, Path(file))
config = checked(study.completed, config)
checked(study.check, config, SCHEMA)
PLANNED = checked(Plan, config)
RESULTS = PLANNED.results


def code(step):
    """The digest of the code of a step: jobs run again when it changes."""
    return lambda wildcards: digest(step)


# Jobs find `springblock` beside this Python; on a cluster, which shares it, by the same path on every node.
os.environ.update(PATH=os.pathsep.join([str(Path(sys.executable).parent), *os.get_exec_path()]))
if workflow.is_main_process:
    os.environ[PLAN] = PLANNED.for_jobs()
    checked(PLANNED.remove_others, workflow.dryrun)


wildcard_constraints:
    scene="|".join(map(re.escape, PLANNED.scenes)),
