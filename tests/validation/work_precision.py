"""Error against run time: the rows of results/tables/work_precision.parquet.

Three comparisons, each for a flat, a pillared and a grooved scene:

reference  single runs against the event-located reference solution, run by run;
paired     ensembles against the leapfrog at a fine step with the same seeds: what is left on the
           mean where single runs no longer agree; and `scatter`, the spread from seed to seed;
twin       single runs against themselves with thresholds nudged by a little: the horizon beyond
           which no step makes single runs agree.

Call with `python -m validation.work_precision` from the folder tests.
"""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import click
import numpy as np
import pyarrow as pa
from scipy.stats import spearmanr, t
from tqdm import tqdm

from springblock import Pattern, compute_prelude, draw_friction, simulate
from springblock.solver import INTEGRATORS
from springblock.sources import code_version
from springblock.tables import column, read, rows_to_table, write
from validation import plain_rk4, reference

SCHEMA = pa.schema(
    [
        column("comparison", pa.string(), "1", "reference, paired, scatter or twin"),
        column("scene", pa.string(), "1", "flat, pillared or grooved"),
        column("n_blocks", pa.int32(), "blocks", "side N of the surface"),
        column("integrator", pa.string(), "1", "leapfrog, rk4 or plain rk4"),
        column("step", pa.float64(), "s", "integration step h"),
        column("nudge", pa.float64(), "1", "relative change of the thresholds of a twin; else 0"),
        column("quantity", pa.string(), "1", "what the error is of"),
        column(
            "error",
            pa.float64(),
            "1",
            "reference and twin: root mean square over the realisations of the relative error; "
            "t_det and t_avg relative to t_max; order: 1 - rank correlation. paired: relative bias",
        ),
        column("ci_low", pa.float64(), "1", "paired: lower end of the 95 % t interval; else error"),
        column("ci_high", pa.float64(), "1", "paired: upper end; else error"),
        column("worst", pa.float64(), "1", "largest modulus among the realisations"),
        column("realisations", pa.int32(), "1", "number of seeds"),
        column("cpu_seconds", pa.float64(), "s", "median CPU time of one realisation"),
        column("force_evaluations", pa.float64(), "1", "mean number per realisation"),
    ]
)

#: Scenes small enough for the reference solution, and for paired ensembles.
SINGLES = {
    "flat": Pattern.flat(6),
    "pillared": Pattern.pillars(8, 4, 4),
    "grooved": Pattern.pillars(6, 5, 1).grooved(2, 1),
}
ENSEMBLES = {
    "flat": Pattern.flat(16),
    "pillared": Pattern.pillars(16, 4, 4),
    "grooved": Pattern.pillars(16, 8, 8).grooved(2, 1),
}
DURATION = {"flat": 1.3e-4, "pillared": 3.5e-4, "grooved": 2.0e-4}
STEPS = (8e-8, 4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9, 1e-9)
PLAIN_STEPS = STEPS[:-2]  # long enough to see that it does not converge
SAMPLE_INTERVAL = 8e-8
SEEDS = range(2)
#: Enough to tell a bias of 0.1 % from the scatter; fewer where a step costs four times as much.
PAIRED_SEEDS = {"flat": range(100), "pillared": range(100), "grooved": range(200)}
PAIRED_SEEDS_RK4 = range(50)
PAIRED_STEPS = {"leapfrog": (8e-8, 4e-8, 2e-8, 1e-8), "rk4": (8e-8, 4e-8)}
FINE_STEP = 2.5e-9
NUDGES = (1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3)
TWIN_STEP = 2.5e-9
#: The nudge whose twins set the horizon; the largest one that is small against any spread.
HORIZON_NUDGE = 1e-5
TWIN_SEEDS = range(3)
PLAIN = "plain rk4"
MEANS = ("static_friction", "t_max", "t_avg")

Errors = dict[str, float]


def run_errors(run: Any, exact: Any, until: float) -> Errors:
    """Relative errors of one run; times relative to the exact t_max.

    `until` is the horizon, s, up to which single runs can be compared.
    """
    upto = exact.time < exact.t_max
    force = np.abs(run.force[: len(exact.force)] - exact.force)[upto].max() / exact.force.max()
    both = np.isfinite(exact.t_det) & np.isfinite(run.t_det)
    shift = (run.t_det - exact.t_det) / exact.t_max
    before_peak, before_horizon = (both & (exact.t_det < end) for end in (exact.t_max, until))
    return {
        "force": float(force),
        "static_friction": run.static_friction / exact.static_friction - 1.0,
        "t_max": run.t_max / exact.t_max - 1.0,
        "t_avg": (run.t_avg - exact.t_avg) / exact.t_max,
        "t_det before peak": root_mean_square(shift[before_peak]),
        "t_det before horizon": root_mean_square(shift[before_horizon]),
        "horizon": until / exact.t_max,
        "order": 1.0 - float(spearmanr(run.t_det[both], exact.t_det[both]).statistic),
    }


