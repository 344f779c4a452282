"""The command line. A command is imported when it is called, to keep jobs fast to start."""

import atexit
import gc
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pkgutil import resolve_name
from typing import Any

import click

COMMANDS = {
    "compile": "springblock.cli.simulate:compile_kernels",
    "mask": "springblock.cli.mask:mask",
    "prelude": "springblock.cli.simulate:prelude",
    "simulate": "springblock.cli.simulate:simulate_batch",
    "sweep": "springblock.cli.sweep:sweep",
    "plot": "springblock.cli.pictures:plot",
    "animate": "springblock.cli.pictures:animate",
    "show": "springblock.cli.pictures:show",
    "aggregate": "springblock.cli.realisations:aggregate",
    "correlation": "springblock.cli.realisations:correlation",
    "make": "springblock.cli.make:make",
    "claims": "springblock.cli.claims:claims",
    "figure": "springblock.cli.figure:figure",
    "report": "springblock.cli.make:report",
    "info": "springblock.cli.tables:info",
    "table": "springblock.cli.tables:table",
    "compare": "springblock.cli.tables:compare",
    "verify": "springblock.cli.results:verify",
    "repair": "springblock.cli.results:repair",
    "dictionary": "springblock.cli.tables:dictionary",
    "archive": "springblock.cli.results:archive_study",
}


@contextmanager
def one_sentence() -> Iterator[None]:
    """Report errors of the input in one sentence, without a traceback."""
    try:
        yield
    except click.exceptions.Exit:  # a RuntimeError, after --help
        raise
    except (OSError, TypeError, ValueError, RuntimeError) as error:
        raise click.ClickException(str(error)) from error


class StrictGroup(click.Group):
    """Commands that refuse an option given twice, of which click would use the last value."""

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        name, command, words = super().resolve_command(ctx, args)
        if command is not None:
            inner = click.Context(command, ctx, name)
            _, _, given = command.make_parser(inner).parse_args(words.copy())
            for option in given:
                once = isinstance(option, click.Option) and not option.multiple
                if once and given.count(option) > 1:
                    raise click.BadParameter("given twice; give it once", inner, option)
        return name, command, words


class _LazyGroup(StrictGroup):
    """Commands imported when they are called, whose errors and interruption end in one line."""

    def invoke(self, ctx: click.Context) -> object:
        try:
            with one_sentence():
                return super().invoke(ctx)
        except KeyboardInterrupt:
            click.echo("\nInterrupted.", err=True)
            ctx.exit(130)

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        gc.set_threshold(100_000)  # imports leave no garbage,
        atexit.register(gc.freeze)  # so that a last collection at exit would be idle
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # idle threads would spin
        command: click.Command = resolve_name(COMMANDS[cmd_name])
        return command


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="springblock")
@click.option("--code", hidden=True, help="Digest of the code, computed by the workflow.")
def main(code: str | None) -> None:
    """Spring-block model of the onset of sliding on patterned surfaces."""
