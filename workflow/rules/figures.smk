# A rule for each figure, from its declaration, and for each sweep of the configuration.

for figure, declared in FIGURES.items():

    rule:
        name:
            figure
        input:
            lambda wildcards, figure=figure: list(needed(figure)),
        output:
            pdf=f"{RESULTS}/figures/{figure}.pdf",
            png=f"{RESULTS}/figures/{figure}.png",
        log:
            f"{RESULTS}/logs/{figure}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{figure}.tsv"
        group:
            "figures"
        resources:
            mem_mb=1200,
            runtime=5,
        params:
            code=code("plot"),
            figure=figure,
            options=options_of(figure),
            caption=lambda wildcards, figure=figure: caption(figure),
        message:
            f"Drawing {figure}: {declared.title}"
        shell:
            "springblock --code {params.code} figure {params.figure} {params.options} {input:q} "
            "--caption {params.caption:q} --output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"


for name, sweep in SWEEPS.items():

    rule:
        name:
            name
        input:
            batches(ensembles(sweep["groups"])),
        output:
            pdf=f"{RESULTS}/figures/{name}.pdf",
            png=f"{RESULTS}/figures/{name}.png",
        log:
            f"{RESULTS}/logs/{name}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{name}.tsv"
        group:
            "figures"
        resources:
            mem_mb=1200,
            runtime=5,
        params:
            code=code("plot"),
            over=sweep["over"],
            of=" ".join(f"--of {observable}" for observable in sweep.get("of", [])),
        message:
            f"Drawing {name}: over {sweep['over']}"
        shell:
            "springblock --code {params.code} plot {input:q} --over {params.over} {params.of} "
            "--output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"


rule figures:
    input:
        expand(
            f"{RESULTS}/figures/{{figure}}.{{suffix}}",
            figure=[*FIGURES, *SWEEPS],
            suffix=["pdf", "png"],
        ),
    localrule: True
    message:
        f"All figures are in {RESULTS}/figures"