def root_mean_square(values: np.ndarray) -> float:
    """Zero for no values at all."""
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def mean_errors(run: Any, exact: Any) -> Errors:
    """Relative errors of what ensembles are used for."""
    return {name: float(getattr(run, name) / getattr(exact, name) - 1.0) for name in MEANS}


def timed(solve: Callable[[], Any]) -> tuple[Any, float]:
    """Return what `solve` returns, and the CPU seconds that it took."""
    start = time.process_time()
    return solve(), time.process_time() - start


def solve_with(integrator: str, step: float, pattern: Pattern, mu: Any, duration: float) -> Any:
    """One realisation by any of the three methods."""
    if integrator == PLAIN:
        return plain_rk4.solve(pattern.contact, *mu, duration, step, SAMPLE_INTERVAL)
    return simulate(
        pattern.contact,
        *mu,
        integrator=integrator,
        step=step,
        duration=duration,
        sample_interval=SAMPLE_INTERVAL,
    )


def evaluations(integrator: str, steps: float) -> float:
    """Force evaluations of so many steps."""
    return steps * (4 if integrator == PLAIN else INTEGRATORS[integrator].FORCE_EVALUATIONS)


def single_rows(scene: str) -> Iterator[dict[str, Any]]:
    """All methods and steps against the reference solution."""
    pattern, duration = SINGLES[scene], DURATION[scene]
    exact = [
        reference.solve(
            pattern.contact,
            *draw_friction(pattern.n_blocks, seed),
            duration=duration,
            sample_interval=SAMPLE_INTERVAL,
        )
        for seed in tqdm(SEEDS, desc=f"{scene}, reference")
    ]
    horizons = [horizon(*twins(scene, seed, HORIZON_NUDGE)) for seed in SEEDS]
    for integrator in (*INTEGRATORS, PLAIN):
        for step in tqdm(PLAIN_STEPS if integrator == PLAIN else STEPS, desc=integrator):
            errors, seconds, steps = [], [], []
            for seed, solution, until in zip(SEEDS, exact, horizons, strict=True):
                mu = draw_friction(pattern.n_blocks, seed)
                job = (integrator, step, pattern, mu, duration)
                run, spent = timed(lambda job=job: solve_with(*job))
                errors.append(run_errors(run, solution, until))
                seconds.append(spent)
                steps.append(run.steps)
            cost = (float(np.median(seconds)), evaluations(integrator, float(np.mean(steps))))
            yield from rows_of("reference", scene, pattern, integrator, step, 0.0, errors, cost)


def paired_rows(scene: str) -> Iterator[dict[str, Any]]:
    """Ensembles of both integrators against the leapfrog at the fine step, seed by seed."""
    pattern, seeds = ENSEMBLES[scene], PAIRED_SEEDS[scene]
    exact, _, _ = ensemble(pattern, "leapfrog", FINE_STEP, seeds)
    for integrator, steps in PAIRED_STEPS.items():
        few = PAIRED_SEEDS_RK4 if integrator == "rk4" else seeds
        for step in steps:
            runs, seconds, taken = ensemble(pattern, integrator, step, few)
            errors = [mean_errors(run, fine) for run, fine in zip(runs, exact, strict=False)]
            cost = (seconds, evaluations(integrator, taken))
            yield from rows_of("paired", scene, pattern, integrator, step, 0.0, errors, cost)
    means = {name: np.mean([getattr(run, name) for run in exact]) for name in MEANS}
    spread = [mean_errors(run, SimpleNamespace(**means)) for run in exact]
    yield from rows_of("scatter", scene, pattern, "leapfrog", FINE_STEP, 0.0, spread, (0.0, 0.0))


def ensemble(
    pattern: Pattern, integrator: str, step: float, seeds: range
) -> tuple[list[Any], float, float]:
    """Runs of these seeds, the median CPU seconds of one, and its mean number of steps."""
    how = {"integrator": integrator, "step": step, "sample_interval": SAMPLE_INTERVAL}
    prelude = compute_prelude(pattern.contact, **how)  # type: ignore[arg-type]
    outcomes = [
        timed(
            lambda seed=seed: simulate(
                pattern.contact,
                *draw_friction(pattern.n_blocks, seed),
                prelude=prelude,
                **how,  # type: ignore[arg-type]
            )
        )
        for seed in tqdm(seeds, desc=f"{integrator} {step:g}")
    ]
    runs = [run for run, _ in outcomes]
    seconds = float(np.median([spent for _, spent in outcomes]))
    return runs, seconds, float(np.mean([run.steps for run in runs]))


