# Why friction depends on the size of pillars: simpler models beside the simulation.

from springblock.mechanism import SIZES


rule mechanism_size:
    input:
        rules.compile.output,
    output:
        f"{RESULTS}/mechanism/{{n_p}}.parquet",
    log:
        f"{RESULTS}/logs/mechanism/{{n_p}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/mechanism/{{n_p}}.tsv"
    wildcard_constraints:
        n_p=r"\d+",
    resources:
        mem_mb=800,
        runtime=5,
    params:
        code=code("mechanism"),
    message:
        "Comparing models of the onset of sliding: n_p = {wildcards.n_p}"
    shell:
        "springblock --code {params.code} make mechanism-{wildcards.n_p} --output {output:q} "
        "> {log:q} 2>&1"


rule mechanism_table:
    input:
        expand(rules.mechanism_size.output, n_p=SIZES),
    output:
        f"{RESULTS}/tables/mechanism.parquet",
    log:
        f"{RESULTS}/logs/mechanism_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/mechanism_table.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("mechanism"),
    message:
        "Collecting models of the onset of sliding in one table"
    shell:
        "springblock --code {params.code} make collect {input:q} --output {output:q} > {log:q} 2>&1"


rule mechanism:
    input:
        rules.mechanism_table.output,
    output:
        f"{RESULTS}/mechanism.md",
    log:
        f"{RESULTS}/logs/mechanism.log",
    benchmark:
        f"{RESULTS}/benchmarks/mechanism.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=code("mechanism"),
    message:
        "Explaining the lowest friction"
    shell:
        "springblock --code {params.code} make mechanism {input:q} --output {output:q} "
        "> {log:q} 2>&1"
