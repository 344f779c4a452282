"""springblock sweep: ensembles for several constants, lengths and directions, without Snakemake."""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import click
import pyarrow as pa
from tqdm import tqdm

from springblock.analysis.runs import realisations
from springblock.cli.options import defaulted, scenes_options
from springblock.io.identity import identity
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import SUMMARY
from springblock.model.scene import Scene
from springblock.plotting import sweep as plot
from springblock.plotting.lines import axes, lines
from springblock.plotting.style import save
from springblock.provenance import SIMULATE, made_by
from springblock.simulation.scenes import columns_of, prelude_of, realise


@click.command("sweep")
@scenes_options
@defaulted("--seeds", type=click.IntRange(1), default=10, help="Realisations of each ensemble.")
@defaulted("--jobs", type=click.IntRange(1), default=1, help="Cores to use.")
@defaulted(
    "--of",
    type=click.Choice(list(plot.OBSERVABLES)),
    multiple=True,
    default=("static_friction", "t_max", "t_avg"),
    help="Observable of the figures. Can be repeated.",
)
@click.option(
    "--output",
    type=click.Path(file_okay=False, path_type=Path),
    required=True,
    help="Folder of the results.",
)
def sweep(scenes: list[Scene], seeds: int, jobs: int, of: tuple[str, ...], output: Path) -> None:
    """Simulate surfaces for several lengths, directions and constants.

    Options of a scene take several values, --n-p 2,4,8 or --law coulomb,slip_weakening, or the ends
    and the number of evenly spaced ones, --step 5e-9:2e-8:4. The output folder receives the table
    realisations.parquet, and a figure against each quantity with several values.
    """
    interval = min(scene.sample_interval for scene in scenes)  # as in a study, one for all
    scenes, tables = [replace(scene, sample_interval=interval) for scene in scenes], []
    for scene in tqdm(scenes, unit="ensemble"):
        how: dict[str, Any] = {"prelude": prelude_of(scene), "progress": False}
        runs = realisations(partial(realise, scene, **how), seeds, jobs)
        about = identity(scene)
        rows = [about | columns_of(run, scene, seed) for seed, run in enumerate(runs)]
        tables.append(rows_to_table(rows, SUMMARY))
    table = pa.concat_tables(tables)
    write(table, output / "realisations.parquet", made_by(SIMULATE))
    for over in axes(scenes):
        found = lines(table.to_pylist(), over)
        picture = plot.draw(found, over, of)
        save(picture, output / f"{over}.png", plot.caption(found))
    click.echo(f"springblock table {output} shows the means, and with --changes how they change")