def twin_rows(scene: str) -> Iterator[dict[str, Any]]:
    """Runs against themselves with thresholds changed by a little, at a fine step."""
    pattern, duration, step = SINGLES[scene], DURATION[scene], TWIN_STEP
    for nudge in tqdm(NUDGES, desc=f"{scene}, twins"):
        errors, seconds, steps = [], [], []
        for seed in TWIN_SEEDS:
            (one, other), spent = timed(lambda seed=seed, nudge=nudge: twins(scene, seed, nudge))
            errors.append(run_errors(other, one, horizon(one, other)))
            seconds.append(spent / 2.0)
            steps.append(duration / step)
        cost = (float(np.median(seconds)), float(np.mean(steps)))
        yield from rows_of("twin", scene, pattern, "leapfrog", step, nudge, errors, cost)


def twins(scene: str, seed: int, nudge: float) -> tuple[Any, Any]:
    """A run, and one with each threshold changed by a random share of the size of `nudge`."""
    pattern = SINGLES[scene]
    mu_static, mu_dynamic = draw_friction(pattern.n_blocks, seed)
    change = 1.0 + nudge * np.random.default_rng(seed).standard_normal(mu_static.shape)
    runs = [
        solve_with(
            "leapfrog", TWIN_STEP, pattern, (mu_static * factor, mu_dynamic), DURATION[scene]
        )
        for factor in (1.0, change)
    ]
    return runs[0], runs[1]


def horizon(one: Any, other: Any) -> float:
    """Time in s up to which two runs agree on t_det within 0.1 % of t_max; t_max at most."""
    both = np.isfinite(one.t_det) & np.isfinite(other.t_det)
    apart = both & (np.abs(one.t_det - other.t_det) > 1e-3 * one.t_max)
    parting = np.minimum(one.t_det, other.t_det)[apart]
    return min(one.t_max, float(parting.min()) if parting.size else np.inf)


def rows_of(
    comparison: str,
    scene: str,
    pattern: Pattern,
    integrator: str,
    step: float,
    nudge: float,
    errors: list[Errors],
    cost: tuple[float, float],
) -> Iterator[dict[str, Any]]:
    """Summarise the errors of several realisations, a row per quantity."""
    for quantity in errors[0]:
        values = np.array([error[quantity] for error in errors])
        count = len(values)
        if comparison in ("paired", "scatter"):
            error = float(values.mean())
            half = t.ppf(0.975, count - 1) * float(values.std(ddof=1)) / np.sqrt(count)
        else:
            error, half = float(np.sqrt(np.mean(values**2))), 0.0
        yield {
            "comparison": comparison,
            "scene": scene,
            "n_blocks": pattern.n_blocks,
            "integrator": integrator,
            "step": step,
            "nudge": nudge,
            "quantity": quantity,
            "error": error,
            "ci_low": error - half,
            "ci_high": error + half,
            "worst": float(np.abs(values).max()),
            "realisations": count,
            "cpu_seconds": cost[0],
            "force_evaluations": cost[1],
        }


COMPARISONS = {"reference": single_rows, "paired": paired_rows, "twin": twin_rows}


@click.group()
def main() -> None:
    """Error against run time."""


@main.command()
@click.option("--comparison", type=click.Choice(list(COMPARISONS)), required=True)
@click.option("--scene", type=click.Choice(list(SINGLES)), required=True)
@click.option("--output", type=click.Path(path_type=Path), required=True)
def compare(comparison: str, scene: str, output: Path) -> None:
    """Make one comparison on one scene."""
    save(rows_to_table(list(COMPARISONS[comparison](scene)), SCHEMA), output)


@main.command()
@click.argument("parts", type=click.Path(exists=True, path_type=Path), nargs=-1, required=True)
@click.option("--output", type=click.Path(path_type=Path), required=True)
def collect(parts: tuple[Path, ...], output: Path) -> None:
    """Collect the parts of the comparison in one table."""
    save(read(parts, SCHEMA), output)


def save(table: pa.Table, output: Path) -> None:
    """Write with the version of the code; there is nothing to configure."""
    write(table, output, {"code_version": code_version("springblock.simulation")})


if __name__ == "__main__":
    main()
