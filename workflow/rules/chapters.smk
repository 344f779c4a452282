# Numerical errors, simpler models, the continuum limit, and verdicts on the paper's statements.


rule part:
    """Measure errors, or compare models with the simulation, on one surface."""
    input:
        rules.compiled.input,
    output:
        f"{RESULTS}/parts/{{part}}.parquet",
    log:
        f"{RESULTS}/logs/parts/{{part}}.log",
    priority: 1  # the longest jobs begin first, so that none of them is left alone at the end
    params:
        code=lambda wildcards: digest(PLANNED.step(wildcards.part)),
        ensembles=lambda wildcards: PLANNED.sampled(wildcards.part),
    shell:
        "springblock make {wildcards.part} {params.ensembles} --output {output:q} > {log:q} 2>&1"


rule parts:
    """Make the parts of all tables."""
    input:
        expand(rules.part.output, part=sum(PLANNED.measured.values(), [])),
    localrule: True


for table, parts in PLANNED.measured.items():

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
            code=code(PLANNED.step(table)),
        shell:
            "springblock make collect {input:q} --output {output:q} > {log:q} 2>&1"


if PLANNED.groups.get("sensitivities"):

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


if not PLANNED.own:

    rule claims_table:
        """Test the paper's statements."""
        input:
            batches=PLANNED.batches(PLANNED.claimed),
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


for page, tables in PLANNED.pages.items():

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
        expand(f"{RESULTS}/{{page}}.md", page=PLANNED.pages),
        expand(f"{RESULTS}/tables/{{table}}.parquet", table=PLANNED.held),
        [] if PLANNED.own else rules.claims_table.output,
        rules.sensitivities_table.output if PLANNED.groups.get("sensitivities") else [],
    localrule: True
