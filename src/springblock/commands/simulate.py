"""springblock prelude and simulate: a batch of realisations of one scene."""

import json
from collections.abc import Callable
from dataclasses import asdict, fields
from functools import wraps
from pathlib import Path
from typing import Any

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
from springblock.defaults import SAMPLE_INTERVAL, STEP
from springblock.material import Material
from springblock.prelude import Prelude, compute_prelude
from springblock.realisation import Realisation
from springblock.scene import TEXTS, Scene
from springblock.setup import Setup
from springblock.simulation import SimulationError, simulate
from springblock.solver import INTEGRATORS
from springblock.sources import code_version, configuration_digest
from springblock.tables import BATCH, rows_to_table, write


def _constants(
    context: click.Context, parameter: click.Parameter, values: tuple[str, ...]
) -> Material:
    """Read name=value pairs; what is not named has the paper's value."""
    constants: dict[str, Any] = dict(Material().items())
    for value in values:
        name, _, number = value.partition("=")
        if name not in constants:
            raise click.BadParameter(f"{name!r} is no constant; there are {', '.join(constants)}")
        try:
            constants[name] = number if name in TEXTS else float(number)
        except ValueError:
            raise click.BadParameter(f"{name} must be a number, not {number!r}") from None
    try:
        return Material(**constants)
    except ValueError as error:
        raise click.BadParameter(str(error)) from None


_SETUP = [
    click.option(
        "--material", multiple=True, callback=_constants, help="A constant: youngs_modulus=1e7."
    ),
    click.option("--integrator", type=click.Choice(list(INTEGRATORS)), default="leapfrog"),
    click.option("--step", type=float, default=STEP, show_default=True, help="h, s."),
    click.option(
        "--sample-interval", type=float, default=SAMPLE_INTERVAL, show_default=True, help="s."
    ),
]


def setup_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a scene and of how to compute it, which the command gets as `setup`."""

    @wraps(command)
    def with_setup(*, scene: Scene, **options: Any) -> Any:
        given = {field.name: options.pop(field.name) for field in fields(Setup)}
        with one_sentence():
            setup = Setup(**given).vary(dict(scene.varied))
        return command(scene=scene, setup=setup, **options)

    return scene_options(with_options(_SETUP, with_setup))


def coefficients(scene: Scene, seed: int, material: Material) -> tuple[Any, Any]:
    """mu_static and mu_dynamic, (N_y, N_x) each: drawn, unless the scene has them from files."""
    mu_static, mu_dynamic = draw_friction(scene.shape, seed, material, scene.is_periodic)
    of_static, of_dynamic = scene.mu_static_field, scene.mu_dynamic_field
    return (
        mu_static if of_static is None else of_static.values,
        mu_dynamic if of_dynamic is None else of_dynamic.values,
    )


def batch_row(scene: Scene, setup: Setup, seed: int, run: Realisation) -> dict[str, Any]:
    """One row of a batch."""
    return {
        **scene.row,
        **setup.constants,
        "seed": seed,
        "static_friction": run.static_friction,
        "dynamic_friction": run.dynamic_friction,
        "t_max": run.t_max,
        "t_avg": run.t_avg,
        "t_first": run.t_first,
        "energy_error": run.energy.relative_residual,
        "steps": run.steps,
        "force": run.force,
        "detachments": run.detachments,
        "switches": run.switches,
        "t_det": run.t_det.ravel(),
        "normal_force": run.normal_force,
        "contact": scene.contact.ravel(),
    }


_CORES = click.option(
    "--cores", type=int, default=1, show_default=True, help="For one large surface."
)


@click.command("prelude")
@setup_options
@_CORES
@click.option("--output", type=OUTPUT, required=True, help="File of type .npz.")
def prelude(scene: Scene, setup: Setup, cores: int, output: Path) -> None:
    """Compute the loading of one scene before its first detachment, for all seeds to share."""
    with one_sentence():
        known = scene.mu_static_field and scene.mu_static_field.values
        how = {"mu_static": known, "periodic": scene.is_periodic, "cores": cores, **vars(setup)}
        compute_prelude(scene.contact, direction=scene.direction, **how).save(output)


@click.command("simulate")
@setup_options
@click.option("--first-seed", type=int, required=True)
@click.option("--last-seed", type=int, required=True, help="Itself included.")
@click.option("--duration", type=float, help="s; by default until the scene has shown its peak.")
@click.option("--prelude", type=INPUT, help="Written by `springblock prelude`; saves time.")
@_CORES
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def simulate_batch(
    scene: Scene,
    setup: Setup,
    first_seed: int,
    last_seed: int,
    duration: float | None,
    prelude: Path | None,
    cores: int,
    output: Path,
) -> None:
    """Run the realisations of one scene from --first-seed to --last-seed."""
    if last_seed < first_seed:
        raise click.BadParameter(f"{last_seed} comes before --first-seed {first_seed}")
    with one_sentence():
        contact, rows = scene.contact, []
        loaded = None if prelude is None else Prelude.read(prelude)
        for seed in tqdm(range(first_seed, last_seed + 1), desc=scene.folder, unit="realisation"):
            try:
                run = simulate(
                    contact,
                    *coefficients(scene, seed, setup.material),
                    direction=scene.direction,
                    duration=duration,
                    prelude=loaded,
                    cores=cores,
                    periodic=scene.is_periodic,
                    **vars(setup),
                )
            except SimulationError as error:
                raise SimulationError(f"{scene.folder}, seed {seed}: {error}") from error
            rows.append(batch_row(scene, setup, seed, run))
        configuration = {**asdict(setup), "duration": duration}
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
    prelude = compute_prelude(surface, integrator=integrator)
    simulate(surface, *draw_friction(4, 0), integrator=integrator, prelude=prelude)
    click.echo(f"{integrator} is compiled")
