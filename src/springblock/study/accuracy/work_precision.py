"""Error against work: the rows of results/tables/work_precision.parquet.

Two comparisons, each for a flat, a pillared and a grooved scene:

reference  single runs against the event-located reference solution, run by run; t_det up to the
           horizon, beyond which no step makes single runs agree; and `order`, how their errors
           fall with the step;
paired     ensembles of 16 x 16 blocks with the paper's step against the leapfrog at a fine step
           with the same seeds, and `scatter`, the spread from seed to seed: what the paper says of
           its step is tested on them. `production` has ensembles at the study's own size.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TypeVar

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.io.rows import Row, limits
from springblock.io.schemas import N_BLOCKS, column, numbers, texts
from springblock.model.defaults import PAPER_STEP
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.simulation.prelude import Prelude, compute_prelude
from springblock.simulation.run import Realisation
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import INTEGRATORS
from springblock.study.accuracy import plain_rk4
from springblock.study.accuracy.conventions import (
    HORIZON_NUDGE,
    MEANS,
    ORDERED,
    PLAIN,
    SAMPLE_INTERVAL,
    half_width,
)
from springblock.study.accuracy.solutions import SMALL, Solution, solutions

SCHEMA = pa.schema(
    [
        *texts(
            comparison="reference, order, paired or scatter",
            scene="flat, pillared or grooved",
        ),
        N_BLOCKS,
        *texts(integrator=f"{', '.join(INTEGRATORS)} or {PLAIN}"),
        *numbers("s", step="integration step h"),
        *texts(quantity="quantity to which the error refers"),
        *numbers(
            "1",
            error="reference: root mean square over the realisations of the relative error (t_det "
            "and t_avg relative to t_max) or, where quantity is horizon reached, root of the share "
            "of runs that reach the horizon. order: mean slope of log error over log step, from "
            "the step to the finest. paired: relative bias. scatter: 0; the interval is that of "
            "the mean over the seeds",
            ci_low="lower limit of the 95 % t interval; reference: error",
            ci_high="upper limit; reference: error",
        ),
        column("realisations", pa.int32(), "1", "number of seeds"),
        *numbers("s", cpu_seconds="median CPU time of one realisation; order, scatter: 0"),
        *numbers("1", force_evaluations="mean number per realisation; order, scatter: 0"),
    ]
)


#: Surfaces of ensembles, and seeds: enough to resolve a bias of 0.1 %.
ENSEMBLES = {
    "flat": (Pattern.flat(16), 100),
    "pillared": (Pattern.pillars(16, 4, 4), 100),
    "grooved": (Pattern.pillars(16, 8, 8).grooved(2, 1), 200),
}
STEPS = (8e-8, 4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9, 1e-9)
SETTLED_STEPS = STEPS[3:]  #: errors fall with one order, on patterned surfaces too
PLAIN_STEPS = STEPS[:4]  #: enough to show that errors hardly decrease
#: By one step of each method.
FORCE_EVALUATIONS = {name: each.force_evaluations for name, each in INTEGRATORS.items()}
FORCE_EVALUATIONS[PLAIN] = 4
PAIRED_SEEDS = {"rk4": 50, PLAIN: 20}  #: at most; fewer where a step costs more
FINE_STEP = 5e-9  #: at second order, it has a quarter of the error of the paper's
Errors = dict[str, Array]  #: by quantity, one for each realisation
Computed = Realisation | Solution
Timed = tuple[Computed, float]  #: a run and its CPU time, s
Cost = tuple[float, float]  #: median CPU time, s, and mean force evaluations of a realisation
Result = TypeVar("Result")


def run_errors(run: Computed, exact: Solution, until: float) -> dict[str, float]:
    """Return the relative errors of one run; times relative to the exact t_max.

    `until` is the horizon, s, up to which single runs can be compared.
    """
    upto = exact.time < exact.t_max
    force = np.abs(run.force[: len(exact.force)] - exact.force)[upto].max() / exact.force.max()
    both = np.isfinite(exact.t_det) & np.isfinite(run.t_det)
    shift = (run.t_det - exact.t_det) / exact.t_max
    return {
        "force": float(force),
        "static_friction": run.static_friction / exact.static_friction - 1.0,
        "t_max": run.t_max / exact.t_max - 1.0,
        "t_avg": (run.t_avg - exact.t_avg) / exact.t_max,
        "t_det before horizon": root_mean_square(shift[both & (exact.t_det < until)]),
        "horizon reached": float(np.isfinite(until)),
    }


def root_mean_square(values: Array) -> float:
    """Return the root of the mean square; zero without values."""
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def timed(solve: Callable[[], Result]) -> tuple[Result, float]:
    """Return the result of `solve`, and its CPU time, s."""
    start = time.process_time()
    return solve(), time.process_time() - start


def setup_of(integrator: str, step: float) -> Setup:
    """Return the numerical parameters of a run."""
    return Setup(integrator=integrator, step=step, sample_interval=SAMPLE_INTERVAL)


def solve_with(
    integrator: str,
    step: float,
    surface: Surface,
    duration: float = 0.0,
    prelude: Prelude | None = None,
) -> Computed:
    """Compute one realisation by any of the three methods.

    Without a duration, s, the integrators stop once the surface slides; the plain method needs one.
    """
    if integrator == PLAIN:
        return plain_rk4.solve(surface, duration, step, SAMPLE_INTERVAL)
    setup = setup_of(integrator, step)
    return simulate(surface, setup, duration=duration or None, prelude=prelude)


def cost_of(integrator: str, runs: Sequence[Timed]) -> Cost:
    """Return the cost of a realisation by this integrator."""
    steps = float(np.mean([run.steps for run, _ in runs]))
    seconds = float(np.median([seconds for _, seconds in runs]))
    return seconds, FORCE_EVALUATIONS[integrator] * steps


def single_rows(scene: str) -> Iterator[Row]:
    """All methods and steps against the reference solution."""
    exact, duration = solutions(scene), SMALL[scene].duration
    surfaces = [SMALL[scene].surface(seed) for seed in range(len(exact))]
    horizons = [horizon(*twins(scene, seed)) for seed in range(len(exact))]
    for integrator in FORCE_EVALUATIONS:
        found: dict[float, Errors] = {}
        for step in tqdm(PLAIN_STEPS if integrator == PLAIN else STEPS, desc=integrator):
            runs = [timed(partial(solve_with, integrator, step, s, duration)) for s in surfaces]
            computed = [run for run, _ in runs]
            each = [*map(run_errors, computed, exact, horizons)]
            found[step] = {name: np.array([errors[name] for errors in each]) for name in each[0]}
            cost = cost_of(integrator, runs)
            yield from rows_of("reference", scene, integrator, step, found[step], cost)
        if integrator != PLAIN:
            orders = {name: orders_of(SETTLED_STEPS, found, name) for name in ORDERED}
            yield from rows_of("order", scene, integrator, SETTLED_STEPS[0], orders)


def orders_of(steps: Sequence[float], found: dict[float, Errors], quantity: str) -> Array:
    """Return the order (k,) in which the errors of each of k seeds fall over these steps."""
    rounding = np.finfo(float).eps  # no error is below
    errors = np.array([np.abs(found[step][quantity]) + rounding for step in steps])
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


def paired_rows(scene: str) -> Iterator[Row]:
    """Ensembles at the paper's step against the leapfrog at the fine step, seed by seed."""
    _, seeds = ENSEMBLES[scene]
    fine = ensemble(scene, "leapfrog", FINE_STEP, seeds)
    exact, longest = means_of(fine), max(float(run.time[-1]) for run, _ in fine)
    for integrator in FORCE_EVALUATIONS:
        few = min(seeds, PAIRED_SEEDS.get(integrator, seeds))
        duration = longest if integrator == PLAIN else 0.0
        runs = ensemble(scene, integrator, PAPER_STEP, few, duration)
        means, cost = means_of(runs), cost_of(integrator, runs)
        errors = {name: means[name] / exact[name][:few] - 1.0 for name in MEANS}
        yield from rows_of("paired", scene, integrator, PAPER_STEP, errors, cost)
    spread = {name: values / values.mean() - 1.0 for name, values in exact.items()}
    yield from rows_of("scatter", scene, "leapfrog", FINE_STEP, spread)


