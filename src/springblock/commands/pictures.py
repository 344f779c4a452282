"""springblock plot, animate and show: pictures of one run, still or moving, and of one surface."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from springblock.commands.options import INPUT, OUTPUT, one_sentence, scene_options, with_options
from springblock.figures.style import save
from springblock.pictures import film, still, surface
from springblock.reading import read
from springblock.scene import Scene
from springblock.tables import Record

_RUN = [
    click.argument("run", type=INPUT),
    click.option("--seed", type=int, help="Which run of the file; the first if unsaid."),
]


def run_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the file that `springblock simulate` has written, and which of its runs is meant."""
    return with_options(_RUN, command)


def _chosen(path: Path, seed: int | None) -> Record:
    runs = {run.seed: run for run in read(path)}
    if seed is None:
        return next(iter(runs.values()))
    if seed not in runs:
        held = ", ".join(map(str, runs))
        raise ValueError(f"{path} holds no run of seed {seed}; there are {held}")
    return runs[seed]


@click.command("plot")
@run_options
@click.option("--output", type=OUTPUT, required=True, help="PDF, PNG or SVG file.")
def plot(run: Path, seed: int | None, output: Path) -> None:
    """Draw one run of a file RUN: force, detachments, their map, and snapshots if any."""
    with one_sentence():
        save(still.draw(_chosen(run, seed)), output, still.CAPTION)


@click.command("animate")
@run_options
@click.option("--output", type=OUTPUT, required=True, help="GIF or MP4 file; 7.5 s.")
def animate(run: Path, seed: int | None, output: Path) -> None:
    """Film one run of a file RUN: the blocks that let go, while the force runs along."""
    with one_sentence():
        film.write(_chosen(run, seed), output)


@click.command("show")
@scene_options
@click.option("--output", type=OUTPUT, required=True, help="PDF, PNG or SVG file.")
def show(scene: Scene, output: Path) -> None:
    """Draw the surface of a scene: its blocks, those in contact, and the sliding direction."""
    with one_sentence():
        name = scene.folder.replace("/", ", ")
        save(surface.draw(scene.pattern.contact, scene.direction, name), output, surface.CAPTION)
