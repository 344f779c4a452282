def scene(wildcards):
    return ENSEMBLE[wildcards.scene].scene.arguments


def duration(wildcards):
    seconds = ENSEMBLE[wildcards.scene].duration
    return "" if seconds is None else f"--duration {seconds}"


def memory(wildcards):
    """MB, measured with a margin: a part that is always there and one for the lattice."""
    return 300 + (ENSEMBLE[wildcards.scene].scene.n_blocks // 12) ** 2


#: How every scene is computed, as options of the command line.
HOW = " ".join(
    [
        f"--integrator {config['integrator']} --step {config['step']}",
        f"--sample-interval {config['sample_interval']}",
        *(f"--material {name}={value}" for name, value in config["material"].items()),
    ]
)


wildcard_constraints:
    scene="|".join(ENSEMBLE),


rule compile:
    output:
        touch(f"{RESULTS}/compiled/{{integrator}}"),
    log:
        f"{RESULTS}/logs/compile-{{integrator}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/compile-{{integrator}}.tsv"
    wildcard_constraints:
        integrator="[a-z0-9]+",
    resources:
        mem_mb=600,
        runtime=5,
    params:
        code=sources.digest("springblock.solver"),
    message:
        "Compiling the solver: {wildcards.integrator}"
    shell:
        "{SPRINGBLOCK} compile --integrator {wildcards.integrator} > {log} 2>&1"


rule prelude:
    input:
        f"{RESULTS}/compiled/{config['integrator']}",
    output:
        f"{RESULTS}/preludes/{{scene}}.npz",
    log:
        f"{RESULTS}/logs/{{scene}}/prelude.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/prelude.tsv"
    resources:
        mem_mb=memory,
        runtime=10,
    params:
        code=sources.digest("springblock.commands.simulate"),
        scene=scene,
        how=HOW,
    message:
        "Loading {wildcards.scene} up to its first detachment"
    shell:
        "{SPRINGBLOCK} prelude {params.scene} {params.how} --output {output} > {log} 2>&1"


rule simulate:
    input:
        rules.prelude.output,
    output:
        f"{RESULTS}/realisations/{{scene}}/seeds={{first}}-{{last}}.parquet",
    log:
        f"{RESULTS}/logs/{{scene}}/seeds={{first}}-{{last}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/seeds={{first}}-{{last}}.tsv"
    wildcard_constraints:
        first=r"\d+",
        last=r"\d+",
    resources:
        mem_mb=memory,
        runtime=30,
    params:
        code=sources.digest("springblock.commands.simulate"),
        scene=scene,
        how=HOW,
        duration=duration,
    message:
        "Simulating {wildcards.scene}, seeds {wildcards.first} to {wildcards.last}"
    shell:
        "{SPRINGBLOCK} simulate {params.scene} {params.how} {params.duration} "
        "--prelude {input} --first-seed {wildcards.first} --last-seed {wildcards.last} "
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
        configuration=sources.configuration_digest(config),
    message:
        "Collecting all realisations in one table"
    shell:
        "{SPRINGBLOCK} aggregate {input} --configuration {params.configuration} "
        "--output {output} > {log} 2>&1"
