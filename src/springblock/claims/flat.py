"""The method, and flat surfaces: isolated precursors, then the front (sections 2 and 3.1)."""

from bisect import bisect_left
from collections.abc import Iterator
from functools import partial
from itertools import product

import numpy as np

from springblock.accuracy.conventions import PAPER_STEP, PLAIN, ensemble_error
from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import cluster_sizes, repeatability
from springblock.claims import ranges, samples, surfaces
from springblock.claims.ranges import INF, within
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import found_on, mean_over, over_runs, share_of
from springblock.claims.surfaces import in_files
from springblock.io.records import Record
from springblock.io.rows import select
from springblock.model.asperities import draw_friction
from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.simulation.run import Run, first_minimum

_ANY = Material()  #: the ratio of stiffnesses is the same for every material
_STUDIED = ("static_friction", "t_max", "t_avg")
_FRONT = 20  #: blocks that detach side by side before they count as a front
_LATE = 1.01  #: of t_max, when fronts are counted
_AFFECTS = 0.1  #: change in proportion that is an effect
_ALIKE = 0.05  #: change in proportion that leaves results the same
_SLIDING = 1.15  #: t/t_avg from which on the surface slides as a whole
_LOADED = "flat surfaces with other constants"
_SAME_RATIO = f"{_LOADED} at the same ratio"
#: Constants that the paper says affect the number of fronts.
_DECISIVE = ("slider_velocity", "pressure", "mu_static_std")
_EARLY = 0.9  #: of t_max
_CORE = 10  #: blocks from the edges of the surface to its core
_SMALL = 0.2  #: difference in standard deviations that is called small (Cohen 1988)
_PATCH = 5  #: blocks, side of the patch that counts as a nucleation point
_BURST = 0.02  #: of t_max, over which detachments are counted
_FLAT = "realisations of the flat surface"
_THREE = f"three {_FLAT} or more"

_on_flat = partial(mean_over, surfaces.flat)


@claim("A step of 1e-8 s suffices", "2", 1, "the table `work_precision`")
def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    """h = 1e-8 s reduces integration errors under the statistical uncertainty.

    Tested: the bias of the mean, on small surfaces, is within one standard error of an ensemble of
    20. The paper does not say how its Runge-Kutta method treats friction within a step: both
    integrators of this study are tested, and the plain Runge-Kutta method, in which friction
    opposes the velocity of each stage and which does not converge (`docs/accuracy.md`).
    """
    for integrator in ("leapfrog", "rk4", PLAIN):
        rows = select(
            evidence.precision, step=PAPER_STEP, comparison="paired", integrator=integrator
        )
        for row in [row for row in rows if row["quantity"] in _STUDIED]:
            keys = {key: row[key] for key in ("scene", "quantity")}
            scatter = select(evidence.precision, comparison="scatter", **keys)
            for each in scatter[:1]:
                yield Finding(
                    {"integrator": integrator},
                    f"relative bias of {keys['quantity']} at h = {PAPER_STEP:.0e} s, "
                    f"{keys['scene']} surface",
                    samples.interval(row, "error"),
                    within(ensemble_error(each)),
                    f"tables/work_precision: comparison = paired, step = {PAPER_STEP:.0e}",
                )


@claim("The slider's springs follow from the shear modulus", "2", 1, "nothing: algebra")
def shear_springs(evidence: Evidence) -> Iterator[Finding]:
    """K_s can be expressed as a function of G = 3/8 E, so that K_s = K_int l²/l_z².

    Tested: between the slider and a block the whole thickness l_z shears, over an area l², or half
    of it, if the displacement of a block is that of the layer's middle.
    """
    sheared = 3.0 / 8.0 * _ANY.youngs_modulus * _ANY.spacing**2 / _ANY.thickness
    for part, length in (("whole", 1.0), ("half", 0.5)) if evidence.records else ():
        ratio = length * _ANY.k_s / sheared
        name = f"K_s of the paper over G l²/(l_z{'' if part == 'whole' else '/2'})"
        exact, case = Estimate(ratio, ratio, ratio), {"what shears": f"the {part} layer"}
        yield Finding(case, name, exact, within(_AFFECTS, 1.0), "equations of section 2")


