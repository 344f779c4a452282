from springblock.solver.integrators import INTEGRATORS

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
    COMPILED |= set(INTEGRATORS)
LAWS = {str(getattr(setup.material.law, "file", setup.material.law)) for setup in SETUPS.values()}
#: Cuts of measured surfaces, by the name of the mask.
MASKS = [ensemble.scene.mask for ensemble in ENSEMBLE.values() if ensemble.scene.mask]
CUTS = {mask.name: mask.cut for mask in MASKS if mask.cut}
CUTS_MADE = [f"{RESULTS}/surfaces/{name}.npy" for name in CUTS]
#: Scenes whose fields are stored, and the files of all preludes.
WITH_FIELDS = [name for name in ENSEMBLE if ENSEMBLE[name].snapshot_times]
PRELUDES = [f"{RESULTS}/preludes/{name}.npz" for name in ENSEMBLE]


rule compile:
    """Compile the integrators and the laws of friction."""
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


if CUTS:

    rule mask:
        """Cut contact masks from measured surfaces."""
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
    """Load each scene up to its first detachment."""
    input:
        rules.compile.output,
        own_files,
    output:
        f"{RESULTS}/preludes/{{scene}}.npz",
    log:
        f"{RESULTS}/logs/{{scene}}/prelude.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/prelude.tsv"
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        code=code("simulate"),
        scene=scene,
        how=HOW,
        law=law,
    message:
        "Loading {wildcards.scene} up to its first detachment"
    shell:
        "springblock --code {params.code} prelude {params.scene} {params.how} --output {output:q} "
        "> {log:q} 2>&1"


rule simulate_batch:
    """Simulate realisations, a batch in each job."""
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
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        code=code("simulate"),
        scene=scene,
        how=HOW,
        law=law,
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
    """Simulate all realisations."""
    input:
        batches(ENSEMBLE.values()),
    localrule: True
    message:
        "All realisations are simulated"


if WITH_FIELDS:

    rule fields_of_scene:
        """Store fields of one run of each scene with snapshot_times."""
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
            law=law,
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
    """Store all fields."""
    input:
        [f"{RESULTS}/fields/{name}.nc" for name in WITH_FIELDS],
    localrule: True
    message:
        "All fields are written"


rule aggregate:
    """Collect realisations in one table."""
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
    """Write means of ensembles with their intervals."""
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
    """Set aside unusable files."""
    log:
        f"{RESULTS}/logs/repair.log",
    localrule: True
    params:
        results=RESULTS,
    message:
        "Setting aside unusable files"
    shell:
        "springblock repair {params.results:q} 2>&1 | tee {log:q}"
