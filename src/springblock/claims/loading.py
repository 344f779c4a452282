"""The method, and flat surfaces of other materials and loads (sections 2 and 3.1 of the paper)."""

from collections.abc import Iterator

import numpy as np

from springblock.accuracy.conventions import PAPER_STEP, ensemble_error
from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import cluster_sizes
from springblock.claims import ranges
from springblock.claims.ranges import within
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import (
    difference,
    in_files,
    interval,
    mean,
    over_runs,
    position,
    relative_lag,
    static_friction,
)
from springblock.io.rows import select
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_FRONT = 20  #: blocks that detach side by side before they count as a front
_LATE = 1e-6  #: s after t_max at which fronts are counted
_AFFECTS = 0.1  #: change in proportion that is an effect
_ALIKE = 0.05  #: change in proportion that leaves results the same
_SLIDING = 1.15  #: t/t_avg from which on the surface slides as a whole
_LOADED = "flat surfaces with other constants"
#: Constants that the paper says affect the number of fronts.
_DECISIVE = ("slider_velocity", "pressure", "mu_static_std")


@claim("A step of 1e-8 s suffices", "2", 1, "the table `work_precision`")
def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    """h = 1e-8 s reduces integration errors under the statistical uncertainty.

    Tested: bias within one standard error of an ensemble of 20, on small surfaces.
    """
    for row in select(evidence.precision, step=PAPER_STEP, comparison="paired"):
        keys = {key: row[key] for key in ("scene", "quantity")}
        scatter = select(evidence.precision, comparison="scatter", **keys)
        if not scatter:
            continue
        limit = ensemble_error(scatter[0])
        yield Finding(
            {"integrator": row["integrator"], **keys},
            f"relative bias at h = {PAPER_STEP:.0e} s",
            interval(row, "error"),
            within(limit),
            f"tables/work_precision: comparison = paired, step = {PAPER_STEP:.0e}",
        )


def varied(evidence: Evidence, *names: str) -> list[Scene]:
    """Flat surfaces with these constants, and no others but the step, of their own; in order."""
    size = _paper(evidence).n_blocks
    found = [s for s in evidence.records if not s.level and s.n_blocks == size]
    alike = [s for s in found if {name for name, _ in s.varied} - {"step"} == set(names)]
    return sorted(alike, key=lambda scene: scene.varied)


def _paper(evidence: Evidence) -> Scene:
    """The flat surface, with the study's constants, of the size whose constants are varied."""
    sizes = [s.n_blocks for s in evidence.records if not s.level and s.varied]
    return Scene(max(sizes, default=1))


def relative(first: Array, second: Array, base: Array) -> Estimate:
    """Mean of a sample minus that of another, over that of a third, whose error is left out."""
    apart, scale = difference(first, second), mean(base).value
    if not scale:
        return UNKNOWN
    return Estimate(apart.value / scale, apart.ci_low / scale, apart.ci_high / scale, apart.n)


def magnitude(estimate: Estimate) -> Estimate:
    """The same seen from the other side, where it is negative."""
    if not estimate.value < 0.0:
        return estimate
    return Estimate(-estimate.value, -estimate.ci_high, -estimate.ci_low, estimate.n)


def swing(run: Run) -> float:
    """Root mean square of the force about its mean while the surface slides, over that mean."""
    force = run.force[run.time > _SLIDING * run.t_avg]
    return float(force.std() / force.mean()) if len(force) > 1 else float("nan")


@claim("Damping removes oscillations", "2", 1, f"{_LOADED}, one of them without damping")
def damping(evidence: Evidence) -> Iterator[Finding]:
    """A viscous damping force is added to eliminate artificial block oscillations.

    Tested: with it, the force swings less than half as much while the surface slides, after 1.15
    t_avg.
    """
    flat = _paper(evidence)
    undamped = [s for s in varied(evidence, "gamma") if dict(s.varied)["gamma"] == 0.0]
    for scene in undamped:
        if flat in evidence.records:
            damped, free = (over_runs(swing, evidence.records[s]) for s in (flat, scene))
            yield Finding(
                {"N": scene.n_blocks},
                "swing of the force while sliding, with damping over without",
                position(damped, np.zeros(len(free)), free),
                ranges.FEWER_THAN_HALF,
                in_files(flat, scene),
            )


