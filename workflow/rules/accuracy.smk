# Error against run time, and stability; the programs stand beside the tests that they share.

VALIDATION = f"PYTHONPATH=tests {sys.executable} -m validation"
COMPARISONS = expand(
    f"{RESULTS}/accuracy/{{comparison}}-{{scene}}.parquet",
    comparison=["reference", "paired", "twin"],
    scene=["flat", "pillared", "grooved"],
)

COMPILED = rules.compile.input

#: Digest of all of the package that the comparisons run.
COMPARED = sources.digest(
    *(f"springblock.{module}" for module in ("realisation", "asperities", "pattern", "tables"))
)


rule compare_scene:
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


rule compare:
    input:
        COMPARISONS,
    localrule: True
    message:
        "All errors are measured"


rule work_precision:
    input:
        COMPARISONS,
    output:
        table=f"{RESULTS}/tables/work_precision.parquet",
        pdf=f"{RESULTS}/figures/work_precision.pdf",
        png=report(
            f"{RESULTS}/figures/work_precision.png",
            caption="../report/work_precision.rst",
            category="Accuracy",
            labels={"figure": "work_precision", "shows": "Error against run time"},
        ),
    log:
        f"{RESULTS}/logs/work_precision.log",
    benchmark:
        f"{RESULTS}/benchmarks/work_precision.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("work_precision"),
    message:
        "Drawing error against run time"
    shell:
        "({VALIDATION}.work_precision collect {input} --output {output.table} && "
        "springblock work_precision {output.table} --output {output.pdf} --output {output.png}"
        ") > {log} 2>&1"


rule stability:
    input:
        COMPILED,
        code=["tests/scenes.py", *multiext("tests/validation/", "stability.py", "reference.py")],
    output:
        table=f"{RESULTS}/tables/stability.parquet",
        pdf=f"{RESULTS}/figures/stability.pdf",
        png=report(
            f"{RESULTS}/figures/stability.png",
            caption="../report/stability.rst",
            category="Accuracy",
            labels={"figure": "stability", "shows": "Stiff and extreme cases"},
        ),
    log:
        f"{RESULTS}/logs/stability.log",
    benchmark:
        f"{RESULTS}/benchmarks/stability.tsv"
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=[COMPARED, figure_code("stability")],
    message:
        "Trying stiff and extreme cases"
    shell:
        "({VALIDATION}.stability --output {output.table} && "
        "springblock stability {output.table} --output {output.pdf} --output {output.png}"
        ") > {log} 2>&1"


rule accuracy:
    input:
        rules.work_precision.output.table,
        rules.stability.output.table,
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
        "springblock accuracy {input} --output {output} > {log} 2>&1"
