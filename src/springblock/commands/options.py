"""Options and errors that several commands share."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import Any

import click

from springblock.scene import Scene

OUTPUT = click.Path(dir_okay=False, path_type=Path)
INPUT = click.Path(exists=True, dir_okay=False, path_type=Path)


def scene_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add one option per field of a scene."""
    for field in reversed(fields(Scene)):
        name = f"--{field.name.replace('_', '-')}"
        required = field.name == "n_blocks"
        default = None if required else field.default
        kind = str if field.name == "direction" else int
        command = click.option(
            name, type=kind, required=required, default=default, show_default=not required
        )(command)
    return command


@contextmanager
def one_sentence() -> Iterator[None]:
    """Report what is wrong with the input in one sentence, without a traceback."""
    try:
        yield
    except (TypeError, ValueError, RuntimeError) as error:
        raise click.ClickException(str(error)) from error