def varied(evidence: Evidence, *names: str) -> list[Scene]:
    """Flat surfaces with these constants, and no others but the step, of their own; in order."""
    found = [scene for scene in evidence.records if not scene.level]
    alike = [s for s in found if {name for name, _ in s.varied} - {"step"} == set(names)]
    return sorted(alike, key=lambda scene: scene.varied)


def restarts(run: Run) -> float:
    """How often a block stops and starts again while the surface slides, on average, in 100 µs."""
    sliding = run.time > _SLIDING * run.t_avg
    lasting = 1e4 * (run.time[-1] - run.time[sliding][0]) if sliding.any() else 0.0
    blocks = np.count_nonzero(run.contact)
    return float(run.switches[sliding].sum() / blocks / lasting) if lasting else float("nan")


@claim("Damping removes oscillations", "2", 1, f"{_LOADED}, one of them without damping")
def damping(evidence: Evidence) -> Iterator[Finding]:
    """A viscous damping force is added to eliminate artificial block oscillations.

    Tested: with it, blocks stop and start again less than a tenth as often while the surface
    slides, after 1.15 t_avg.
    """
    undamped = [s for s in varied(evidence, "gamma") if dict(s.varied)["gamma"] == 0.0]
    for flat in surfaces.flat(evidence.records):
        for scene in undamped:
            damped, free = (over_runs(restarts, evidence.records[s]) for s in (flat, scene))
            yield Finding(
                {},
                "stops of a sliding block, with damping over without",
                samples.position(damped, np.zeros(len(free)), free),
                ranges.NEGLIGIBLE,
                in_files(flat, scene),
            )


@claim("Only the ratio of modulus and pressure matters", "2", 1, _SAME_RATIO, "universal")
def same_ratio(evidence: Evidence) -> Iterator[Finding]:
    """The relevant parameter is the ratio between Young's modulus and applied pressure; results are
    qualitatively the same for all larger moduli, if the pressure is also increased.

    Tested: static friction within 5 %, and t_max < t_avg.
    """
    flats = surfaces.flat(evidence.records)
    for flat, scene in product(flats, varied(evidence, "youngs_modulus", "pressure")):
        case = {"E in Pa": dict(scene.varied)["youngs_modulus"]}
        own, paper = (samples.friction(evidence, s) for s in (scene, flat))
        name, apart = "static friction minus that of the paper's material", within(_ALIKE)
        more = samples.relative(own, paper, paper)
        yield found_on(scene, f"{name}, over the latter", more, apart, case=case, beside=[flat])
        lag = samples.mean(over_runs(samples.relative_lag, evidence.records[scene]))
        yield found_on(scene, "(t_max - t_avg)/t_max", lag, ranges.NEGATIVE, case=case)


def fronts(run: Run) -> float:
    """Number of fronts just after t_max."""
    sizes = cluster_sizes(run.t_det <= _LATE * run.t_max, by_corners=True)  # NaN: never
    return float(np.count_nonzero(sizes > _FRONT))


@claim("Velocity, pressure and scatter affect the number of fronts", "3.1", 2, _LOADED, "universal")
def number_of_fronts(evidence: Evidence) -> Iterator[Finding]:
    """Parameters like the slider velocity, pressure, or statistical distributions of the local
    friction coefficients all affect the number of wave fronts.

    Tested: clusters of more than 20 detached blocks at 1.01 t_max; between the smallest and the
    largest value their number changes by a tenth or more of that with the paper's constants.
    """
    for flat, name in product(surfaces.flat(evidence.records), _DECISIVE):
        scenes = varied(evidence, name)
        if len(scenes) < 2:
            continue
        chosen = scenes[0], scenes[-1], flat
        low, high = (dict(scene.varied)[name] for scene in chosen[:2])
        change = samples.relative(*(over_runs(fronts, evidence.records[s]) for s in chosen))
        yield Finding(
            {"constant": name},
            f"change of the number of fronts from {low:g} to {high:g}, over that of the paper's",
            samples.magnitude(change),
            (_AFFECTS, INF),
            in_files(*chosen),
        )


