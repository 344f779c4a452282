# Figures, sweeps and films of the study, and its report.
for figure in [*PLANNED.figures, *PLANNED.sweeps]:

    rule:
        """Draw this figure."""
        name:
            figure
        input:
            checked(PLANNED.needed, figure),
        output:
            pdf=f"{RESULTS}/figures/{figure}.pdf",
            png=report(f"{RESULTS}/figures/{figure}.png", category="Figures"),
        log:
            f"{RESULTS}/logs/figures/{figure}.log",
        resources:
            mem_mb=3000,
        params:
            code=PLANNED.code(figure),
            command=PLANNED.command(figure),
        shell:
            "springblock {params.command} {input:q} --output {output.pdf:q} --output {output.png:q} "
            "> {log:q} 2>&1"


rule figures:
    """Draw all figures."""
    input:
        expand(
            f"{RESULTS}/figures/{{name}}.{{kind}}",
            name=[*PLANNED.figures, *PLANNED.sweeps],
            kind=["pdf", "png"],
        ),
    localrule: True


rule film:
    """Film the slip front on one surface."""
    input:
        lambda wildcards: PLANNED.batches([PLANNED.films[wildcards.surface]])[:1],
    output:
        f"{RESULTS}/films/{{surface}}.gif",
    log:
        f"{RESULTS}/logs/films/{{surface}}.log",
    params:
        code=code((*ANALYSE, "plotting")),
    shell:
        "springblock animate {input:q} --output {output:q} > {log:q} 2>&1"


rule films:
    """Film the slip front on all surfaces that figures show."""
    input:
        expand(rules.film.output, surface=PLANNED.films),
    localrule: True


#: The glossary beside this workflow, for the paper's study.
GLOSSARY = workflow.current_basedir.join("../../docs/glossary.md").get_path_or_uri(True)
GLOSSARY = [] if PLANNED.own or not Path(GLOSSARY).exists() else os.path.relpath(GLOSSARY)


rule report:
    """Write the report: films, figures, pages and tables."""
    input:
        shown=[
            *[file for file in rules.figures.input if file.endswith(".png")],
            *rules.pages.input,
            *rules.aggregate.output,
            *CORRELATIONS,
        ],
        glossary=GLOSSARY,
        films=rules.films.input,
        runs=[PLANNED.batches([shown])[0] for shown in PLANNED.films.values()],
    output:
        report(f"{RESULTS}/report.html", category="Report"),
    log:
        f"{RESULTS}/logs/report.log",
    params:
        code=checked(digest_of_report),
        own="--own" if PLANNED.own else "",
        films=lambda wildcards, input: " ".join(
            f"--film {quote(film)} {quote(run)}"
            for film, run in zip(input.films, input.runs, strict=True)
        ),
    shell:
        "springblock report {input.shown:q} {input.glossary:q} {params.films} {params.own} "
        "--output {output:q} > {log:q} 2>&1"
