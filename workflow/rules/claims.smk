# Verdicts on the paper's statements, and questions beyond the paper.

#: Groups whose realisations test the statements.
GROUPS_CLAIMED = ["flat", "pillars", "small_pillars", "grooves", "angles", "third_level"]
GROUPS_CLAIMED += ["loading", "scatter", "repetitions", "groove_lengths", "one_level"]
GROUPS_CLAIMED += ["square", "ungrooved"]


rule claims:
    """Test the paper's statements."""
    input:
        batches=batches(ensembles(GROUPS_CLAIMED)),
        correlations=[
            f"{RESULTS}/correlations/{ensemble.scene.folder}/{table}.parquet"
            for ensemble in ensembles(GROUPS_CLAIMED)
            if ensemble.scene.folder in WITH_SIDES and not ensemble.scene.varied
            for table in ("correlation", "correlation_length")
        ],
        precision=rules.precision_table.output if config["accuracy"] else [],
    output:
        table=f"{RESULTS}/tables/claims.parquet",
        page=f"{RESULTS}/claims.md",
    log:
        f"{RESULTS}/logs/claims.log",
    benchmark:
        f"{RESULTS}/benchmarks/claims.tsv"
    resources:
        mem_mb=6000,
        runtime=10,
    params:
        code=code("claims"),
        configuration=CONFIGURATION,
        tables=lambda wildcards, input: " ".join(
            f"--{Path(table).stem.replace('_', '-')} {quote(table)}"
            for table in chain(input.correlations, input.precision)
        ),
    message:
        "Testing the paper's statements"
    shell:
        "springblock --code {params.code} claims {input.batches:q} {params.tables} "
        "--configuration {params.configuration} --output {output.table:q} "
        "--page {output.page:q} > {log:q} 2>&1"


use rule accuracy as beyond with:
    """Answer questions beyond the paper."""
    input:
        batches(ensembles([*GROUPS_CLAIMED, *GROUPS_BEYOND])),
    output:
        f"{RESULTS}/beyond.md",
    log:
        f"{RESULTS}/logs/beyond.log",
    benchmark:
        f"{RESULTS}/benchmarks/beyond.tsv"
    resources:
        mem_mb=5000,
        runtime=10,
    params:
        code=code("beyond"),
        page="beyond",
    message:
        "Answering questions beyond the paper"
