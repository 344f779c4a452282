# Tables that the chapters compute: errors, simpler models, theory, verdicts; and pages on them.


rule part:
    """Measure a part of a table, which needs no realisations of the study."""
    input:
        rules.compiled.input,
    output:
        f"{RESULTS}/parts/{{part}}.parquet",
    log:
        f"{RESULTS}/logs/parts/{{part}}.log",
    priority: 1  # the longest jobs begin first, so that none of them is left alone at the end
    params:
        code=lambda wildcards: digest(PARTS[wildcards.part].code),
        ensembles=lambda wildcards: PLANNED.sampled(wildcards.part),
    shell:
        "springblock make {wildcards.part} {params.ensembles} --output {output:q} > {log:q} 2>&1"


rule parts:
    """Measure all parts of tables."""
    input:
        expand(rules.part.output, part=sum(PLANNED.measured.values(), [])),
    localrule: True


for table, declared in PLANNED.of_chapters.items():

    rule:
        """Compute this table, from its parts, or from realisations and other tables."""
        name:
            f"{table}_table"
        input:
            PLANNED.sources(declared),
        output:
            PLANNED.tables[table],
        log:
            f"{RESULTS}/logs/{table}_table.log",
        resources:
            mem_mb=6000 if declared.groups else 2000,
        params:
            code=code(declared.code),
            table=table,
        shell:
            "springblock make {params.table} {input:q} --output {output:q} > {log:q} 2>&1"


for page, tables in PLANNED.pages.items():

    rule:
        """Write this page."""
        name:
            page
        input:
            tables,
        output:
            f"{RESULTS}/{page}.md",
        log:
            f"{RESULTS}/logs/{page}.log",
        params:
            code=PAGES[page].digest,
            page=page,
        shell:
            "springblock make {params.page} {input:q} --output {output:q} > {log:q} 2>&1"


rule pages:
    """Write all pages, and the tables of the chapters."""
    input:
        expand(f"{RESULTS}/{{page}}.md", page=PLANNED.pages),
        [PLANNED.tables[table] for table in PLANNED.of_chapters],
    localrule: True
