"""springblock claims: verdicts on the paper's statements, as a table and as a page."""

from collections.abc import Container, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

import click

from springblock.beyond.question import by_scene
from springblock.claims import CLAIMS
from springblock.claims.page import page
from springblock.claims.rule import Evidence, enough
from springblock.claims.stress import elastic_forces
from springblock.claims.table import SCHEMA, rows
from springblock.cli.options import INPUT, OUTPUT, code_version
from springblock.files import write_text
from springblock.io.parquet import load, refuse_mixture, rows_to_table, write
from springblock.io.records import Record, read_records
from springblock.io.rows import Row
from springblock.model.scene import Scene
from springblock.simulation.run import Array

Records = Mapping[Scene, Sequence[Record]]


def _tables(files: Iterable[Path], records: Container[Scene]) -> dict[Scene, list[Row]]:
    """Return the rows of tables by scene, for scenes in `records`."""
    found: dict[Scene, list[Row]] = {}
    for file in files:
        rows = by_scene(load(file).to_pylist(), Scene.from_row)
        found |= {scene: rows[scene] for scene in rows if scene in records}
    return found


def _stress(records: Records) -> dict[Scene, Array]:
    """Return the stress before any slip on patterned surfaces with the study's constants."""
    return {
        scene: elastic_forces(scene, runs[0].material)
        for scene, runs in records.items()
        if scene.level and not scene.varied and scene.direction in ("x", "y")
    }


_files = partial(click.option, type=INPUT, multiple=True)


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@_files("--correlation", help="Table of correlation functions. Can be repeated.")
@_files("--correlation-length", help="Table of correlation lengths. Can be repeated.")
@_files("--work-precision", help="Table of work and precision. Can be repeated.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
@click.option("--page", "text", type=OUTPUT, required=True, help="Markdown file.")
def claims(
    batches: tuple[Path, ...],
    correlation: tuple[Path, ...],
    correlation_length: tuple[Path, ...],
    work_precision: tuple[Path, ...],
    configuration: str,
    output: Path,
    text: Path,
) -> None:
    """Test the paper's statements on BATCHES of realisations and on tables.

    Statements whose data are missing are not tested.
    """
    records = by_scene(read_records(batches))
    tables = *correlation, *correlation_length
    refuse_mixture((file, load(file)) for file in (batches[0], *tables))
    evidence = Evidence(
        records=enough(records),
        correlation=enough(_tables(correlation, records)),
        correlation_length=enough(_tables(correlation_length, records)),
        stress=_stress(records),
        precision=[row for table in work_precision for row in load(table).to_pylist()],
    )
    table = rows(CLAIMS, evidence)
    origin = {"code_version": code_version("claims"), "configuration_digest": configuration}
    write(rows_to_table(table, SCHEMA), output, origin)
    write_text(text, page(table))
