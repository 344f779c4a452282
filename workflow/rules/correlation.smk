# Correlations of detachment times along the sides of pillars, scene by scene and in two tables.

#: Scenes whose pillars have sides, with the several realisations that c(r) needs.
WITH_SIDES = [
    each.scene.folder
    for each in ensembles(group for group in ENSEMBLES if group != "sensitivities")
    if not OWN and each.scene.sides and len(each.seeds) > 1
]
#: Tables of correlations, and those of each scene.
CORRELATIONS = ["correlation", "correlation_length"]
CORRELATED = [
    f"{RESULTS}/correlations/{scene}/{table}.parquet"
    for scene in WITH_SIDES
    for table in CORRELATIONS
]


if WITH_SIDES:

    rule correlation:
        """Correlate detachment times along the sides of pillars, scene by scene."""
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
        """Collect the correlations of all scenes."""
        input:
            lambda wildcards: [file for file in CORRELATED if Path(file).stem == wildcards.table],
        output:
            f"{RESULTS}/tables/{{table}}.parquet",
        log:
            f"{RESULTS}/logs/{{table}}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{{table}}.tsv"
        wildcard_constraints:
            table="|".join(CORRELATIONS),
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
    """Make all tables of correlations."""
    input:
        [f"{RESULTS}/tables/{table}.parquet" for table in CORRELATIONS if WITH_SIDES],
    localrule: True
    message:
        "All correlations are in two tables"
