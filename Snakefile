# Slip precursors and topological length scales at the onset of frictional sliding:
# from a grid of surfaces to realisations, tables and figures.

from snakemake.utils import min_version

min_version("9.20")


# `config` already holds the keys that the user gives, which override those of this file.
configfile: "config/own.yaml" if config.get("study") == "own" else "config/config.yaml"


# Container of all rules with `--software-deployment-method apptainer`; container/springblock.def builds it.
container: "container/springblock.sif"


include: "workflow/rules/common.smk"
include: "workflow/rules/drawn.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/correlation.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/mechanism.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


onstart:
    begin()


rule all:
    default_target: True
    input:
        rules.aggregate.output,
        rules.fields.input,
        rules.correlations.input,
        rules.means.output if OWN else rules.claims.output,
        rules.figures.input,
        rules.report.output,
        rules.accuracy.output if config["accuracy"] else [],
        rules.reference_solutions.output if config["accuracy"] and config["verification"] else [],
        rules.mechanism.output if config["mechanism"] else [],
        rules.beyond.output if GROUPS_BEYOND else [],
    localrule: True
    message:
        f"The study is complete; its tables and figures are in {RESULTS}"


onerror:
    tell_errors()


onsuccess:
    page = Path(RESULTS, "report.html").resolve()
    if page.exists():
        print(f"Report, to be opened in a browser: {page.as_uri()}", file=sys.stderr)
