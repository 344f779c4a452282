"""springblock claims: what becomes of the paper's statements, as a table and as a page."""

from collections.abc import Callable, Iterable
from operator import attrgetter
from pathlib import Path
from typing import Any

import click
import numpy as np
import pyarrow.parquet as pq

from springblock.claims import CLAIMS
from springblock.claims.page import page
from springblock.claims.rule import Evidence
from springblock.claims.table import SCHEMA, rows
from springblock.commands.options import INPUT, OUTPUT, one_sentence
from springblock.direction import heading
from springblock.files import whole_file
from springblock.prelude import Prelude, surface
from springblock.rows import Row
from springblock.run import Array
from springblock.scene import Scene
from springblock.sources import code_version
from springblock.tables import read_records, rows_to_table, write


def _by_scene(items: Iterable[Any], scene_of: Callable[[Any], Scene]) -> dict[Scene, list[Any]]:
    """Items by their scene; those on surfaces that the paper could not have are left out."""
    found: dict[Scene, list[Any]] = {}
    for item in items:
        if (scene := scene_of(item)).is_papers:
            found.setdefault(scene, []).append(item)
    return found


def _rows(table: Path | None) -> list[Row]:
    return [] if table is None else pq.read_table(table, partitioning=None).to_pylist()


def _stress(preludes: Iterable[Path], scenes: Iterable[Scene]) -> dict[Scene, Array]:
    """Tangential force on each block in the last state of a prelude, over its mean, by scene."""
    loaded = {prelude.surface: prelude for prelude in map(Prelude.read, preludes)}
    found = {}
    for scene in scenes:
        contact = scene.pattern.contact
        prelude = loaded.get(surface(contact, heading(scene.direction)))
        if prelude is not None:
            found[scene] = np.full(contact.shape, np.nan)
            force = np.sqrt(prelude.peak[-1])
            found[scene][contact] = force / force.mean()
    return found


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--realisations", type=INPUT, required=True, help="Table of all realisations.")
@click.option("--correlation", type=INPUT, help="Table of correlation functions.")
@click.option("--correlation-length", type=INPUT, help="Table of correlation lengths.")
@click.option(
    "--prelude",
    "preludes",
    type=INPUT,
    multiple=True,
    help="Prelude of a scene of the realisations; can be repeated.",
)
@click.option("--precision", type=INPUT, help="Table of work and precision.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
@click.option("--page", "text", type=OUTPUT, required=True, help="Markdown file.")
def claims(
    batches: tuple[Path, ...],
    realisations: Path,
    correlation: Path | None,
    correlation_length: Path | None,
    preludes: tuple[Path, ...],
    precision: Path | None,
    configuration: str,
    output: Path,
    text: Path,
) -> None:
    """Test the claims on BATCHES of realisations and on tables; a missing table tests none."""
    with one_sentence():
        records = _by_scene(read_records(batches), attrgetter("scene"))
        evidence = Evidence(
            records=records,
            summaries=_by_scene(_rows(realisations), Scene.from_row),
            correlation=_by_scene(_rows(correlation), Scene.from_row),
            correlation_length=_by_scene(_rows(correlation_length), Scene.from_row),
            stress=_stress(preludes, [scene for scene in records if not scene.varied]),
            precision=_rows(precision),
        )
        table = rows(CLAIMS, evidence)
        origin = {"code_version": code_version(__name__), "configuration_digest": configuration}
        write(rows_to_table(table, SCHEMA), output, origin)
        with whole_file(text) as partial:
            partial.write_text(page(table), encoding="utf-8")
