# Figures of the supplement: what the paper leaves open, and what depends on it.

#: Groups of scenes that each figure needs, and what it shows.
SUPPLEMENT = {
    "supplement_spacing": (["pillars", "spacing"], "Distance between pillars"),
    "supplement_size": (["flat", "pillars", "size_flat", "size_pillars"], "Size of the surface"),
    "supplement_angle": (["grooves", "angles"], "Sliding at an angle to grooves"),
    "supplement_levels": (["grooves", "third_level"], "A third level"),
    "supplement_repetitions": (["flat", "pillars", "grooves"], "Number of realisations"),
    "supplement_restick": (["flat", "pillars", "grooves"], "Blocks that let go again"),
}
#: Those whose groups the configuration simulates.
SUPPLEMENT = {
    name: (groups, shows)
    for name, (groups, shows) in SUPPLEMENT.items()
    if all(map(ENSEMBLES.get, groups))
}


def one_pattern(*groups):
    """Ensembles of the groups with the pattern of the last group's first scene."""

    def pattern(ensemble):
        scene = ensemble.scene
        return scene.n_p, scene.n_s, scene.n_p2, scene.n_s2

    wanted = pattern(ENSEMBLES[groups[-1]][0])
    return [e for group in groups for e in ENSEMBLES[group] if pattern(e) == wanted]


def supplement_ensembles(name):
    """What a figure is drawn from: every scene once, where groups overlap."""
    groups = SUPPLEMENT[name][0]
    if name == "supplement_spacing":
        varied = one_for_each("n_p", "spacing")
        drawn = [e for group in groups for e in ENSEMBLES[group] if e.scene.n_p in varied]
    elif name == "supplement_size":
        drawn = [*one_pattern("flat", "size_flat"), *one_pattern("pillars", "size_pillars")]
    elif name == "supplement_angle":
        drawn = one_pattern(*groups)
    elif name == "supplement_levels":
        drawn = [e for e in sum(map(ENSEMBLES.get, groups), []) if e.scene.direction in ("x", "y")]
    else:
        drawn = sum(map(ENSEMBLES.get, groups), [])
    return {ensemble.scene: ensemble for ensemble in drawn}.values()


for supplement, (_, shows) in SUPPLEMENT.items():

    rule:
        name:
            supplement
        input:
            batches(supplement_ensembles(supplement)),
        output:
            pdf=f"{RESULTS}/figures/{supplement}.pdf",
            png=report(
                f"{RESULTS}/figures/{supplement}.png",
                caption=f"../report/{supplement}.rst",
                category="Supplement",
                labels={"figure": supplement, "shows": shows},
            ),
        log:
            f"{RESULTS}/logs/{supplement}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{supplement}.tsv"
        resources:
            mem_mb=700,
            runtime=5,
        params:
            code=figure_code(supplement),
            figure=supplement,
        message:
            f"Drawing {supplement}: {shows}"
        shell:
            "springblock {params.figure} {input} --output {output.pdf} --output {output.png} "
            "> {log} 2>&1"
