"""The method, and flat surfaces: isolated precursors, then a front (sections 2 and 3.1)."""

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from springblock.accuracy.conventions import PAPER_STEP, PLAIN, ensemble_error
from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import repeatability
from springblock.claims import ranges, samples, surfaces
from springblock.claims.ranges import INF, within
from springblock.claims.rule import Case, Evidence, Finding
from springblock.claims.samples import found_on, mean_over, over_runs, share_of
from springblock.claims.surfaces import Mask, in_files
from springblock.io.records import Record
from springblock.io.rows import select
from springblock.model.asperities import draw_friction
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.run import Run, first_minimum

_AFFECTS = 0.1  #: smallest relative change that counts as an effect
#: Constants that the paper says affect the number of fronts.
_DECISIVE = ("slider_velocity", "pressure", "mu_static_std")
_SMALL = 0.2  #: a small difference, in standard deviations (Cohen 1988)
_PATCH = 5  #: side of the patch taken as a nucleation point, blocks
#: Place of the share of first patches near the edge, by chance, between that of all patches (0) and
#: that of all blocks (1): 0.63 ± 0.03, on periodic surfaces of 120 x 120 blocks that were cut open.
_INWARD = 0.63
_BURST = 0.02  #: window of the detachment rate over t_max
_WINDOW = f"(window: {_BURST} t_max)"
_BEFORE = "the share of blocks detached before t_max"

_on_flat = partial(mean_over, surfaces.flat)


def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    scatter = select(evidence.precision, comparison="scatter")
    errors = {(row["scene"], row["quantity"]): ensemble_error(row) for row in scatter}
    paired = select(evidence.precision, comparison="paired", step=PAPER_STEP)
    source = f"tables/work_precision: comparison = paired, step = {PAPER_STEP:.0e}"
    for integrator in ("leapfrog", "rk4", PLAIN):
        for row in select(paired, integrator=integrator):
            scene, quantity = row["scene"], row["quantity"]
            if (scene, quantity) in errors:
                name = quantity.replace("static_friction", "static friction")
                statistic = (
                    f"the relative bias of {name} at h = {PAPER_STEP:.0e} s on the {scene} surface"
                )
                bias, claimed = samples.interval(row, "error"), within(errors[scene, quantity])
                yield Finding(Case(integrator=integrator), statistic, bias, claimed, source)


def shear_springs(evidence: Evidence) -> Iterator[Finding]:
    if not evidence.records:
        return
    any_ = Material()  # the ratio of stiffnesses is the same for every material
    ratio = any_.k_s / (3.0 / 8.0 * any_.youngs_modulus * any_.spacing**2 / any_.thickness)
    exact, claimed = Estimate(ratio, ratio, ratio), within(_AFFECTS, 1.0)
    yield Finding(Case(), "the paper's K_s over G l²/l_z", exact, claimed, "equations of section 2")


def varied(evidence: Evidence, *names: str) -> list[Scene]:
    """Return, in order, flat surfaces whose only constants of their own are these and the step."""
    own = {s: surfaces.own_constants(evidence.records, s) for s in evidence.records if not s.level}
    alike = [scene for scene in own if own[scene].keys() - {"step"} == set(names)]
    return sorted(alike, key=lambda scene: tuple(own[scene].values()))


@_on_flat("the amplitude of an oscillation at t_max over that at t = 0", ranges.NEGLIGIBLE)
def damping(run: Record) -> float:
    return float(np.exp(-0.5 * run.material.gamma * run.t_max))


def _larger_moduli(evidence: Evidence, paper: Material) -> Iterator[tuple[float, Scene]]:
    """Yield moduli in Pa with the paper's E/P, and their scenes.

    With E and P multiplied by a, the motion is that with v and gamma divided by √a, but √a times
    faster: such scenes count as those with the larger modulus.
    """
    for scene in varied(evidence, "youngs_modulus", "pressure"):
        yield scene.youngs_modulus, scene
    for scene in varied(evidence, "slider_velocity", "gamma"):
        slower = paper.slider_velocity / scene.slider_velocity
        if np.isclose(slower, paper.gamma / scene.gamma):
            yield float(f"{paper.youngs_modulus * slower**2:.3g}"), scene


def same_ratio(evidence: Evidence) -> Iterator[Finding]:
    for flat, runs in surfaces.flat(evidence.records).items():
        for modulus, scene in _larger_moduli(evidence, runs[0].material):
            case = Case(constant="youngs_modulus", constant_value=modulus)
            own, paper = (samples.friction(evidence, s) for s in (scene, flat))
            name, apart = "static friction minus that with the paper's material", within(0.05)
            more = samples.relative(own, paper, paper)
            yield found_on(scene, f"{name}, over the latter", more, apart, case=case, beside=[flat])
            lag = samples.mean(over_runs(samples.relative_lag, evidence.records[scene]))
            yield found_on(scene, "(t_max - t_avg)/t_max", lag, ranges.NEGATIVE, case=case)


