"""Options and error handling shared by several commands."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import Field, fields
from functools import partial, wraps
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click
import numpy as np

from springblock.files import check_output
from springblock.model.material import Material
from springblock.model.scene import FIELDS, Scene, expand, scene_of


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


if TYPE_CHECKING:
    Type: TypeAlias = click.ParamType[Any, Any]
else:  # older versions of click have no types of their own
    Type = click.ParamType
#: An option whose help shows its default.
defaulted = partial(click.option, show_default=True)
PICTURE = Output(".pdf", ".png", ".svg")
INPUT = click.Path(exists=True, dir_okay=False, path_type=Path)


class Read(Type):
    """Value that a function reads from text; its errors are those of the option."""

    def __init__(self, name: str, read: Callable[[str], Any]) -> None:
        self.name, self.read = name, read

    def convert(self, value: Any, param: Any, ctx: click.Context | None) -> Any:
        try:
            return self.read(value)
        except (TypeError, ValueError) as error:
            self.fail(str(error), param, ctx)


def _type_of(each: Field[Any]) -> Type:
    """Return the type of the option of a field."""
    if choices := each.metadata.get("choices"):
        return click.Choice([*filter(None, choices)])
    if "read" in each.metadata:
        return Read({"name": "file"}.get(each.metadata["unit"], "text"), each.metadata["read"])
    return click.INT if each.type is int else click.FLOAT


def _types_of(each: Field[Any]) -> Type:
    """Return the type of the option with several values: A,B,C, or FIRST:LAST:COUNT."""
    one = click.STRING if each.name == "n_s" else _type_of(each)  # n_s may be a multiple of n_p

    def values(text: str) -> list[Any]:
        parts = [part.split(":") for part in text.split(",")]
        every = chain.from_iterable(_spaced(*part) if len(part) == 3 else part for part in parts)
        return [one.convert(value, None, None) for value in every]

    return Read(f"{one.name},...", values)


def _spaced(first: str, last: str, count: str) -> list[str]:
    """Return numbers from `first` to `last`, as text."""
    return [f"{each:.12g}" for each in np.linspace(float(first), float(last), int(count))]


def pairs(texts: tuple[str, ...]) -> dict[str, str]:
    """Return the texts of NAME=TEXT, each name once."""
    found: dict[str, str] = {}
    for pair in texts:
        name, _, text = pair.partition("=")
        if name in found:
            raise ValueError(f"{name} is given twice, as {found[name]} and {text}; give it once")
        found[name] = text
    return found


def _fields_as_options(
    name: str,
    type_of: Callable[[Field[Any]], Type],
    made: Callable[[dict[str, Any]], Any],
    command: Callable[..., Any],
    among: Mapping[str, Field[Any]] = FIELDS,
) -> Callable[..., Any]:
    """Add an option for each field of a scene; the command receives under `name` what is made."""
    number = type_of(FIELDS["gamma"])

    @wraps(command)
    def called(constants: dict[str, str], **options: Any) -> Any:
        fields = {field: options.pop(field) for field in among}
        given = {field: value for field, value in fields.items() if value is not None}
        own = {each: number.convert(text, None, None) for each, text in constants.items()}
        return command(**{name: made(given | own)}, **options)

    of_law = click.option(
        "--constant",
        "constants",
        multiple=True,
        callback=lambda *given: pairs(given[-1]),
        help="Constant of a law from a file: NAME=VALUE. Can be repeated.",
    )
    return with_options([*(_option(each, type_of) for each in among.values()), of_law], called)


def _option(each: Field[Any], type_of: Callable[[Field[Any]], Type]) -> Any:
    unit, meaning = each.metadata["unit"], each.metadata["meaning"]
    told = meaning[0].upper() + meaning[1:] + ("" if unit in ("1", "name") else f" ({unit})")
    usual = f"  [default: {each.default}]" if each.default else ""
    return click.option(
        f"--{each.name.replace('_', '-')}", type=type_of(each), help=f"{told}.{usual}"
    )


def _combined(given: dict[str, Any]) -> list[Scene]:
    return list(dict.fromkeys(map(scene_of, expand(given))))


#: Add the options of a scene, which the command receives as `scene`.
scene_options = partial(_fields_as_options, "scene", _type_of, scene_of)
#: Add the same options with several values each, of which it receives all combinations as `scenes`.
scenes_options = partial(_fields_as_options, "scenes", _types_of, _combined)


#: Law of the theory, unless another is given.
_WEAKENING = {"law": "slip_weakening", "healing": "none"}
#: Add the options of a material, which the command receives as `material`.
material_options = partial(
    _fields_as_options,
    "material",
    _type_of,
    lambda given: Material(**(given if "law" in given else _WEAKENING | given)),
    among={each.name: each for each in fields(Material)},
)


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
