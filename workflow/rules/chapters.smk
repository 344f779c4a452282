# Numerical errors, simpler models, the continuum limit, and verdicts on the paper's statements.

from springblock.accuracy.conventions import SCENES
from springblock.continuum import PARTS as CELLS
from springblock.mechanism.surfaces import TABLES

#: Parts of tables that need no realisations of the study, and the step whose code makes them.
MEASURED = {
    "work_precision": ("accuracy", [f"reference-{scene}" for scene in SCENES]),
    "production": ("accuracy", [f"production-{scene}" for scene in SCENES]),
    "stability": ("accuracy", ["stability"]),
    **{table: ("mechanism", [f"mechanism-{part}" for part in TABLES[table]]) for table in TABLES},
    "continuum": ("continuum", [f"continuum-{part}" for part in CELLS]),
}
if config["verification"]:
    MEASURED["work_precision"][1].extend(f"paired-{scene}" for scene in SCENES)
STEP = {part: step for step, parts in MEASURED.values() for part in parts}
#: Tables that the study has: of errors, and of models with the paper's damping or also strong damping.
HELD = ["work_precision", "production", "stability"] if config["accuracy"] else []
HELD += {"sizes": ["mechanism"], "all": [*TABLES, "continuum"]}.get(config["mechanism"], [])
#: Pages, and the tables that they are written from.
PAGES = {"claims": ["claims"]} if not PLANNED.own else {}
if config["accuracy"]:
    PAGES["accuracy"] = ["work_precision", "stability", "realisations", "production"]
if config["mechanism"] == "all":
    PAGES["continuum"] = ["continuum"]
    if PLANNED.groups.get("sensitivities"):
        PAGES["mechanism"] = [*TABLES, "sensitivities"]
#: Groups whose realisations test the statements.
CLAIMED = ["flat", "pillars", "small_pillars", "grooves", "angles", "third_level", "loading"]
CLAIMED += ["scatter", "repetitions", "groove_lengths", "one_level", "square", "ungrooved"]


def ensembles(wildcards):
    """Seeds and finest step of ensembles that measure errors, as options."""
    kind, _, scene = wildcards.part.partition("-")
    given = config["production"]
    return (
        f"--seeds {given[scene]} --finest-step {given['finest_step']}" if kind == "production" else ""
    )


rule part:
    """Measure errors, or compare models with the simulation, on one surface."""
    input:
        rules.compile.output,
    output:
        f"{RESULTS}/parts/{{part}}.parquet",
    log:
        f"{RESULTS}/logs/parts/{{part}}.log",
    priority: 1 # the longest jobs begin first, so that none of them is left alone at the end
    resources:
        runtime=30,
    params:
        code=lambda wildcards: digest(STEP[wildcards.part]),
        ensembles=ensembles,
    shell:
        "springblock make {wildcards.part} {params.ensembles} --output {output:q} > {log:q} 2>&1"


for table, (step, parts) in MEASURED.items():

    rule:
        """Collect the parts of this table."""
        name:
            f"{table}_table"
        input:
            expand(rules.part.output, part=parts),
        output:
            f"{RESULTS}/tables/{table}.parquet",
        log:
            f"{RESULTS}/logs/{table}_table.log",
        params:
            code=code(step),
        shell:
            "springblock make collect {input:q} --output {output:q} > {log:q} 2>&1"


rule measured:
    """Make all tables that need no realisations."""
    input:
        expand(f"{RESULTS}/tables/{{table}}.parquet", table=HELD),
    localrule: True


rule sensitivities_table:
    """Collect what friction and load peaks depend on."""
    input:
        PLANNED.batches(PLANNED.members(["sensitivities"])),
    output:
        f"{RESULTS}/tables/sensitivities.parquet",
    log:
        f"{RESULTS}/logs/sensitivities_table.log",
    resources:
        mem_mb=3000,
    params:
        code=code("mechanism"),
    shell:
        "springblock make sensitivities {input:q} --output {output:q} > {log:q} 2>&1"


SENSITIVE = rules.sensitivities_table.output if PLANNED.groups.get("sensitivities") else []


rule claims_table:
    """Test the paper's statements."""
    input:
        batches=PLANNED.batches(PLANNED.members(CLAIMED)),
        correlations=CORRELATIONS,
        errors=f"{RESULTS}/tables/work_precision.parquet" if config["accuracy"] else [],
    output:
        f"{RESULTS}/tables/claims.parquet",
    log:
        f"{RESULTS}/logs/claims_table.log",
    resources:
        mem_mb=6000,
    params:
        code=code("claims"),
        tables=lambda wildcards, input: " ".join(
            f"--{Path(table).stem.replace('_', '-')} {quote(table)}"
            for table in input[len(input.batches) :]
        ),
    shell:
        "springblock claims {input.batches:q} {params.tables} --output {output:q} > {log:q} 2>&1"


for page, tables in PAGES.items():

    rule:
        """Write this page."""
        name:
            page
        input:
            expand(f"{RESULTS}/tables/{{table}}.parquet", table=tables),
        output:
            f"{RESULTS}/{page}.md",
        log:
            f"{RESULTS}/logs/{page}.log",
        params:
            code=code(f"{page}.md"),
            page=page,
        shell:
            "springblock make {params.page} {input:q} --output {output:q} > {log:q} 2>&1"


rule pages:
    """Write all pages, and the tables of their chapters."""
    input:
        expand(f"{RESULTS}/{{page}}.md", page=PAGES),
        rules.measured.input,
        [] if PLANNED.own else rules.claims_table.output,
        SENSITIVE,
    localrule: True
