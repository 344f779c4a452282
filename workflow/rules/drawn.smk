# Figures, sweeps and films of the study, with their inputs.

from springblock.plotting import figures
from springblock.plotting.declaration import file_name, having
from springblock.plotting.lines import axes

#: Groups of scenes from which figures are drawn.
SHOWN = study.for_figures(config, ENSEMBLES)
SCENES = {group: [each.scene for each in members] for group, members in SHOWN.items()}
#: Declarations of those figures whose groups of scenes and tables the study has.
FIGURES = {
    name: figure
    for name, figure in figures.FIGURES.items()
    if figure.is_part_of(SCENES)
    and (figure.category != "Figures" or not OWN)
    and (figure.category != "Accuracy" or config["accuracy"])
    and (figure.category != "Mechanism" or config["mechanism"])
    and (figure.category != "Continuum" or config["mechanism"] == "all")
}
#: Default sweeps of a study with `study: own`: friction against each parameter that varies.
SWEPT = {
    axis: {"groups": list(ENSEMBLES), "over": axis}
    for axis in (axes(each.scene for each in ENSEMBLE.values()) if OWN else [])
}
#: Sweeps whose groups of scenes the study has.
SWEEPS = {
    f"sweep_{name}": sweep
    for name, sweep in config["figures"].get("sweeps", SWEPT).items()
    if all(ENSEMBLES.get(group) for group in sweep["groups"])
}
#: Ensembles that are filmed, by group: on the surface that a figure shows.
FILMS = {
    group: ENSEMBLE[scene.folder]
    for group, figure in {"flat": "figure_3", "pillars": "figure_5", "grooves": "figure_8"}.items()
    for scene in having(config["figures"].get(figure, {}), SCENES.get(group, []))[:1]
}
if OWN:  # each surface, in the first of its directions
    FILMS = {file_name(each.scene): each for each in reversed(SHOWN["surfaces"])}


def needed(figure):
    """Yield the files of a figure; refuse lengths that no scene has."""
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
            yield f"{RESULTS}/tables/{table}.parquet"
        elif table == "realisations":
            yield from batches([ENSEMBLE[scene.folder]])[:number]
        else:
            yield f"{RESULTS}/correlations/{scene.folder}/{table}.parquet"


def command(figure):
    """The command that draws a figure, without files."""
    if figure in SWEEPS:
        of = [f"--of {observable}" for observable in SWEEPS[figure].get("of", [])]
        return " ".join(["plot", "--over", SWEEPS[figure]["over"], *of])
    lengths = config["figures"].get(figure, {})
    return f"figure {figure} {FIGURES[figure].options(config['n_blocks'], lengths)}"
