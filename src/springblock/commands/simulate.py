"""springblock simulate: a batch of realisations of one scene."""

import hashlib
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import click
from tqdm import tqdm

from springblock.asperities import draw_friction
from springblock.commands.options import OUTPUT, one_sentence, scene_options
from springblock.material import Material
from springblock.realisation import SimulationError, simulate
from springblock.scene import Scene
from springblock.solver import INTEGRATORS
from springblock.sources import code_version
from springblock.tables import BATCH, batch_row, rows_to_table, write


def _constant(
    context: click.Context, parameter: click.Parameter, values: tuple[str, ...]
) -> dict[str, float]:
    """Read name=value pairs."""
    constants = {}
    for value in values:
        name, _, number = value.partition("=")
        if name not in dict(Material().items()):
            known = ", ".join(key for key, _ in Material().items())
            raise click.BadParameter(f"{name!r} is no constant; there are {known}")
        try:
            constants[name] = float(number)
        except ValueError:
            raise click.BadParameter(f"{name} must be a number, not {number!r}") from None
    return constants


@click.command("simulate")
@scene_options
@click.option("--first-seed", type=int, required=True)
@click.option("--last-seed", type=int, required=True, help="Itself included.")
@click.option("--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog")
@click.option("--step", type=float, default=2e-8, show_default=True, help="h, s.")
@click.option("--sample-interval", type=float, default=2e-7, show_default=True, help="s.")
@click.option("--duration", type=float, help="s; by default until the scene has shown its peak.")
@click.option(
    "--material", multiple=True, callback=_constant, help="A constant, as youngs_modulus=1e7."
)
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def simulate_batch(
    first_seed: int,
    last_seed: int,
    integrator: str,
    step: float,
    sample_interval: float,
    duration: float | None,
    material: dict[str, float],
    output: Path,
    **lengths: Any,
) -> None:
    """Run the realisations of one scene from --first-seed to --last-seed."""
    if last_seed < first_seed:
        raise click.BadParameter(f"{last_seed} comes before --first-seed {first_seed}")
    with one_sentence():
        scene = Scene(**lengths)
        constants = replace(Material(), **material)
        how = {"integrator": integrator, "step": step, "sample_interval": sample_interval}
        rows = []
        for seed in tqdm(range(first_seed, last_seed + 1), desc=scene.folder, unit="realisation"):
            coefficients = draw_friction(scene.n_blocks, seed, constants)
            try:
                run = simulate(
                    scene.pattern.contact,
                    *coefficients,
                    material=constants,
                    direction=scene.heading,
                    duration=duration,
                    **how,  # type: ignore[arg-type]
                )
            except SimulationError as error:
                raise SimulationError(f"{scene.folder}, seed {seed}: {error}") from error
            rows.append(batch_row(scene, seed, run, sample_interval))
        configuration = {**how, "duration": duration, **dict(constants.items())}
        write(rows_to_table(rows, BATCH), output, _metadata(configuration))


def _metadata(configuration: dict[str, Any]) -> dict[str, str]:
    text = json.dumps(configuration, sort_keys=True)
    return {
        "code_version": code_version(__name__),
        "configuration": text,
        "configuration_digest": hashlib.sha256(text.encode()).hexdigest()[:16],
    }


@click.command("compile")
def compile_kernels() -> None:
    """Compile the solver once, so that no job has to."""
    surface = Scene(n_blocks=4).pattern.contact
    for integrator in INTEGRATORS:
        simulate(surface, *draw_friction(4, 0), integrator=integrator, duration=2e-7)
        click.echo(f"{integrator} is compiled")
