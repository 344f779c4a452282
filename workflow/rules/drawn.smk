# What is drawn: figures and sweeps, what each needs, and what it shows.

from springblock.plotting import declarations, drawing

#: Those that figures are drawn from, and their scenes.
DRAWN = study.for_figures(ENSEMBLES)
SCENES = {group: [ensemble.scene for ensemble in members] for group, members in DRAWN.items()}
#: What figures declare whose groups of scenes the configuration simulates.
FIGURES = {name: figure for name, figure in declarations().items() if figure.is_part_of(SCENES)}
#: Observables over an axis of some groups, as far as the configuration simulates these.
SWEEPS = {
    name: sweep
    for name, sweep in config["figures"].get("sweeps", {}).items()
    if all(ENSEMBLES.get(group) for group in sweep["groups"])
}
#: Those that the study draws by itself.
CATEGORIES = ["Figures", "Supplement"] + ["Accuracy"] * config["accuracy"]


def part_of(figure):
    """The part of the study that a figure takes its ensembles from."""
    declared = FIGURES[figure]
    return furthest(declared.source.groups) if declared.category == "Beyond" else ""


def needed(figure):
    """Files that a figure is drawn from; there must be surfaces with the lengths that it shows."""
    lengths, part = config["figures"].get(figure, {}), part_of(figure)
    shown = lengths.items() if FIGURES[figure].source.groups else ()
    scenes = chain.from_iterable(SCENES[group] for group in FIGURES[figure].source.groups)
    if shown and not any(shown <= scene.lengths.items() for scene in scenes):
        wanted = ", ".join(f"{name} = {length}" for name, length in shown)
        raise WorkflowError(
            f"figures.{figure} shows {wanted}, which no scene of "
            f"{' or '.join(FIGURES[figure].source.groups)} has."
        )
    for table, scene, number in FIGURES[figure].source.needs(SCENES, lengths):
        if scene is None:
            yield f"{RESULTS}/tables/{table}.parquet"
        elif table == "realisations":
            yield from batches([ENSEMBLE[part][scene.folder]])[:number]
        else:
            yield f"{RESULTS}/correlations/{part}{scene.folder}/{table}.parquet"


def caption(figure):
    """What a figure shows, and what of this study it is drawn from."""
    lengths, part = config["figures"].get(figure, {}), part_of(figure)
    members = {
        group: [ENSEMBLE[part][each.scene.folder] for each in drawn]
        for group, drawn in DRAWN.items()
        if group in REACH[part]
    }
    return FIGURES[figure].caption_in(members, lengths, Material(**config["material"]))


def sweeps(part):
    """Sweeps that belong to a part of the study: over groups of the study itself, or beyond it."""
    own = set(config["scenes"])
    return [
        f"sweep_{name}" for name in SWEEPS if (set(SWEEPS[name]["groups"]) <= own) == (not part)
    ]


def is_part_of_all(figure):
    """Whether `snakemake` alone draws a figure; what is upon request, once its table is there."""
    declared = FIGURES[figure]
    if declared.category not in CATEGORIES:
        return False
    return not declared.upon_request or all(Path(file).exists() for file in needed(figure))
