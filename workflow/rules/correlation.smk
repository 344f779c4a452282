rule correlation_scene:
    input:
        made_of("steps/correlation", "springblock.cli.correlation"),
        batches=lambda wildcards: batches([ENSEMBLE[wildcards.part][wildcards.scene]]),
    output:
        correlation=f"{RESULTS}/correlations/{{part}}{{scene}}/correlation.parquet",
        length=f"{RESULTS}/correlations/{{part}}{{scene}}/correlation_length.parquet",
    log:
        f"{RESULTS}/logs/{{part}}{{scene}}/correlation.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{part}}{{scene}}/correlation.tsv"
    group:
        "correlations"
    resources:
        mem_mb=1200,
        runtime=5,
    message:
        "Correlating detachment times along the sides of {wildcards.part}{wildcards.scene}"
    shell:
        "springblock correlation {input.batches:q} --output-correlation {output.correlation:q} "
        "--output-length {output.length:q} > {log:q} 2>&1"


rule correlation:
    input:
        [correlations(table, "") for table in ("correlation", "correlation_length")],
    localrule: True
    message:
        "Detachment times are correlated wherever pillars have sides"


rule correlations_table:
    input:
        made_of("steps/correlations", "springblock.io.parquet", configuration=CONFIGURATION),
        tables=lambda wildcards: correlations(wildcards.table, wildcards.part),
    output:
        f"{RESULTS}/tables/{{part}}{{table}}.parquet",
    log:
        f"{RESULTS}/logs/{{part}}{{table}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{part}}{{table}}.tsv"
    wildcard_constraints:
        table="correlation|correlation_length",
    resources:
        mem_mb=400,
        runtime=5,
    params:
        configuration=CONFIGURATION,
    message:
        "Collecting correlations in one table: {wildcards.part}{wildcards.table}"
    shell:
        "springblock make collect {input.tables:q} --configuration {params.configuration} "
        "--output {output:q} > {log:q} 2>&1"


rule correlations:
    input:
        CORRELATIONS,
    localrule: True
    message:
        "All correlations are in two tables"
