"""springblock sweep: ensembles for several constants, lengths and directions, without Snakemake."""

from dataclasses import replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import click
import pyarrow as pa
from tqdm import tqdm

from springblock.analysis.runs import realisations
from springblock.cli.options import (
    SURFACE,
    defaulted,
    given,
    scene_of,
    value_lists,
    with_options,
)
from springblock.cli.simulate import SETUP, setup_of
from springblock.io.identity import identity
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import SUMMARY
from springblock.model.direction import normalised
from springblock.model.material import expanded
from springblock.model.scene import COLUMNS, gap_of, grid_of, in_order
from springblock.plotting import sweep as plot
from springblock.plotting.lines import axes, lines
from springblock.plotting.style import save
from springblock.provenance import made_by
from springblock.simulation.scenes import columns_of, prelude_of, realise

_DRAWN = ("static_friction", "t_max", "t_avg")  #: observables of the figures
_SWEPT = [
    defaulted(
        "--direction",
        "directions",
        default="x",
        callback=given(lambda text: [normalised(each) for each in text.split(",")]),
        help="Sliding directions, separated by commas: x, y or degrees from x.",
    ),
    click.option(
        "--vary",
        multiple=True,
        callback=given(value_lists),
        help="Constant or length with its values, n_p=2,4,8, or with the ends and the number of "
        "evenly spaced ones, step=5e-9:2e-8:4. Can be repeated.",
    ),
    defaulted("--seeds", type=click.IntRange(1), default=10, help="Realisations of each ensemble."),
    click.option("--duration", type=float, help="Simulated time, s; as for `simulate`."),
    defaulted("--jobs", type=click.IntRange(1), default=1, help="Cores to use."),
    click.option(
        "--output",
        type=click.Path(file_okay=False, path_type=Path),
        required=True,
        help="Folder of the results.",
    ),
]


@click.command("sweep")
@partial(with_options, [*SURFACE, *_SWEPT, *SETUP])
def sweep(
    directions: list[str],
    vary: dict[str, list[Any]],
    seeds: int,
    duration: float | None,
    jobs: int,
    output: Path,
    **options: Any,
) -> None:
    """Simulate one surface for several constants, lengths and directions.

    The output folder receives the table realisations.parquet, and a figure against each quantity
    with several values.
    """
    usual, scenes = setup_of(options), []
    for each, direction in product(grid_of(vary), directions):
        size = {name: value for name, value in each.items() if name in options}
        size["n_s"] = gap_of(size.get("n_s", options["n_s"]), size.get("n_p", options["n_p"]))
        known = expanded(usual.constants)  # which a scene does not repeat
        constants = in_order({name: each[name] for name in each.keys() - size.keys()})
        own = [(name, value) for name, value in constants if value != known.get(name)]
        scenes.append(scene_of({**options, **size}, direction=direction, varied=tuple(own)))
    setups = {scene: usual.vary(dict(scene.varied)) for scene in scenes}
    interval = min(setup.interval for setup in setups.values())  # as in a study, one for all
    tables = []
    for scene, setup in tqdm(setups.items(), unit="ensemble"):
        setup = replace(setup, sample_interval=interval)
        how: dict[str, Any] = {
            "prelude": prelude_of(scene, setup),
            "duration": duration,
            "progress": False,
        }
        runs = realisations(partial(realise, scene, setup, **how), seeds, jobs)
        about = identity(scene, setup, duration)
        rows = [about | columns_of(run, scene, seed) for seed, run in enumerate(runs)]
        tables.append(rows_to_table(rows, SUMMARY))
    table = pa.concat_tables(tables).sort_by([(name, "ascending") for name in [*COLUMNS, "seed"]])
    write(table, output / "realisations.parquet", made_by("simulate"))
    for over in axes(setups):
        found = lines(table.to_pylist(), over)
        picture = plot.draw(found, over, _DRAWN)
        save(picture, output / f"{over}.png", plot.caption(found))
    click.echo(f"springblock table {output} shows the means, and with --changes how they change")
