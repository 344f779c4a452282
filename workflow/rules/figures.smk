# A rule for each figure, from its declaration, and for each sweep of the configuration.

for figure in [*FIGURES, *SWEEPS]:

    rule:
        """Draw this figure."""
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
        resources:
            mem_mb=3000,
            runtime=5,
        params:
            code=code("plot"),
            command=command(figure),
        message:
            f"Drawing {figure}: {FIGURES[figure].title if figure in FIGURES else command(figure)}"
        shell:
            "springblock --code {params.code} {params.command} {input:q} "
            "--output {output.pdf:q} --output {output.png:q} > {log:q} 2>&1"


rule figures:
    """Draw all figures."""
    input:
        expand(
            f"{RESULTS}/figures/{{name}}.{{kind}}", name=[*FIGURES, *SWEEPS], kind=["pdf", "png"]
        ),
    localrule: True
    message:
        f"All figures are in {RESULTS}/figures"
