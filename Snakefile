# Slip precursors and topological length scales at the onset of frictional sliding:
# from a grid of surfaces to realisations, tables and figures.

from pathlib import Path

from snakemake.utils import min_version

min_version("9.20")


# `config` already holds the keys that the user gives, which override those of this file.
DEFAULTS = "config/own.yaml" if config.get("study") == "own" else "config/config.yaml"
if Path(DEFAULTS).exists():

    configfile: DEFAULTS


# Container of all rules with `--software-deployment-method apptainer`; container/springblock.def builds it.
container: "container/springblock.sif"


include: "workflow/rules/common.smk"
include: "workflow/rules/drawn.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/correlation.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/mechanism.smk"
include: "workflow/rules/continuum.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


rule all:
    """Make everything that the configuration asks for."""
    default_target: True
    input:
        rules.simulate.input,
        rules.fields.input,
        rules.aggregate.output,
        CORRELATED,
        rules.correlations.input,
        rules.means.output if OWN else [rules.claims_table.output, rules.claims.output],
        rules.figures.input,
        FILMED,
        rules.report.output,
        [
            rules.precision_table.input,
            rules.production_table.input,
            rules.accuracy.input,
            rules.accuracy.output,
        ]
        if config["accuracy"]
        else [],
        MODEL_PARTS,
        MODELS,
        SENSITIVE,
        EXPLAINED,
        CONTINUUM,
    localrule: True
    message:
        f"The study is complete; its tables and figures are in {RESULTS}"


#: Files of the finished study.
NEEDED = [str(file) for file in rules.all.input]
#: Files that it may also have: for jobs that are yet to run, and of rules that run only if named.
SPARE = [*PRELUDES, *CUTS_MADE, *PARTS, *map(str, workflow.concrete_files)]
SPARE = [file for file in SPARE if Path(file).is_relative_to(RESULTS)]


onerror:
    watched.tell_errors()


onsuccess:
    page = Path(RESULTS, "report.html").resolve()
    if page.exists():
        print(f"Report, to be opened in a browser: {page.as_uri()}", file=sys.stderr)
