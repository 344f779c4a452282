# Error against run time, stiff and extreme cases, and the page on both.

from springblock.accuracy import conventions

COMPILED = rules.compile.input


rule compare_scene:
    input:
        COMPILED,
        made_of("steps/compare_scene", "springblock.cli.measure"),
    output:
        f"{RESULTS}/accuracy/{{comparison}}-{{scene}}.parquet",
    log:
        f"{RESULTS}/logs/accuracy/{{comparison}}-{{scene}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy/{{comparison}}-{{scene}}.tsv"
    wildcard_constraints:
        comparison="[a-z]+",
        scene="[a-z]+",
    # The longest jobs begin first, lest one of them ends alone.
    priority: 1
    resources:
        mem_mb=600,
        runtime=20,
    message:
        "Measuring errors: {wildcards.comparison}, {wildcards.scene}"
    shell:
        "springblock measure --comparison {wildcards.comparison} --scene {wildcards.scene} "
        "--output {output:q} > {log:q} 2>&1"


rule compare:
    input:
        expand(
            rules.compare_scene.output,
            comparison=conventions.COMPARISONS,
            scene=conventions.SCENES,
        ),
    localrule: True
    message:
        "All errors are measured"


rule precision_table:
    input:
        made_of("steps/precision_table", "springblock.cli.collect"),
        tables=rules.compare.input,
    output:
        f"{RESULTS}/tables/work_precision.parquet",
    log:
        f"{RESULTS}/logs/precision_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/precision_table.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    message:
        "Collecting errors and run times in one table"
    shell:
        "springblock collect {input.tables:q} --output {output:q} > {log:q} 2>&1"


rule production_scene:
    input:
        COMPILED,
        made_of("steps/production_scene", "springblock.cli.production"),
    output:
        f"{RESULTS}/accuracy/production/{{scene}}.parquet",
    log:
        f"{RESULTS}/logs/accuracy/production/{{scene}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy/production/{{scene}}.tsv"
    wildcard_constraints:
        scene="|".join(conventions.SCENES),
    resources:
        mem_mb=800,
        runtime=30,
    message:
        "Measuring errors of ensembles at full size: {wildcards.scene}"
    shell:
        "springblock production --scene {wildcards.scene} --output {output:q} > {log:q} 2>&1"


rule production_table:
    input:
        made_of("steps/production_table", "springblock.cli.collect"),
        tables=expand(rules.production_scene.output, scene=conventions.SCENES),
    output:
        f"{RESULTS}/tables/production.parquet",
    log:
        f"{RESULTS}/logs/production_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/production_table.tsv"
    resources:
        mem_mb=400,
        runtime=5,
    message:
        "Collecting errors at full size in one table"
    shell:
        "springblock collect {input.tables:q} --output {output:q} > {log:q} 2>&1"


rule production:
    input:
        rules.production_table.output,
        expand(
            f"{RESULTS}/figures/{{figure}}.{{suffix}}",
            figure=[name for name, figure in FIGURES.items() if figure.upon_request],
            suffix=["pdf", "png"],
        ),
    localrule: True
    message:
        "Errors at full size are measured and drawn"


rule stability_table:
    input:
        COMPILED,
        made_of("steps/stability_table", "springblock.cli.stability"),
    output:
        f"{RESULTS}/tables/stability.parquet",
    log:
        f"{RESULTS}/logs/stability_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/stability_table.tsv"
    resources:
        mem_mb=1000,
        runtime=10,
    message:
        "Trying stiff and extreme cases"
    shell:
        "springblock try --output {output:q} > {log:q} 2>&1"


#: The table of errors at full size belongs to the page once it is there.
AT_FULL_SIZE = [table for table in rules.production_table.output if Path(table).exists()]


rule accuracy:
    input:
        made_of("steps/accuracy", "springblock.cli.accuracy"),
        tables=[
            rules.precision_table.output,
            rules.stability_table.output,
            rules.aggregate.input,
        ],
        production=AT_FULL_SIZE,
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
        production="--production" if AT_FULL_SIZE else "",
    message:
        "Writing down what to trust"
    shell:
        "springblock accuracy {input.tables:q} {params.production} {input.production:q} "
        "--output {output:q} > {log:q} 2>&1"
