"""springblock figure NAME: one figure, written once for each --output."""

from collections.abc import Callable
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import Any

import click

from springblock.cli.options import INPUT, PICTURE, scene_options, with_options
from springblock.io.records import Record, read_records
from springblock.model.scene import differing
from springblock.plotting.style import save, span
from springblock.study.commands.make import read_as
from springblock.study.results import FIGURES, Figure

Paths = tuple[Path, ...]


def ensembles(batches: Paths, *keys: str) -> dict[Any, list[Record]]:
    """Return the records of each scene in `batches` by the values of `keys`."""
    found: dict[Any, list[Record]] = {}
    for record in read_records(batches):
        found.setdefault(attrgetter(*keys)(record.scene), []).append(record)
    for value, records in found.items():
        scenes = dict.fromkeys(record.scene for record in records)
        if len(scenes) > 1:
            what = f"{', '.join(keys)} = {value}"
            apart = ", ".join(differing(scene.values for scene in scenes))
            raise ValueError(f"{what} is not unique: scenes differ in {apart}; give one of them")
    return found


def _realisations(declared: Figure, batches: Paths) -> list[Any]:
    if declared.keys:
        return [ensembles(batches, *declared.keys)]
    records = read_records(batches)
    scenes = dict.fromkeys(str(record.scene) for record in records)
    if len(scenes) > 1:
        raise ValueError(f"several scenes: {'; '.join(scenes)}; give batches of one")
    return [records]


def _tables(declared: Figure, tables: Paths, n_p: int | None = None) -> list[Any]:
    names = declared.tables + (declared.also if declared.draws == "correlations" else ())
    if not len(declared.tables) <= len(tables) <= len(names):
        raise ValueError(f"{len(tables)} files given; give {', '.join(declared.tables)}")
    named = zip(names, tables, strict=False)
    frames = [read_as(name, table).to_pandas() for name, table in named]
    return frames if n_p is None else [n_p, *frames]


_many = partial(click.argument, type=INPUT, nargs=-1, required=True)
_SIZE = click.option("--n-p", type=int, required=True, help="Size of the pillars of c(r), blocks.")
#: Arguments of a figure's command, and the function that reads them, by what it draws.
_DATA: dict[str, tuple[list[Callable[..., Any]], Callable[..., list[Any]]]] = {
    "nothing": ([], lambda declared: []),
    "pattern": ([scene_options], lambda declared, scene: [scene.pattern]),
    "tables": ([_many("tables")], _tables),
    "realisations": ([_many("batches")], _realisations),
    "correlations": ([_many("tables"), _SIZE], _tables),
}
_OUTPUTS = click.option(
    "--output", "outputs", type=PICTURE, multiple=True, required=True, help="PDF, PNG or SVG file."
)


def _values(declared: Figure, data: list[Any]) -> dict[str, object]:
    """Return what a caption names of the data."""
    if declared.draws == "correlations":
        return {name: span(data[1][name]) for name in ("n_blocks", "n_p")}
    if declared.draws != "realisations":
        return {}
    samples = list(data[0].values()) if declared.keys else data
    scenes = [runs[0].scene for runs in samples]
    return {
        **{name: span(getattr(scene, name) for scene in scenes) for name in ("n_blocks", "n_p")},
        "direction": ", ".join(dict.fromkeys(scene.direction for scene in scenes)),
        "runs": span(map(len, samples)),
    }


def _command(name: str, declared: Figure) -> click.Command:
    """Return the command that draws a figure, from its declaration."""
    takes, given = _DATA[declared.draws]

    def write(outputs: Paths, **inputs: Any) -> None:
        data = given(declared, **inputs)
        picture = declared.function()(*data)
        for output in outputs:
            save(picture, output, declared.described(**_values(declared, data)))

    command = click.command(name, help=declared.caption, short_help=declared.title)
    return command(with_options([*takes, _OUTPUTS], write))


@click.group(
    "figure",
    commands=[_command(*item) for item in FIGURES.items()],
    subcommand_metavar="NAME [INPUTS]... --output FILE",
)
def figure() -> None:
    """Draw a figure from results of the study."""
