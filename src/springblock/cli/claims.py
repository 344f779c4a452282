"""springblock claims: what becomes of the paper's statements, as a table and as a page."""

from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click
import numpy as np

from springblock.beyond.question import by_scene
from springblock.claims import CLAIMS
from springblock.claims.page import page
from springblock.claims.rule import Evidence, enough
from springblock.claims.table import SCHEMA, rows
from springblock.cli.options import INPUT, OUTPUT, code_version, one_sentence
from springblock.files import whole_file
from springblock.io.parquet import load, refuse_mixture, rows_to_table, write
from springblock.io.records import Record, read_records
from springblock.io.rows import Row
from springblock.model.direction import heading
from springblock.model.scene import Scene
from springblock.simulation.prelude import Prelude, surface
from springblock.simulation.run import Array

Records = Mapping[Scene, Sequence[Record]]


def _tables(files: Iterable[Path], records: Container[Scene]) -> dict[Scene, list[Row]]:
    """Rows of tables by scene: all of the first, of others those of the scenes of `records`.

    A scene of two tables has the rows of the later one.
    """
    found: dict[Scene, list[Row]] = {}
    for i, file in enumerate(files):
        rows = by_scene(load(file).to_pylist(), Scene.from_row)
        found |= {scene: rows[scene] for scene in rows if i == 0 or scene in records}
    return found


def _stress(preludes: Iterable[Path], records: Records) -> dict[Scene, Array]:
    """Tangential force on each block in the last state of a prelude, over its mean, by scene."""
    loaded = {prelude.surface: prelude for prelude in map(Prelude.read, preludes)}
    found = {}
    for scene, runs in records.items():
        contact = scene.contact
        prelude = loaded.get(surface(contact, heading(scene.direction)))
        if prelude is None or scene.varied:
            continue
        for name, value in prelude.constants.items():
            if runs[0].constants[name] != value:
                ours = f"{runs[0].constants[name]!r} in its realisations"
                raise ValueError(f"{name} is {value!r} in the prelude of {scene.folder}, {ours}")
        found[scene] = np.full(contact.shape, np.nan)
        force = np.sqrt(prelude.peak[-1])
        found[scene][contact] = force / force.mean()
    return found


def _files(option: str, what: str, **more: Any) -> Callable[..., Any]:
    return click.option(option, type=INPUT, multiple=True, help=f"{what} Can be repeated.", **more)


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@_files("--realisations", "Table of all realisations of a part of the study.", required=True)
@_files("--correlation", "Table of correlation functions.")
@_files("--correlation-length", "Table of correlation lengths.")
@_files("--prelude", "Prelude of a scene of the realisations.")
@_files("--work-precision", "Table of work and precision.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
@click.option("--page", "text", type=OUTPUT, required=True, help="Markdown file.")
def claims(
    batches: tuple[Path, ...],
    realisations: tuple[Path, ...],
    correlation: tuple[Path, ...],
    correlation_length: tuple[Path, ...],
    prelude: tuple[Path, ...],
    work_precision: tuple[Path, ...],
    configuration: str,
    output: Path,
    text: Path,
) -> None:
    """Test the claims on BATCHES of realisations and on tables; a missing table tests none."""
    with one_sentence():
        records = by_scene(read_records(batches))
        tables = *realisations, *correlation, *correlation_length
        refuse_mixture((file, load(file)) for file in (batches[0], *tables))
        evidence = Evidence(
            records=enough(records),
            summaries=enough(_tables(realisations, records)),
            correlation=enough(_tables(correlation, records)),
            correlation_length=enough(_tables(correlation_length, records)),
            stress=_stress(prelude, records),
            precision=[row for table in work_precision for row in load(table).to_pylist()],
        )
        table = rows(CLAIMS, evidence)
        origin = {"code_version": code_version("claims"), "configuration_digest": configuration}
        write(rows_to_table(table, SCHEMA), output, origin)
        with whole_file(text) as partial:
            partial.write_text(page(table), encoding="utf-8")
