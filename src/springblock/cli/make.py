"""springblock make: tables of the error study, tables joined in one, and pages in Markdown."""

from pathlib import Path
from types import ModuleType

import click

from springblock.accuracy.conventions import COMPARISONS, SCENES
from springblock.cli.options import INPUT, OUTPUT, code_version, one_sentence
from springblock.files import whole_file
from springblock.io.parquet import load, origin_of, read, rows_to_table, write

MEASURED = ["stability"]
MEASURED += [f"{kind}-{scene}" for kind in (*COMPARISONS, "production") for scene in SCENES]
#: Inputs of each name: what they are, how many at least, and how many at most.
INPUTS = {
    **dict.fromkeys(MEASURED, ("no inputs", 0, 0)),
    "collect": ("tables of equal columns", 1, None),
    "accuracy": (
        "the tables work_precision, stability, realisations and, if any, production",
        3,
        4,
    ),
    "beyond": ("batches of realisations", 1, None),
}


@click.command("make", epilog=f"Names: {', '.join(INPUTS)}.")
@click.argument("name", type=click.Choice(list(INPUTS)), metavar="NAME")
@click.argument("inputs", type=INPUT, nargs=-1)
@click.option("--configuration", help="Digest of the configuration that collected tables share.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file, or Markdown for a page.")
def make(name: str, inputs: tuple[Path, ...], configuration: str | None, output: Path) -> None:
    """Make the table or page NAME.

    Tables without INPUTS: stability, of stiff and extreme cases; those of errors in one comparison
    on one scene; and production, of errors with N = 120. From INPUTS: collect joins tables of
    equal columns, made by the same code; accuracy writes the page on errors from the tables
    work_precision, stability, realisations and, if there is one, production; beyond answers
    questions beyond the paper from batches of realisations, where they suffice.
    """
    with one_sentence():
        wanted, least, most = INPUTS[name]
        if len(inputs) < least or (most is not None and len(inputs) > most):
            raise ValueError(f"{name} takes {wanted}; number of files given: {len(inputs)}")
        if name in MEASURED:
            _measure(name, output)
        elif name == "collect":
            _collect(inputs, configuration, output)
        else:
            with whole_file(output) as partial:
                partial.write_text(_page(name, inputs), encoding="utf-8")


def _measure(name: str, output: Path) -> None:
    """Write a table of the error study, in which there is nothing to configure."""
    from springblock.accuracy import production, stability, work_precision

    kind, _, scene = name.partition("-")
    module: ModuleType = work_precision
    if kind == "stability":
        module, rows = stability, stability.stability_rows()
    elif kind == "production":
        module, rows = production, list(production.production_rows(scene))
    else:
        rows = list(work_precision.ROWS[kind](scene))
    table = rows_to_table(rows, module.SCHEMA)
    write(table, output, {"code_version": code_version("accuracy")})


def _collect(tables: tuple[Path, ...], configuration: str | None, output: Path) -> None:
    """Join tables of equal columns, made by the same code."""
    first = load(tables[0])
    metadata = {"code_version": origin_of(first)["code_version"]}
    if configuration is not None:
        metadata["configuration_digest"] = configuration
    write(read(tables, first.schema.remove_metadata()), output, metadata)


def _page(name: str, files: tuple[Path, ...]) -> str:
    """Write one of the two pages."""
    if name == "accuracy":
        from springblock.accuracy.page import page

        return page(*(load(file).to_pylist() for file in files))
    from springblock.beyond.page import page as beyond
    from springblock.beyond.question import by_scene
    from springblock.io.records import read_records

    return beyond(by_scene(read_records(files)))
