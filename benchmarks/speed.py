"""How fast: the rows of results/tables/benchmark.parquet, printed as one table.

kernel       ns per block and step where all blocks move: both integrators, the same leapfrog in C,
             LAMMPS, Runge-Kutta as one would first write it, and SciPy's DOP853; and the share of
             the core's peak that those reach whose operations are counted
realisation  CPU seconds of whole runs, from zero and with the prelude
scaling      the leapfrog over the size of the surface, and over the share of blocks that move
cores        the leapfrog on one core and on all, by the clock on the wall
peak         what that is a share of: the multiply-adds of one core, and the operations counted
study        where the CPU time of the whole study goes, and what the pipeline adds to it

No part but cores uses threads. Peers that are not there, or fail, make rows that say so. What
history.csv keeps of a release is printed at the end.

Call with `python -m benchmarks` from the repository, or `make bench`.
"""

import os
import platform
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from importlib import metadata
from pathlib import Path
from typing import Any, Protocol

import click
import llvmlite.binding
import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from benchmarks import history, study_cost
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.peers.c_loop import CLoop, Peak
from benchmarks.peers.lammps_lattice import LammpsLattice
from benchmarks.peers.missing import Missing
from benchmarks.peers.scipy_lattice import RTOL, ScipyLattice
from benchmarks.timing import (
    BLOCK_STEP,
    SCHEMA,
    WITH_PRELUDE,
    Array,
    Row,
    interleaved,
    missing,
    printed,
    row,
)
from springblock import Realisation, compute_prelude, draw_friction, simulate
from springblock.accuracy import plain_rk4
from springblock.accuracy.conventions import PAPER_STEP
from springblock.cli.options import one_sentence
from springblock.io.parquet import rows_to_table, write
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.scene import Scene
from springblock.provenance import code_version
from springblock.simulation.setup import PAPER
from springblock.solver import INTEGRATORS, on_cores
from springblock.solver.lattice import Samples, prepare, unpadded

N = 120
REPETITIONS = 15
FEW = 3  #: repetitions of whole realisations, which take seconds
#: Steps before anything is timed, with all code compiled and all memory in use.
WARM_UP = 40

#: Surfaces in motion: velocities of 0.05 m/s, a tenth of what slip reaches, and thresholds so low
#: that no block comes to rest.
SPEED = 0.05
THRESHOLDS = 1e-4
NEVER = 1e9  #: a coefficient of friction that is never overcome

SCENES = {
    "flat": Scene(N),
    "pillars": Scene(N, n_p=20, n_s=20),
    "grooves": Scene(N, n_p=58, n_s=62, n_p2=8, n_s2=2),
}
#: The plain Runge-Kutta method would need minutes on the full size.
PLAIN_N = 40
FINE_STEP = 2.5e-9

SIZES = (16, 30, 60, 120, 250, 500, 1000, 2000)
BLOCK_STEPS = 4_000_000  #: per repetition, whatever the size
LONGER = 100  #: times as many on several cores, whose threads begin anew with every call
LARGE = (500, 2000)  #: surfaces that several cores may share
SHARES = (0.0, 0.25, 0.5, 0.75)

#: Floating-point operations per block and step that the methods ask for, counted in peers/loop.c
#: and, beyond its forces, in solver/rk4.py. A fused multiply-add is two, a division or a root one.
#: What the solver does on top, its energy balance above all, does not count.
SPRINGS = 2 * (2 + 5 + 13 + 3) + 2 * (2 + 6 + 13 + 4)  #: ends, q, polynomial, two components
GATHER = 2 * (9 + 3)  #: eight springs and the slider, two components
OPERATIONS = {
    "leapfrog": {
        "springs": SPRINGS,
        "gather": GATHER,
        # trial, |w|², turned, held, stops, mean velocity, friction over its length, velocity
        "friction": 4 + 3 + 3 + 4 + 1 + 2 + 5 + 4,
        "drift": 4,  # new displacement, and its sum
    },
    "rk4": {
        "springs": 4 * SPRINGS,
        "gather": 4 * GATHER,
        "stages": 4 * (8 + 2 * 4 + 2 * 4),  # acceleration, sums over stages, the next stage
        "friction": 6 + 21 + 3,  # direction, that in the middle of the step, turned
        "drift": 2 + 4,  # new velocity, new displacement and its sum
    },
}
COUNTS = {name: sum(counted.values()) for name, counted in OPERATIONS.items()}

