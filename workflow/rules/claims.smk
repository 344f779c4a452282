# Verdicts on the paper's statements.

#: Groups whose realisations test the statements.
GROUPS_CLAIMED = ["flat", "pillars", "small_pillars", "grooves", "angles", "third_level"]
GROUPS_CLAIMED += ["loading", "scatter", "repetitions", "groove_lengths", "one_level"]
GROUPS_CLAIMED += ["square", "ungrooved"]


rule claims_table:
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
        f"{RESULTS}/tables/claims.parquet",
    log:
        f"{RESULTS}/logs/claims_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/claims_table.tsv"
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
        "--configuration {params.configuration} --output {output:q} > {log:q} 2>&1"


rule claims:
    """Write the page on the paper's statements."""
    input:
        rules.claims_table.output,
    output:
        f"{RESULTS}/claims.md",
    log:
        f"{RESULTS}/logs/claims.log",
    benchmark:
        f"{RESULTS}/benchmarks/claims.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("claims.md"),
    message:
        "Writing the page on the paper's statements"
    shell:
        "springblock --code {params.code} make claims {input:q} --output {output:q} > {log:q} 2>&1"
