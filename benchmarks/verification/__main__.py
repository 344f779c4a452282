"""Compare a code with the references, or write these and the first entries."""

import math
from pathlib import Path

import click

from benchmarks.verification import entries as own
from benchmarks.verification import references
from benchmarks.verification.metrics import NAMES, errors, uncertainties
from benchmarks.verification.problems import PROBLEMS, read_answer, read_reference
from springblock.cli import one_sentence
from springblock.cli.options import INPUT
from springblock.files import write_text

_NAME = click.Choice(list(PROBLEMS))


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
def main() -> None:
    """Verification problems for spring-block friction."""


@main.command()
@click.argument("problem", type=_NAME)
@click.argument("t_det", type=INPUT, metavar="TABLE")
@click.option("--force", type=INPUT, help="Table of the force: columns time, force.")
def compare(problem: str, t_det: Path, force: Path | None) -> None:
    """Print the errors of TABLE, which has the columns y, x and t_det."""
    with one_sentence():
        answer = read_answer(PROBLEMS[problem], t_det, force)
    reference = read_reference(PROBLEMS[problem])
    off_by, uncertain = errors(answer, reference), uncertainties(reference)
    for name, error, uncertainty in zip(NAMES, off_by, uncertain, strict=True):
        known = "no force table" if math.isnan(error) else f"{error:.3g} ± {uncertainty:.2g}"
        click.echo(f"{name:<54} {known}")


@main.command()
@click.argument("problems", type=_NAME, nargs=-1)
def reference(problems: tuple[str, ...]) -> None:
    """Write surface and reference of PROBLEMS, by default of all; takes minutes."""
    for name in problems or PROBLEMS:
        references.write_surface(PROBLEMS[name])
        references.write_reference(PROBLEMS[name])
        click.echo(f"{name}: written")


@main.command()
def entries() -> None:
    """Write ENTRIES.md: errors and CPU times of our integrators and Siconos."""
    write_text(Path(__file__).with_name("ENTRIES.md"), own.page())


if __name__ == "__main__":
    main()
