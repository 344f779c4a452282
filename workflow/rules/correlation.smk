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
    resources:
        mem_mb=800,
        runtime=5,
    params:
        code=sources.digest("springblock.commands.correlation"),
    message:
        "Correlating detachment times along the sides of {wildcards.scene}"
    shell:
        "{SPRINGBLOCK} correlation {input} --output-correlation {output.correlation} "
        "--output-length {output.length} > {log} 2>&1"


rule correlations:
    input:
        lambda wildcards: correlations(wildcards.table, ENSEMBLE.values()),
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
        code=sources.digest("springblock.commands.correlation"),
        configuration=sources.configuration_digest(config),
    message:
        "Collecting correlations in one table: {wildcards.table}"
    shell:
        "{SPRINGBLOCK} collect {input} --configuration {params.configuration} "
        "--output {output} > {log} 2>&1"
