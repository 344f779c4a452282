# From scenes to realisations, their table and correlations.


rule compile:
    """Compile an integrator and the laws of friction before any job needs them."""
    input:
        [law for law in PLANNED.laws if law.endswith(".py")],
    output:
        touch(f"{RESULTS}/kernels/{{integrator}}"),
    log:
        f"{RESULTS}/logs/kernels/{{integrator}}.log",
    params:
        code=code(COMPILE),
        laws=" ".join(f"--law {quote(name)}" for name in PLANNED.laws),
        edges="--periodic" if PLANNED.periodic else "",
    shell:
        "springblock compile --integrator {wildcards.integrator} {params.laws} {params.edges} "
        "> {log:q} 2>&1"


rule compiled:
    """Compile all integrators."""
    input:
        expand(rules.compile.output, integrator=PLANNED.integrators),
    localrule: True


rule mask:
    """Cut a contact mask from a measured surface."""
    input:
        lambda wildcards: str(PLANNED.cuts[wildcards.mask].topography),
    output:
        f"{RESULTS}/surfaces/{{mask}}.npy",
    log:
        f"{RESULTS}/logs/surfaces/{{mask}}.log",
    params:
        code=code(MASK),
        cut=lambda wildcards: PLANNED.cuts[wildcards.mask].arguments,
    shell:
        "springblock mask {input:q} {params.cut} --output {output:q} > {log:q} 2>&1"


rule masks:
    """Cut all contact masks."""
    input:
        expand(rules.mask.output, mask=PLANNED.cuts),
    localrule: True


# Preludes are not temp(): made again for more seeds, they would make finished batches run again.
rule prelude:
    """Load a scene up to its first detachment."""
    input:
        lambda wildcards: PLANNED.scenes[wildcards.scene].files,
        lambda wildcards: f"{RESULTS}/kernels/{PLANNED.scenes[wildcards.scene].integrator}",
    output:
        f"{RESULTS}/preludes/{{scene}}.npz",
    log:
        f"{RESULTS}/logs/preludes/{{scene}}.log",
    resources:
        mem_mb=lambda wildcards, attempt: attempt * PLANNED.memory(wildcards),
        runtime=lambda wildcards, attempt: attempt * PLANNED.minutes(wildcards),
    params:
        scene=lambda wildcards: PLANNED.scenes[wildcards.scene].options,
    shell:
        "springblock prelude {params.scene} --output {output:q} > {log:q} 2>&1"


rule preludes:
    """Load all scenes up to their first detachment."""
    input:
        expand(rules.prelude.output, scene=PLANNED.scenes),
    localrule: True


rule simulate_batch:
    """Simulate realisations of a scene, from the first seed to the last."""
    input:
        lambda wildcards: PLANNED.scenes[wildcards.scene].files,
        prelude=rules.prelude.output,
    output:
        f"{RESULTS}/realisations/{{scene}}/{{first}}-{{last}}.parquet",
    log:
        f"{RESULTS}/logs/realisations/{{scene}}/{{first}}-{{last}}.log",
    wildcard_constraints:
        first=r"\d+",
        last=r"\d+",
    resources:
        mem_mb=lambda wildcards, attempt: attempt * PLANNED.memory(wildcards),
        runtime=lambda wildcards, attempt: attempt * PLANNED.minutes(wildcards),
    params:
        scene=lambda wildcards: PLANNED.scenes[wildcards.scene].options,
    shell:
        "springblock simulate {params.scene} --prelude {input.prelude:q} "
        "--first-seed {wildcards.first} --last-seed {wildcards.last} --output {output:q} > {log:q} 2>&1"


rule simulate:
    """Simulate all realisations."""
    input:
        PLANNED.batches(PLANNED.seeds),
    localrule: True


rule fields_of_scene:
    """Store fields of the first run of a scene at its snapshot_times."""
    input:
        lambda wildcards: PLANNED.scenes[wildcards.scene].files,
        prelude=rules.prelude.output,
    output:
        fields=f"{RESULTS}/fields/{{scene}}.nc",
        run=temp(f"{RESULTS}/fields/{{scene}}.parquet"),
    log:
        f"{RESULTS}/logs/fields/{{scene}}.log",
    resources:
        mem_mb=lambda wildcards, attempt: attempt * PLANNED.memory(wildcards),
        runtime=lambda wildcards, attempt: attempt * PLANNED.minutes(wildcards),
    params:
        scene=lambda wildcards: PLANNED.scenes[wildcards.scene].options,
        seed=lambda wildcards: config["first_seed"],
    shell:
        "springblock simulate {params.scene} --prelude {input.prelude:q} "
        "--first-seed {params.seed} --fields {output.fields:q} --output {output.run:q} > {log:q} 2>&1"


rule fields:
    """Store all fields."""
    input:
        expand(rules.fields_of_scene.output.fields, scene=PLANNED.with_fields),
    localrule: True


rule aggregate:
    """Collect realisations in one table."""
    input:
        rules.simulate.input,
    output:
        f"{RESULTS}/tables/realisations.parquet",
    log:
        f"{RESULTS}/logs/aggregate.log",
    params:
        code=code(SIMULATE),
    shell:
        "springblock aggregate {input:q} --output {output:q} > {log:q} 2>&1"


rule means:
    """Write means of ensembles with their intervals."""
    input:
        rules.aggregate.output,
    output:
        f"{RESULTS}/tables/means.csv",
    log:
        f"{RESULTS}/logs/means.log",
    params:
        code=code(ANALYSE),
    shell:
        "springblock table {input:q} --output {output:q} > {log:q} 2>&1"


if PLANNED.with_sides:

    rule correlations:
        """Correlate detachment times along the sides of pillars."""
        input:
            PLANNED.batches(PLANNED.with_sides),
        output:
            correlation=f"{RESULTS}/tables/correlation.parquet",
            length=f"{RESULTS}/tables/correlation_length.parquet",
        log:
            f"{RESULTS}/logs/correlations.log",
        params:
            code=code(ANALYSE),
        shell:
            "springblock correlation {input:q} --output-correlation {output.correlation:q} "
            "--output-length {output.length:q} > {log:q} 2>&1"


CORRELATIONS = rules.correlations.output if PLANNED.with_sides else []
