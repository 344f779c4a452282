"""springblock plot, animate and show: pictures of one run, still or moving, and of one surface."""

from pathlib import Path

import click
from matplotlib.figure import Figure

from springblock.cli.options import INPUT, PICTURE, Output, scene_options
from springblock.io.parquet import load
from springblock.io.parquet import read as read_tables
from springblock.io.records import Record, read
from springblock.io.schemas import SUMMARY
from springblock.model.scene import Scene
from springblock.plotting import film, still, sweep
from springblock.plotting.lines import lines
from springblock.plotting.style import save
from springblock.simulation.fields import Fields, import_xarray

_SEED = click.option("--seed", type=int, help="Seed of the run to draw; the first run by default.")


def _chosen(path: Path, seed: int | None) -> Record:
    runs = {run.seed: run for run in read(path)}
    if seed is None:
        return next(iter(runs.values()))
    if seed not in runs:
        held = ", ".join(map(str, runs))
        raise ValueError(f"{path} has no run with seed {seed}; choose one of {held}")
    return runs[seed]


def _fields(files: tuple[Path, ...], options: object) -> Figure:
    """Draw the fields of one file, which holds one run: no options apply."""
    if len(files) > 1 or options:
        raise ValueError(f"{files[0]} holds fields of one run: plot it alone, without an option")
    xarray = import_xarray()
    try:
        with xarray.open_dataset(files[0]) as data:
            fields, about = Fields.from_xarray(data), data.attrs
    except Exception as error:  # of xarray, or of the library that it chooses for the file
        raise ValueError(f"{files[0]} holds no fields of springblock, or is cut short") from error
    return still.plot_fields(fields, f"{about.get('scene')}, seed = {about.get('seed')}")


@click.command("plot")
@click.argument("files", type=INPUT, nargs=-1, required=True)
@_SEED
@click.option(
    "--over", help="What all runs are drawn against: contact_fraction, n_p, gamma, law, mask, ..."
)
@click.option(
    "--of",
    "observables",
    type=click.Choice(list(sweep.OBSERVABLES)),
    multiple=True,
    help="Observable with --over; static_friction by default. Can be repeated.",
)
@click.option(
    "--output",
    "outputs",
    type=PICTURE,
    multiple=True,
    required=True,
    help="PDF, PNG or SVG file. Can be repeated.",
)
def plot(
    files: tuple[Path, ...],
    seed: int | None,
    over: str | None,
    observables: tuple[str, ...],
    outputs: tuple[Path, ...],
) -> None:
    """Draw one run, fields of blocks, or runs against a parameter.

    Of a run: force, detachments, their map, and snapshots if any. Of a file of fields (.nc): maps
    of shear stress and slip. With --over: all runs of FILES, which may be tables of realisations,
    against a parameter.
    """
    if files[0].suffix == ".nc":
        picture = _fields(files, seed is not None or over or observables)
        caption = still.FIELDS_CAPTION
    elif over is None:
        own = load(files[0], ["seed"], ["onset_end"])  # the latter only beside curves
        if len(files) > 1 or len(own.column_names) < 2:
            raise ValueError("name an axis of the runs: --over contact_fraction, n_p or gamma")
        picture, caption = still.plot(_chosen(files[0], seed)), still.RUN_CAPTION
    else:
        rows = read_tables(files, SUMMARY).to_pylist()
        found = lines(rows, over)
        observables = observables or ("static_friction",)
        picture = sweep.draw(found, over, observables)
        caption = sweep.caption(found)
        if left_out := len(rows) - len(found):
            click.echo(f"Left out: {left_out} realisations of surfaces with a single {over}")
    for output in outputs:
        save(picture, output, caption)


@click.command("animate")
@click.argument("run", type=INPUT)
@_SEED
@click.option(
    "--output", type=Output(".gif", ".mp4"), required=True, help="GIF or MP4 file (7.5 s)."
)
def animate(run: Path, seed: int | None, output: Path) -> None:
    """Film one run of a file: detaching blocks and force curve."""
    film.animate(_chosen(run, seed), output)


@click.command("show")
@scene_options
@click.option("--output", type=PICTURE, required=True, help="PDF, PNG or SVG file.")
def show(scene: Scene, output: Path) -> None:
    """Draw the blocks in contact and the sliding direction."""
    picture = still.show(scene.contact, scene.direction, str(scene))
    save(picture, output, still.SURFACE_CAPTION)
