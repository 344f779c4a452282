"""springblock prelude and simulate: a batch of realisations of one scene."""

import json
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any, TypedDict

import click
from tqdm import tqdm

from springblock.asperities import draw_friction
from springblock.commands.options import (
    INPUT,
    OUTPUT,
    one_sentence,
    scene_options,
    with_options,
)
from springblock.material import Material
from springblock.prelude import Prelude
from springblock.realisation import STEP, Realisation, SimulationError, load, simulate
from springblock.scene import Scene
from springblock.solver import INTEGRATORS
from springblock.sources import code_version, configuration_digest
from springblock.tables import BATCH, rows_to_table, write


class How(TypedDict):
    """How a scene is computed, by the keywords of `simulate`."""

    material: Material
    integrator: str
    step: float
    sample_interval: float


def _constants(
    context: click.Context, parameter: click.Parameter, values: tuple[str, ...]
) -> Material:
    """Read name=value pairs; what is not named has the paper's value."""
    constants = dict(Material().items())
    for value in values:
        name, _, number = value.partition("=")
        if name not in constants:
            raise click.BadParameter(f"{name!r} is no constant; there are {', '.join(constants)}")
        try:
            constants[name] = float(number)
        except ValueError:
            raise click.BadParameter(f"{name} must be a number, not {number!r}") from None
    try:
        return Material(**constants)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


_HOW = [
    click.option(
        "--material", multiple=True, callback=_constants, help="A constant: youngs_modulus=1e7."
    ),
    click.option("--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog"),
    click.option("--step", type=float, default=STEP, show_default=True, help="h, s."),
    click.option("--sample-interval", type=float, default=2e-7, show_default=True, help="s."),
]


def run_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a scene and of how to compute it, which the command gets as `how`."""

    @wraps(command)
    def with_how(**options: Any) -> Any:
        how = {key: options.pop(key) for key in How.__annotations__}
        return command(how=how, **options)

    return scene_options(with_options(_HOW, with_how))


def batch_row(scene: Scene, seed: int, run: Realisation, sample_interval: float) -> dict[str, Any]:
    """One row of a batch."""
    return {
        **scene.row,
        "seed": seed,
        "static_friction": run.static_friction,
        "dynamic_friction": run.dynamic_friction,
        "t_max": run.t_max,
        "t_avg": run.t_avg,
        "t_first": run.t_first,
        "energy_error": run.energy.relative_residual,
        "steps": run.steps,
        "sample_interval": sample_interval,
        "force": run.force,
        "detachments": run.detachments,
        "switches": run.switches,
        "t_det": run.t_det.ravel(),
        "normal_force": run.normal_force,
    }


@click.command("prelude")
@run_options
@click.option("--output", type=OUTPUT, required=True, help="File of type .npz.")
def compute_prelude(scene: Scene, how: How, output: Path) -> None:
    """Compute the loading of one scene before its first detachment, for all seeds to share."""
    with one_sentence():
        load(scene.pattern.contact, direction=scene.direction, **how).save(output)


@click.command("simulate")
@run_options
@click.option("--first-seed", type=int, required=True)
@click.option("--last-seed", type=int, required=True, help="Itself included.")
@click.option("--duration", type=float, help="s; by default until the scene has shown its peak.")
@click.option("--prelude", type=INPUT, help="Written by `springblock prelude`; saves time.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def simulate_batch(
    scene: Scene,
    how: How,
    first_seed: int,
    last_seed: int,
    duration: float | None,
    prelude: Path | None,
    output: Path,
) -> None:
    """Run the realisations of one scene from --first-seed to --last-seed."""
    if last_seed < first_seed:
        raise click.BadParameter(f"{last_seed} comes before --first-seed {first_seed}")
    with one_sentence():
        contact, rows = scene.pattern.contact, []
        loaded = None if prelude is None else Prelude.read(prelude)
        for seed in tqdm(range(first_seed, last_seed + 1), desc=scene.folder, unit="realisation"):
            try:
                run = simulate(
                    contact,
                    *draw_friction(scene.n_blocks, seed, how["material"]),
                    direction=scene.direction,
                    duration=duration,
                    prelude=loaded,
                    **how,
                )
            except SimulationError as error:
                raise SimulationError(f"{scene.folder}, seed {seed}: {error}") from error
            rows.append(batch_row(scene, seed, run, how["sample_interval"]))
        constants = dict(how["material"].items())
        configuration = {**how, "material": constants, "duration": duration}
        write(rows_to_table(rows, BATCH), output, _metadata(configuration))


def _metadata(configuration: dict[str, Any]) -> dict[str, str]:
    return {
        "code_version": code_version(__name__),
        "configuration": json.dumps(configuration, sort_keys=True),
        "configuration_digest": configuration_digest(configuration),
    }


@click.command("compile")
@click.option("--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog")
def compile_kernels(integrator: str) -> None:
    """Compile an integrator once, so that no job has to."""
    surface = Scene(n_blocks=4).pattern.contact
    prelude = load(surface, integrator=integrator)
    simulate(surface, *draw_friction(4, 0), integrator=integrator, prelude=prelude)
    click.echo(f"{integrator} is compiled")
