def duration(wildcards):
    seconds = ENSEMBLE[wildcards.scene].duration
    return "" if seconds is None else f"--duration {seconds}"


rule compile:
    output:
        touch(f"{RESULTS}/realisations/.compiled"),
    log:
        f"{RESULTS}/logs/compile.log",
    benchmark:
        f"{RESULTS}/benchmarks/compile.tsv"
    resources:
        mem_mb=600,
        runtime=5,
    params:
        code=sources.digest("springblock.solver"),
    message:
        "Compiling the solver"
    shell:
        "{SPRINGBLOCK} compile > {log} 2>&1"


rule simulate:
    input:
        ancient(rules.compile.output),
    output:
        f"{RESULTS}/realisations/{{scene}}/seeds={{first}}-{{last}}.parquet",
    log:
        f"{RESULTS}/logs/{{scene}}/seeds={{first}}-{{last}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/seeds={{first}}-{{last}}.tsv"
    wildcard_constraints:
        scene="|".join(ENSEMBLE),
        first=r"\d+",
        last=r"\d+",
    resources:
        mem_mb=400,
        runtime=30,
    params:
        code=sources.digest("springblock.commands.simulate"),
        scene=lambda wildcards: ENSEMBLE[wildcards.scene].scene.arguments,
        integrator=config["integrator"],
        step=config["step"],
        sample_interval=config["sample_interval"],
        duration=duration,
        material=" ".join(f"--material {k}={v}" for k, v in config["material"].items()),
    message:
        "Simulating {wildcards.scene}, seeds {wildcards.first} to {wildcards.last}"
    shell:
        "{SPRINGBLOCK} simulate {params.scene} {params.duration} {params.material} "
        "--integrator {params.integrator} --step {params.step} "
        "--sample-interval {params.sample_interval} "
        "--first-seed {wildcards.first} --last-seed {wildcards.last} "
        "--output {output} > {log} 2>&1"


rule aggregate:
    input:
        realisations(*ENSEMBLES),
    output:
        f"{RESULTS}/tables/realisations.parquet",
    log:
        f"{RESULTS}/logs/aggregate.log",
    benchmark:
        f"{RESULTS}/benchmarks/aggregate.tsv"
    resources:
        mem_mb=600,
        runtime=5,
    params:
        code=sources.digest("springblock.commands.aggregate"),
        configuration=study.configuration_digest(config),
    message:
        "Collecting all realisations in one table"
    shell:
        "{SPRINGBLOCK} aggregate {input} --configuration {params.configuration} "
        "--output {output} > {log} 2>&1"
