"""The command line. A command is imported when it is called, to keep jobs fast to start."""

import atexit
import gc
import os
import signal
import sys
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from pkgutil import resolve_name
from textwrap import shorten

import click

#: Commands by name, to which `springblock.__main__` adds those of the study.
COMMANDS = {
    "compile": "springblock.cli.simulate:compile_kernels",
    "mask": "springblock.cli.mask:mask",
    "prelude": "springblock.cli.simulate:prelude",
    "simulate": "springblock.cli.simulate:simulate_batch",
    "sweep": "springblock.cli.sweep:sweep",
    "refine": "springblock.cli.refine:refine_lattice",
    "predict": "springblock.cli.predict:predict",
    "plot": "springblock.cli.pictures:plot",
    "animate": "springblock.cli.pictures:animate",
    "show": "springblock.cli.pictures:show",
    "aggregate": "springblock.cli.realisations:aggregate",
    "correlation": "springblock.cli.realisations:correlation",
    "info": "springblock.cli.tables:info",
    "table": "springblock.cli.tables:table",
    "compare": "springblock.cli.tables:compare",
}


_PACKAGE = str(Path(__file__).parents[1])  #: its own errors need no explanation
_PROCESSOR = Path("/proc/cpuinfo")  #: of Linux


@contextmanager
def one_sentence() -> Iterator[None]:
    """Report errors in one sentence."""
    try:
        yield
    except (click.ClickException, click.exceptions.Exit):
        raise
    except BrokenPipeError:  # nobody reads the output: end as other programs do
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise click.exceptions.Exit(128 + signal.SIGPIPE) from None
    except Exception as error:
        raise click.ClickException(sentence(error)) from error


def sentence(error: Exception) -> str:
    """Return the message of an error, with its type and the command if a library raised it.

    With SPRINGBLOCK_TRACEBACK in the environment, print the traceback.
    """
    if os.environ.get("SPRINGBLOCK_TRACEBACK"):
        traceback.print_exception(error)
    last = traceback.extract_tb(error.__traceback__)[-1]
    is_raised = last.filename.startswith(_PACKAGE) and str(last.line).startswith("raise")
    is_own = isinstance(error, OSError) or type(error).__module__.startswith("springblock")
    if is_raised or is_own:
        return str(error)
    command = shorten(" ".join(sys.argv[1:]), 300)
    if isinstance(error, MemoryError):
        return f"{command}: there is not enough memory. {error}"
    return f"{command}: {error!r}; SPRINGBLOCK_TRACEBACK=1 shows where this happened"


def use_long_vectors() -> None:
    """Let numba, which is not loaded yet, use vectors of 512 bits on processors that have them.

    LLVM prefers 256, since the first of these processors reduced their clock rate for longer ones.
    A processor or features that the user has chosen stay.
    """
    if {"NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"} & os.environ.keys():
        return
    with suppress(OSError), _PROCESSOR.open(encoding="utf-8") as file:
        if "avx512f" in file.read(8192):  # otherwise save the import
            from llvmlite.binding import get_host_cpu_features

            features = get_host_cpu_features().flatten()
            os.environ["NUMBA_CPU_FEATURES"] = f"{features},-prefer-256-bit"


class _LazyGroup(click.Group):
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
        os.environ["MPLBACKEND"] = "agg"  # that of a notebook's kernel may be unknown here
        os.environ.pop("NUMBA_DISABLE_JIT", None)  # kernels have parts that are only compiled
        if not sys.stderr.isatty():  # a bar is no log
            os.environ.setdefault("TQDM_DISABLE", "1")
        use_long_vectors()
        warnings.formatwarning = lambda message, *_, **__: f"warning: {message}\n"
        command: click.Command = resolve_name(COMMANDS[cmd_name])
        return command


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="springblock")
def main() -> None:
    """Spring-block model of the onset of sliding on patterned surfaces."""
