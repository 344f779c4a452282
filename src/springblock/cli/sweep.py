"""springblock sweep: ensembles for several constants and directions, without Snakemake."""

from dataclasses import replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import click
from tqdm import tqdm

from springblock.cli.options import (
    SURFACE,
    by_name,
    code_version,
    defaulted,
    given,
    scene_of,
    with_options,
)
from springblock.cli.simulate import SETUP, batch_table, setup_of
from springblock.io.identity import identity, metadata
from springblock.io.parquet import load, origin_of, read, write
from springblock.io.rows import Row
from springblock.io.schemas import SUMMARY
from springblock.model.direction import normalised
from springblock.model.material import expanded
from springblock.model.scene import COLUMNS, Scene, Varied, in_order
from springblock.plotting import sweep as plot
from springblock.plotting.lines import axes, lines
from springblock.plotting.style import save
from springblock.simulation.scenes import columns_of, prelude_of, realise
from springblock.simulation.setup import Setup
from springblock.simulation.threads import in_threads

_BATCH = 5  #: seeds of one job
_DRAWN = ("static_friction", "t_max", "t_avg")  #: observables of the figures


class Job(NamedTuple):
    """Realisations of one scene with some seeds."""

    scene: Scene
    setup: Setup
    seeds: range
    output: Path  #: folder of the sweep
    duration: float | None  #: s

    @property
    def file(self) -> Path:
        """Return the file of its realisations."""
        name = f"seeds-{self.seeds[0]}-{self.seeds[-1]}.parquet"
        return self.output / "realisations" / self.scene.folder / name

    @property
    def identity(self) -> dict[str, Any]:
        """Return the identity of its realisations."""
        return identity(self.scene, self.setup, self.duration)

    @property
    def metadata(self) -> dict[str, str]:
        """Return the metadata of the file: code and configuration."""
        return metadata(self.identity, code_version("simulate"))

    @property
    def is_done(self) -> bool:
        """Whether the file exists; raise ValueError if it has other runs."""
        if not self.file.exists():
            return False
        if not self.metadata.items() <= origin_of(load(self.file, [])).items():
            other = "runs with other constants or code"
            raise ValueError(f"{self.file} has {other}; choose another folder")
        return True

    def run(self) -> tuple["Job", list[Row]]:
        """Simulate the seeds, and return their rows."""
        scene, rows, begun = self.scene, list[Row](), prelude_of(self.scene, self.setup)
        how = {"prelude": begun, "duration": self.duration, "progress": False}
        for seed in self.seeds:
            run = realise(scene, self.setup, seed, **how)
            rows.append(self.identity | columns_of(run, scene, seed))
        return self, rows


def _varied(pairs: tuple[str, ...]) -> list[Varied]:
    """Return every combination of constants with several values each."""
    lists = {name: text.split(",") for name, text in by_name(pairs).items()}
    values = product(*lists.values())
    return [in_order(dict(zip(lists, each, strict=True))) for each in values]


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
        callback=given(_varied),
        help="Constant with its values: slider_velocity=5e-4,1e-3. Can be repeated.",
    ),
    defaulted(
        "--seeds", type=click.IntRange(1, 10**6), default=10, help="Realisations of each ensemble."
    ),
    click.option(
        "--duration", type=float, help="Simulated time, s; by default until after the force peak."
    ),
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
    vary: list[Varied],
    seeds: int,
    duration: float | None,
    jobs: int,
    output: Path,
    **options: Any,
) -> None:
    """Simulate one surface for several constants and directions.

    The output folder receives the runs, the table realisations.parquet, and a figure against each
    constant with several values. Table and figures cover the runs of this command only; runs that
    are already in the folder are not repeated.
    """
    usual, surface = setup_of(options), scene_of(options, direction="x", varied=())
    scenes = [
        replace(surface, direction=direction, varied=_own(varied, usual))
        for varied, direction in product(vary, directions)
    ]
    parts = [range(first, min(first + _BATCH, seeds)) for first in range(0, seeds, _BATCH)]
    setups = {scene: usual.vary(dict(scene.varied)) for scene in scenes}
    interval = min(setup.interval for setup in setups.values())  # as in a study, one for all
    work = [
        Job(scene, replace(setups[scene], sample_interval=interval), part, output, duration)
        for scene, part in product(setups, parts)
    ]
    _run([job for job in work if not job.is_done], jobs)
    table = read([job.file for job in work], SUMMARY)
    table = table.sort_by([(name, "ascending") for name in [*COLUMNS, "seed"]])
    made_by = {"code_version": work[0].metadata["code_version"]}
    write(table, output / "realisations.parquet", made_by)
    for over in axes(scenes):
        found = lines(table.to_pylist(), over)
        picture = plot.draw(found, over, _DRAWN)
        save(picture, output / f"{over}.png", plot.caption(found))
    click.echo(f"springblock table {output} shows the means, and with --changes how they change")


def _own(varied: Varied, usual: Setup) -> Varied:
    """Return constants of a scene without those that all scenes have."""
    known = expanded(usual.constants)
    return tuple((name, value) for name, value in varied if value != known.get(name))


def _run(work: list[Job], jobs: int) -> None:
    """Run all jobs in parallel, with a count of realisations, and write their files."""
    with tqdm(total=sum(len(job.seeds) for job in work), unit="realisation") as bar:
        for job, rows in in_threads([job.run for job in work], jobs):
            write(batch_table(rows), job.file, job.metadata)
            bar.update(len(rows))
