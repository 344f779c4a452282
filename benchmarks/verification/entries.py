"""The first entries: our integrators and Siconos at several steps, as one table per problem."""

import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import click
import numpy as np

from benchmarks.timing import interleaved
from benchmarks.verification.metrics import cells, errors, uncertainties
from benchmarks.verification.problems import (
    PROBLEMS,
    Answer,
    Problem,
    read_answer,
    read_reference,
    read_surface,
)
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
REPETITIONS = 3  #: of our runs, for the median of their CPU time
_SYSTEM_PYTHON = "/usr/bin/python3"  # for which Debian packages Siconos
_PROGRAM = Path(__file__).parents[1] / "peers" / "siconos_blocks.py"
_HEADER = (
    *("code", "step, s", "force evaluations", "CPU s"),
    *("t_det", "static friction", "force", "order"),
)

_PAGE = """# Entries

Written by `python -m benchmarks.verification entries`; README.md defines the metrics. In short,
t_det is the RMS error before the horizon over t_max, force the largest error before t_max over the
largest force, and order the number of blocks out of order. The first line of each table gives the
uncertainties of the reference: smaller errors cannot be distinguished.

CPU s is the CPU time of one run on one core, without compilation: for leapfrog, rk4 and plain rk4
the median of three runs, for Siconos a single run without set-up.
"""


def solved_by(
    integrator: str, step: float, problem: Problem, surface: Surface
) -> tuple[Answer, int]:
    """Return the answer of one of our integrators, and its number of force evaluations."""
    run = solve_with(integrator, step, surface, problem.duration, SAMPLE_INTERVAL)
    return Answer(problem, run.t_det, run.force), FORCE_EVALUATIONS[integrator] * run.steps


def solved_by_siconos(step: float, problem: Problem) -> tuple[Answer, int, float]:
    """Return the answer of Siconos, its number of force evaluations and its CPU time in s."""
    with tempfile.TemporaryDirectory() as folder:
        t_det, force = Path(folder, "t_det.csv"), Path(folder, "force.csv")
        words = [problem.folder / "surface.csv", step, problem.duration, t_det, force]
        outcome = subprocess.run(
            # isolated: without the packages of this process
            [_SYSTEM_PYTHON, "-I", _PROGRAM, *map(str, words)],
            env=os.environ | {"OMP_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
        evaluations, seconds = outcome.stdout.split()
        return read_answer(problem, t_det, force), int(evaluations), float(seconds)


def page() -> str:
    """Return all entries, in Markdown; needs Siconos."""
    if subprocess.run([_SYSTEM_PYTHON, "-I", "-c", "import siconos.kernel"]).returncode:
        raise click.ClickException("the entries need Siconos, Debian's package python3-siconos")
    tables = (
        f"## {problem.name.capitalize()}\n\n{markdown_table(_HEADER, _lines(problem))}\n"
        for problem in PROBLEMS.values()
    )
    return "\n".join([_PAGE, *tables])


def _lines(problem: Problem) -> Iterator[Sequence[str]]:
    surface, reference = read_surface(problem), read_reference(problem)
    yield "uncertainty", "", "", "", *cells(uncertainties(reference))

    def line(code: str, step: float, answer: Answer, evaluations: int, seconds: float) -> list[str]:
        cost = f"{step:g}", f"{evaluations}", f"{seconds:.2g}"
        return [code, *cost, *cells(errors(answer, reference))]

    for integrator, steps in STEPS.items():
        for step in steps:
            run = partial(solved_by, integrator, step, problem, surface)
            answer, evaluations = run()  # compiles
            (seconds,) = interleaved({integrator: run}, REPETITIONS).values()
            yield line(integrator, step, answer, evaluations, float(np.median(seconds)))
    for step in STEPS["leapfrog"]:
        yield line("Siconos", step, *solved_by_siconos(step, problem))
