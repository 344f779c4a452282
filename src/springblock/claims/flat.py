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
from springblock.claims.rule import Evidence, Finding
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
    """Test: on surfaces of 16 x 16 blocks (flat, pillars of 4 blocks, and pillars of 8 blocks with
    pawls of 2 and grooves of 1), the bias of the mean of static friction, of t_max and of t_avg is
    smaller than the standard error of this mean over 20 realisations. The paper does not say how
    its Runge-Kutta method treats friction within a step. Three methods are therefore tested: both
    integrators of this study (leapfrog and rk4), and the plain Runge-Kutta method, in which
    friction opposes the velocity of each stage. Biases are differences from the means with the
    leapfrog and a step of 5e-9 s. Most of the bias of the plain method does not depend on the step:
    with half the step, means over the same 20 realisations change by 0.5 % or less (standard errors
    of 0.06 to 0.9 %), while their biases are 4 to 17 %. If “integration errors” meant such changes
    alone, the plain method would be an open case, and the statement not settled.
    """
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
                yield Finding({"integrator": integrator}, statistic, bias, claimed, source)


def shear_springs(evidence: Evidence) -> Iterator[Finding]:
    """Test: K_s differs by less than a tenth from the stiffness in shear, G l²/l_z, of the layer
    above a block (l: lattice spacing). The paper's K_s is that of half the layer, as if blocks
    moved with its mid-plane; with this reading the statement would be reproduced.
    """
    if not evidence.records:
        return
    any_ = Material()  # the ratio of stiffnesses is the same for every material
    ratio = any_.k_s / (3.0 / 8.0 * any_.youngs_modulus * any_.spacing**2 / any_.thickness)
    exact, claimed = Estimate(ratio, ratio, ratio), within(_AFFECTS, 1.0)
    yield Finding({}, "the paper's K_s over G l²/l_z", exact, claimed, "equations of section 2")


def varied(evidence: Evidence, *names: str) -> list[Scene]:
    """Return, in order, flat surfaces whose only constants of their own are these and the step."""
    found = [scene for scene in evidence.records if not scene.level]
    alike = [s for s in found if {name for name, _ in s.varied} - {"step"} == set(names)]
    return sorted(alike, key=lambda scene: scene.varied)


@_on_flat("the amplitude of an oscillation at t_max over that at t = 0", ranges.NEGLIGIBLE)
def damping(run: Record) -> float:
    """Test: viscous damping reduces the amplitude of oscillations to less than a tenth by t_max of
    the flat surface; the verdict is the same on pillars, where t_max is later. The reduction takes
    0.92 ms, 8.6 times t_max; at a slider velocity of 5e-5 m/s, where t_max is 1.06 ms, the test
    would hold. The amplitude decreases as exp(-gamma t/2) in all modes of the lattice, since even
    the slowest mode, with the frequency (K_s/m)^(1/2), is underdamped.
    """
    return float(np.exp(-0.5 * run.material.gamma * run.t_max))


def _larger_moduli(evidence: Evidence, paper: Material) -> Iterator[tuple[float, Scene]]:
    """Yield moduli in Pa with the paper's E/P, and their scenes.

    With E and P multiplied by a, the motion is that with v and gamma divided by √a, but √a times
    faster: such scenes count as those with the larger modulus.
    """
    for scene in varied(evidence, "youngs_modulus", "pressure"):
        yield float(dict(scene.varied)["youngs_modulus"]), scene
    for scene in varied(evidence, "slider_velocity", "gamma"):
        constants = dict(scene.varied)
        slower = paper.slider_velocity / constants["slider_velocity"]
        if np.isclose(slower, paper.gamma / constants["gamma"]):
            yield float(f"{paper.youngs_modulus * slower**2:.3g}"), scene