def first_front(run: Run) -> float:
    """Time at which the first front begins over t_max; by bisection, since clusters only grow."""

    def has_front(time: float) -> bool:
        return bool(cluster_sizes(run.t_det <= time, by_corners=True).max() > _FRONT)

    times = np.sort(run.t_det[np.isfinite(run.t_det)])
    return float(times[bisect_left(times[:-1], True, key=has_front)]) / run.t_max


@claim("Fronts begin at t_max whatever the loading", "3.1", 2, _LOADED, "universal")
def onset_in_any_case(evidence: Evidence) -> Iterator[Finding]:
    """In any case the time instant t_max corresponds to the onset of propagation.

    Tested: the first cluster of more than 20 blocks has formed within a tenth of t_max. Where
    thresholds scatter by 0.3 it forms by chance: with the same times shuffled over the surface, at
    0.88 t_max.
    """
    statistic = f"time at which {_FRONT} blocks side by side have detached, over t_max"
    for name in _DECISIVE:
        for scene in varied(evidence, name):
            case = {"constant": f"{name} = {dict(scene.varied)[name]:g}"}
            time = samples.mean(over_runs(first_front, evidence.records[scene]))
            yield found_on(scene, statistic, time, within(_AFFECTS, 1.0), case=case)


@claim("Isolated precursors on flat surfaces", "3.1", 3, _FLAT)
def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Slip precursors occur as single detachment events before the macroscopic sliding phase.

    Tested: most blocks detach while all eight neighbours are at rest, of those that detach before
    0.9 t_max or 0.99 t_max and of all that detach before t_max.
    """
    name = "share of the precursors that detach while all eight neighbours are at rest"
    for flat, runs in surfaces.flat(evidence.records).items():
        for until in (_EARLY, 0.99, 1.0):
            alone = samples.share(over_runs(partial(samples.isolated, until=until), runs))
            yield found_on(flat, name, alone, ranges.MOST, case={"t/t_max below": until})


@claim("Precursors are the weakest blocks", "3.1", 3, _FLAT)
@_on_flat(
    "share of the m blocks detached before t_max that have one of the m lowest mu_static",
    ranges.MOST,
)
def weakest_first(run: Record) -> float:
    """Slip precursors occur corresponding to the weakest microscopic static friction thresholds.

    Tested: most of them.
    """
    early = run.t_det < run.t_max
    thresholds, _ = draw_friction(run.t_det.shape, run.seed, run.material)
    bound = np.sort(thresholds, axis=None)[np.count_nonzero(early) - 1]
    return share_of(thresholds <= bound, early)


@claim("Not every precursor starts a front", "3.1", 3, _FLAT)
@_on_flat(
    "share of the blocks detached before 0.9 t_max around which no other has by t_max",
    (1.0 - 0.9, 0.9),
)
def not_all_nucleate(run: Record) -> float:
    """From these events rupture waves may nucleate; not all the precursors trigger a rupture wave
    front.

    Tested: more than a tenth of them stay alone, and less than nine tenths.
    """
    alone = np.all(~(samples.neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return share_of(alone, run.t_det < _EARLY * run.t_max)


@claim("t_max is the onset of propagation on flat surfaces", "3.1", 2, _FLAT)
@_on_flat("share of the blocks detached before t_max", ranges.NEGLIGIBLE)
def onset(run: Record) -> float:
    """The time instant t_max corresponds to the onset of propagation.

    Tested: less than a tenth of the surface has detached before.
    """
    return samples.before_peak(run)


def avalanche(run: Run) -> float:
    """Time of the most detachments, s."""
    return float(run.time[np.argmax(samples.rates(run, _BURST * run.t_max))])


@claim("The main avalanche follows t_max on flat surfaces", "3.1", 2, _FLAT)
@_on_flat(
    "time of the most detachments, within 2 % of t_max, minus t_max", ranges.POSITIVE, unit="s"
)
def avalanche_follows(run: Record) -> float:
    """After t_max there is the main sliding avalanche, highlighted by the peak of the number of
    detachments.
    """
    return avalanche(run) - run.t_max


@claim("Force and detachments peak apart on flat surfaces", "3.1", 2, _FLAT)
@_on_flat(
    "detachments within 2 % of t_max around it, over the most in such a time",
    ranges.FEWER_THAN_HALF,
)
def peaks_apart(run: Record) -> float:
    """The two peaks, of force and of detachments, are clearly separated.

    Tested: at the one, detachments are below half of the other.
    """
    counts = samples.rates(run, _BURST * run.t_max)
    return float(counts[np.argmin(np.abs(run.time - run.t_max))] / counts.max())


@claim("t_avg is when the fronts cross the surface", "3.1", 2, _FLAT)
@_on_flat(
    "time of the most detachments, within 2 % of t_max, minus t_avg, over the duration", within(0.5)
)
def average_is_propagation(run: Record) -> float:
    """t_avg corresponds roughly to the propagation instant of the wave fronts over the whole
    surface.

    Tested: the time of the most detachments differs from it by less than half the duration of the
    transition, from a tenth to nine tenths of the detachments; t_max differs by 0.77 of it. The
    same for any bound from 0.3 on, and for detachments within 0.2 to 5 % of t_max.
    """
    return (avalanche(run) - run.t_avg) / (samples.lasting(run) * run.t_max)


@claim("Small parts of the surface stick and slip while it slides", "3.1", 2, _FLAT)
@_on_flat(
    "share of the blocks that slide anew in one duration, from the first force minimum on",
    ranges.NEGLIGIBLE,
)
def localized_stick_slip(run: Record) -> float:
    """At the beginning of the dynamic phase localized stick-slip motions of small fractions of the
    contact area take place.

    Tested: after the first force minimum, less than a tenth of the blocks slide anew within the
    duration of the transition, from a tenth to nine tenths of the first detachments. The same over
    the first 1 to 50 durations after the minimum alone.
    """
    minimum = first_minimum(run.force)
    if minimum is None:
        return float("nan")
    durations = (run.time[-1] - run.time[minimum]) / (samples.lasting(run) * run.t_max)
    blocks = np.count_nonzero(run.contact)
    return float(run.switches[minimum:].sum() / blocks / durations)


@claim("t_max < t_avg on flat surfaces", "3.1", 2, _FLAT)
@_on_flat("t_max - t_avg", ranges.NEGATIVE, unit="s")
def peak_before_average(run: Record) -> float:
    """The force maximum occurs before the average detachment time."""
    return run.t_max - run.t_avg


@claim("Detachment times are uniform on flat surfaces", "3.2", 3, _THREE, "universal")
def uniform(evidence: Evidence) -> Iterator[Finding]:
    """In repeated simulations the spatial distribution of the initial detachment time is
    uniform.

    Tested: place explains less than a fifth of the variance in the core, and the outermost blocks
    are not early or late by more than a fifth of a standard deviation, a small effect. The
    same for the two outermost rings; with a bound above 0.38 it would hold.
    """
    name = "share of the variance of t_det that place explains (jackknife)"
    lateness, unit = "mean t_det minus that of the core", "standard deviations of t_det"
    for flat, runs in surfaces.flat(evidence.records).items():
        depth = surfaces.from_edge(flat.n_blocks)
        core = depth >= min(_CORE, flat.n_blocks // 4)
        times = np.stack([run.t_det for run in runs])
        by_place = Estimate.of(repeatability(times[:, core]), len(times))
        yield found_on(flat, name, by_place, ranges.ALIKE, case={"part": "the core"})
        late = samples.mean([(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times])
        outermost = {"part": "the outermost blocks"}
        yield found_on(flat, lateness, late, within(_SMALL), unit, outermost)


@claim("Nucleation anywhere on flat surfaces", "3.2", 3, _FLAT, "universal")
@_on_flat(
    f"share of places nearer to the edge than the {_PATCH} x {_PATCH} blocks detaching first",
    within(_SMALL, 0.5),
)
def nucleation_anywhere(run: Record) -> float:
    """On average, each point of the surface has the same probability of being a nucleation point.

    Tested: how far from the edge the first patch of 5 x 5 blocks detaches. The same for patches of
    1 to 17 blocks a side, each by itself.
    """
    return samples.first_patch(run.t_det, _PATCH)
