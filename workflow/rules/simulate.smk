# From a scene to its realisations, and one table of them all. Where a step has many jobs, its own
# rule collects what they leave.

#: How every scene is computed, as options of the command line.
HOW = " ".join(
    [
        f"--integrator {config['integrator']} --step {config['step']}",
        f"--sample-interval {config['sample_interval']}",
        *(f"--material {name}={value}" for name, value in config["material"].items()),
    ]
)


wildcard_constraints:
    scene="|".join(map(re.escape, EVERY)),
    part="|".join(map(re.escape, PARTS)),
    mask="|".join(map(re.escape, CUTS)),


rule compile_integrator:
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
        "springblock compile --integrator {wildcards.integrator} > {log:q} 2>&1"


rule compile:
    input:
        expand(rules.compile_integrator.output, integrator=INTEGRATORS),
    localrule: True
    message:
        "All integrators are compiled"


rule mask_topography:
    input:
        made_of("steps/mask", "springblock.cli.mask"),
        topography=lambda wildcards: str(CUTS[wildcards.mask].topography),
    output:
        f"{RESULTS}/surfaces/{{mask}}.npy",
    log:
        f"{RESULTS}/logs/surfaces/{{mask}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/surfaces/{{mask}}.tsv"
    resources:
        mem_mb=800,
        runtime=5,
    params:
        cut=lambda wildcards: CUTS[wildcards.mask].arguments,
    message:
        "Cutting a measured surface: {wildcards.mask}"
    shell:
        "springblock mask {input.topography:q} {params.cut} --output {output:q} > {log:q} 2>&1"


rule mask:
    input:
        expand(rules.mask_topography.output, mask=CUTS),
    localrule: True
    message:
        "All measured surfaces are cut"


# Preludes are not temp(): made again for more seeds, they would make finished batches run again.
rule prelude_scene:
    input:
        f"{RESULTS}/compiled/{config['integrator']}",
        own_files,
        lambda wildcards: SCENE_ORIGIN[wildcards.scene],
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
        scene=scene,
        how=HOW,
    message:
        "Loading {wildcards.scene} up to its first detachment"
    shell:
        "springblock prelude {params.scene} {params.how} --output {output:q} > {log:q} 2>&1"


rule prelude:
    input:
        expand(
            rules.prelude_scene.output,
            scene=[ensemble.scene.folder for ensemble in ensembles("")],
        ),
    localrule: True
    message:
        "All scenes are loaded up to their first detachment"


rule simulate_batch:
    input:
        own_files,
        lambda wildcards: SCENE_ORIGIN[wildcards.scene],
        prelude=rules.prelude_scene.output,
    output:
        f"{RESULTS}/realisations/{{scene}}/{{more}}seeds-{{first}}-{{last}}.parquet",
    log:
        f"{RESULTS}/logs/{{scene}}/{{more}}seeds-{{first}}-{{last}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{scene}}/{{more}}seeds-{{first}}-{{last}}.tsv"
    wildcard_constraints:
        more=r"(more-\d+/)?",
        first=r"\d+",
        last=r"\d+",
    group:
        "batches"
    resources:
        mem_mb=memory,
        runtime=minutes,
    params:
        scene=scene,
        how=HOW,
        duration=duration,
    message:
        "Simulating {wildcards.scene}, seeds {wildcards.first} to {wildcards.last}"
    shell:
        "springblock simulate {params.scene} {params.how} {params.duration} "
        "--prelude {input.prelude:q} --first-seed {wildcards.first} --last-seed {wildcards.last} "
        "--output {output:q} > {log:q} 2>&1"


rule simulate:
    input:
        batches(ensembles("")),
    localrule: True
    message:
        "All realisations are simulated"


rule aggregate_part:
    input:
        made_of("steps/aggregate", "springblock.cli.aggregate", configuration=CONFIGURATION),
        batches=lambda wildcards: batches(ensembles(wildcards.part)),
    output:
        f"{RESULTS}/tables/{{part}}realisations.parquet",
    log:
        f"{RESULTS}/logs/{{part}}aggregate.log",
    benchmark:
        f"{RESULTS}/benchmarks/{{part}}aggregate.tsv"
    resources:
        mem_mb=600,
        runtime=5,
    params:
        configuration=CONFIGURATION,
    message:
        "Collecting realisations in one table: {wildcards.part}realisations"
    shell:
        "springblock aggregate {input.batches:q} --configuration {params.configuration} "
        "--output {output:q} > {log:q} 2>&1"


rule aggregate:
    input:
        f"{RESULTS}/tables/realisations.parquet",
    localrule: True
    message:
        "All realisations are in one table"
