# Numerical errors, stiff and extreme cases, and the page on both.

from springblock.accuracy import conventions


rule compare_scene:
    """Measure errors of single runs and of ensembles."""
    input:
        rules.compile.output,
    output:
        f"{RESULTS}/accuracy/{{comparison}}-{{scene}}.parquet",
    log:
        f"{RESULTS}/logs/accuracy/{{comparison}}-{{scene}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy/{{comparison}}-{{scene}}.tsv"
    wildcard_constraints:
        comparison="[a-z]+",
        scene="[a-z]+",
    # The longest jobs begin first, so that none of them is left alone at the end.
    priority: 1
    resources:
        mem_mb=800,
        runtime=30,
    params:
        code=code("accuracy"),
        ensembles=lambda here: (
            f"--seeds {config['production'][here.scene]} "
            f"--finest-step {config['production']['finest_step']}"
            if here.comparison == "production"
            else ""
        ),
    message:
        "Measuring errors: {wildcards.comparison}, {wildcards.scene}"
    shell:
        "springblock --code {params.code} make {wildcards.comparison}-{wildcards.scene} "
        "{params.ensembles} --output {output:q} > {log:q} 2>&1"


rule precision_table:
    """Collect errors in one table."""
    input:
        expand(
            rules.compare_scene.output,
            comparison=["reference", "paired"] if config["verification"] else ["reference"],
            scene=conventions.SCENES,
        ),
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
        code=code("accuracy"),
    message:
        "Collecting errors in one table"
    shell:
        "springblock --code {params.code} make collect {input:q} --output {output:q} > {log:q} 2>&1"


use rule precision_table as production_table with:
    """Collect errors with N = 120 in one table."""
    input:
        expand(rules.compare_scene.output, comparison="production", scene=conventions.SCENES),
    output:
        f"{RESULTS}/tables/production.parquet",
    log:
        f"{RESULTS}/logs/production_table.log",
    benchmark:
        f"{RESULTS}/benchmarks/production_table.tsv"
    message:
        "Collecting errors with N = 120 in one table"


rule stability_table:
    """Run stiff and extreme cases."""
    input:
        rules.compile.output,
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
        code=code("accuracy"),
    message:
        "Running stiff and extreme cases"
    shell:
        "springblock --code {params.code} make stability --output {output:q} > {log:q} 2>&1"


rule accuracy:
    """Write the page on errors."""
    input:
        rules.precision_table.output,
        rules.stability_table.output,
        rules.aggregate.output,
        rules.production_table.output,
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
        code=code("accuracy.md"),
    message:
        "Writing the page on errors"
    shell:
        "springblock --code {params.code} make accuracy {input:q} --output {output:q} > {log:q} 2>&1"
