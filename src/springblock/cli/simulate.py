"""springblock prelude and simulate: a batch of realisations of one scene."""

from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import click
import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.cli.options import INPUT, Output, defaulted, scene_options
from springblock.files import MENDING, whole_file
from springblock.io.identity import identity, metadata
from springblock.io.parquet import rows_to_table, write
from springblock.io.rows import Row
from springblock.io.schemas import BATCH, SNAPSHOTS
from springblock.model.material import LAWS, Material
from springblock.model.scene import Scene
from springblock.model.surface import Surface
from springblock.provenance import SIMULATE, made_by, same_code
from springblock.simulation.fields import Fields, import_xarray
from springblock.simulation.prelude import Prelude, compute_prelude
from springblock.simulation.scenes import columns_of, prelude_of, realise, setup_of
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import INTEGRATORS

#: As in the configuration of the study: up to a million seeds, from 1e18 at most.
_MOST_SEEDS = 10**6
_SEED = click.IntRange(0, 10**18 + _MOST_SEEDS)


@click.command("prelude")
@scene_options
@click.option("--output", type=Output(".npz"), required=True, help="File of type .npz.")
def prelude(scene: Scene, output: Path) -> None:
    """Compute the loading of a scene up to its first detachment.

    All seeds of the scene share it.
    """
    version = made_by(SIMULATE)["code_version"]
    replace(prelude_of(scene), code_version=version).save(output)


@click.command("simulate")
@scene_options
@defaulted("--first-seed", type=_SEED, default=0, help="First seed of the friction coefficients.")
@click.option("--last-seed", type=_SEED, help="Last seed (included); by default the first seed.")
@click.option(
    "--fields",
    "field_file",
    type=Output(".nc"),
    help="NetCDF file (.nc) of displacement, velocity, slip, stress and state of blocks at the "
    "--snapshot-times. One seed.",
)
@click.option(
    "--prelude",
    type=INPUT,
    help="File of `springblock prelude` for this scene, to save computing it again.",
)
@click.option("--output", type=Output(".parquet"), required=True, help="Parquet file.")
def simulate_batch(
    scene: Scene,
    first_seed: int,
    last_seed: int | None,
    field_file: Path | None,
    prelude: Path | None,
    output: Path,
) -> None:
    """Simulate realisations of one scene.

    There is one realisation for each seed from --first-seed to --last-seed.
    """
    seeds = range(first_seed, (first_seed if last_seed is None else last_seed) + 1)
    if not seeds:
        raise click.BadParameter(f"--last-seed {last_seed} is below --first-seed {first_seed}")
    if len(seeds) > _MOST_SEEDS:
        raise click.BadParameter(f"{len(seeds)} seeds in a batch; choose up to {_MOST_SEEDS}")
    single = len(seeds) == 1
    _check_fields(field_file, scene.snapshot_times, seeds)
    own, rows = identity(scene), list[Row]()
    metadata(scene)  # refuses code that has changed before it runs for long
    how: dict[str, Any] = {"prelude": prelude and _prelude(prelude), "progress": single}
    for seed in tqdm(seeds, desc=scene.folder, unit="realisation", disable=single or None):
        run = realise(scene, seed, **how)
        rows.append(own | columns_of(run, scene, seed))
    origin = metadata(scene)
    if field_file is not None:
        source = {"source": f"springblock {origin['code_version']}", "seed": str(first_seed)}
        about = source | {"scene": str(scene), "identity": origin["configuration"]}
        _write_fields(run.fields, field_file, about | setup_of(scene).constants)
    write(batch_table(rows), output, origin)
    angle = "" if scene.direction in ("x", "y") else f", sliding at {scene.direction}°"
    click.echo(_in_words(rows) + angle)


def _prelude(file: Path) -> Prelude:
    """Read a prelude, which must have been written by the same code."""
    begun = Prelude.read(file)
    if not same_code(begun.code_version, made_by(SIMULATE)["code_version"]):
        raise ValueError(f"{file} was made by other code, {begun.code_version}; {MENDING}")
    return begun


def _in_words(rows: list[Row]) -> str:
    """Summarise runs: means, and standard errors of several."""
    told = []
    for name, unit, factor in (
        ("static_friction", "", 1),
        ("t_max", " µs", 1e6),
        ("t_avg", " µs", 1e6),
    ):
        values = factor * np.array([row[name] for row in rows], dtype=float)
        error = f" ± {values.std(ddof=1) / np.sqrt(len(rows)):.2g}" if len(rows) > 1 else ""
        told.append(f"{name} {values.mean():.5g}{error}{unit}")
    runs = f" (means of {len(rows)} runs ± standard error)" if len(rows) > 1 else ""
    rising = sum(int(np.argmax(row["force"]) == len(row["force"]) - 1) for row in rows)
    note = f"; at the end the force still increases in {rising} of {len(rows)}" if rising else ""
    return ", ".join(told) + runs + note


def _check_fields(field_file: Path | None, snapshot_times: tuple[float, ...], seeds: range) -> None:
    """Refuse --fields where there is nothing to write, or more than one run."""
    if field_file is None:
        return
    if not snapshot_times:
        raise ValueError(f"--fields {field_file} needs times: give them with --snapshot-times")
    if len(seeds) > 1:
        raise ValueError(f"--fields {field_file} takes one seed, not {len(seeds)}")
    import_xarray()  # refused before the run, not after it


def _write_fields(fields: Fields, file: Path, about: dict[str, Any]) -> None:
    """Write fields as NetCDF, whole or not at all, with attributes of the run: numbers or text."""
    attributes = {
        name: value if isinstance(value, float) else str(value) for name, value in about.items()
    }
    with whole_file(file) as partial:
        fields.to_xarray().assign_attrs(attributes).to_netcdf(partial, engine="scipy")


def batch_table(rows: list[Row]) -> pa.Table:
    """Return the table of a batch, with snapshots if the runs have any."""
    kept = SNAPSHOTS if rows[0]["snapshot_times"] else []
    return rows_to_table(rows, pa.schema([*BATCH, *kept]))


@click.command("compile")
@defaulted(
    "--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog", help="Integrator."
)
@click.option(
    "--law",
    "laws",
    multiple=True,
    help="Law of friction, as for `springblock simulate`; coulomb by default. Can be repeated.",
)
@click.option("--periodic", is_flag=True, help="Also for surfaces with periodic edges.")
def compile_kernels(integrator: str, laws: tuple[str, ...], periodic: bool) -> None:
    """Compile the solver, once for all later runs."""
    for law, edges in product(laws or ["coulomb"], {False, periodic}):
        constants: dict[str, Any] = {LAWS[law]: 1.0} if LAWS.get(law) else {}
        setup = Setup(Material(law=law, **constants), integrator)
        surface = Surface.draw(Scene(n_blocks=4).contact, seed=0, periodic=edges)
        begun = compute_prelude(surface.contact, setup, periodic=edges)
        simulate(surface, setup, prelude=begun, duration=1e-6, snapshot_times=[4e-7])
        kind = "periodic" if edges else "free"
        click.echo(f"compiled: {integrator} with the friction law {law} and {kind} edges")
