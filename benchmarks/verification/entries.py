"""The first entries: the project's own integrators at some steps, as one table per problem."""

from collections.abc import Iterator

from benchmarks.verification.metrics import cells, errors, uncertainties
from benchmarks.verification.problems import PROBLEMS, Answer, Problem, read_reference, read_surface
from springblock.accuracy.conventions import PLAIN
from springblock.accuracy.work_precision import FORCE_EVALUATIONS, solve_with
from springblock.io.rows import markdown_table
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.surface import Surface

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
    run = solve_with(integrator, step, surface, problem.duration, SAMPLE_INTERVAL)
    return Answer(problem, run.t_det, run.force), FORCE_EVALUATIONS[integrator] * run.steps


def page() -> str:
    """All entries, in Markdown."""
    tables = (
        f"## {problem.name.capitalize()}\n\n{markdown_table(_HEADER, _lines(problem))}\n"
        for problem in PROBLEMS.values()
    )
    return "\n".join([_PAGE, *tables])


def _lines(problem: Problem) -> Iterator[tuple[str, ...]]:
    surface, reference = read_surface(problem), read_reference(problem)
    yield "uncertainty", "", "", *cells(uncertainties(reference))
    for integrator, steps in STEPS.items():
        for step in steps:
            answer, evaluations = solved_by(integrator, step, problem, surface)
            off_by = errors(answer, reference)
            yield integrator, f"{step:g}", f"{evaluations}", *cells(off_by)
