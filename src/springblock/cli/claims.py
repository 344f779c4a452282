"""springblock claims: verdicts on the paper's statements, as a table and as a page."""

from collections.abc import Container, Iterable
from functools import partial
from itertools import chain
from pathlib import Path

import click

from springblock.beyond.question import by_scene
from springblock.claims import CLAIMS
from springblock.claims.page import page
from springblock.claims.rule import ENOUGH, Evidence
from springblock.claims.stress import elastic_forces
from springblock.claims.table import SCHEMA, rows
from springblock.cli.options import INPUT, PAGE, TABLE, code_version
from springblock.files import write_text
from springblock.io.parquet import load, refuse_mixture, rows_to_table, write
from springblock.io.records import read_records
from springblock.io.rows import Row
from springblock.model.scene import Scene


def _rows(tables: Iterable[Path]) -> list[Row]:
    return list(chain.from_iterable(load(table).to_pylist() for table in tables))


def _by_scene(tables: Iterable[Path], scenes: Container[Scene]) -> dict[Scene, list[Row]]:
    """Return the rows of tables by scene, for some scenes."""
    found = by_scene(_rows(tables), Scene.from_row)
    return {scene: rows for scene, rows in found.items() if scene in scenes}


_files = partial(click.option, type=INPUT, multiple=True)


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@_files("--correlation", help="Table `correlation`. Can be repeated.")
@_files("--correlation-length", help="Table `correlation_length`. Can be repeated.")
@_files("--work-precision", help="Table `work_precision`. Can be repeated.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=TABLE, required=True, help="Parquet file.")
@click.option("--page", "text", type=PAGE, required=True, help="Markdown file.")
def claims(
    batches: tuple[Path, ...],
    correlation: tuple[Path, ...],
    correlation_length: tuple[Path, ...],
    work_precision: tuple[Path, ...],
    configuration: str,
    output: Path,
    text: Path,
) -> None:
    """Test the paper's statements.

    The tests use BATCHES of realisations and tables. Statements whose data are missing are not
    tested.
    """
    refuse_mixture((file, load(file)) for file in (batches[0], *correlation, *correlation_length))
    found = by_scene(read_records(batches, snapshots=True))
    records = {scene: runs for scene, runs in found.items() if len(runs) >= ENOUGH}
    evidence = Evidence(
        records=records,
        correlation=_by_scene(correlation, records),
        correlation_length=_by_scene(correlation_length, records),
        stress={
            scene: elastic_forces(scene, runs[0].material)
            for scene, runs in found.items()
            if scene.level and not scene.varied and scene.direction in ("x", "y")
        },
        precision=_rows(work_precision),
    )
    table = rows(CLAIMS, evidence)
    origin = {"code_version": code_version("claims"), "configuration_digest": configuration}
    write(rows_to_table(table, SCHEMA), output, origin)
    write_text(text, page(table))
