"""The first entries: the project's own integrators at some steps, as one table per problem."""

from collections.abc import Iterator

from benchmarks.verification.metrics import cells, errors, uncertainties
from benchmarks.verification.problems import PROBLEMS, Problem
from benchmarks.verification.tables import Answer, read_reference, read_surface
from springblock import simulate
from springblock.accuracy import plain_rk4
from springblock.accuracy.conventions import PLAIN
from springblock.accuracy.specimens import Surface
from springblock.io.rows import markdown_table
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.solver.integrators import INTEGRATORS

#: Of each integrator, s.
STEPS = {
    "leapfrog": (4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9),
    "rk4": (4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9),
    PLAIN: (2e-8, 1e-8, 5e-9),
}
_HEADER = ("code", "step, s", "force evaluations", "t_det", "static friction", "force", "order")

_PAGE = """# Entries

Written by `python -m benchmarks.verification entries`; README.md defines the metrics. In short,
t_det is the RMS error before the horizon over t_max, force the largest error before t_max over the
largest force, and order the number of blocks out of order. The first line of each table says how
uncertain these are: entries below cannot be told apart.
"""


def solved_by(
    integrator: str, step: float, problem: Problem, surface: Surface
) -> tuple[Answer, int]:
    """Return what one of our integrators says, and the force evaluations that it took."""
    if integrator == PLAIN:
        plain = plain_rk4.solve(*surface, problem.duration, step, SAMPLE_INTERVAL)
        return Answer(plain.t_det, plain.force), 4 * plain.steps
    run = simulate(*surface, integrator=integrator, step=step, duration=problem.duration)
    evaluations = INTEGRATORS[integrator].FORCE_EVALUATIONS * run.steps
    return Answer(run.t_det, run.force), evaluations


def page() -> str:
    """All entries, in Markdown."""
    tables = (
        f"## {problem.name.capitalize()}\n\n{markdown_table(_HEADER, _lines(problem))}\n"
        for problem in PROBLEMS.values()
    )
    return "\n".join([_PAGE, *tables])


def _lines(problem: Problem) -> Iterator[tuple[str, ...]]:
    surface, reference = read_surface(problem), read_reference(problem)
    yield "uncertainty", "", "", *cells(uncertainties(problem, reference))
    for integrator, steps in STEPS.items():
        for step in steps:
            answer, evaluations = solved_by(integrator, step, problem, surface)
            off_by = errors(problem, answer, reference)
            yield integrator, f"{step:g}", f"{evaluations}", *cells(off_by)
