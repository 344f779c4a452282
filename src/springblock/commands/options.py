"""Options and errors that several commands share."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import Any, TypedDict

import click

from springblock.material import Material
from springblock.realisation import STEP
from springblock.scene import Scene
from springblock.solver import INTEGRATORS

OUTPUT = click.Path(dir_okay=False, path_type=Path)
INPUT = click.Path(exists=True, dir_okay=False, path_type=Path)


class How(TypedDict):
    """How a scene is computed, by the keywords of `simulate`."""

    material: Material
    integrator: str
    step: float
    sample_interval: float


def _constants(
    context: click.Context, parameter: click.Parameter, values: tuple[str, ...]
) -> Material:
    """Read name=value pairs; what is not named has the paper's value."""
    constants = dict(Material().items())
    for value in values:
        name, _, number = value.partition("=")
        if name not in constants:
            raise click.BadParameter(f"{name!r} is no constant; there are {', '.join(constants)}")
        try:
            constants[name] = float(number)
        except ValueError:
            raise click.BadParameter(f"{name} must be a number, not {number!r}") from None
    try:
        return Material(**constants)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


_SCENE = [
    click.option("--n-blocks", type=int, required=True, help="N, blocks along one side."),
    click.option("--n-p", type=int, default=0, help="Size of the pillars, blocks."),
    click.option("--n-s", type=int, default=0, help="Distance between them, blocks."),
    click.option("--n-p2", type=int, default=0, help="Width of the pawls, blocks."),
    click.option("--n-s2", type=int, default=0, help="Width of the grooves, blocks."),
    click.option("--direction", default="x", show_default=True, help="x, y or degrees."),
]
_HOW = [
    click.option(
        "--material", multiple=True, callback=_constants, help="A constant: youngs_modulus=1e7."
    ),
    click.option("--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog"),
    click.option("--step", type=float, default=STEP, show_default=True, help="h, s."),
    click.option("--sample-interval", type=float, default=2e-7, show_default=True, help="s."),
]


def scene_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a scene; the command gets them as `scene`."""

    @wraps(command)
    def with_scene(*, n_blocks: int, direction: str, **options: Any) -> Any:
        lengths = {key: options.pop(key) for key in ("n_p", "n_s", "n_p2", "n_s2")}
        return command(scene=Scene(n_blocks, direction=direction, **lengths), **options)

    return _with(_SCENE, with_scene)


def run_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a scene and of how to compute it, which the command gets as `how`."""

    @wraps(command)
    def with_how(**options: Any) -> Any:
        how = {key: options.pop(key) for key in How.__annotations__}
        return command(how=how, **options)

    return scene_options(_with(_HOW, with_how))


def _with(options: list[Callable[..., Any]], command: Callable[..., Any]) -> Callable[..., Any]:
    for option in reversed(options):
        command = option(command)
    return command


@contextmanager
def one_sentence() -> Iterator[None]:
    """Report what is wrong with the input in one sentence, without a traceback."""
    try:
        yield
    except (TypeError, ValueError, RuntimeError) as error:
        raise click.ClickException(str(error)) from error
