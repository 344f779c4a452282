def figure_code(figure):
    """Digest of all that is run to draw a figure."""
    return sources.digest("springblock.commands.figures", f"springblock.figures.{figure}")


def pattern_options(figure):
    """The pattern that a figure draws, as options of its command."""
    lengths = config["figures"][figure]
    return Scene(config["n_blocks"], **lengths).arguments


#: The first ensemble of pillars of each size.
SIZES = one_for_each("n_p", "pillars")


rule figure_1:
    output:
        pdf=f"{RESULTS}/figures/figure_1.pdf",
        png=report(
            f"{RESULTS}/figures/figure_1.png",
            caption="../report/figure_1.rst",
            category="Figures",
            labels={"figure": "1", "shows": "The model"},
        ),
    log:
        f"{RESULTS}/logs/figure_1.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_1.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_1"),
    message:
        "Drawing figure 1: the model"
    shell:
        "springblock figure_1 --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_2:
    input:
        realisations("flat"),
    output:
        pdf=f"{RESULTS}/figures/figure_2.pdf",
        png=report(
            f"{RESULTS}/figures/figure_2.png",
            caption="../report/figure_2.rst",
            category="Figures",
            labels={"figure": "2", "shows": "Force and detachments, flat surface"},
        ),
    log:
        f"{RESULTS}/logs/figure_2.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_2.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_2"),
    message:
        "Drawing figure 2: force and detachments over time"
    shell:
        "springblock figure_2 {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_3:
    input:
        realisations("flat")[0],
    output:
        pdf=f"{RESULTS}/figures/figure_3.pdf",
        png=report(
            f"{RESULTS}/figures/figure_3.png",
            caption="../report/figure_3.rst",
            category="Figures",
            labels={"figure": "3", "shows": "First detachment times, flat surface"},
        ),
    log:
        f"{RESULTS}/logs/figure_3.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_3.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_3"),
    message:
        "Drawing figure 3: first detachment times"
    shell:
        "springblock figure_3 {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_4:
    output:
        pdf=f"{RESULTS}/figures/figure_4.pdf",
        png=report(
            f"{RESULTS}/figures/figure_4.png",
            caption="../report/figure_4.rst",
            category="Figures",
            labels={"figure": "4", "shows": "Square pillars"},
        ),
    log:
        f"{RESULTS}/logs/figure_4.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_4.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_4"),
        pattern=pattern_options("figure_4"),
    message:
        "Drawing figure 4: square pillars"
    shell:
        "springblock figure_4 {params.pattern} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_5:
    input:
        batches([SIZES[config["figures"]["figure_5"]["n_p"]]]),
    output:
        pdf=f"{RESULTS}/figures/figure_5.pdf",
        png=report(
            f"{RESULTS}/figures/figure_5.png",
            caption="../report/figure_5.rst",
            category="Figures",
            labels={"figure": "5", "shows": "First detachment times on one pillar"},
        ),
    log:
        f"{RESULTS}/logs/figure_5.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_5.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_5"),
    message:
        "Drawing figure 5: first detachment times on one pillar"
    shell:
        "springblock figure_5 {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_6:
    input:
        batches(one_for_each("n_p", "flat").values()),
        batches(SIZES.values()),
    output:
        pdf=f"{RESULTS}/figures/figure_6.pdf",
        png=report(
            f"{RESULTS}/figures/figure_6.png",
            caption="../report/figure_6.rst",
            category="Figures",
            labels={"figure": "6", "shows": "Force and detachments, pillars"},
        ),
    log:
        f"{RESULTS}/logs/figure_6.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_6.tsv"
    resources:
        mem_mb=700,
        runtime=5,
    params:
        code=figure_code("figure_6"),
    message:
        "Drawing figure 6: force and detachments on pillars"
    shell:
        "springblock figure_6 {input} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_7:
    input:
        correlation=correlations("correlation", [SIZES[config["figures"]["figure_7"]["n_p"]]]),
        lengths=correlations("correlation_length", SIZES.values()),
    output:
        pdf=f"{RESULTS}/figures/figure_7.pdf",
        png=report(
            f"{RESULTS}/figures/figure_7.png",
            caption="../report/figure_7.rst",
            category="Figures",
            labels={"figure": "7", "shows": "Correlation of detachments on pillars"},
        ),
    log:
        f"{RESULTS}/logs/figure_7.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_7.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_7"),
    message:
        "Drawing figure 7: correlation of detachment times on pillars"
    shell:
        "springblock figure_7 {input.correlation} {input.lengths} "
        "--output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_8:
    output:
        pdf=f"{RESULTS}/figures/figure_8.pdf",
        png=report(
            f"{RESULTS}/figures/figure_8.png",
            caption="../report/figure_8.rst",
            category="Figures",
            labels={"figure": "8", "shows": "Grooved pillars"},
        ),
    log:
        f"{RESULTS}/logs/figure_8.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_8.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_8"),
        pattern=pattern_options("figure_8"),
    message:
        "Drawing figure 8: grooved pillars"
    shell:
        "springblock figure_8 {params.pattern} --output {output.pdf} --output {output.png} > {log} 2>&1"


rule figure_9:
    input:
        batches(one_for_each("direction", "grooves").values()),
    output:
        pdf=f"{RESULTS}/figures/figure_9.pdf",
        png=report(
            f"{RESULTS}/figures/figure_9.png",
            caption="../report/figure_9.rst",
            category="Figures",
            labels={"figure": "9", "shows": "Force and detachments, grooved pillars"},
        ),
    log:
        f"{RESULTS}/logs/figure_9.log",
    benchmark:
        f"{RESULTS}/benchmarks/figure_9.tsv"
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=figure_code("figure_9"),
    message:
        "Drawing figure 9: force and detachments on grooved pillars"
    shell:
        "springblock figure_9 {input} --output {output.pdf} --output {output.png} > {log} 2>&1"