STEPS = 300  #: of a kernel in one repetition, some 50 ms
ROUNDS = 10_000_000  #: of multiply-adds
MULTIPLY_ADDS = "multiply-adds"
BLOCK_EVALUATION = "ns per block and evaluation"


Flags = NDArray[np.bool_]
Runs = dict[str, Callable[[], object]]  #: what is timed in turn, by its name


class Lattice(Protocol):
    """Anything that can be timed step by step."""

    def advance(self, steps: int) -> object:
        """Take so many steps."""


class Solver:
    """The compiled solver on a flat surface in motion, pulled along x."""

    def __init__(self, integrator: str, n: int, still: Flags | None = None) -> None:
        self.integrator, self.n, self.taken = integrator, n, 0
        contact, mu_static, mu_dynamic, velocity = in_motion(n)
        if still is not None:
            mu_static = np.where(still, NEVER, mu_static)
            velocity = np.where(still, 0.0, velocity)
        how = (PAPER, (1.0, 0.0), INTEGRATORS[integrator], PAPER_STEP)
        self.state, self.constants = prepare(contact, mu_static, mu_dynamic, *how)
        for component, start in zip(self.velocity, velocity, strict=True):
            component[:] = start
        self.advance(min(WARM_UP, 1 + BLOCK_STEPS // n**2))

    def advance(self, steps: int, cores: int = 1) -> None:
        """Take so many steps."""
        advance, samples = on_cores(self.integrator, cores), Samples.empty(1)
        advance(self.state, self.constants, self.taken, steps, steps, samples)
        self.taken += steps

    @property
    def velocity(self) -> tuple[Array, Array]:
        """Both components, (N, N) each, views."""
        blocks = self.state.blocks
        grid = self.constants.grid
        return unpadded(blocks.wx, grid), unpadded(blocks.wy, grid)

    @property
    def moving(self) -> str:
        """How many blocks move now."""
        rest = ~np.any(self.velocity, axis=0)
        return f"{100.0 * (1.0 - rest.mean()):.4g} % of the blocks move"


class PlainRungeKutta:
    """Runge-Kutta as one would first write it, from rest in every call."""

    def __init__(self, n: int) -> None:
        self.surface = in_motion(n)[:3]
        self.advance(WARM_UP)

    def advance(self, steps: int) -> None:
        """Take so many steps."""
        plain_rk4.solve(*self.surface, steps * PAPER_STEP, PAPER_STEP, steps * PAPER_STEP)


def in_motion(n: int) -> tuple[Flags, Array, Array, Array]:
    """Contact, coefficients and velocities (2, N, N), in l per step, of a surface in motion."""
    noise = np.random.default_rng(n).standard_normal((2, n, n))
    mu_static, mu_dynamic = draw_friction(n, seed=0)
    velocity = SPEED * PAPER_STEP / PAPER.spacing * noise
    return np.ones((n, n), bool), THRESHOLDS * mu_static, THRESHOLDS * mu_dynamic, velocity


def c_loop_in_motion(n: int) -> CLoop:
    """The same in C; raises Missing."""
    c_loop.require()
    contact, mu_static, mu_dynamic, velocity = in_motion(n)
    loop = CLoop(contact, mu_static, mu_dynamic, PAPER_STEP)
    loop.velocity[:] = velocity
    loop.advance(WARM_UP)
    return loop


def lammps_in_motion(n: int) -> LammpsLattice:
    """The frictionless lattice in LAMMPS, from strained springs; raises Missing."""
    lammps_lattice.require()
    lattice = LammpsLattice(in_motion(n)[3], PAPER_STEP)
    lattice.advance(WARM_UP)
    return lattice


def scipy_in_motion(n: int) -> ScipyLattice:
    """The frictionless lattice for DOP853, which has found its step."""
    lattice = ScipyLattice(in_motion(n)[3])
    lattice.advance(5)
    return lattice


@dataclass(frozen=True)
class Contender:
    """What takes part in the comparison of kernels."""

    make: Callable[[int], Lattice]  #: from N; raises Missing
    steps: int  #: per repetition
    evaluations: int  #: of the force, per step
    note: str
    operations: int = 0  #: per block and step; 0 where nobody has counted them


#: What DOP853 does in a step is counted while it runs.
CONTENDERS = {
    "leapfrog": Contender(partial(Solver, "leapfrog"), STEPS, 1, "", COUNTS["leapfrog"]),
    "C loop": Contender(
        c_loop_in_motion,
        STEPS,
        1,
        "leapfrog without energy balance and watch over strains",
        COUNTS["leapfrog"],
    ),
    "LAMMPS": Contender(
        lammps_in_motion, STEPS // 5, 1, "bonds, tethers, velocity Verlet; no friction"
    ),
    "rk4": Contender(partial(Solver, "rk4"), STEPS // 5, 4, "", COUNTS["rk4"]),
    "plain rk4": Contender(PlainRungeKutta, STEPS // 30, 5, "numba, as one would first write it"),
    "DOP853": Contender(
        scipy_in_motion, 1, 12, f"SciPy with NumPy, rtol {RTOL:g}; no friction; per 1e-8 s"
    ),
}


def kernel() -> Iterator[Row]:
    """Both integrators and their peers, step by step, all blocks in motion."""
    made: dict[str, Any] = {}
    absent: dict[str, Missing] = {}
    for name, contender in CONTENDERS.items():
        try:
            made[name] = contender.make(N)
        except Missing as why:
            absent[name] = why
    before = made["DOP853"].progress
    runs: Runs = {
        name: partial(peer.advance, CONTENDERS[name].steps) for name, peer in made.items()
    }
    multiply_adds = None
    with suppress(Missing):
        multiply_adds = Peak(ROUNDS)
        runs[MULTIPLY_ADDS] = multiply_adds.run
    seconds = interleaved(runs, REPETITIONS)
    operation: Array | float = np.nan  # at the core's peak, ns
    if multiply_adds:
        operation = 1e9 * seconds.pop(MULTIPLY_ADDS) / multiply_adds.operations
    cost = {name: 1e9 * each / N**2 for name, each in seconds.items()}
    leapfrog = cost["leapfrog"] / CONTENDERS["leapfrog"].steps
    for name, contender in CONTENDERS.items():
        if name in absent:
            yield missing("kernel", name, BLOCK_STEP, absent[name], "flat", N)
            continue
        steps: float = contender.steps
        evaluations: float = steps * contender.evaluations
        if name == "DOP853":
            steps, evaluations = (made[name].progress - before) / REPETITIONS
        here = partial(row, "kernel", name, scene="flat", n_blocks=N, reference=leapfrog)
        note = "; ".join(filter(None, [contender.note, getattr(made[name], "moving", "")]))
        at_peak = contender.operations * operation if contender.operations else None
        yield here(BLOCK_STEP, cost[name] / steps, note=note, at_peak=at_peak)
        if evaluations > steps:
            yield here(BLOCK_EVALUATION, cost[name] / evaluations)


def realisation() -> Iterator[Row]:
    """Whole runs of the paper's scenes, and what the plain method would need."""
    for name, scene in SCENES.items():
        contact, mu = scene.pattern.contact, draw_friction(N, seed=0)
        prelude = compute_prelude(contact)
        run = partial(simulate, contact, *mu)
        runs: Runs = {
            "from zero": run,
            WITH_PRELUDE: partial(run, prelude=prelude),
            "prelude, once for all seeds": partial(compute_prelude, contact),
        }
        yield from against_c(name, N, runs, run(prelude=prelude))
    yield from plain_realisation()


def plain_realisation() -> Iterator[Row]:
    """A flat realisation by the plain method, and by the solver: time and error."""
    contact, mu = Scene(PLAIN_N).pattern.contact, draw_friction(PLAIN_N, seed=0)
    solve = partial(simulate, contact, *mu, prelude=compute_prelude(contact))
    solved = solve()
    fine = simulate(contact, *mu, step=FINE_STEP).static_friction
    plain = partial(
        plain_rk4.solve, contact, *mu, float(solved.time[-1]), PAPER_STEP, SAMPLE_INTERVAL
    )
    plain_friction = plain().static_friction
    runs: Runs = {WITH_PRELUDE: solve, "plain rk4, from zero": plain}
    yield from against_c("flat", PLAIN_N, runs, solved)
    note = f"against a step of {FINE_STEP:g} s; one seed"
    for name, friction in (
        (WITH_PRELUDE, solved.static_friction),
        ("plain rk4, from zero", plain_friction),
    ):
        error = f"{name}: error of static friction"
        yield row("realisation", error, "1", friction / fine - 1.0, "flat", PLAIN_N, note=note)


def against_c(scene: str, n: int, runs: Runs, run: Realisation) -> Iterator[Row]:
    """Rows of these runs; the ratio is to the C loop from zero, as long, at the paper's step."""
    bound, steps = None, round(run.time[-1] / PAPER_STEP)
    try:
        loop = c_loop_in_motion(n)
    except Missing:
        seconds = interleaved(runs, FEW)
    else:
        seconds = interleaved({**runs, "C": partial(loop.advance, STEPS)}, FEW)
        bound = seconds.pop("C") / STEPS * steps
    for name, each in seconds.items():
        note = f"{run.steps} steps from zero; of C {steps}"
        yield row("realisation", name, "s", each, scene, n, bound, note)


def scaling() -> Iterator[Row]:
    """The leapfrog over the size of the surface, and over the share of blocks that move."""
    rng = np.random.default_rng(0)
    solvers = {f"leapfrog, N = {n}": Solver("leapfrog", n) for n in SIZES}
    reference = f"leapfrog, N = {N}"
    for share in SHARES:
        spread = rng.permutation(N * N).reshape(N, N) >= share * N * N
        rows = np.repeat(rng.permutation(N)[:, None] >= share * N, N, axis=1)
        for how, still in (("at random", spread), ("by rows", rows)):
            name = f"leapfrog, {100 * share:.0f} % moving {how}"
            solvers[name] = Solver("leapfrog", N, still)
    steps = {name: max(1, BLOCK_STEPS // solver.n**2) for name, solver in solvers.items()}
    runs = {name: partial(solver.advance, steps[name]) for name, solver in solvers.items()}
    cost = {
        name: 1e9 * each / steps[name] / solvers[name].n ** 2
        for name, each in interleaved(runs, REPETITIONS).items()
    }
    for name, each in cost.items():
        here, note = ("flat", solvers[name].n), solvers[name].moving
        yield row("scaling", name, BLOCK_STEP, each, *here, cost[reference], note)


def cores() -> Iterator[Row]:
    """Large surfaces on one core and on all there are; seconds of the wall."""
    numbers = sorted({1, os.cpu_count() or 1})
    for n in LARGE:
        solver, steps = Solver("leapfrog", n), max(1, LONGER * BLOCK_STEPS // n**2)
        runs = {
            f"leapfrog, N = {n}, cores = {k}": partial(solver.advance, steps, k) for k in numbers
        }
        seconds = interleaved(runs, FEW, time.perf_counter)
        alone = next(iter(seconds.values()))
        for name, each in seconds.items():
            cost = 1e9 * each / steps / n**2
            yield row("cores", name, BLOCK_STEP, cost, "flat", n, 1e9 * alone / steps / n**2)


def peak() -> Iterator[Row]:
    """The most operations that one core does in a second, and those that the methods ask for."""
    for name, counted in OPERATIONS.items():
        listed = ", ".join(f"{what} {number}" for what, number in counted.items())
        yield row("peak", f"{name}: operations per block and step", "1", COUNTS[name], note=listed)
    try:
        multiply_adds = Peak(ROUNDS)
    except Missing as why:
        yield missing("peak", MULTIPLY_ADDS, "Gflop/s", why)
        return
    seconds = interleaved({MULTIPLY_ADDS: multiply_adds.run}, REPETITIONS)[MULTIPLY_ADDS]
    yield row("peak", MULTIPLY_ADDS, "Gflop/s", 1e-9 * multiply_adds.operations / seconds)


PARTS: dict[str, Callable[[], Iterator[Row]]] = {
    "kernel": kernel,
    "realisation": realisation,
    "scaling": scaling,
    "cores": cores,
    "peak": peak,
    "study": study_cost.rows,
}


def machine() -> dict[str, str]:
    """What the numbers depend on besides the code."""
    cpu = Path("/proc/cpuinfo")
    models = [
        line.partition(": ")[2]
        for line in (cpu.read_text().splitlines() if cpu.exists() else [])
        if line.startswith("model name")
    ]
    has = llvmlite.binding.get_host_cpu_features()
    return {
        "cpu": models[0] if models else platform.processor() or platform.machine(),
        "vectors": "avx512" if has.get("avx512f") else "avx2" if has.get("avx2") else "other",
        "python": platform.python_version(),
        **{name: metadata.version(name) for name in ("numba", "numpy", "scipy")},
        "llvm": ".".join(map(str, llvmlite.binding.llvm_version_info)),
        "gcc": c_loop.compiler_version(),
        "lammps": lammps_lattice.version(),
        "code_version": code_version("springblock.simulation.simulate"),
    }


@click.command()
@click.option(
    "--part",
    "parts",
    type=click.Choice(list(PARTS)),
    multiple=True,
    default=list(PARTS),
    help="Measure only this; may be repeated.",
)
@click.option(
    "--output",
    type=click.Path(dir_okay=False, path_type=Path),
    default=study_cost.RESULTS / "tables" / "benchmark.parquet",
    show_default=True,
    help="Parquet file.",
)
@click.option("--release", is_flag=True, help="Add a line to benchmarks/history.csv.")
def main(parts: tuple[str, ...], output: Path, release: bool) -> None:
    """Measure how fast the solver and the study are."""
    here = machine()
    whole = set(history.PARTS) <= set(parts)
    if release:
        if not whole:
            raise click.UsageError(
                f"--part is {', '.join(parts)}, and --release needs {' and '.join(history.PARTS)}"
            )
        with one_sentence():
            history.refuse_second(history.release(here))
    rows = [each for part in tqdm(parts) for each in PARTS[part]()]
    write(rows_to_table(rows, SCHEMA), output, here)
    click.echo(printed(rows))
    click.echo(f"\nratio: {SCHEMA.field('ratio').metadata[b'meaning'].decode()}")
    click.echo(f"of peak: {SCHEMA.field('of_peak').metadata[b'meaning'].decode()}")
    click.echo(", ".join(f"{name} {what}" for name, what in here.items()))
    if whole:
        line = {**history.release(here), **history.measured(rows, N)}
        click.echo(f"\n{'added to' if release else 'as a line of'} benchmarks/history.csv:")
        click.echo(history.text(line), nl=False)
        if release:
            history.append(line)
