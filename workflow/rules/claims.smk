# What becomes of the paper's statements.

#: Tables that claims rest on beside the realisations, by the option that takes them.
CLAIM_TABLES = dict(zip(("correlation", "correlation-length"), CORRELATIONS, strict=True))
if config["accuracy"]:
    CLAIM_TABLES["precision"] = rules.precision_table.output[0]
#: Groups whose realisations and preludes claims rest on.
CLAIM_GROUPS = ("flat", "loading", "pillars", "small_pillars", "grooves", "groove_lengths")
CLAIM_GROUPS += ("angles", "third_level", "one_level")
CLAIM_ENSEMBLES = list(
    dict.fromkeys(ensemble for group in CLAIM_GROUPS for ensemble in ENSEMBLES.get(group, []))
)


rule claims:
    input:
        *CLAIM_TABLES.values(),
        table=rules.aggregate.input,
        batches=batches(CLAIM_ENSEMBLES),
        preludes=[
            f"{RESULTS}/preludes/{ensemble.scene.folder}.npz"
            for ensemble in CLAIM_ENSEMBLES
            if not ensemble.scene.varied
        ],
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
        configuration=sources.configuration_digest(config),
        preludes=lambda wildcards, input: " ".join(
            f"--prelude {quote(file)}" for file in input.preludes
        ),
        tables=" ".join(f"--{option} {quote(table)}" for option, table in CLAIM_TABLES.items()),
    message:
        "Testing the paper's statements"
    shell:
        "springblock claims {input.batches:q} --realisations {input.table:q} "
        "{params.tables} {params.preludes} "
        "--configuration {params.configuration} --output {output.table:q} --page {output.page:q} "
        "> {log:q} 2>&1"
