"""springblock claims: what becomes of the paper's statements, as a table and as a page."""

from pathlib import Path

import click
import pyarrow.parquet as pq

from springblock.claims import CLAIMS, Evidence, Row, page, rows
from springblock.commands.options import INPUT, OUTPUT, one_sentence
from springblock.files import whole_file
from springblock.scene import Scene
from springblock.sources import code_version
from springblock.statements import STATEMENTS
from springblock.tables import Record, read_records, rows_to_table, write


def _rows(table: Path | None) -> list[Row]:
    return [] if table is None else pq.read_table(table, partitioning=None).to_pylist()


def _summaries(table: Path) -> dict[Scene, dict[int, Row]]:
    summaries: dict[Scene, dict[int, Row]] = {}
    for row in _rows(table):
        summaries.setdefault(Scene.from_row(row), {})[row["seed"]] = row
    return summaries


def _records(batches: tuple[Path, ...]) -> dict[Scene, list[Record]]:
    records: dict[Scene, list[Record]] = {}
    for record in read_records(batches):
        records.setdefault(record.scene, []).append(record)
    return records


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--realisations", type=INPUT, required=True, help="Table of all realisations.")
@click.option("--correlation", type=INPUT, help="Table of correlation functions.")
@click.option("--correlation-length", type=INPUT, help="Table of correlation lengths.")
@click.option("--precision", type=INPUT, help="Table of work and precision.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
@click.option("--page", "text", type=OUTPUT, required=True, help="Markdown file.")
def test_statements(
    batches: tuple[Path, ...],
    realisations: Path,
    correlation: Path | None,
    correlation_length: Path | None,
    precision: Path | None,
    configuration: str,
    output: Path,
    text: Path,
) -> None:
    """Test the statements on BATCHES of realisations and on tables; a missing table tests none."""
    with one_sentence():
        evidence = Evidence(
            summaries=_summaries(realisations),
            records=_records(batches),
            correlation=_rows(correlation),
            correlation_length=_rows(correlation_length),
            precision=_rows(precision),
        )
        table = rows(STATEMENTS, evidence)
        origin = {"code_version": code_version(__name__), "configuration_digest": configuration}
        write(rows_to_table(table, CLAIMS), output, origin)
        with whole_file(text) as partial:
            partial.write_text(page(table), encoding="utf-8")
