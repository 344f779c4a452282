# What becomes of the paper's statements.

#: Tables that statements rest on beside the realisations, by the option that takes them.
CLAIM_TABLES = {
    "correlation": f"{RESULTS}/tables/correlation.parquet",
    "correlation-length": f"{RESULTS}/tables/correlation_length.parquet",
} | ({"precision": rules.work_precision.output.table} if config["accuracy"] else {})


rule claims:
    input:
        *CLAIM_TABLES.values(),
        table=rules.aggregate.output,
        batches=realisations(
            *(
                group
                for group in ("flat", "pillars", "grooves", "third_level")
                if group in ENSEMBLES
            )
        ),
    output:
        table=f"{RESULTS}/tables/claims.parquet",
        page=f"{RESULTS}/claims.md",
    log:
        f"{RESULTS}/logs/claims.log",
    benchmark:
        f"{RESULTS}/benchmarks/claims.tsv"
    resources:
        mem_mb=1500,
        runtime=10,
    params:
        code=sources.digest("springblock.commands.claims"),
        configuration=study.configuration_digest(config),
        tables=" ".join(f"--{option} {table}" for option, table in CLAIM_TABLES.items()),
    message:
        "Testing the paper's statements"
    shell:
        "{SPRINGBLOCK} claims {input.batches} --realisations {input.table} {params.tables} "
        "--configuration {params.configuration} --output {output.table} --page {output.page} "
        "> {log} 2>&1"
