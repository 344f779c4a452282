# The continuum limit: unit cells of one pillar or stripe beside their theory.

from springblock.continuum import PARTS as CELLS


use rule mechanism_part as continuum_part with:
    """Simulate unit cells beside their theory."""
    output:
        f"{RESULTS}/continuum/{{part}}.parquet",
    log:
        f"{RESULTS}/logs/continuum/{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/continuum/{{part}}.tsv"
    wildcard_constraints:
        part="|".join(CELLS),
    params:
        code=code("continuum"),
        table="continuum",
    message:
        "Simulating unit cells beside their theory: {wildcards.part}"


use rule precision_table as continuum_table with:
    """Collect unit cells in one table."""
    input:
        expand(rules.continuum_part.output, part=CELLS),
    output:
        f"{RESULTS}/tables/continuum.parquet",
    log:
        f"{RESULTS}/logs/continuum_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/continuum_table.tsv"
    params:
        code=code("continuum"),
    message:
        "Collecting unit cells in one table"


rule continuum:
    """Write the page on the continuum limit."""
    input:
        rules.continuum_table.output,
    output:
        f"{RESULTS}/continuum.md",
    log:
        f"{RESULTS}/logs/continuum.log",
    benchmark:
        f"{RESULTS}/benchmarks/continuum.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("continuum.md"),
    message:
        "Writing the page on the continuum limit"
    shell:
        "springblock --code {params.code} make continuum {input:q} --output {output:q} > {log:q} 2>&1"


#: Files of this chapter, which belongs to the whole study.
CONTINUUM = [
    *rules.continuum_table.input,
    *rules.continuum_table.output,
    *rules.continuum.output,
]
CONTINUUM = CONTINUUM if config["mechanism"] == "all" else []
