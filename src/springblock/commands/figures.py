"""springblock figure_1 ...: one figure each, written in as many formats as --output is given.

The module that draws a figure is imported by its name, when it is asked for.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from springblock.commands.options import INPUT, OUTPUT, one_sentence, scene_options
from springblock.figures.style import save
from springblock.scene import Scene
from springblock.tables import read_frame, read_records

_outputs = click.option(
    "--output", "outputs", type=OUTPUT, multiple=True, required=True, help="PDF, PNG or SVG file."
)
_batches = click.argument("batches", type=INPUT, nargs=-1, required=True)


def _draw(name: str, outputs: tuple[Path, ...], collect: Callable[[], tuple[Any, ...]]) -> None:
    with one_sentence():
        picture = import_module(f"springblock.figures.{name}").draw(*collect())
        for output in outputs:
            save(picture, output)


@click.command("figure_1")
@_outputs
def figure_1(outputs: tuple[Path, ...]) -> None:
    """Draw the model."""
    _draw("figure_1", outputs, tuple)


@click.command("figure_2")
@_batches
@_outputs
def figure_2(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw force and detachments of the first seed in BATCHES before the spread of all."""
    _draw("figure_2", outputs, lambda: (read_records(batches),))


@click.command("figure_3")
@_batches
@_outputs
def figure_3(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw the first detachment times of the first seed in BATCHES."""
    _draw("figure_3", outputs, lambda: (read_records(batches)[0],))


@click.command("figure_4")
@scene_options
@_outputs
def figure_4(scene: Scene, outputs: tuple[Path, ...]) -> None:
    """Draw square pillars."""
    portion = min(scene.n_blocks, 3 * (scene.n_p + scene.n_s))
    _draw("figure_4", outputs, lambda: (scene.pattern, portion))


@click.command("figure_8")
@scene_options
@_outputs
def figure_8(scene: Scene, outputs: tuple[Path, ...]) -> None:
    """Draw pillars with grooves."""
    _draw("figure_8", outputs, lambda: (scene.pattern,))


@click.command("work_precision")
@click.argument("table", type=INPUT)
@_outputs
def work_precision(table: Path, outputs: tuple[Path, ...]) -> None:
    """Draw error against run time from TABLE."""
    _draw("work_precision", outputs, lambda: (read_frame(table),))


@click.command("stability")
@click.argument("table", type=INPUT)
@_outputs
def stability(table: Path, outputs: tuple[Path, ...]) -> None:
    """Draw the stiff and extreme cases in TABLE."""
    _draw("stability", outputs, lambda: (read_frame(table),))
