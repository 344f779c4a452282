"""How fast, printed as one table.

kernel       ns per block and step where all blocks move: both integrators, the same leapfrog in C,
             LAMMPS and Runge-Kutta as one would first write it; and the share of the core's peak
             that those reach whose operations are counted
realisation  CPU seconds of whole runs, from zero and with the prelude
scaling      the leapfrog over the size of the surface, and over the share of blocks that move
cores        the leapfrog on one core and on all, by the clock on the wall

No part but cores uses threads. Peers that are not there, or fail, make rows that say so. What
history.csv keeps of a release is printed at the end.

Call with `python -m benchmarks` from the repository, or `make bench`.
"""

import os
import platform
import re
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

import click
import llvmlite.binding
import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from benchmarks import history
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.peers.c_loop import CLoop, Peak
from benchmarks.peers.lammps_lattice import LammpsLattice
from benchmarks.timing import (
    BLOCK_STEP,
    WITH_PRELUDE,
    Array,
    Missing,
    Row,
    Runs,
    interleaved,
    printed,
)
from springblock import Surface, compute_prelude, draw_friction, simulate
from springblock.accuracy import plain_rk4
from springblock.accuracy.conventions import PAPER_STEP
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.scene import Scene
from springblock.provenance import code_version
from springblock.simulation.setup import PAPER
from springblock.solver.integrators import INTEGRATORS, on_cores
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
#: Trial, |w|², turned, held, stops, mean velocity, friction over its length, velocity; drift.
LEAPFROG = SPRINGS + GATHER + (4 + 3 + 3 + 4 + 1 + 2 + 5 + 4) + 4
#: Acceleration, sums over stages, the next stage; direction, that in mid-step, turned; drift.
RK4 = 4 * (SPRINGS + GATHER) + 4 * (8 + 2 * 4 + 2 * 4) + (6 + 21 + 3) + (2 + 4)

STEPS = 300  #: of a kernel in one repetition, some 50 ms
ROUNDS = 10_000_000  #: of multiply-adds
MULTIPLY_ADDS = "multiply-adds"

MOVING = "all blocks move"

Flags = NDArray[np.bool_]
Steps = Callable[[int], object]  #: takes so many steps


