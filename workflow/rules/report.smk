# Films of the slip front, and the page that shows the study: films, figures, pages and tables.

from springblock.plotting.declaration import having

#: What is filmed, by group: the ensemble on the surface that a figure shows.
FILMS = {
    group: ENSEMBLE[""][scene.folder]
    for group, figure in {"flat": "figure_3", "pillars": "figure_5", "grooves": "figure_8"}.items()
    for scene in having(config["figures"].get(figure, {}), SCENES[group])[:1]
}

for surface, shown in FILMS.items():

    rule:
        name:
            f"film_{surface}"
        input:
            made_of(f"films/{surface}", "springblock.plotting.runs.film"),
            batch=batches([shown])[:1],
        output:
            f"{RESULTS}/films/{surface}.mp4",
        log:
            f"{RESULTS}/logs/film_{surface}.log",
        benchmark:
            f"{RESULTS}/benchmarks/film_{surface}.tsv"
        resources:
            mem_mb=1000,
            runtime=5,
        message:
            f"Filming the slip front: {surface}"
        shell:
            "springblock animate {input.batch:q} --output {output:q} > {log:q} 2>&1"


rule report:
    input:
        made_of("steps/report", "springblock.cli.report"),
        pictures=expand(
            f"{RESULTS}/figures/{{figure}}.png",
            figure=[*filter(is_part_of_all, FIGURES), *sweeps("")],
        ),
        further=there_already(
            *(f"figures/{figure}.png" for figure in FIGURES if part_of(figure)),
            *(f"figures/{figure}.png" for figure in sweeps("beyond/")),
            *("beyond.md", "benchmark.md", "tables/benchmark.parquet"),
        ),
        reliability=[file for file in ["docs/reliability.md"] if Path(file).exists()],
        tables=[rules.aggregate.input, CORRELATIONS, rules.claims.output],
        accuracy=(
            [rules.accuracy.output, rules.accuracy.input.tables[:2], AT_FULL_SIZE]
            if config["accuracy"]
            else []
        ),
        films=[f"{RESULTS}/films/{surface}.mp4" for surface in FILMS],
        runs=[batches([shown])[0] for shown in FILMS.values()],
    output:
        f"{RESULTS}/report.html",
    log:
        f"{RESULTS}/logs/report.log",
    benchmark:
        f"{RESULTS}/benchmarks/report.tsv"
    resources:
        mem_mb=1500,
        runtime=5,
    params:
        films=lambda wildcards, input: " ".join(
            f"--film {quote(film)} {quote(run)}"
            for film, run in zip(input.films, input.runs, strict=True)
        ),
    message:
        "Writing the report"
    shell:
        "springblock report {input.pictures:q} {input.further:q} {input.tables:q} "
        "{input.reliability:q} {input.accuracy:q} {params.films} --output {output:q} > {log:q} 2>&1"
