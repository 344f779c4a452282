# A rule for each figure, from what its module declares.

for figure, declared in FIGURES.items():

    rule:
        name:
            figure
        input:
            lambda wildcards, figure=figure: list(needed(figure)),
        output:
            pdf=f"{RESULTS}/figures/{figure}.pdf",
            png=report(
                f"{RESULTS}/figures/{figure}.png",
                caption="../report/caption.rst",
                category=declared.category,
                labels={"figure": figure.removeprefix("figure_"), "shows": declared.title},
            ),
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
            code=sources.digest("springblock.commands.figure", f"springblock.figures.{figure}"),
            figure=figure,
            options=declared.source.options(config["n_blocks"], config["figures"].get(figure, {})),
            caption=lambda wildcards, figure=figure: caption(figure),
        message:
            f"Drawing {figure}: {declared.title}"
        shell:
            "springblock figure {params.figure} {params.options} {input:q} "
            "--caption {params.caption:q} --output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"


# Sweeps: observables over an axis, as the configuration names them.
for name, sweep in SWEEPS.items():

    rule:
        name:
            f"sweep_{name}"
        input:
            lambda wildcards, groups=sweep["groups"]: batches(ensembles("beyond/", groups)),
        output:
            pdf=f"{RESULTS}/figures/sweep_{name}.pdf",
            png=report(
                f"{RESULTS}/figures/sweep_{name}.png",
                category="Sweeps",
                labels={"figure": name, "shows": f"over {sweep['over']}"},
            ),
        log:
            f"{RESULTS}/logs/sweep_{name}.log",
        benchmark:
            f"{RESULTS}/benchmarks/sweep_{name}.tsv"
        group:
            "figures"
        resources:
            mem_mb=1200,
            runtime=5,
        params:
            code=sources.digest("springblock.pictures.sweep"),
            over=sweep["over"],
            of=" ".join(f"--of {observable}" for observable in sweep.get("of", [])),
        message:
            f"Drawing sweep_{name}: over {sweep['over']}"
        shell:
            "springblock plot {input:q} --over {params.over} {params.of} "
            "--output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"
