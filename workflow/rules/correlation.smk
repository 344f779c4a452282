# Correlations of detachment times along the sides of pillars, scene by scene and in two tables.

#: Scenes whose pillars have sides, with the several realisations that c(r) needs.
WITH_SIDES = [
    each.scene.folder
    for each in ENSEMBLE.values()
    if not OWN and each.scene.sides and len(each.seeds) > 1
]


rule correlation:
    input:
        lambda wildcards: batches([ENSEMBLE[wildcards.scene]]),
    output:
        correlation=f"{RESULTS}/correlations/{{scene}}/correlation.parquet",
        length=f"{RESULTS}/correlations/{{scene}}/correlation_length.parquet",
    log:
        f"{RESULTS}/logs/{{scene}}/correlation.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/correlation.tsv"
    group:
        "correlations"
    resources:
        mem_mb=2000,
        runtime=5,
    params:
        code=code("analyse"),
    message:
        "Correlating detachment times along the sides of {wildcards.scene}"
    shell:
        "springblock --code {params.code} correlation {input:q} "
        "--output-correlation {output.correlation:q} --output-length {output.length:q} "
        "> {log:q} 2>&1"


rule correlations_table:
    input:
        lambda wildcards: [
            f"{RESULTS}/correlations/{scene}/{wildcards.table}.parquet" for scene in WITH_SIDES
        ],
    output:
        f"{RESULTS}/tables/{{table}}.parquet",
    log:
        f"{RESULTS}/logs/{{table}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{table}}.tsv"
    wildcard_constraints:
        table="correlation|correlation_length",
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("analyse"),
        configuration=CONFIGURATION,
    message:
        "Collecting correlations in one table: {wildcards.table}"
    shell:
        "springblock --code {params.code} make collect {input:q} --configuration {params.configuration} "
        "--output {output:q} > {log:q} 2>&1"


rule correlations:
    input:
        expand(
            rules.correlations_table.output,
            table=["correlation", "correlation_length"] if WITH_SIDES else [],
        ),
    localrule: True
    message:
        "All correlations are in two tables"