def same_ratio(evidence: Evidence) -> Iterator[Finding]:
    """Test: on flat surfaces with other moduli at the same ratio, static friction changes by less
    than 5 %, and t_max < t_avg. The registered cases are 4 and 16 times the paper's modulus; with
    these alone the statement would be reproduced. 1e12 Pa (diamond) was added when other runs had
    shown that the statement fails there. Its motion is √1e5 times faster than that with the paper's
    modulus but slider velocity and damping divided by √1e5, which is simulated instead. The larger
    the modulus, the sooner after t_max the fronts have crossed the surface, so that in the end the
    blocks that detach before t_max decide the sign of t_max - t_avg: (t_max - t_avg)/t_max is
    -0.00050 at 1e11 Pa, -0.00009 at 2e11 Pa and 0.00021 at 4e11 Pa (20 other runs each, standard
    errors of 0.00007 to 0.0001).
    """
    for flat, runs in surfaces.flat(evidence.records).items():
        for modulus, scene in _larger_moduli(evidence, runs[0].material):
            case = {"E in Pa": modulus}
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
    """Test: fronts are counted as clusters of more than 20 detached blocks at the time when half of
    all blocks have detached; about two such clusters form by chance. Among the simulated values of
    a parameter, the largest number of fronts exceeds the smallest by more than a tenth of the
    number with the paper's constants. The number is not a monotonic function of the scatter: from
    0.02 to 0.3 it changes by 0.33 of the number with the paper's constants, and the sign of this
    change depends on how fronts are counted. The change between the scatters with the fewest and
    the most fronts exceeds the bound however they are counted: it is 0.49 or more for clusters of
    10 to 100 blocks when 10 to 60 % of all blocks have detached.
    """
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
            yield Finding({"constant": name}, statistic, change, (_AFFECTS, INF), source)


def onset_in_any_case(evidence: Evidence) -> Iterator[Finding]:
    """Test: less than a tenth of the blocks detach before t_max. Blocks also detach without a
    front, where their own threshold is below the load: at t_max, the thresholds of 0.08 of all
    blocks at the largest velocity, and of 0.17 and 0.30 with scatters of 0.2 and 0.3, are below the
    mean load on the blocks that still stick. If these shares were subtracted, 0.06, 0.06 and 0.07
    would remain in the three cases (0.05 at a pressure of 12500 Pa), and the statement would be
    reproduced. If thresholds were compared with the load that a block would bear without any slip
    instead, 0.09, 0.09 and 0.11 would remain, and only the largest scatter would fail.
    """
    for name in _DECISIVE:
        for scene in varied(evidence, name):
            case = {"constant": f"{name} = {dict(scene.varied)[name]:g}"}
            early = samples.share(over_runs(samples.before_peak, evidence.records[scene]))
            yield found_on(scene, _BEFORE, early, ranges.NEGLIGIBLE, case=case)


def single_events(run: Run) -> float:
    """Return the share of the clusters of precursors that are a single block."""
    sizes = cluster_sizes(run.t_det < run.t_max)
    return float(np.mean(sizes == 1)) if len(sizes) else float("nan")


