"""springblock make and report: tables of accuracy, mechanism and continuum, and pages."""

from pathlib import Path
from pkgutil import resolve_name

import click

from springblock.accuracy.conventions import COMPARISONS, SCENES
from springblock.cli.options import INPUT, Output, check_type, load_as
from springblock.continuum import PARTS
from springblock.files import write_text
from springblock.io.parquet import load, origin_of, read, rows_to_table, write
from springblock.io.records import read_records
from springblock.mechanism.surfaces import TABLES
from springblock.provenance import made_by, of_study

MEASURED = ["stability"]
MEASURED += [f"{kind}-{scene}" for kind in (*COMPARISONS, "production") for scene in SCENES]
MEASURED += [f"mechanism-{part}" for parts in TABLES.values() for part in parts]
MEASURED += [f"continuum-{part}" for part in PARTS]
#: Modules that compute the values of pages, and the tables that these follow from.
PAGES = {
    "applicability": ("analysis.strips", ("realisations",)),
    "accuracy": ("accuracy.page", ("work_precision", "stability", "realisations", "production")),
    "claims": ("claims.summary", ("claims",)),
    "continuum": ("continuum.page", ("continuum",)),
    "findings": (
        "report.findings",
        ("claims", "realisations", "continuum", "production"),
    ),
    "mechanism": ("mechanism.page", (*TABLES, "sensitivities")),
}
#: Inputs of each name: description, smallest and largest number.
INPUTS = {
    **dict.fromkeys(MEASURED, ("no inputs", 0, 0)),
    "collect": ("tables of equal columns", 1, None),
    "sensitivities": ("batches of realisations", 1, None),
    **{name: (f"the tables {', '.join(of)}", len(of), len(of)) for name, (_, of) in PAGES.items()},
}
_ENSEMBLES = "Of the ensembles of `production-SCENE`."


@click.command("make", epilog=f"Names: {', '.join(INPUTS)}.")
@click.argument("name", type=click.Choice(list(INPUTS)), metavar="NAME")
@click.argument("inputs", type=INPUT, nargs=-1)
@click.option("--seeds", type=click.IntRange(2), default=10, show_default=True, help=_ENSEMBLES)
@click.option("--finest-step", type=float, default=1e-8, show_default=True, help=_ENSEMBLES)
@click.option(
    "--output", type=Output(), required=True, help="Parquet file, or Markdown for a page."
)
def make(
    name: str,
    inputs: tuple[Path, ...],
    seeds: int,
    finest_step: float,
    output: Path,
) -> None:
    """Make the table or page NAME.

    \b
    Tables, without INPUTS:
      stability          stiff and extreme cases
      reference-SCENE    errors of single runs (likewise paired-SCENE: of small ensembles)
      production-SCENE   errors of ensembles with N = 120
      continuum-PART     unit cells beside their theory
      mechanism-N_P      simpler models on pillars (likewise on other surfaces)
    From INPUTS:
      collect            one table, from tables of equal columns made by the same code
      sensitivities      what friction and load peaks depend on, from batches
      accuracy           page on errors, from the tables work_precision, stability,
                         realisations and production
      claims             page on the paper's statements, from their table
      findings           findings of the full study, from the tables claims, realisations,
                         continuum and production
      applicability      page on where the model applies, from the table realisations
      mechanism          page on static friction, from its tables
      continuum          page on the continuum limit, from its table
    """
    wanted, least, most = INPUTS[name]
    if len(inputs) < least or (most is not None and len(inputs) > most):
        raise ValueError(f"{name}: {len(inputs)} files given; give {wanted}")
    check_type(output, ".md" if name in PAGES else ".parquet")
    if name in MEASURED:
        _measure(name, seeds, finest_step, output)
    elif name == "collect":
        _collect(inputs, output)
    elif name == "sensitivities":
        _sensitivities(inputs, output)
    else:
        write_text(output, _page(name, inputs))


def _measure(name: str, seeds: int, finest_step: float, output: Path) -> None:
    """Write a table without inputs."""
    from springblock.accuracy import production, stability, work_precision
    from springblock.continuum import cases
    from springblock.mechanism.tables import FRICTION, measure

    kind, _, scene = name.partition("-")
    step, schema = "accuracy", work_precision.SCHEMA
    if kind == "stability":
        schema, rows = stability.SCHEMA, stability.stability_rows()
    elif kind == "production":
        schema = production.SCHEMA
        rows = list(production.production_rows(scene, seeds, finest_step))
    elif kind == "mechanism":
        step, schema, rows = "mechanism", FRICTION, list(measure(scene))
    elif kind == "continuum":
        step, schema, rows = "continuum", cases.CELLS, list(cases.measure(scene))
    else:
        rows = list(work_precision.ROWS[kind](scene))
    write(rows_to_table(rows, schema), output, made_by(step))


def _collect(tables: tuple[Path, ...], output: Path) -> None:
    """Join tables of equal columns, made by the same code."""
    first = load(tables[0])
    origin = {"code_version": origin_of(first)["code_version"]}
    write(read(tables, first.schema.remove_metadata()), output, origin)


def _sensitivities(batches: tuple[Path, ...], output: Path) -> None:
    """Write what friction and load peaks depend on."""
    from springblock.mechanism.sensitivities import SENSITIVITIES, sensitivities

    table = rows_to_table(list(sensitivities(read_records(batches))), SENSITIVITIES)
    write(table, output, of_study("mechanism"))


def _page(name: str, files: tuple[Path, ...]) -> str:
    """Return the text of a page."""
    from springblock.pages import rendered  # needs the packages of the study

    place, kinds = PAGES[name]
    values = resolve_name(f"springblock.{place}:values")
    rows = (load_as(kind, file).to_pylist() for kind, file in zip(kinds, files, strict=True))
    return rendered(f"{name}.md", **values(*rows))


@click.command("report")
@click.argument("files", type=INPUT, nargs=-1, required=True)
@click.option(
    "--film",
    "films",
    type=(INPUT, INPUT),
    multiple=True,
    help="MP4 file and the batch whose first run it shows. Can be repeated.",
)
@click.option("--own", is_flag=True, help="Report on a study with `study: own`.")
@click.option("--output", type=Output(".html"), required=True, help="HTML file.")
def report(
    files: tuple[Path, ...], films: tuple[tuple[Path, Path], ...], own: bool, output: Path
) -> None:
    """Write the HTML report of a study.

    FILES are pictures (PNG), pages (Markdown) and tables (Parquet). With --own the report begins
    with means and changes of the table `realisations`.
    """
    from springblock.report.page import report_page  # needs the packages of the study

    write_text(output, report_page(files, dict(films), own))
