# Error against run time, and stability; the programs stand beside the tests that they share.

VALIDATION = f"PYTHONPATH=tests {sys.executable} -m validation"
COMPARISONS = expand(
    f"{RESULTS}/accuracy/{{comparison}}-{{scene}}.parquet",
    comparison=["reference", "paired", "twin"],
    scene=["flat", "pillared", "grooved"],
)

COMPILED = expand(rules.compile.output, integrator=["leapfrog", "rk4"])

#: Digest of all of the package that the comparisons run.
COMPARED = sources.digest(
    *(f"springblock.{module}" for module in ("simulation", "asperities", "pattern", "tables"))
)


rule compare:
    input:
        COMPILED,
        code=multiext("tests/validation/", "work_precision.py", "reference.py", "plain_rk4.py"),
    output:
        f"{RESULTS}/accuracy/{{comparison}}-{{scene}}.parquet",
    log:
        f"{RESULTS}/logs/accuracy/{{comparison}}-{{scene}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy/{{comparison}}-{{scene}}.tsv"
    wildcard_constraints:
        comparison="[a-z]+",
        scene="[a-z]+",
    resources:
        mem_mb=600,
        runtime=20,
    params:
        code=COMPARED,
    message:
        "Measuring errors: {wildcards.comparison}, {wildcards.scene}"
    shell:
        "{VALIDATION}.work_precision compare --comparison {wildcards.comparison} "
        "--scene {wildcards.scene} --output {output} > {log} 2>&1"


rule precision_table:
    input:
        COMPARISONS,
    output:
        f"{RESULTS}/tables/work_precision.parquet",
    log:
        f"{RESULTS}/logs/precision_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/precision_table.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    message:
        "Collecting error against run time in one table"
    shell:
        "{VALIDATION}.work_precision collect {input} --output {output} > {log} 2>&1"


rule stability_table:
    input:
        COMPILED,
        code=["tests/scenes.py", *multiext("tests/validation/", "stability.py", "reference.py")],
    output:
        f"{RESULTS}/tables/stability.parquet",
    log:
        f"{RESULTS}/logs/stability_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/stability_table.tsv"
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=COMPARED,
    message:
        "Trying stiff and extreme cases"
    shell:
        "{VALIDATION}.stability --output {output} > {log} 2>&1"


rule accuracy:
    input:
        rules.precision_table.output,
        rules.stability_table.output,
        rules.aggregate.output,
    output:
        f"{RESULTS}/accuracy.md",
    log:
        f"{RESULTS}/logs/accuracy.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=sources.digest("springblock.commands.accuracy"),
    message:
        "Writing down what to trust"
    shell:
        "{SPRINGBLOCK} accuracy {input} --output {output} > {log} 2>&1"
