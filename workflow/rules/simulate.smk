# From scenes to realisations and their table. The rule `simulate` stands for all jobs of `simulate_batch`,
# and `fields` for those of `fields_of_scene`.

#: Numerical method and material of all scenes, as options of the command line.
HOW = " ".join(
    [
        f"--integrator {config['integrator']} --step {config['step']}",
        f"--sample-interval {config['sample_interval']}",
        *(f"--material {quote(f'{name}={value}')}" for name, value in config["material"].items()),
    ]
)
#: Integrators and laws of friction that are compiled before any job needs them.
COMPILED = {setup.integrator for setup in SETUPS.values()}
if config["accuracy"]:
    COMPILED |= {"leapfrog", "rk4"}
LAWS = {str(getattr(setup.material.law, "file", setup.material.law)) for setup in SETUPS.values()}
#: Cuts of measured surfaces, by the name of the mask.
MASKS = [ensemble.scene.mask for ensemble in ENSEMBLE.values() if ensemble.scene.mask]
CUTS = {mask.name: mask.cut for mask in MASKS if mask.cut}


rule compile:
    input:
        [law for law in LAWS if law.endswith(".py")],
    output:
        touch(f"{RESULTS}/compiled"),
    log:
        f"{RESULTS}/logs/compile.log",
    benchmark:
        f"{RESULTS}/benchmarks/compile.tsv"
    resources:
        mem_mb=600,
        runtime=5,
    params:
        code=code("compile"),
        integrators=" ".join(f"--integrator {name}" for name in sorted(COMPILED)),
        laws=" ".join(f"--law {quote(name)}" for name in sorted(LAWS)),
    message:
        "Compiling the solver"
    shell:
        "springblock --code {params.code} compile {params.integrators} {params.laws} > {log:q} 2>&1"


rule mask:
    input:
        topography=lambda wildcards: str(CUTS[wildcards.mask].topography),
    output:
        f"{RESULTS}/surfaces/{{mask}}.npy",
    log:
        f"{RESULTS}/logs/surfaces/{{mask}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/surfaces/{{mask}}.tsv"
    wildcard_constraints:
        mask="|".join(map(re.escape, CUTS)),
    resources:
        mem_mb=800,
        runtime=5,
    params:
        code=code("mask"),
        cut=lambda wildcards: CUTS[wildcards.mask].arguments,
    message:
        "Cutting a measured surface: {wildcards.mask}"
    shell:
        "springblock --code {params.code} mask {input.topography:q} {params.cut} --output {output:q} "
        "> {log:q} 2>&1"


# Preludes are not temp(): made again for more seeds, they would make finished batches run again.
rule prelude:
    input:
        rules.compile.output,
        own_files,
    output:
        f"{RESULTS}/preludes/{{scene}}.npz",
    log:
        f"{RESULTS}/logs/{{scene}}/prelude.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/prelude.tsv"
    group:
        "preludes"
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        code=code("simulate"),
        scene=scene,
        how=HOW,
    message:
        "Loading {wildcards.scene} up to its first detachment"
    shell:
        "springblock --code {params.code} prelude {params.scene} {params.how} --output {output:q} "
        "> {log:q} 2>&1"


rule simulate_batch:
    input:
        own_files,
        prelude=rules.prelude.output,
    output:
        f"{RESULTS}/realisations/{{scene}}/batch-{{batch}}.parquet",
    log:
        f"{RESULTS}/logs/{{scene}}/batch-{{batch}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/batch-{{batch}}.tsv"
    wildcard_constraints:
        batch=r"\d+",
    group:
        "batches"
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        code=code("simulate"),
        scene=scene,
        how=HOW,
        duration=duration,
        times=snapshots,
        first=lambda wildcards: seeds(wildcards)[0],
        last=lambda wildcards: seeds(wildcards)[-1],
    message:
        "Simulating {wildcards.scene}, seeds {params.first} to {params.last}"
    shell:
        "springblock --code {params.code} simulate {params.scene} {params.how} {params.duration} "
        "--prelude {input.prelude:q} --first-seed {params.first} --last-seed {params.last} "
        "{params.times} --output {output:q} > {log:q} 2>&1"


rule simulate:
    input:
        batches(ENSEMBLE.values()),
    localrule: True
    message:
        "All realisations are simulated"


rule fields_of_scene:
    input:
        own_files,
        prelude=rules.prelude.output,
    output:
        fields=f"{RESULTS}/fields/{{scene}}.nc",
        run=temp(f"{RESULTS}/fields/{{scene}}.parquet"),
    log:
        f"{RESULTS}/logs/{{scene}}/fields.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/fields.tsv"
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        code=code("simulate"),
        scene=scene,
        how=HOW,
        duration=duration,
        times=snapshots,
        seed=lambda wildcards: ENSEMBLE[wildcards.scene].seeds[0],
    message:
        "Storing fields of {wildcards.scene}, seed {params.seed}"
    shell:
        "springblock --code {params.code} simulate {params.scene} {params.how} {params.duration} "
        "--prelude {input.prelude:q} --first-seed {params.seed} {params.times} "
        "--fields {output.fields:q} --output {output.run:q} > {log:q} 2>&1"


rule fields:
    input:
        [f"{RESULTS}/fields/{name}.nc" for name in ENSEMBLE if ENSEMBLE[name].snapshot_times],
    localrule: True
    message:
        "All fields are written"


rule aggregate:
    input:
        batches(ENSEMBLE.values()),
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
        code=code("simulate"),
        configuration=CONFIGURATION,
        realisations=sum(len(ensemble.seeds) for ensemble in ENSEMBLE.values()),
    message:
        "Collecting realisations in one table"
    shell:
        "springblock --code {params.code} aggregate {input:q} --configuration {params.configuration} "
        "--realisations {params.realisations} --output {output:q} > {log:q} 2>&1"


rule means:
    input:
        rules.aggregate.output,
    output:
        f"{RESULTS}/tables/means.csv",
    log:
        f"{RESULTS}/logs/means.log",
    benchmark:
        f"{RESULTS}/benchmarks/means.tsv"
    resources:
        mem_mb=600,
        runtime=5,
    params:
        code=code("analyse"),
    message:
        "Writing means of ensembles with their intervals"
    shell:
        "springblock --code {params.code} table {input:q} --output {output:q} > {log:q} 2>&1"


rule repair:
    log:
        f"{RESULTS}/logs/repair.log",
    localrule: True
    params:
        results=RESULTS,
    message:
        "Setting aside unusable files"
    shell:
        "springblock repair {params.results:q} 2>&1 | tee {log:q}"
