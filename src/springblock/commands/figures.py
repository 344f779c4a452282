"""springblock figure_1 ...: one figure each, written in as many formats as --output is given.

The module that draws a figure is imported by its name, when it is asked for.
"""

from collections.abc import Callable
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any

import click

from springblock.commands.options import INPUT, OUTPUT, one_sentence, scene_options
from springblock.figures.style import save
from springblock.pattern import Pattern
from springblock.scene import Scene
from springblock.tables import (
    CORRELATION,
    CORRELATION_LENGTH,
    Record,
    read,
    read_frame,
    read_records,
)

_outputs = click.option(
    "--output", "outputs", type=OUTPUT, multiple=True, required=True, help="PDF, PNG or SVG file."
)
_batches = click.argument("batches", type=INPUT, nargs=-1, required=True)


def _draw(name: str, outputs: tuple[Path, ...], collect: Callable[[], tuple[Any, ...]]) -> None:
    with one_sentence():
        picture = import_module(f"springblock.figures.{name}").draw(*collect())
        for output in outputs:
            save(picture, output)


def _ensembles(batches: tuple[Path, ...], *keys: str) -> list[tuple[Any, list[Record]]]:
    """Records of each scene in `batches` with the scene's `keys`, which tell the scenes apart."""
    ensembles: dict[Any, list[Record]] = {}
    for record in read_records(batches):
        ensembles.setdefault(attrgetter(*keys)(record.scene), []).append(record)
    for value, records in ensembles.items():
        scenes = {record.scene.folder for record in records}
        if len(scenes) > 1:
            what = f"{', '.join(keys)} = {value}"
            raise ValueError(f"several scenes have {what}: {', '.join(sorted(scenes))}")
    return list(ensembles.items())


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


@click.command("figure_5")
@_batches
@_outputs
def figure_5(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw first detachment times on one pillar of the scene in BATCHES."""

    def collect() -> tuple[list[Record], Pattern, str]:
        ensembles = _ensembles(batches, "n_p")
        if len(ensembles) > 1:
            raise ValueError(f"one size of pillars is drawn, not {[n_p for n_p, _ in ensembles]}")
        ((_, records),) = ensembles
        scene = records[0].scene
        return records, scene.pattern, scene.direction

    _draw("figure_5", outputs, collect)


@click.command("figure_6")
@_batches
@_outputs
def figure_6(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw force and detachments for each size of pillars in BATCHES."""
    _draw("figure_6", outputs, lambda: (_ensembles(batches, "n_p"),))


@click.command("figure_7")
@click.argument("correlation", type=INPUT)
@click.argument("lengths", type=INPUT, nargs=-1, required=True)
@_outputs
def figure_7(correlation: Path, lengths: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw the CORRELATION of one scene, and the LENGTHS of pillars of all sizes."""
    _draw(
        "figure_7",
        outputs,
        lambda: (
            read([correlation], CORRELATION).to_pandas(),
            read(lengths, CORRELATION_LENGTH).to_pandas(),
        ),
    )


@click.command("figure_8")
@scene_options
@_outputs
def figure_8(scene: Scene, outputs: tuple[Path, ...]) -> None:
    """Draw pillars with grooves."""
    _draw("figure_8", outputs, lambda: (scene.pattern,))


@click.command("figure_9")
@_batches
@_outputs
def figure_9(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw force and detachments for each sliding direction in BATCHES."""
    _draw("figure_9", outputs, lambda: (_ensembles(batches, "direction"),))


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


@click.command("supplement_spacing")
@_batches
@_outputs
def supplement_spacing(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw static friction and times over the distance between pillars."""
    _draw("supplement_spacing", outputs, lambda: (dict(_ensembles(batches, "n_p", "n_s")),))


@click.command("supplement_size")
@_batches
@_outputs
def supplement_size(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw static friction and times over the size of the surface."""
    _draw(
        "supplement_size", outputs, lambda: (dict(_ensembles(batches, "n_p", "n_s", "n_blocks")),)
    )


@click.command("supplement_angle")
@_batches
@_outputs
def supplement_angle(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw static friction and times over the angle between sliding and grooves."""
    _draw("supplement_angle", outputs, lambda: (dict(_ensembles(batches, "direction")),))


@click.command("supplement_levels")
@_batches
@_outputs
def supplement_levels(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw the force on patterns of two and of three levels."""
    _draw("supplement_levels", outputs, lambda: (dict(_ensembles(batches, "direction", "level")),))


@click.command("supplement_repetitions")
@_batches
@_outputs
def supplement_repetitions(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw the width of intervals over the number of realisations."""
    _draw(
        "supplement_repetitions",
        outputs,
        lambda: (dict(_ensembles(batches, "n_p", "n_p2", "direction")),),
    )


@click.command("supplement_restick")
@_batches
@_outputs
def supplement_restick(batches: tuple[Path, ...], outputs: tuple[Path, ...]) -> None:
    """Draw how many blocks let go again over time."""
    _draw(
        "supplement_restick",
        outputs,
        lambda: (dict(_ensembles(batches, "n_p", "n_p2", "direction")),),
    )