def cluster_sizes(blocks: Mask) -> NDArray[np.integer]:
    """Return the number of blocks of each cluster, joined by sides and corners."""
    from scipy.ndimage import label  # slow to import

    clusters, _ = label(blocks, structure=np.ones((3, 3)))
    return np.bincount(clusters.ravel())[1:]


def fronts(run: Run) -> float:
    """Return the number of clusters of more than 20 blocks when half of them have detached."""
    return float(np.sum(cluster_sizes(run.t_det <= np.nanmedian(run.t_det)) > 20))  # NaN: never


def number_of_fronts(evidence: Evidence) -> Iterator[Finding]:
    for flat, runs in surfaces.flat(evidence.records).items():
        here = over_runs(fronts, runs)
        for name in _DECISIVE:
            others = varied(evidence, name)
            if len(others) < 2:
                continue
            counts = {s: over_runs(fronts, evidence.records[s]) for s in others} | {flat: here}
            fewest, *_, most = sorted(counts, key=lambda scene: float(np.mean(counts[scene])))
            change = samples.relative(counts[most], counts[fewest], here)
            low, high = (getattr(evidence.records[s][0].material, name) for s in (fewest, most))
            span = f"from {name} = {low:g} to {high:g}, over the number with the paper's constants"
            statistic = f"the change in the number of fronts {span}"
            source = in_files(*dict.fromkeys((fewest, most, flat)))
            yield Finding(Case(constant=name), statistic, change, (_AFFECTS, INF), source)


def onset_in_any_case(evidence: Evidence) -> Iterator[Finding]:
    for name in _DECISIVE:
        for scene in varied(evidence, name):
            case = Case(constant=name, constant_value=getattr(scene, name))
            early = samples.share(over_runs(samples.before_peak, evidence.records[scene]))
            yield found_on(scene, _BEFORE, early, ranges.NEGLIGIBLE, case=case)


def single_events(run: Run) -> float:
    """Return the share of the clusters of precursors that are a single block."""
    sizes = cluster_sizes(run.t_det < run.t_max)
    return float(np.mean(sizes == 1)) if len(sizes) else float("nan")


def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    blocks = ("the share of precursors that detach before all eight neighbours", samples.isolated)
    events = ("the share of clusters of precursors that are a single block", single_events)
    for scene, runs in surfaces.flat(evidence.records).items():
        for unit, (statistic, quantity) in (("blocks", blocks), ("events", events)):
            share = samples.share(over_runs(quantity, runs))
            yield found_on(scene, statistic, share, ranges.MOST, case=Case(part=unit))


@_on_flat(
    "the share of the m blocks detached before t_max that are among the m of lowest mu_static",
    ranges.MOST,
)
def weakest_first(run: Record) -> float:
    early = run.t_det < run.t_max
    thresholds, _ = draw_friction(run.t_det.shape, run.seed, run.material)
    bound = np.sort(thresholds, axis=None)[np.count_nonzero(early) - 1]
    return share_of(thresholds <= bound, early)


