# Why friction depends on the size of pillars: simpler models beside the simulation.

from springblock.mechanism.surfaces import TABLES


rule mechanism_part:
    """Compare simpler models with the simulation."""
    input:
        rules.compile.output,
    output:
        f"{RESULTS}/mechanism/{{part}}.parquet",
    log:
        f"{RESULTS}/logs/mechanism/{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/mechanism/{{part}}.tsv"
    wildcard_constraints:
        part="|".join(chain.from_iterable(TABLES.values())),
    resources:
        mem_mb=500,
        runtime=15,
    params:
        code=code("mechanism"),
        table="mechanism",
    message:
        "Comparing simpler models with the simulation: {wildcards.part}"
    shell:
        "springblock --code {params.code} make {params.table}-{wildcards.part} --output {output:q} "
        "> {log:q} 2>&1"


#: Tables of all parts.
PARTS = expand(rules.mechanism_part.output, part=chain.from_iterable(TABLES.values()))


use rule precision_table as mechanism_table with:
    """Collect results of simpler models."""
    input:
        lambda here: expand(rules.mechanism_part.output, part=TABLES[here.table]),
    output:
        f"{RESULTS}/tables/{{table}}.parquet",
    log:
        f"{RESULTS}/logs/{{table}}_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{table}}_table.tsv"
    wildcard_constraints:
        table="|".join(TABLES),
    params:
        code=code("mechanism"),
    message:
        "Collecting results of simpler models: {wildcards.table}"


#: Tables that the study has, and those of their parts.
MODELLED = {"sizes": ["mechanism"], "all": [*TABLES]}.get(config["mechanism"], [])
MODELS = expand(rules.mechanism_table.output, table=MODELLED)
MODEL_PARTS = expand(
    rules.mechanism_part.output, part=chain.from_iterable(TABLES[table] for table in MODELLED)
)


rule sensitivities_table:
    """Collect what friction and load peaks depend on."""
    input:
        batches(ensembles(["sensitivities"])),
    output:
        f"{RESULTS}/tables/sensitivities.parquet",
    log:
        f"{RESULTS}/logs/sensitivities_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/sensitivities_table.tsv"
    resources:
        mem_mb=3000,
        runtime=5,
    params:
        code=code("mechanism"),
        configuration=CONFIGURATION,
    message:
        "Collecting what friction and load peaks depend on"
    shell:
        "springblock --code {params.code} make sensitivities {input:q} "
        "--configuration {params.configuration} --output {output:q} > {log:q} 2>&1"


rule mechanism:
    """Explain the lowest friction and two load peaks."""
    input:
        expand(rules.mechanism_table.output, table=TABLES),
        rules.sensitivities_table.output,
    output:
        f"{RESULTS}/mechanism.md",
    log:
        f"{RESULTS}/logs/mechanism.log",
    benchmark:
        f"{RESULTS}/benchmarks/mechanism.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("mechanism.md"),
    message:
        "Explaining the lowest friction"
    shell:
        "springblock --code {params.code} make mechanism {input:q} --output {output:q} > {log:q} 2>&1"


#: The table of sensitivities and the page, if the study has their groups and tables.
SENSITIVE = rules.sensitivities_table.output if ENSEMBLES.get("sensitivities") else []
EXPLAINED = rules.mechanism.output if SENSITIVE and config["mechanism"] == "all" else []
