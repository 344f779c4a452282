"""The method, and flat surfaces: isolated precursors, then a front (sections 2 and 3.1)."""

from collections.abc import Iterator, Mapping
from itertools import product
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.statistics import students_t
from springblock.io.records import Record
from springblock.io.rows import select
from springblock.model.defaults import PAPER_STEP
from springblock.model.numbers import Array
from springblock.simulation.run import Run
from springblock.study.claims import rule, samples, surfaces
from springblock.study.claims.rule import INF, Case, Evidence, Finding, tests_statement
from springblock.study.claims.samples import on_each, over_runs, share_of, share_on_each

_FRONT = 20  #: blocks that a cluster of a front exceeds
_RATIO = {"youngs_modulus", "pressure"}
_SEEDS = 20  #: of the paper's ensembles


@tests_statement
def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    scatters = select(evidence.precision, comparison="scatter")
    paired = select(evidence.precision, comparison="paired", step=PAPER_STEP)
    methods = dict.fromkeys(row["integrator"] for row in paired)
    for integrator, scatter in product(methods, scatters):
        measured = {name: scatter[name] for name in ("scene", "quantity")}
        for row in select(paired, integrator=integrator, **measured):
            name = f"the relative bias of {row['quantity'].replace('static_f', 'static f')}"
            statistic = f"{name} at h = {PAPER_STEP:.0e} s on the {row['scene']} surface"
            error, case = ensemble_error(scatter), Case(integrator=integrator)
            yield Finding(case, statistic, samples.interval(row, "error"), (-error, error))


def ensemble_error(scatter: Mapping[str, Any], realisations: int = _SEEDS) -> float:
    """Return the standard error of a mean over `realisations`, from a row with another number."""
    half = (scatter["ci_high"] - scatter["ci_low"]) / 2.0
    count = scatter["realisations"]
    deviation = half / students_t(count - 1) * count**0.5
    return float(deviation / realisations**0.5)


@tests_statement
def same_ratio(evidence: Evidence) -> Iterator[Finding]:
    records = evidence.records
    own = {s: surfaces.own_constants(records, s) for s in records if not s.level}
    alike = [scene for scene in own if own[scene].keys() - {"step"} == _RATIO]
    name = "static friction minus that with the paper's material, over the latter"
    for flat, usual in surfaces.flat(records).items():
        for scene in sorted(alike, key=attrgetter("youngs_modulus")):
            runs, modulus = records[scene], scene.youngs_modulus
            case = Case(constant="youngs_modulus", constant_value=modulus)
            ours, paper = (over_runs(samples.static_friction, each) for each in (runs, usual))
            more = samples.difference(ours, paper) / float(paper.mean())
            yield Finding(case, name, more, (-0.05, 0.05), [scene, flat])
            lag = samples.mean(over_runs(samples.relative_lag, runs))
            yield Finding(case, "(t_max - t_avg)/t_max", lag, rule.NEGATIVE, [scene])


def clusters(blocks: surfaces.Mask) -> NDArray[np.integer]:
    """Number the clusters of blocks, joined by sides and corners, from 1 on; 0 elsewhere."""
    from scipy.ndimage import label  # slow to import

    return np.asarray(label(blocks, structure=np.ones((3, 3)))[0])


def single_events(run: Run) -> float:
    """Return the share of the clusters of precursors that are a single block."""
    sizes = np.bincount(clusters(run.t_det < run.t_max).ravel())[1:]
    return float(np.mean(sizes == 1)) if len(sizes) else float("nan")


@tests_statement
def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    blocks = "the share of precursors that detach before all eight neighbours", samples.isolated
    events = "the share of clusters of precursors that are a single block", single_events
    for part, (name, quantity) in {"blocks": blocks, "events": events}.items():
        flat = surfaces.flat(evidence.records)
        yield from share_on_each(flat, name, quantity, rule.MOST, part=part)


def starts_no_front(run: Run) -> float:
    """Return the share of the blocks detached before 0.9 t_max that are not the first of a front.

    Fronts are the clusters of more than 20 blocks when half of the blocks have detached.
    """
    numbers = clusters(run.t_det <= np.nanmedian(run.t_det))  # NaN: never
    first = np.zeros(numbers.shape, bool)
    for number in np.flatnonzero(np.bincount(numbers.ravel()) > _FRONT):
        if number:
            first.flat[np.argmin(np.where(numbers == number, run.t_det, INF))] = True
    return share_of(~first, run.t_det < 0.9 * run.t_max)


@tests_statement
def not_all_nucleate(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of the blocks detached before 0.9 t_max that are not the first of a front"
    return share_on_each(surfaces.flat(evidence.records), name, starts_no_front, (0.1, 0.9))


@tests_statement
def onset(evidence: Evidence) -> Iterator[Finding]:
    name, flat = "the share of blocks detached before t_max", surfaces.flat(evidence.records)
    return on_each(flat, name, samples.before_peak, rule.NEGLIGIBLE)


def strain_left(run: Record, minimum: int) -> tuple[Array, Array]:
    """Return how much of the strain along x at the force minimum is left at each snapshot, (k,).

    As slope of the regression on it; and the standard deviation over that at the minimum.
    """
    strain = np.diff(run.snapshots[:, 0], axis=2).reshape(len(run.snapshots), -1)
    strain = strain - strain.mean(axis=1, keepdims=True)
    left = strain @ strain[minimum] / (strain[minimum] @ strain[minimum])
    return left, strain.std(axis=1) / strain[minimum].std()


def minimum_of(run: Run) -> int:
    """Return the sample of the lowest force after the peak of the onset."""
    force = run.force[run.onset]
    peak = int(np.argmax(force))
    return peak + int(np.argmin(force[peak:]))


@tests_statement
def residual_strains(evidence: Evidence) -> Iterator[Finding]:
    amount = "the standard deviation of the strain at {:.3g} µs, over that at the force minimum"
    share = "the share of the strain at the force minimum that is left at {:.3g} µs"
    for scene, all_runs in surfaces.flat(evidence.records).items():
        runs = [run for run in all_runs if len(run.snapshots)]
        if not runs:
            continue
        times = runs[0].snapshot_times
        minima = [run.time[minimum_of(run)] for run in runs]
        minimum = int(np.abs(times - np.mean(minima)).argmin())
        left, scatter = np.array([strain_left(run, minimum) for run in runs]).transpose(1, 2, 0)
        before, after = times < min(run.t_max for run in runs), times > times[minimum]
        for part, statistic, values, claimed, when in (
            ("the appearance of residual strains", amount, scatter, (-INF, 1.0), before),
            ("the removal of the strains at the minimum", share, left, rule.NEGLIGIBLE, after),
            ("the removal of all strains", amount, scatter, rule.FEWER_THAN_HALF, after),
        ):
            for time, sample in zip(1e6 * times[when], values[when], strict=True):
                name, found = statistic.format(time), samples.mean(sample)
                yield Finding(Case(part=part), name, found, claimed, [scene])


@tests_statement
def peak_before_average(evidence: Evidence) -> Iterator[Finding]:
    flat = surfaces.flat(evidence.records)
    return on_each(flat, "t_max - t_avg", samples.lag, rule.NEGATIVE, "s")