@_on_flat(
    "the share of the blocks detached before 0.9 t_max that have no neighbour detached by t_max",
    (1.0 - 0.9, 0.9),
)
def not_all_nucleate(run: Record) -> float:
    alone = np.all(~(samples.neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return share_of(alone, run.t_det < 0.9 * run.t_max)


@_on_flat(_BEFORE, ranges.NEGLIGIBLE)
def onset(run: Record) -> float:
    return samples.before_peak(run)


def avalanche(run: Run) -> float:
    """Return the time of the largest detachment rate, s."""
    return float(run.time[np.argmax(samples.rates(run, _BURST * run.t_max))])


@_on_flat(
    f"the time of the largest detachment rate {_WINDOW} minus t_max", ranges.POSITIVE, unit="s"
)
def avalanche_follows(run: Record) -> float:
    return avalanche(run) - run.t_max


@_on_flat(f"the detachment rate at t_max over its maximum {_WINDOW}", ranges.FEWER_THAN_HALF)
def peaks_apart(run: Record) -> float:
    counts = samples.rates(run, _BURST * run.t_max)
    return float(counts[np.argmin(np.abs(run.time - run.t_max))] / counts.max())


@_on_flat(
    f"the time of the largest detachment rate {_WINDOW} minus t_avg, over the duration of the "
    "transition",
    within(0.5),
)
def average_is_propagation(run: Record) -> float:
    return (avalanche(run) - run.t_avg) / (samples.lasting(run) * run.t_max)


@_on_flat(
    "the number of slips per block in a time as long as the transition, at the beginning of the "
    "dynamic phase",
    ranges.NEGLIGIBLE,
)
def localized_stick_slip(run: Record) -> float:
    """Return the mean number from the force minimum to the fall that follows the next maximum."""
    start = first_minimum(run.force)
    if start is None:
        return float("nan")
    after = run.force[start:]
    loaded = int(np.argmax(after))
    end = start + loaded + int(np.argmax(after[loaded:] < after.mean()))
    durations = (run.time[end] - run.time[start]) / (samples.lasting(run) * run.t_max)
    return float(run.switches[start:end].sum() / np.count_nonzero(run.contact) / durations)


def strain_left(run: Record, minimum: int) -> tuple[Array, Array]:
    """Compare the strain along x at each snapshot with that at the one of the force minimum.

    Returns the share of the strain at the minimum that is left (slope of the regression on it), and
    the standard deviation over blocks relative to that at the minimum, each (k,).
    """
    strain = np.diff(run.snapshots[:, 0], axis=2).reshape(len(run.snapshots), -1)
    strain = strain - strain.mean(axis=1, keepdims=True)
    left = strain @ strain[minimum] / (strain[minimum] @ strain[minimum])
    return left, strain.std(axis=1) / strain[minimum].std()


def residual_strains(evidence: Evidence) -> Iterator[Finding]:
    for scene, all_runs in surfaces.flat(evidence.records).items():
        runs = [run for run in all_runs if len(run.snapshots)]
        if not runs:
            continue
        times = runs[0].snapshot_times
        minima = [run.time[first_minimum(run.force) or -1] for run in runs]
        minimum = int(np.abs(times - np.mean(minima)).argmin())
        left, scatter = np.array([strain_left(run, minimum) for run in runs]).transpose(1, 2, 0)
        before, after = times < min(run.t_max for run in runs), times > times[minimum]
        amount = "the standard deviation of the strain at {:.3g} µs, over that at the force minimum"
        share = "the share of the strain at the force minimum that is left at {:.3g} µs"
        for part, statistic, values, claimed, when in (
            ("the appearance of residual strains", amount, scatter, (-INF, 1.0), before),
            ("the removal of the strains at the minimum", share, left, ranges.NEGLIGIBLE, after),
            ("the removal of all strains", amount, scatter, ranges.FEWER_THAN_HALF, after),
        ):
            for time, sample in zip(1e6 * times[when], values[when], strict=True):
                found, case = samples.mean(sample), Case(part=part)
                yield found_on(scene, statistic.format(time), found, claimed, case=case)


@_on_flat("t_max - t_avg", ranges.NEGATIVE, unit="s")
def peak_before_average(run: Record) -> float:
    return run.t_max - run.t_avg


def _margin(flat: Scene) -> int:
    """Return the distance from the edge at which the core of a surface begins, blocks."""
    return min(10, flat.n_blocks // 4)


def uniform(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of the variance of t_det explained by position (jackknife)"
    lateness, unit = "the mean t_det minus that of the core", "standard deviations of t_det"
    for flat, runs in surfaces.flat(evidence.records).items():
        depth = surfaces.from_edge(flat.n_blocks)
        core = depth >= _margin(flat)
        times = np.stack([run.t_det for run in runs])
        by_place = Estimate.of(repeatability(times[:, core]), len(times))
        yield found_on(flat, name, by_place, ranges.ALIKE, case=Case(part="the core"))
        late = samples.mean([(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times])
        outermost = Case(part="the outermost blocks")
        yield found_on(flat, lateness, late, within(_SMALL), unit, outermost)


def nucleation_anywhere(evidence: Evidence) -> Iterator[Finding]:
    first = f"the first {_PATCH} x {_PATCH} patch to detach"
    rank = f"the share of positions nearer to the edge than {first}"
    near = "the share of runs in which {} has its centre less than {} blocks from the edge"
    for flat, runs in surfaces.flat(evidence.records).items():
        margin = _margin(flat)
        ranks = np.array([samples.first_patch(run.t_det, _PATCH) for run in runs])
        case = Case(part="all positions")
        yield found_on(flat, rank, samples.mean(ranks), within(_SMALL, 0.5), case=case)
        depth = surfaces.from_edge(flat.n_blocks - _PATCH + 1) + _PATCH // 2  # of the centres
        found = samples.proportion((ranks < np.mean(depth < margin)).astype(float))
        blocks = np.mean(surfaces.from_edge(flat.n_blocks) < margin)
        chance = float((1.0 - _INWARD) * np.mean(depth < margin) + _INWARD * blocks)
        statistic, case = near.format(first, margin), Case(part="the blocks near the edge")
        yield found_on(flat, statistic, found, within(_SMALL * chance, chance), case=case)