@claim("Only the ratio of modulus and pressure matters", "2", 1, f"{_LOADED} at the same ratio")
def same_ratio(evidence: Evidence) -> Iterator[Finding]:
    """The relevant parameter is the ratio between Young's modulus and applied pressure; results are
    qualitatively the same for larger moduli, if the pressure is also increased.

    Tested: static friction within 5 %, and t_max < t_avg.
    """
    flat = _paper(evidence)
    for scene in varied(evidence, "youngs_modulus", "pressure"):
        if flat not in evidence.records:
            continue
        constants = dict(scene.varied)
        case = {"E in Pa": constants["youngs_modulus"], "P in Pa": constants["pressure"]}
        own, paper = (over_runs(static_friction, evidence.records[s]) for s in (scene, flat))
        yield Finding(
            case,
            "static friction minus that of the paper's material, over the latter",
            relative(own, paper, paper),
            within(_ALIKE),
            in_files(scene, flat),
        )
        lag = mean(over_runs(relative_lag, evidence.records[scene]))
        yield Finding(case, "(t_max - t_avg)/t_max", lag, ranges.NEGATIVE, in_files(scene))


def fronts(run: Run) -> float:
    """Number of fronts just after t_max."""
    sizes = cluster_sizes(run.t_det <= run.t_max + _LATE, by_corners=True)  # NaN: never
    return float(np.count_nonzero(sizes > _FRONT))


@claim("Velocity, pressure and scatter affect the number of fronts", "3.1", 2, _LOADED)
def number_of_fronts(evidence: Evidence) -> Iterator[Finding]:
    """Parameters like the slider velocity, pressure, or statistical distributions of the local
    friction coefficients all affect the number of wave fronts.

    Tested: clusters of more than 20 detached blocks 1 µs after t_max; their number changes by a
    tenth or more of the paper's.
    """
    flat = _paper(evidence)
    for name in _DECISIVE:
        scenes = varied(evidence, name)
        if len(scenes) < 2 or flat not in evidence.records:
            continue
        chosen = scenes[0], scenes[-1], flat
        low, high = (dict(scene.varied)[name] for scene in chosen[:2])
        yield Finding(
            {"constant": name},
            f"change of the number of fronts from {low:g} to {high:g}, over that of the paper's",
            magnitude(relative(*(over_runs(fronts, evidence.records[s]) for s in chosen))),
            (_AFFECTS, ranges.INF),
            in_files(*chosen),
        )


def first_front(run: Run) -> float:
    """Time at which the first front begins over t_max; by bisection, since clusters only grow."""
    times = np.sort(run.t_det[np.isfinite(run.t_det)])
    low, high = 0, len(times) - 1
    while low < high:
        middle = (low + high) // 2
        if cluster_sizes(run.t_det <= times[middle], by_corners=True).max() > _FRONT:
            high = middle
        else:
            low = middle + 1
    return float(times[low]) / run.t_max


@claim("Fronts begin at t_max whatever the loading", "3.1", 2, _LOADED)
def onset_in_any_case(evidence: Evidence) -> Iterator[Finding]:
    """In any case the time instant t_max corresponds to the onset of propagation.

    Tested: the first cluster of more than 20 blocks has formed within a tenth of t_max.
    """
    for name in _DECISIVE:
        for scene in varied(evidence, name):
            yield Finding(
                {"constant": name, "value": dict(scene.varied)[name]},
                f"time at which {_FRONT} blocks side by side have detached, over t_max",
                mean(over_runs(first_front, evidence.records[scene])),
                within(_AFFECTS, 1.0),
                in_files(scene),
            )
