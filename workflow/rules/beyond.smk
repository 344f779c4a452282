# What goes beyond the paper: maps and sweeps, which take longer than the paper itself.

#: Groups that its questions look at, of the study and beyond it; the others decide claims.
BEYOND_GROUPS = ["flat", "pillars", "grooves", "angles", "lattice", "disorder", "layer", "peaks"]
BEYOND_GROUPS += ["friction", "scatter", "variance"]


rule beyond_page:
    input:
        made_of("steps/beyond", "springblock.beyond", "springblock.beyond.page"),
        batches=lambda wildcards: batches(ensembles(furthest(BEYOND_GROUPS), BEYOND_GROUPS)),
    output:
        f"{RESULTS}/beyond.md",
    log:
        f"{RESULTS}/logs/beyond_page.log",
    benchmark:
        f"{RESULTS}/benchmarks/beyond_page.tsv"
    resources:
        mem_mb=2500,
        runtime=10,
    message:
        "Answering questions beyond the paper"
    shell:
        "springblock make beyond {input.batches:q} --output {output:q} > {log:q} 2>&1"


rule beyond:
    input:
        lambda wildcards: tables_of("beyond/"),
        expand(
            f"{RESULTS}/figures/{{figure}}.{{suffix}}",
            figure=[name for name in FIGURES if part_of(name)] + sweeps("beyond/"),
            suffix=["pdf", "png"],
        ),
        rules.beyond_page.output,
    localrule: True
    message:
        f"What goes beyond the paper is in {RESULTS}: tables/beyond, figures/beyond_*, beyond.md"
