# What is drawn: figures, sweeps and films, what each needs, and what its caption says.

from springblock.plotting import figures
from springblock.plotting.caption import file_name
from springblock.plotting.declaration import having
from springblock.plotting.lines import axes

#: Groups of scenes that figures are drawn from.
SHOWN = study.for_figures(config, ENSEMBLES)
SCENES = {group: [each.scene for each in members] for group, members in SHOWN.items()}
#: Groups that questions beyond the paper look at.
GROUPS_BEYOND = ["lattice", "disorder", "layer", "peaks", "friction", "scatter"]
GROUPS_BEYOND = [group for group in GROUPS_BEYOND if SHOWN.get(group)]
#: What figures declare whose groups of scenes and tables the study has.
FIGURES = {
    name: figure
    for name, figure in figures.FIGURES.items()
    if figure.is_part_of(SCENES)
    and (figure.category != "Figures" or not OWN)
    and (figure.category != "Accuracy" or config["accuracy"])
    and (figure.category != "Mechanism" or config["mechanism"])
}
#: What is drawn of one's own scenes unless `sweeps` says: friction over each number that varies.
SWEPT = {
    axis: {"groups": list(ENSEMBLES), "over": axis}
    for axis in (axes(each.scene for each in ENSEMBLE.values()) if OWN else [])
}
#: Observables over an axis of some groups that the study has.
SWEEPS = {
    f"sweep_{name}": sweep
    for name, sweep in config["figures"].get("sweeps", SWEPT).items()
    if all(ENSEMBLES.get(group) for group in sweep["groups"])
}
#: What is filmed, by group: the ensemble on the surface that a figure shows.
FILMS = {
    group: ENSEMBLE[scene.folder]
    for group, figure in {"flat": "figure_3", "pillars": "figure_5", "grooves": "figure_8"}.items()
    for scene in having(config["figures"].get(figure, {}), SCENES.get(group, []))[:1]
}
if OWN:  # each surface, in the first of its directions
    FILMS = {file_name(each.scene): each for each in reversed(SHOWN["surfaces"])}


def needed(figure):
    """Files that a picture is drawn from; there must be surfaces with the lengths that it shows."""
    if figure in SWEEPS:
        yield from batches(ensembles(SWEEPS[figure]["groups"]))
        return
    lengths, declared = config["figures"].get(figure, {}), FIGURES[figure]
    shown = lengths.items() if declared.groups else ()
    scenes = chain.from_iterable(SCENES[group] for group in declared.groups)
    if shown and not any(shown <= scene.lengths.items() for scene in scenes):
        wanted = ", ".join(f"{name} = {length}" for name, length in shown)
        raise WorkflowError(
            f"figures.{figure}: no scene of {' or '.join(declared.groups)} has {wanted}."
        )
    for table, scene, number in declared.needs(SCENES, lengths):
        if scene is None:
            if config["production"] or table != "production":
                yield f"{RESULTS}/tables/{table}.parquet"
        elif table == "realisations":
            yield from batches([ENSEMBLE[scene.folder]])[:number]
        else:
            yield f"{RESULTS}/correlations/{scene.folder}/{table}.parquet"


def command(figure):
    """What draws a picture, but for files and caption."""
    if figure in SWEEPS:
        of = [f"--of {observable}" for observable in SWEEPS[figure].get("of", [])]
        return " ".join(["plot", "--over", SWEEPS[figure]["over"], *of])
    lengths = config["figures"].get(figure, {})
    return f"figure {figure} {FIGURES[figure].options(config['n_blocks'], lengths)}"


def caption(figure):
    """What a figure shows, and what of this study it is drawn from; a sweep says it itself."""
    if figure in SWEEPS:
        return ""
    lengths = config["figures"].get(figure, {})
    return f"--caption {quote(FIGURES[figure].caption_in(SHOWN, lengths, SETUP.material))}"
