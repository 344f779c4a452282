# Slip precursors and topological length scales at the onset of frictional sliding:
# from a grid of surfaces to realisations, tables and figures.

from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

min_version("9.20")

try:
    import springblock
except ModuleNotFoundError:
    raise WorkflowError(
        "The package springblock is missing: run `pip install -e .` first."
    ) from None


# `config` already holds the keys that the user gives, which override those of this file.
DEFAULTS = "config/own.yaml" if config.get("study") == "own" else "config/config.yaml"
if Path(DEFAULTS).exists():

    configfile: DEFAULTS


# Container of all rules with `--software-deployment-method apptainer`; container/springblock.def builds it.
container: "container/springblock.sif"


include: "workflow/rules/common.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/chapters.smk"
include: "workflow/rules/figures.smk"


rule all:
    """Make everything that the configuration asks for."""
    default_target: True
    input:
        rules.simulate.input,
        rules.fields.input,
        rules.means.output if PLANNED.own else [],
        rules.pages.input,
        rules.figures.input,
        rules.films.input,
        rules.report.output,
    localrule: True


onsuccess:
    page = Path(RESULTS, "report.html").resolve()
    if page.exists():
        print(f"Report, to be opened in a browser: {page.as_uri()}", file=sys.stderr)
