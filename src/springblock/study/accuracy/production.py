"""Errors of ensembles at the study's own size: the rows of results/tables/production.parquet.

Ensembles of the study's scenes with N = 120 at several steps, against the leapfrog at the finest
of them with the same seeds. The bias is the mean difference of pairs, which has little of the
scatter from seed to seed; the scatter determines the standard error of an ensemble.
"""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.analysis.correlation import Correlation, fit_tail, side_times
from springblock.analysis.statistics import mean_interval, standard_error
from springblock.io.rows import Row, limits
from springblock.io.schemas import N_BLOCKS, column, numbers, texts
from springblock.model.defaults import STEP
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.run import Realisation
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.study.accuracy.conventions import DELAY, LENGTH, MEANS
from springblock.study.accuracy.work_precision import timed

SCHEMA = pa.schema(
    [
        *texts(scene="flat, pillared or grooved; pulled along x"),
        N_BLOCKS,
        *texts(
            quantity="quantity to which value and errors refer",
            unit="unit of value, scale, deviation and bias: 1, s or blocks",
        ),
        *numbers("s", step="integration step h of the leapfrog"),
        *numbers(
            "see unit",
            value="mean over the realisations; the decay length is fitted to all of them",
            scale="reference of relative errors: the value at the finest step, t_max for "
            "t_max - t_avg",
            deviation="standard deviation over realisations; for the decay length, bootstrap "
            "standard error times the square root of their number",
            bias="value minus that at the finest step, for the same seeds",
            bias_error="standard error of the bias, paired by seed",
            ci_low="lower limit of the 95 % interval of the bias: Student's t; for the decay "
            "length, bootstrap percentiles",
            ci_high="upper limit",
        ),
        column("realisations", pa.int32(), "1", "number of seeds, each at every step"),
        *numbers(
            "s",
            cpu_seconds="median CPU time of one realisation",
            prelude_seconds="CPU time of the prelude, which all share",
        ),
    ]
)

PATTERNS = {
    "flat": Pattern.flat(120),
    "pillared": Pattern.pillars(120, 20, 20),
    "grooved": Pattern.pillars(120, 58, 62).grooved(8, 2),
}
STEPS = (8e-8, 4e-8, 2e-8, 1e-8, 5e-9)
FINEST = STEPS[3:]  #: steps with which ensembles of the coarser ones may be compared
#: A multiple of all steps, near the study's 2e-7 s.
SAMPLE_INTERVAL = 1.6e-7
QUANTITIES = (*MEANS, DELAY)  #: of every realisation
#: Of one run, or of k stacked, (k, ...) each: the quantities, the times along sides as of
#: `side_times`, s (none where pillars are not whole), and the CPU time, s.
Kept = tuple[Array, ...]
UNITS = {"static_friction": "1", LENGTH: "blocks"}  #: of quantities other than times


def measure(part: str, seeds: int = 10, finest_step: float = STEPS[3]) -> Iterator[Row]:
    """Compare ensembles of a scene at steps down to the finest; a row per quantity and step."""
    scene = part.removeprefix("production-")
    if finest_step not in FINEST:
        known = " or ".join(f"{step:g}" for step in FINEST)
        raise ValueError(f"the finest step must be {known} s, not {finest_step:g}")
    pattern, steps = PATTERNS[scene], [step for step in STEPS if step >= finest_step]
    preludes, ensembles = simulate_ensembles(pattern, seeds, steps)
    finest = ensembles[finest_step][0]
    found = {
        (quantity, step): of_mean(values[:, i], finest[:, i])
        for i, quantity in enumerate(QUANTITIES)
        for step, (values, _, _) in ensembles.items()
    }
    sides = {step: sides for step, (_, sides, _) in ensembles.items()}
    if sides[STEP].size:
        found |= {(LENGTH, step): biased for step, biased in of_length(sides).items()}
    for (quantity, step), biased in found.items():
        against = "t_max" if quantity == DELAY else quantity
        yield {
            "scene": scene,
            "n_blocks": pattern.n_blocks,
            "quantity": quantity,
            "unit": UNITS.get(quantity, "s"),
            "step": step,
            **biased,
            "scale": found[against, finest_step]["value"],
            "realisations": seeds,
            "cpu_seconds": float(np.median(ensembles[step][2])),
            "prelude_seconds": preludes[step],
        }


def simulate_ensembles(
    pattern: Pattern, seeds: int, steps: Sequence[float]
) -> tuple[dict[float, float], dict[float, Kept]]:
    """Return the CPU time of the prelude and the results of all seeds, by step.

    Each seed is run with all steps in turn, so that other load on the machine affects all alike.
    """
    setups = {h: Setup(step=h, sample_interval=SAMPLE_INTERVAL) for h in steps}
    compute_prelude(Pattern.flat(4).contact)  # compiled first
    preludes = {h: timed(partial(compute_prelude, pattern.contact, setups[h])) for h in steps}
    kept: dict[float, list[Kept]] = {h: [] for h in steps}
    for seed in tqdm(range(seeds), desc="seeds"):
        surface = Surface.draw(pattern.contact, seed)
        for h, (prelude, _) in preludes.items():
            pull = partial(simulate, surface, setups[h], prelude=prelude)
            kept[h].append(keep(pattern, *timed(pull)))
    seconds = {h: spent for h, (_, spent) in preludes.items()}
    return seconds, {h: tuple(map(np.stack, zip(*kept[h], strict=True))) for h in steps}


def keep(pattern: Pattern, run: Realisation, seconds: float) -> Kept:
    """Return the quantities of a run, the times along sides of whole pillars, and the CPU time."""
    means = [*(getattr(run, name) for name in MEANS), run.t_max - run.t_avg]
    whole = len(pattern.levels) == 1
    sides = side_times([run], pattern, "x")[0] if whole else np.empty(0)
    return np.array(means), sides, np.array(seconds)


def of_mean(values: Array, exact: Array) -> Row:
    """Return a mean over k seeds, (k,), and its bias from that of the same seeds, as columns."""
    differences = values - exact
    return limits("bias", mean_interval(differences), "ci") | {
        "value": float(values.mean()),
        "deviation": float(values.std(ddof=1)),
        "bias_error": float(standard_error(differences)),
    }


def of_length(sides: dict[float, Array]) -> dict[float, Row]:
    """Decay length and its bias by step, from the times along the sides of the same k seeds.

    All steps have the same resamples of seeds, and the range of r and the weights of the fit at
    the default step: only the times differ.
    """
    curves = {step: Correlation(times) for step, times in sides.items()}
    span = slice(1, curves[STEP].last + 1)
    errors = curves[STEP].resampled[:, span].std(axis=0)
    alone = {h: fit_tail(curve.mean[None, span], errors)[0] for h, curve in curves.items()}
    resampled = {h: fit_tail(curve.resampled[:, span], errors) for h, curve in curves.items()}
    found = {}
    for step, times in sides.items():
        differences = resampled[step] - resampled[min(sides)]
        bias = alone[step] - alone[min(sides)], *np.percentile(differences, (2.5, 97.5))
        found[step] = limits("bias", bias, "ci") | {
            "value": float(alone[step]),
            "deviation": float(np.sqrt(len(times)) * resampled[step].std()),
            "bias_error": float(differences.std()),
        }
    return found
