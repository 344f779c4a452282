# What becomes of the paper's statements.

#: Groups whose realisations and preludes claims rest on, by part; those of the parts that are
#: simulated upon request count once that has been done.
CLAIM_GROUPS = {
    "": ["flat", "pillars", "small_pillars", "grooves", "angles", "third_level"],
    "beyond/": ["loading"],
    "more/": ["repetitions", "groove_lengths", "one_level"],
}
CLAIM_PARTS = ["", *filter(was_simulated, ["beyond/", "more/"])]
CLAIM_ENSEMBLES = ensembles(
    CLAIM_PARTS[-1], chain.from_iterable(CLAIM_GROUPS[part] for part in CLAIM_PARTS)
)
#: Tables that claims rest on, by the option that takes them.
CLAIM_TABLES = {
    table.replace("_", "-"): [
        file for part in CLAIM_PARTS for file in tables_of(part) if Path(file).stem == table
    ]
    for table in ("realisations", "correlation", "correlation_length")
}
if config["accuracy"]:
    CLAIM_TABLES["precision"] = rules.precision_table.output


rule more:
    input:
        lambda wildcards: tables_of("more/"),
    localrule: True
    message:
        f"{RESULTS}/tables/more is what statements rest on, too, from the next `snakemake` on"


rule claims:
    input:
        *CLAIM_TABLES.values(),
        made_of("steps/claims", "springblock.cli.claims", configuration=CONFIGURATION),
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
        configuration=CONFIGURATION,
        preludes=lambda wildcards, input: " ".join(
            f"--prelude {quote(file)}" for file in input.preludes
        ),
        tables=" ".join(
            f"--{option} {quote(table)}"
            for option, tables in CLAIM_TABLES.items()
            for table in tables
        ),
    message:
        "Testing the paper's statements"
    shell:
        "springblock claims {input.batches:q} {params.tables} {params.preludes} "
        "--configuration {params.configuration} --output {output.table:q} --page {output.page:q} "
        "> {log:q} 2>&1"
