# A rule for each figure, from what its module declares.

for figure, declared in FIGURES.items():

    rule:
        name:
            figure
        input:
            made_of(
                f"figures/{figure}",
                "springblock.cli.figure",
                drawing(figure).__module__,
                options=declared.source.options(
                    config["n_blocks"], config["figures"].get(figure, {})
                ),
            ),
            data=lambda wildcards, figure=figure: list(needed(figure)),
        output:
            pdf=f"{RESULTS}/figures/{figure}.pdf",
            png=report(
                f"{RESULTS}/figures/{figure}.png",
                caption="../report/caption.rst",
                category=declared.category,
                # A second label with two values would make the report a blank page.
                labels={"figure": f"{figure.removeprefix('figure_')}: {declared.title}"},
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
            figure=figure,
            options=declared.source.options(config["n_blocks"], config["figures"].get(figure, {})),
            caption=lambda wildcards, figure=figure: caption(figure),
        message:
            f"Drawing {figure}: {declared.title}"
        shell:
            "springblock figure {params.figure} {params.options} {input.data:q} "
            "--caption {params.caption:q} --output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"


# Sweeps: observables over an axis, as the configuration names them.
for name, sweep in SWEEPS.items():

    rule:
        name:
            f"sweep_{name}"
        input:
            made_of(f"figures/sweep_{name}", "springblock.plotting.runs.sweep", **sweep),
            batches=lambda wildcards, groups=sweep["groups"]: batches(
                ensembles(furthest(groups), groups)
            ),
        output:
            pdf=f"{RESULTS}/figures/sweep_{name}.pdf",
            png=report(
                f"{RESULTS}/figures/sweep_{name}.png",
                category="Sweeps",
                labels={"figure": f"{name}: over {sweep['over']}"},
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
            over=sweep["over"],
            of=" ".join(f"--of {observable}" for observable in sweep.get("of", [])),
        message:
            f"Drawing sweep_{name}: over {sweep['over']}"
        shell:
            "springblock plot {input.batches:q} --over {params.over} {params.of} "
            "--output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"
