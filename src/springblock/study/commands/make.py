"""springblock make: a table, a part of one, or a page of the study."""

from pathlib import Path
from typing import Any

import click

from springblock.cli.options import INPUT, Output, check_type
from springblock.files import write_text
from springblock.io.parquet import (
    load,
    origin_of,
    read,
    refuse_other_study,
    rows_to_table,
    write,
)
from springblock.io.records import read_records
from springblock.provenance import made_by, of_study
from springblock.study.results import PAGES, PARTS, TABLES, Table, found

Paths = tuple[Path, ...]
_MADE = {name: table for name, table in TABLES.items() if table.made}
_ENSEMBLES = "Of the ensembles of `production-SCENE`."


@click.command("make", epilog=f"Names: {', '.join([*PARTS, *_MADE, *PAGES])}.")
@click.argument("name", type=click.Choice([*PARTS, *_MADE, *PAGES]), metavar="NAME")
@click.argument("inputs", type=INPUT, nargs=-1)
@click.option("--seeds", type=click.IntRange(2), help=_ENSEMBLES)
@click.option("--finest-step", type=float, help=_ENSEMBLES)
@click.option(
    "--output", type=Output(), required=True, help="Parquet file, or Markdown for a page."
)
def make(name: str, inputs: Paths, output: Path, **ensembles: Any) -> None:
    """Make the table, part of a table, or page NAME; a page where the output is Markdown.

    A part, such as production-flat, has no INPUTS. Those of a table are its parts, or batches of
    realisations and tables in files of their names; those of a page are tables.
    """
    kinds = {".md": PAGES, ".parquet": [*PARTS, *_MADE]}
    check_type(output, *(kind for kind, names in kinds.items() if name in names))
    given = {key: value for key, value in ensembles.items() if value is not None}
    if given and not name.startswith("production-"):
        raise ValueError(f"{name}: --seeds and --finest-step are those of production-SCENE")
    if output.suffix == ".md":
        write_text(output, _page(name, inputs))
    elif name in PARTS and not inputs:
        table = PARTS[name]
        _write(table, found(table.made)(name, **given), output, made_by(table.code))
    elif name not in _MADE:
        raise ValueError(f"{len(inputs)} files given; give none")
    elif _MADE[name].parts:
        _refuse(inputs, "parts of the table", bool(inputs))
        origin = {"code_version": origin_of(load(inputs[0]))["code_version"]}  # the same for all
        write(read(inputs, found(_MADE[name].columns)), output, origin)
    else:
        _from_evidence(_MADE[name], inputs, output)


def _refuse(inputs: Paths, wanted: str, holds: bool) -> None:
    if not holds:
        raise ValueError(f"{len(inputs)} files given; give {wanted}")


def _write(table: Table, rows: Any, output: Path, origin: dict[str, str]) -> None:
    write(rows_to_table(list(rows), found(table.columns)), output, origin)


def _from_evidence(table: Table, files: Paths, output: Path) -> None:
    """Compute a table from batches, and tables in files of their names."""
    named = {file.stem: file for file in files if file.stem in table.tables}
    tables = {name: read_as(name, file).to_pylist() for name, file in named.items()}
    batches = [file for file in files if file.stem not in named]
    _refuse(files, "batches of realisations", bool(batches))
    records = read_records(batches, snapshots=True)
    _write(table, found(table.made)(records, **tables), output, of_study(table.code))


def read_as(name: str, file: Path) -> Any:
    """Read a table that must have the columns of its name, and be of this study."""
    table = load(file, found(TABLES[name].columns).names)
    refuse_other_study(file, table)
    return table


def _page(name: str, files: Paths) -> str:
    """Return the text of a page from its tables, in their order."""
    from springblock.study.pages import rendered  # needs the packages of the study

    page = PAGES[name]
    _refuse(files, f"the tables {', '.join(page.tables)}", len(files) == len(page.tables))
    tables = [read_as(*each).to_pylist() for each in zip(page.tables, files, strict=True)]
    return rendered(page.template, **found(page.values)(*tables))