class Solver:
    """The compiled solver on a flat surface in motion, pulled along x."""

    def __init__(self, integrator: str, n: int, still: Flags | None = None) -> None:
        self.integrator, self.n, self.taken = integrator, n, 0
        contact, mu_static, mu_dynamic, velocity = in_motion(n)
        if still is not None:
            mu_static = np.where(still, NEVER, mu_static)
            velocity = np.where(still, 0.0, velocity)
        how = (PAPER, (1.0, 0.0), INTEGRATORS[integrator], PAPER_STEP)
        self.state, self.constants = prepare(Surface(contact, mu_static, mu_dynamic), *how)
        blocks, grid = self.state.blocks, self.constants.grid
        self.velocity = unpadded(blocks.vx, grid), unpadded(blocks.vy, grid)  # views
        self.velocity[0][:], self.velocity[1][:] = velocity
        self.advance(min(WARM_UP, 1 + BLOCK_STEPS // n**2))

    def advance(self, steps: int, cores: int = 1) -> None:
        """Take so many steps."""
        advance, samples = on_cores(self.integrator, cores), Samples.empty(1)
        advance(self.state, self.constants, self.taken, steps, steps, samples)
        self.taken += steps

    @property
    def moving(self) -> str:
        """Say how many blocks move now."""
        moving = np.any(self.velocity, axis=0).mean()
        return f"{100.0 * moving:.4g} % of the blocks move"


def in_motion(n: int) -> tuple[Flags, Array, Array, Array]:
    """Contact, coefficients and velocities (2, N, N), in l per step, of a surface in motion."""
    noise = np.random.default_rng(n).standard_normal((2, n, n))
    mu_static, mu_dynamic = draw_friction(n, seed=0)
    velocity = SPEED * PAPER_STEP / PAPER.spacing * noise
    return np.ones((n, n), bool), THRESHOLDS * mu_static, THRESHOLDS * mu_dynamic, velocity


def c_loop_in_motion(n: int) -> Steps:
    """Return the leapfrog in C; raises Missing."""
    c_loop.require()
    contact, mu_static, mu_dynamic, velocity = in_motion(n)
    loop = CLoop(contact, mu_static, mu_dynamic, PAPER_STEP)
    loop.velocity[:] = velocity
    return loop.advance


def lammps_in_motion(n: int) -> Steps:
    """Return the frictionless lattice in LAMMPS, from strained springs; raises Missing."""
    lammps_lattice.require()
    return LammpsLattice(in_motion(n)[3], PAPER_STEP).advance


def plain_in_motion(n: int) -> Steps:
    """Return Runge-Kutta as one would first write it, from rest in every call."""
    surface = Surface(*in_motion(n)[:3])
    return lambda k: plain_rk4.solve(surface, k * PAPER_STEP, PAPER_STEP, k * PAPER_STEP)


class Contender(NamedTuple):
    """What takes part in the comparison of kernels."""

    make: Callable[[int], Steps]  #: from N; raises Missing
    steps: int  #: per repetition
    note: str
    operations: float = np.nan  #: per block and step; NaN where nobody has counted them


CONTENDERS = {
    "leapfrog": Contender(lambda n: Solver("leapfrog", n).advance, STEPS, MOVING, LEAPFROG),
    "C loop": Contender(c_loop_in_motion, STEPS, "leapfrog without balance and watch", LEAPFROG),
    "LAMMPS": Contender(lammps_in_motion, STEPS // 5, "bonds and tethers; no friction"),
    "rk4": Contender(lambda n: Solver("rk4", n).advance, STEPS // 5, MOVING, RK4),
    "plain rk4": Contender(plain_in_motion, STEPS // 30, "numba, as one would first write it"),
}


def kernel() -> Iterator[Row]:
    """Both integrators and their peers, step by step, all blocks in motion."""
    runs: Runs = {}
    for name, contender in CONTENDERS.items():
        try:
            advance = contender.make(N)
        except Missing as why:
            yield Row("kernel", name, BLOCK_STEP, np.nan, "flat", N, note=str(why))
            continue
        advance(min(WARM_UP, contender.steps))
        runs[name] = partial(advance, contender.steps)
    with suppress(Missing):
        peak = Peak(ROUNDS)
        runs[MULTIPLY_ADDS] = peak.run
    seconds = interleaved(runs, REPETITIONS)
    operation: Array | float = np.nan  # at the core's peak, ns
    if MULTIPLY_ADDS in seconds:
        rate = 1e-9 * peak.operations / seconds.pop(MULTIPLY_ADDS)
        operation = 1.0 / rate
        yield Row("kernel", MULTIPLY_ADDS, "Gflop/s", rate, note="the peak of one core")
    cost = {name: 1e9 * each / CONTENDERS[name].steps / N**2 for name, each in seconds.items()}
    for name, each in cost.items():
        contender = CONTENDERS[name]
        ends = cost["leapfrog"], contender.operations * operation, contender.note
        yield Row("kernel", name, BLOCK_STEP, each, "flat", N, *ends)


def realisation() -> Iterator[Row]:
    """Whole runs of the paper's scenes, and of a small surface by the plain method as well.

    The ratio is to the C loop from zero, as long, at the paper's step.
    """
    for name, scene in [*SCENES.items(), ("flat", Scene(PLAIN_N))]:
        contact = scene.pattern.contact
        surface = Surface.draw(contact, seed=0)
        run = partial(simulate, surface, prelude=compute_prelude(contact))
        duration = float(run().time[-1])
        runs: Runs = {
            "from zero": partial(simulate, surface),
            WITH_PRELUDE: run,
            "prelude, once for all seeds": partial(compute_prelude, contact),
        }
        if scene.n_blocks == PLAIN_N:
            plain = partial(plain_rk4.solve, surface, duration, PAPER_STEP, SAMPLE_INTERVAL)
            plain()  # compiled first
            runs["plain rk4, from zero"] = plain
        with suppress(Missing):
            runs["C"] = partial(c_loop_in_motion(scene.n_blocks), STEPS)
        seconds = interleaved(runs, FEW)
        bound = seconds.pop("C", np.nan) / STEPS * round(duration / PAPER_STEP)
        for what, each in seconds.items():
            yield Row("realisation", what, "s", each, name, scene.n_blocks, bound)


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
    seconds = interleaved(runs, REPETITIONS)
    cost = {name: 1e9 * seconds[name] / steps[name] / solvers[name].n ** 2 for name in solvers}
    for name, solver in solvers.items():
        each, whole = cost[name], cost[reference]
        yield Row("scaling", name, BLOCK_STEP, each, "flat", solver.n, whole, note=solver.moving)


def cores() -> Iterator[Row]:
    """Large surfaces on one core and on all there are; seconds of the wall."""
    numbers = sorted({1, os.cpu_count() or 1})
    for n in LARGE:
        solver, steps = Solver("leapfrog", n), max(1, LONGER * BLOCK_STEPS // n**2)
        runs = {
            f"leapfrog, N = {n}, cores = {k}": partial(solver.advance, steps, k) for k in numbers
        }
        seconds = interleaved(runs, FEW, time.perf_counter)
        cost = {name: 1e9 * each / steps / n**2 for name, each in seconds.items()}
        alone = next(iter(cost.values()))
        for name, each in cost.items():
            yield Row("cores", name, BLOCK_STEP, each, "flat", n, alone)


PARTS = {part.__name__: part for part in (kernel, realisation, scaling, cores)}
LEGEND = """
ratio: kernel, to a step of the leapfrog; realisation, to all steps by the C loop; scaling, to
N = 120, all moving; cores, to one core. of peak: share of the multiply-adds that one core can do.
Times are CPU times but for those of cores.
"""


def machine() -> dict[str, str]:
    """What the numbers depend on besides the code."""
    file, has = Path("/proc/cpuinfo"), llvmlite.binding.get_host_cpu_features()
    model = re.search(r"model name\s*: (.*)", file.read_text()) if file.exists() else None
    return {
        "cpu": model[1] if model else platform.processor() or platform.machine(),
        "vectors": "avx512" if has.get("avx512f") else "avx2" if has.get("avx2") else "other",
        "python": platform.python_version(),
        **{name: metadata.version(name) for name in ("numba", "llvmlite", "numpy")},
        "code_version": code_version("simulate"),
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
@click.option("--release", is_flag=True, help="Add a line to benchmarks/history.csv.")
def main(parts: tuple[str, ...], release: bool) -> None:
    """Measure how fast the solver is."""
    whole = set(history.PARTS) <= set(parts)
    if release and not whole:
        raise click.UsageError(f"--release needs the parts {' and '.join(history.PARTS)}")
    here = machine()
    rows = [each for part in tqdm(parts) for each in PARTS[part]()]
    click.echo(f"{printed(rows)}\n{LEGEND}")
    click.echo(", ".join(f"{name} {what}" for name, what in here.items()))
    if whole:
        line = history.line(here, rows, N)
        click.echo(f"\n{'added to' if release else 'as a line of'} benchmarks/history.csv:\n{line}")
    if release:
        with history.FILE.open("a", encoding="utf-8") as file:
            file.write(f"{line}\n")