def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Test: most precursors (“those occurring before t_max”) detach before all of their eight
    neighbours; or, if events (here: clusters of precursors) are counted, most consist of a single
    block. With only the blocks that detach before 0.9 t_max, or before 0.99 t_max, as precursors,
    the test would also hold for blocks. With the bound for “all” it would fail for blocks and for
    events.
    """
    blocks = ("the share of precursors that detach before all eight neighbours", samples.isolated)
    events = ("the share of clusters of precursors that are a single block", single_events)
    for scene, runs in surfaces.flat(evidence.records).items():
        for unit, (statistic, quantity) in (("blocks", blocks), ("events", events)):
            share = samples.share(over_runs(quantity, runs))
            yield found_on(scene, statistic, share, ranges.MOST, case={"unit": unit})


@_on_flat(
    "the share of the m blocks detached before t_max that are among the m of lowest mu_static",
    ranges.MOST,
)
def weakest_first(run: Record) -> float:
    """Test: of the m blocks that detach before t_max, most are among the m with the lowest
    mu_static. With the bound for “all” the statement would not be reproduced, unless m counted only
    the blocks that detach before 0.9 t_max: 0.97 of these are among the m with the lowest
    mu_static.
    """
    early = run.t_det < run.t_max
    thresholds, _ = draw_friction(run.t_det.shape, run.seed, run.material)
    bound = np.sort(thresholds, axis=None)[np.count_nonzero(early) - 1]
    return share_of(thresholds <= bound, early)


@_on_flat(
    "the share of the blocks detached before 0.9 t_max that have no neighbour detached by t_max",
    (1.0 - 0.9, 0.9),
)
def not_all_nucleate(run: Record) -> float:
    """Test: of the blocks that detach before 0.9 t_max, between a tenth and nine tenths have no
    neighbour that detaches by t_max. The paper's precursors are all blocks that detach before
    t_max, but the last of them have no time to trigger a front. Of all precursors, 0.263 [0.261,
    0.266] have no such neighbour: the verdict is the same. Neighbours also detach by chance: if
    blocks detached independently, both shares would be 0.65. A more direct measure are the clusters
    of more than 20 blocks that exist when half of all blocks have detached: 0.86 of the precursors
    before 0.9 t_max are not the first block of such a cluster (60 runs), with the same verdict.
    """
    alone = np.all(~(samples.neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return share_of(alone, run.t_det < 0.9 * run.t_max)


@_on_flat(_BEFORE, ranges.NEGLIGIBLE)
def onset(run: Record) -> float:
    """Test: less than a tenth of the blocks detach before t_max. Some fronts have begun by then:
    there are 3.8 clusters of more than 20 detached blocks at t_max (60 runs); by chance there would
    be none.
    """
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
    """Test: at t_max the detachment rate is below half its maximum. The verdict is the same with
    windows of 0.2 to 3 % of t_max; with one of 5 %, the test would fail.
    """
    counts = samples.rates(run, _BURST * run.t_max)
    return float(counts[np.argmin(np.abs(run.time - run.t_max))] / counts.max())


@_on_flat(
    f"the time of the largest detachment rate {_WINDOW} minus t_avg, over the duration of the "
    "transition",
    within(0.5),
)
def average_is_propagation(run: Record) -> float:
    """Test: t_avg differs from the time of the largest detachment rate by less than half the
    duration of the transition, which is the time from a tenth to nine tenths of the detachments.
    For comparison, t_max and t_avg differ by 0.77 of this duration. The verdict is the same with
    any bound of 0.3 or more and any window of 0.2 to 5 % of t_max.
    """
    return (avalanche(run) - run.t_avg) / (samples.lasting(run) * run.t_max)


@_on_flat(
    "the number of slips per block in a time as long as the transition, after the first force "
    "minimum",
    ranges.NEGLIGIBLE,
)
def localized_stick_slip(run: Record) -> float:
    """Test: after the first force minimum, there is less than one slip for every ten blocks in a
    time as long as the transition, which lasts from a tenth to nine tenths of the first
    detachments. The number of slips, in which turning back without sticking counts as a new slip,
    is a mean over all intervals of this length in the rest of the run. In single intervals it rises
    from 0.01 in the first, when nearly all blocks stick, to 0.132 in the 16th (about 156 µs), and
    exceeds a tenth in the 14th to the 19th, when the force reaches its dynamic level: with these
    intervals alone the statement would fail. If the transition were defined as lasting from 5 to 95
    % of the detachments, the number would be 0.118, and the statement would fail.
    """
    minimum = first_minimum(run.force)
    if minimum is None:
        return float("nan")
    durations = (run.time[-1] - run.time[minimum]) / (samples.lasting(run) * run.t_max)
    blocks = np.count_nonzero(run.contact)
    return float(run.switches[minimum:].sum() / blocks / durations)


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
    """Test: the strain along the sliding direction varies less from block to block before t_max
    (snapshot at 100 µs) than at the force minimum (112 µs). When the force has reached its dynamic
    level (160 µs) and later (290 µs), less than a tenth of the strain at the force minimum is left
    (slope of the regression of the later strain on that at the force minimum). In a second reading
    of the removal, strains that have formed since must be absent, too: at both times, the strain
    varies less than half as much as at the force minimum. While the surface slides, new strains
    replace the former ones and vary more than these did, so that this reading would fail with any
    bound up to 1; without it the statement would be reproduced.
    """
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
                found, case = samples.mean(sample), {"part": part}
                yield found_on(scene, statistic.format(time), found, claimed, case=case)


@_on_flat("t_max - t_avg", ranges.NEGATIVE, unit="s")
def peak_before_average(run: Record) -> float:
    return run.t_max - run.t_avg


def _margin(flat: Scene) -> int:
    """Return the distance from the edge at which the core of a surface begins, blocks."""
    return min(10, flat.n_blocks // 4)


def uniform(evidence: Evidence) -> Iterator[Finding]:
    """Test: in the core (here the blocks 10 or more from the edge), position explains less than a
    fifth of the variance of t_det; the mean t_det of the outermost blocks differs from that of the
    core by less than a fifth of the standard deviation of t_det (a bound for small effects). The
    verdict is the same if the two outermost rows along each edge are taken as the outermost blocks.
    With a bound above 0.35 for the outermost blocks the statement would hold. As a general
    statement it would be reproduced in part. Over the whole surface, position explains 0.009 of the
    variance; with this measure alone the statement would hold.
    """
    name = "the share of the variance of t_det explained by position (jackknife)"
    lateness, unit = "the mean t_det minus that of the core", "standard deviations of t_det"
    for flat, runs in surfaces.flat(evidence.records).items():
        depth = surfaces.from_edge(flat.n_blocks)
        core = depth >= _margin(flat)
        times = np.stack([run.t_det for run in runs])
        by_place = Estimate.of(repeatability(times[:, core]), len(times))
        yield found_on(flat, name, by_place, ranges.ALIKE, case={"part": "the core"})
        late = samples.mean([(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times])
        outermost = {"part": "the outermost blocks"}
        yield found_on(flat, lateness, late, within(_SMALL), unit, outermost)


def nucleation_anywhere(evidence: Evidence) -> Iterator[Finding]:
    """Test: the first patch is that of 5 x 5 blocks with the earliest mean t_det. On average, 30 to
    70 % of all positions are nearer to the edge than this patch (50 % if all are equally likely),
    and the share of realisations in which its centre is less than 10 blocks from the edge differs
    from the share expected by chance by less than a fifth of the latter. The share expected by
    chance, 0.287 (standard error: 0.0013), was measured on 300 periodic surfaces, which have no
    edges; these were marked at random places after the runs. It lies between the share of all
    patches (0.257) and that of all blocks (0.306) that are so near to the edge: no patch has its
    centre in the two outermost rows, and some of the fronts that begin there are counted further
    inside. If 0.306 were taken as the share by chance, the statement would be reproduced; with
    0.257 it would not be settled. With a distance of 5 blocks the share is 0.145, by chance 0.136,
    and the case would be open, too. Over 1,200 further runs and these 400, the tested share is
    0.299 [0.274, 0.326], and the statement would be reproduced. The outcome of the first finding is
    the same for patches of 1 to 17 blocks a side.
    """
    first = f"the first {_PATCH} x {_PATCH} patch to detach"
    rank = f"the share of positions nearer to the edge than {first}"
    near = "the share of runs in which {} has its centre less than {} blocks from the edge"
    for flat, runs in surfaces.flat(evidence.records).items():
        margin = _margin(flat)
        ranks = np.array([samples.first_patch(run.t_det, _PATCH) for run in runs])
        case = {"part": "all positions"}
        yield found_on(flat, rank, samples.mean(ranks), within(_SMALL, 0.5), case=case)
        depth = surfaces.from_edge(flat.n_blocks - _PATCH + 1) + _PATCH // 2  # of the centres
        found = samples.proportion((ranks < np.mean(depth < margin)).astype(float))
        blocks = np.mean(surfaces.from_edge(flat.n_blocks) < margin)
        chance = float((1.0 - _INWARD) * np.mean(depth < margin) + _INWARD * blocks)
        statistic, case = near.format(first, margin), {"part": "the blocks near the edge"}
        yield found_on(flat, statistic, found, within(_SMALL * chance, chance), case=case)
