"""Options and error handling shared by several commands."""

from collections.abc import Callable, Sequence
from dataclasses import fields
from functools import partial, wraps
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import click
import numpy as np

from springblock.files import check_output
from springblock.model.blockmap import BlockMap
from springblock.model.direction import normalised
from springblock.model.scene import EDGES, Scene, Varied, in_order


def check_type(path: Path, *suffixes: str) -> None:
    """Refuse a name of another type of file. Where there is only one type, a name may have none."""
    if path.suffix not in suffixes and (path.suffix or len(suffixes) > 1):
        raise ValueError(f"{path}: choose a name that ends in {' or '.join(suffixes)}")


class Output(click.Path):
    """Path of a file of one of several types that a command writes."""

    def __init__(self, *suffixes: str) -> None:
        super().__init__(dir_okay=False, path_type=Path)
        self.suffixes = suffixes

    def convert(self, value: Any, param: Any, ctx: click.Context | None) -> Any:
        path: Any = super().convert(value, param, ctx)
        check_output(path)
        if self.suffixes:
            check_type(path, *self.suffixes)
        others = ctx.meta.setdefault(__name__, set()) if ctx else set()
        if path.absolute() in others:
            raise ValueError(f"two options name {path}; choose two files")
        others.add(path.absolute())
        return path


#: An option whose help shows its default.
defaulted = partial(click.option, show_default=True)
PICTURE = Output(".pdf", ".png", ".svg")
INPUT = click.Path(exists=True, dir_okay=False, path_type=Path)


def given(read: Callable[[Any], Any]) -> Callable[..., Any]:
    """Return a callback that reads the value of an option, with errors in one sentence."""

    def value_of(context: click.Context, parameter: click.Parameter, value: Any) -> Any:
        try:
            return None if value is None else read(value)
        except (TypeError, ValueError) as error:
            raise click.BadParameter(str(error)) from None

    return value_of


def by_name(pairs: tuple[str, ...]) -> dict[str, str]:
    """Return the texts of NAME=TEXT, each name once."""
    found: dict[str, str] = {}
    for pair in pairs:
        name, _, text = pair.partition("=")
        if name in found:
            raise ValueError(f"{name} is given twice, as {found[name]} and {text}; give it once")
        found[name] = text
    return found


def name_value_pairs(pairs: tuple[str, ...]) -> Varied:
    """Read constants from their options."""
    return in_order(by_name(pairs))


def value_lists(pairs: tuple[str, ...]) -> dict[str, list[Any]]:
    """Read names with several values each: A,B,C, or FIRST:LAST:COUNT, evenly spaced."""
    found: dict[str, list[Any]] = {}
    for name, text in by_name(pairs).items():
        ends = [part.split(":") for part in text.split(",")]
        values = [each for end in ends for each in (_spaced(*end) if len(end) == 3 else end)]
        is_length = name.startswith("n_") and name != "n_s"  # that may be a multiple of n_p
        found[name] = [int(each) for each in values] if is_length else values
    return found


def _spaced(first: str, last: str, count: str) -> list[str]:
    """Return numbers from `first` to `last`, as text."""
    return [f"{each:.12g}" for each in np.linspace(float(first), float(last), int(count))]


#: Options of a surface, without those that a sweep varies.
SURFACE = [
    click.option("--n-blocks", type=int, default=0, help="N, blocks along x; not with --mask."),
    click.option("--n-rows", type=int, default=0, help="Blocks along y; N by default."),
    click.option("--n-p", type=int, default=0, help="Size of the pillars, blocks."),
    click.option("--n-s", type=int, default=0, help="Distance between the pillars, blocks."),
    click.option("--n-p2", type=int, default=0, help="Width of the pawls, blocks."),
    click.option("--n-s2", type=int, default=0, help="Width of the grooves along x, blocks."),
    click.option(
        "--n-p3",
        type=int,
        default=0,
        help="Length of the pawls between grooves of level 3, blocks.",
    ),
    click.option("--n-s3", type=int, default=0, help="Width of the grooves of level 3, blocks."),
    click.option(
        "--along-3", type=click.Choice("xy"), help="Axis of the grooves of level 3; y by default."
    ),
    defaulted("--edges", type=click.Choice(EDGES), default="free", help="Edges of the surface."),
    click.option(
        "--mask",
        type=INPUT,
        callback=given(BlockMap.mask),
        help="Blocks in contact: white in an image, not zero in an array (.npy).",
    ),
    click.option(
        "--mu-static",
        "mu_static_field",
        type=INPUT,
        callback=given(BlockMap.coefficients),
        help="Array (.npy) of static friction coefficients, instead of random ones.",
    ),
    click.option(
        "--mu-dynamic",
        "mu_dynamic_field",
        type=INPUT,
        callback=given(BlockMap.coefficients),
        help="Array (.npy) of dynamic friction coefficients, instead of random ones.",
    ),
]
_SCENE = [
    *SURFACE,
    defaulted(
        "--direction",
        default="x",
        callback=given(normalised),
        help="Sliding direction: x, y or degrees from x.",
    ),
    click.option(
        "--vary",
        "varied",
        multiple=True,
        callback=given(name_value_pairs),
        help="Constant that the scene varies: step=1e-8. Can be repeated.",
    ),
]


def scene_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a scene, which the command receives as `scene`."""

    @wraps(command)
    def with_scene(**options: Any) -> Any:
        return command(scene=scene_of(options), **options)

    return with_options(_SCENE, with_scene)


def scene_of(options: dict[str, Any], **others: Any) -> Scene:
    """Remove the options of a scene from `options`, and return the scene."""
    given = {field.name: options.pop(field.name, None) for field in fields(Scene)} | others
    if not given["n_blocks"] and given["mask"] is None:
        raise ValueError("the surface has no size; give --n-blocks or --mask")
    return Scene(**given | {"along_3": given["along_3"] or ""})


def with_options(
    options: list[Callable[..., Any]], command: Callable[..., Any]
) -> Callable[..., Any]:
    """Add several options, in the order of the help text."""
    for option in reversed(options):
        command = option(command)
    return command


def print_columns(lines: Sequence[Sequence[str]]) -> None:
    """Print lines of cells, each column as wide as its widest cell."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        padded = (cell.ljust(width) for cell, width in zip(line, widths, strict=True))
        click.echo("  ".join(padded).rstrip())


#: Where the columns of the tables of a study are declared.
_SCHEMAS = {
    "realisations": "io.schemas:SUMMARY",
    "correlation": "io.schemas:CORRELATION",
    "correlation_length": "io.schemas:CORRELATION_LENGTH",
    "claims": "claims.table:SCHEMA",
    "work_precision": "accuracy.work_precision:SCHEMA",
    "production": "accuracy.production:SCHEMA",
    "stability": "accuracy.stability:SCHEMA",
    "mechanism": "mechanism.tables:FRICTION",
    "mechanism_damped": "mechanism.tables:FRICTION",
    "sensitivities": "mechanism.sensitivities:SENSITIVITIES",
    "continuum": "continuum.cases:CELLS",
}


def schema_of(name: str) -> Any:
    """Return the columns of a table of a study."""
    return resolve_name(f"springblock.{_SCHEMAS[name]}")


def load_as(name: str, file: Path) -> Any:
    """Read a table that must have the columns of its name, and be of the study of this job."""
    from springblock.io.parquet import load, refuse_other_study

    table = load(file, schema_of(name).names)
    refuse_other_study(file, table)
    return table
