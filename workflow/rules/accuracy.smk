# Error against run time, stiff and extreme cases, and the page on both.

from springblock.accuracy.conventions import COMPARISONS, SCENES

COMPILED = expand(rules.compile.output, integrator=["leapfrog", "rk4"])


rule compare:
    input:
        COMPILED,
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
        code=sources.digest("springblock.commands.compare"),
    message:
        "Measuring errors: {wildcards.comparison}, {wildcards.scene}"
    shell:
        "{SPRINGBLOCK} compare --comparison {wildcards.comparison} --scene {wildcards.scene} "
        "--output {output} > {log} 2>&1"


rule precision_table:
    input:
        expand(rules.compare.output, comparison=COMPARISONS, scene=SCENES),
    output:
        f"{RESULTS}/tables/work_precision.parquet",
    log:
        f"{RESULTS}/logs/precision_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/precision_table.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    params:
        code=sources.digest("springblock.commands.correlation"),
    message:
        "Collecting errors and run times in one table"
    shell:
        "{SPRINGBLOCK} collect {input} --output {output} > {log} 2>&1"


rule stability_table:
    input:
        COMPILED,
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
        code=sources.digest("springblock.commands.stability"),
    message:
        "Trying stiff and extreme cases"
    shell:
        "{SPRINGBLOCK} try --output {output} > {log} 2>&1"


rule work_precision:
    input:
        rules.precision_table.output,
    output:
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
        "{SPRINGBLOCK} work_precision {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule stability:
    input:
        rules.stability_table.output,
    output:
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
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("stability"),
    message:
        "Drawing stiff and extreme cases"
    shell:
        "{SPRINGBLOCK} stability {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


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
