# Slip precursors and topological length scales at the onset of frictional sliding:
# from a grid of surfaces to realisations, tables and figures.

from snakemake.utils import min_version

min_version("9.3")


configfile: "config/config.yaml"


# What rules run, for `--software-deployment-method apptainer`; container/springblock.def says how to build it.
container: "container/springblock.sif"


include: "workflow/rules/common.smk"
include: "workflow/rules/drawn.smk"
include: "workflow/rules/running.smk"
include: "workflow/rules/simulate.smk"
include: "workflow/rules/correlation.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/beyond.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/origins.smk"


onstart:
    refuse_orphans()
    # Without a limit on jobs per second: Snakemake would look for free places once a second for each job
    # that has ended, and after some hundred short ones do little else.
    workflow.scheduler.job_rate_limiter = None


rule all:
    default_target: True
    input:
        rules.aggregate.input,
        CORRELATIONS,
        rules.claims.output,
        expand(
            f"{RESULTS}/figures/{{figure}}.{{suffix}}",
            figure=[*filter(is_part_of_all, FIGURES), *sweeps("")],
            suffix=["pdf", "png"],
        ),
        rules.accuracy.output if config["accuracy"] else [],
        rules.report.output,
    localrule: True
    message:
        f"The study is complete; its tables and figures are in {RESULTS}"


onsuccess:
    from springblock.study import audit

    audit.write_manifest(Path(RESULTS), config, Path(workflow.basedir, "environment.lock"))
    page = Path(RESULTS, "report.html").resolve()
    if page.exists():
        print(
            f"The study's report, to be opened in a browser: {page.as_uri()}", file=sys.stderr
        )
