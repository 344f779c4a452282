# Films of the slip front, and the report: films, figures, pages and tables.

#: Files of all films; the glossary beside this workflow.
FILMED = [f"{RESULTS}/films/{surface}.gif" for surface in FILMS]
GLOSSARY = workflow.current_basedir.join("../../docs/glossary.md").get_path_or_uri(True)
GLOSSARY = os.path.relpath(GLOSSARY)

for surface, shown in FILMS.items():

    rule:
        """Film the slip front on this surface."""
        name:
            f"film_{surface}"
        input:
            batches([shown])[:1],
        output:
            f"{RESULTS}/films/{surface}.gif",
        log:
            f"{RESULTS}/logs/film_{surface}.log",
        benchmark:
            f"{RESULTS}/benchmarks/film_{surface}.tsv"
        resources:
            mem_mb=1000,
            runtime=5,
        params:
            code=code("plot"),
        message:
            f"Filming the slip front: {surface}"
        shell:
            "springblock --code {params.code} animate {input:q} --output {output:q} > {log:q} 2>&1"


rule report:
    """Write the report: films, figures, pages and tables."""
    input:
        pictures=[file for file in rules.figures.input if file.endswith(".png")],
        claims=[] if OWN else [rules.claims_table.output, rules.claims.output],
        tables=[rules.aggregate.output, *rules.correlations.input],
        accuracy=(
            [
                rules.accuracy.output,
                rules.precision_table.output,
                rules.stability_table.output,
                rules.production_table.output,
            ]
            if config["accuracy"]
            else []
        ),
        mechanism=[MODELS, SENSITIVE, EXPLAINED],
        continuum=CONTINUUM[-2:],
        glossary=[] if OWN or not Path(GLOSSARY).exists() else GLOSSARY,
        films=FILMED,
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
        code=code("report"),
        files=lambda wildcards, input: [
            file for file in input if file not in {*input.films, *input.runs}
        ],
        own="--own" if OWN else "",
        films=lambda wildcards, input: " ".join(
            f"--film {quote(film)} {quote(run)}"
            for film, run in zip(input.films, input.runs, strict=True)
        ),
    message:
        "Writing the report"
    shell:
        "springblock --code {params.code} report {params.files:q} {params.films} {params.own} "
        "--output {output:q} > {log:q} 2>&1"
