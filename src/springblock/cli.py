"""The command line. Commands are imported when they are called: a job loads what it needs."""

import atexit
import gc
import os
from functools import cache
from importlib import import_module

import click

COMMANDS = {
    "compile": "springblock.commands.simulate:compile_kernels",
    "mask": "springblock.commands.mask:mask",
    "prelude": "springblock.commands.simulate:prelude",
    "simulate": "springblock.commands.simulate:simulate_batch",
    "plot": "springblock.commands.pictures:plot",
    "animate": "springblock.commands.pictures:animate",
    "show": "springblock.commands.pictures:show",
    "aggregate": "springblock.commands.aggregate:aggregate",
    "correlation": "springblock.commands.correlation:correlation",
    "collect": "springblock.commands.collect:collect",
    "measure": "springblock.commands.measure:measure",
    "production": "springblock.commands.production:production",
    "try": "springblock.commands.stability:try_cases",
    "accuracy": "springblock.commands.accuracy:write_page",
    "claims": "springblock.commands.claims:claims",
    "beyond": "springblock.commands.beyond:beyond",
    "figure": "springblock.commands.figure:figure",
    "report": "springblock.commands.report:report",
    "info": "springblock.commands.files:info",
    "compare": "springblock.commands.files:compare",
    "verify": "springblock.commands.audit:verify",
    "repair": "springblock.commands.audit:repair",
    "dictionary": "springblock.commands.files:dictionary",
    "archive": "springblock.commands.archive:archive_study",
}


@cache
def _start_lightly() -> None:
    """Leave out what costs a short job half of its time and is of no use to it.

    Garbage would be looked for among all that imports leave some hundred times while they run,
    and twice at the end, when the memory goes back as a whole. NumPy's linear algebra would start
    a thread for each core, which then waits by counting.
    """
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


class _LazyGroup(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        _start_lightly()
        module, name = COMMANDS[cmd_name].split(":")
        return getattr(import_module(module), name)


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="springblock")
def main() -> None:
    """Spring-block model of the onset of sliding on patterned surfaces."""