def ensemble(
    scene: str, integrator: str, step: float, seeds: int, duration: float = 0.0
) -> list[Timed]:
    """Return one run per seed, with a common prelude where the method has one."""
    contact = ENSEMBLES[scene][0].contact
    prelude = None if integrator == PLAIN else compute_prelude(contact, setup_of(integrator, step))
    solve = partial(solve_with, integrator, step, duration=duration, prelude=prelude)
    described = f"{integrator} {step:g}"
    surfaces = (Surface.draw(contact, seed) for seed in tqdm(range(seeds), desc=described))
    return [timed(partial(solve, surface)) for surface in surfaces]


def means_of(runs: Sequence[Timed]) -> Errors:
    """Return the quantities averaged over ensembles, each (seeds,)."""
    return {name: np.array([getattr(run, name) for run, _ in runs]) for name in MEANS}


def twins(scene: str, seed: int) -> tuple[Computed, Computed]:
    """Return a run, and one with each threshold changed by a random share like `HORIZON_NUDGE`."""
    surface, duration = SMALL[scene].surface(seed), SMALL[scene].duration
    change = HORIZON_NUDGE * np.random.default_rng(seed).standard_normal(surface.mu_static.shape)
    nudged = Surface(surface.contact, surface.mu_static * (1.0 + change), surface.mu_dynamic)
    one, other = (solve_with("leapfrog", FINE_STEP, each, duration) for each in (surface, nudged))
    return one, other


def horizon(one: Computed, other: Computed) -> float:
    """Time in s up to which two runs agree on t_det within 0.1 % of t_max; infinite without one."""
    both = np.isfinite(one.t_det) & np.isfinite(other.t_det)
    apart = both & (np.abs(one.t_det - other.t_det) > 1e-3 * one.t_max)
    parting = np.minimum(one.t_det, other.t_det)[apart]
    return float(parting.min()) if parting.size else np.inf


def rows_of(
    comparison: str,
    scene: str,
    integrator: str,
    step: float,
    errors: Errors,
    cost: Cost = (0.0, 0.0),
) -> Iterator[Row]:
    """Summarise the errors of several realisations, a row per quantity, with their cost."""
    small = SMALL[scene].pattern if comparison in ("reference", "order") else ENSEMBLES[scene][0]
    for quantity, values in errors.items():
        count, error, half = len(values), float(values.mean()), 0.0
        if comparison == "reference":
            error = root_mean_square(values)
        else:
            half = half_width(float(values.std(ddof=1)), count)
        yield {
            "comparison": comparison,
            "scene": scene,
            "n_blocks": small.n_blocks,
            "integrator": integrator,
            "step": step,
            "quantity": quantity,
            **limits("error", (error, error - half, error + half), "ci"),
            "realisations": count,
            "cpu_seconds": cost[0],
            "force_evaluations": cost[1],
        }


def measure(part: str) -> Iterator[Row]:
    """Yield the rows of a comparison, of single runs or in pairs, on a scene."""
    comparison, _, scene = part.partition("-")
    return (single_rows if comparison == "reference" else paired_rows)(scene)
