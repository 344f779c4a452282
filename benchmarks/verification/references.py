"""The published references: the event-located solution, checked by itself and by the leapfrog."""

import numpy as np

from benchmarks.verification.entries import solved_by
from benchmarks.verification.metrics import Metrics, cells, errors
from benchmarks.verification.problems import (
    FORCE,
    SCALARS,
    SURFACE,
    T_DET,
    Answer,
    Problem,
    read_reference,
    read_surface,
    write_table,
)
from springblock import Setup, Surface, draw_friction, simulate
from springblock.accuracy import reference
from springblock.accuracy.conventions import HORIZON_NUDGE
from springblock.accuracy.work_precision import horizon

PUBLISHED, COARSE = 1e-11, 1e-10  #: relative tolerances of the event-located solution
STEPS = (1e-9, 5e-10)  #: of the leapfrog that checks it, s
TWINS = 5  #: runs with nudged thresholds


def write_surface(problem: Problem) -> None:
    """Write contact and coefficients with all their digits."""
    coefficients = draw_friction(problem.pattern.n_blocks, problem.seed)
    rows = (
        (f"{y}", f"{x}", f"{touches:d}", *(f"{mu[y, x]:.17g}" for mu in coefficients))
        for (y, x), touches in np.ndenumerate(problem.pattern.contact)
    )
    write_table(problem.folder / "surface.csv", SURFACE, rows)


def write_reference(problem: Problem) -> None:
    """Compute and write the reference with its uncertainty, and how well the checks agree."""
    surface = read_surface(problem)
    published = _located(problem, surface, PUBLISHED)
    checks = {f"event-located {COARSE:g}": _located(problem, surface, COARSE)}
    checks |= {f"leapfrog {h:g} s": solved_by("leapfrog", h, problem, surface)[0] for h in STEPS}
    _write_answer(surface, published, list(checks.values()))
    read = read_reference(problem)
    rows = ((name, *cells(errors(check, read))) for name, check in checks.items())
    write_table(problem.folder / "agreement.csv", ("check", *Metrics._fields), rows)


def _located(problem: Problem, surface: Surface, accuracy: float) -> Answer:
    run = reference.solve(surface, duration=problem.duration, accuracy=accuracy)
    return Answer(problem, run.t_det, run.force)


def _write_answer(surface: Surface, published: Answer, checks: list[Answer]) -> None:
    """Write what is published; its uncertainty is the largest disagreement with a check."""
    problem, t_det, force = published.problem, published.t_det, published.force
    t_det_by = np.max([np.abs(check.t_det - t_det) for check in checks], axis=0)
    force_by = np.max([np.abs(check.force - force) for check in checks], axis=0)
    blocks = [
        (f"{y}", f"{x}", f"{t_det[y, x]:.12g}", f"{t_det_by[y, x]:.2e}")
        for y, x in np.argwhere(surface.contact)
    ]
    curve = [
        (f"{time:.10g}", f"{value:.12g}", f"{by:.2e}")
        for time, value, by in zip(problem.time, force, force_by, strict=True)
    ]
    scalars = [("horizon", f"{_horizon(problem, surface):.10g}", "", "s")]
    for quantity, unit in (("t_max", "s"), ("static_friction", "1")):
        value, *others = (getattr(answer, quantity) for answer in (published, *checks))
        by = max(abs(other - value) for other in others)
        scalars.append((quantity, f"{value:.12g}", f"{by:.2e}", unit))
    write_table(problem.folder / "t_det.csv", (*T_DET, "uncertainty"), blocks)
    write_table(problem.folder / "force.csv", (*FORCE, "uncertainty"), curve)
    write_table(problem.folder / "scalars.csv", SCALARS, scalars)


def _horizon(problem: Problem, surface: Surface) -> float:
    """Time in s at which runs with slightly nudged thresholds part; the end where none does."""
    contact, setup = surface.contact, Setup(step=STEPS[0])
    rng = np.random.default_rng(problem.seed)
    changes = 1.0, *(1.0 + HORIZON_NUDGE * rng.standard_normal((TWINS, *contact.shape)))
    nudged = (Surface(contact, surface.mu_static * each, surface.mu_dynamic) for each in changes)
    one, *others = (simulate(each, setup, duration=problem.duration) for each in nudged)
    return min(problem.duration, *(horizon(one, other) for other in others))
