"""springblock refine: static friction of one surface on finer lattices."""

import click

from springblock.analysis.refine import refine
from springblock.cli.options import defaulted, scene_options
from springblock.model.scene import Scene
from springblock.simulation.scenes import setup_of


@click.command("refine")
@scene_options
@defaulted("--seeds", type=click.IntRange(2), default=10, help="Realisations on each lattice.")
@defaulted("--levels", type=click.IntRange(2), default=3, help="Lattices: l, l/2, l/4, ...")
@defaulted("--jobs", type=click.IntRange(1), default=1, help="Cores to use.")
def refine_lattice(scene: Scene, seeds: int, levels: int, jobs: int) -> None:
    """Simulate a surface on finer lattices, and say whether static friction has converged.

    All lengths in metres are fixed, those of the disorder, too. The cost of a run grows by eight
    with each level.
    """
    if scene.is_periodic or not scene.is_drawn:
        raise ValueError("refine needs free edges and coefficients that are drawn")
    surface = scene.textured if scene.texture else scene.contact
    how = {"jobs": jobs, "duration": scene.duration or None}
    click.echo(refine(surface, setup_of(scene), scene.direction, seeds, levels, **how))
