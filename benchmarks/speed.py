"""Speed of the solver, as one table: `make bench`, or `python -m benchmarks [PART ...]`.

kernel       one step with all blocks moving, N = 120: both integrators, the same leapfrog in C,
             LAMMPS, and a direct Runge-Kutta method; ratio to the leapfrog
realisation  whole runs, from zero and with the prelude; ratio to as many steps of 1e-8 s in C
scaling      a step of the leapfrog with all blocks moving; ratio to N = 120

Values are medians of the repetitions, in CPU time. All codes of a comparison run in turn, and
ratios are medians of the ratios within repetitions.
"""

import platform
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from importlib import metadata
from pathlib import Path

import click
import numpy as np
import pandas as pd
from numpy.typing import NDArray
from tqdm import tqdm

from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.timing import Array, Missing, Runs, interleaved
from springblock import Surface, compute_prelude, draw_friction, simulate
from springblock.model.defaults import PAPER_STEP, SAMPLE_INTERVAL
from springblock.model.scene import Scene
from springblock.provenance import SIMULATE, code_version
from springblock.simulation.setup import PAPER
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.loop import advance
from springblock.study.accuracy import plain_rk4

N = 120
STEPS = 300  #: of a kernel in one repetition, some 50 ms
REPETITIONS = 15
FEW = 3  #: repetitions of whole realisations, which take seconds
WARM_UP = 40  #: steps before anything is timed, with all code compiled and all memory in use

#: Surfaces in motion: velocities of 0.05 m/s, a tenth of what slip reaches, and thresholds so low
#: that no block comes to rest.
SPEED = 0.05
THRESHOLDS = 1e-4

SCENES = {
    "flat": Scene(N),
    "pillars": Scene(N, n_p=20, n_s=20),
    "grooves": Scene(N, n_p=58, n_s=62, n_p2=8, n_s2=2),
}
#: The plain Runge-Kutta method would need minutes on the full size.
PLAIN_N = 40

SIZES = (16, 30, 60, 120, 250, 500, 1000, 2000)
BLOCK_STEPS = 4_000_000  #: per repetition, whatever the size

PER_STEP = "ns per block and step"
Steps = Callable[[int], object]  #: takes so many steps
Row = dict[str, str]  #: of the printed table


class Solver:
    """The compiled solver on a flat surface in motion, pulled along x."""

    def __init__(self, integrator: str, n: int) -> None:
        self.integrator, self.taken = integrator, 0
        contact, mu_static, mu_dynamic, velocity = in_motion(n)
        how = (PAPER, (1.0, 0.0), INTEGRATORS[integrator], PAPER_STEP)
        self.state, self.constants = prepare(Surface(contact, mu_static, mu_dynamic), *how)
        blocks, grid = self.state.blocks, self.constants.grid
        self.velocity = unpadded(blocks.vx, grid), unpadded(blocks.vy, grid)  # views
        self.velocity[0][:], self.velocity[1][:] = velocity
        self.advance(min(WARM_UP, 1 + BLOCK_STEPS // n**2))

    def advance(self, steps: int) -> None:
        """Take so many steps."""
        how = INTEGRATORS[self.integrator], self.state, self.constants
        advance(*how, self.taken, steps, steps, Samples.empty(1))
        self.taken += steps


def in_motion(n: int) -> tuple[NDArray[np.bool_], Array, Array, Array]:
    """Contact, coefficients and velocities (2, N, N), in l per step, of a surface in motion."""
    noise = np.random.default_rng(n).standard_normal((2, n, n))
    mu_static, mu_dynamic = draw_friction(n, seed=0)
    velocity = SPEED * PAPER_STEP / PAPER.spacing * noise
    return np.ones((n, n), bool), THRESHOLDS * mu_static, THRESHOLDS * mu_dynamic, velocity


def c_loop_in_motion(n: int) -> Steps:
    """Return the leapfrog in C; raises Missing."""
    c_loop.require()
    contact, mu_static, mu_dynamic, velocity = in_motion(n)
    loop = c_loop.CLoop(contact, mu_static, mu_dynamic, PAPER_STEP)
    loop.velocity[:] = velocity
    return loop.advance


def lammps_in_motion(n: int) -> Steps:
    """Return the frictionless lattice in LAMMPS, from strained springs; raises Missing."""
    lammps_lattice.require()
    return lammps_lattice.LammpsLattice(in_motion(n)[3], PAPER_STEP).advance


def plain_in_motion(n: int) -> Steps:
    """Return the plain Runge-Kutta method, from rest in every call."""
    surface = Surface(*in_motion(n)[:3])
    return lambda k: plain_rk4.solve(surface, k * PAPER_STEP, PAPER_STEP, k * PAPER_STEP)


#: Codes whose steps are compared: what makes one for N, steps per repetition, and a note.
CODES: dict[str, tuple[Callable[[int], Steps], int, str]] = {
    "leapfrog": (lambda n: Solver("leapfrog", n).advance, STEPS, ""),
    "C loop": (c_loop_in_motion, STEPS, "leapfrog without energy balance and check of strains"),
    "LAMMPS": (lammps_in_motion, STEPS // 5, "bonds and tethers; no friction"),
    "rk4": (lambda n: Solver("rk4", n).advance, STEPS // 5, ""),
    "plain rk4": (plain_in_motion, STEPS // 30, "numba, a first, direct implementation"),
}


def row(what: str, values: Array, unit: str, reference: Array | float, note: str = "") -> Row:
    """Return a row of the table from the values of all repetitions."""
    low, median, high = (f"{value:.3g}" for value in np.quantile(values, [0.25, 0.5, 0.75]))
    ratio = np.median(values / np.asarray(reference))
    numbers = {
        "value": median,
        "quartiles": f"{low} - {high}",
        "ratio": "" if np.isnan(ratio) else f"{ratio:.2f}",
    }
    return {"what": what, **numbers, "unit": unit, "note": note}


def kernel() -> Iterator[Row]:
    """Steps of both integrators and of other codes, with all blocks in motion."""
    runs: Runs = {}
    for name, (make, steps, _) in CODES.items():
        try:
            advance = make(N)
        except Missing as reason:
            yield {"what": name, "value": "missing", "note": str(reason)}
            continue
        advance(min(WARM_UP, steps))
        runs[name] = partial(advance, steps)
    seconds = interleaved(runs, REPETITIONS)
    cost = {name: 1e9 * each / CODES[name][1] / N**2 for name, each in seconds.items()}
    for name, each in cost.items():
        yield row(name, each, PER_STEP, cost["leapfrog"], CODES[name][2])


def realisation() -> Iterator[Row]:
    """Whole runs of the paper's scenes, and of a small surface by the plain method as well."""
    for name, scene in [*SCENES.items(), ("flat", Scene(PLAIN_N))]:
        contact = scene.pattern.contact
        surface = Surface.draw(contact, seed=0)
        run = partial(simulate, surface, prelude=compute_prelude(contact))
        duration = float(run().time[-1])
        runs: Runs = {
            "from zero": partial(simulate, surface),
            "with the prelude": run,
            "prelude, once for all seeds": partial(compute_prelude, contact),
        }
        if scene.n_blocks == PLAIN_N:
            plain = partial(plain_rk4.solve, surface, duration, PAPER_STEP, SAMPLE_INTERVAL)
            plain()  # compiled first
            runs["plain rk4, from zero"] = plain
        with suppress(Missing):
            runs["C"] = partial(c_loop_in_motion(scene.n_blocks), STEPS)
        seconds = interleaved(runs, FEW)
        in_c = seconds.pop("C", np.nan) / STEPS * round(duration / PAPER_STEP)
        for what, each in seconds.items():
            yield row(f"{name}, N = {scene.n_blocks}: {what}", each, "s", in_c)


def scaling() -> Iterator[Row]:
    """The leapfrog over the size of the surface."""
    steps = {n: max(1, BLOCK_STEPS // n**2) for n in SIZES}
    runs: Runs = {f"N = {n}": partial(Solver("leapfrog", n).advance, steps[n]) for n in SIZES}
    seconds = interleaved(runs, REPETITIONS)
    cost = {n: 1e9 * seconds[f"N = {n}"] / steps[n] / n**2 for n in SIZES}
    for n, each in cost.items():
        yield row(f"N = {n}", each, PER_STEP, cost[N])


PARTS = {part.__name__: part for part in (kernel, realisation, scaling)}


def machine() -> str:
    """Return the processor and the versions on which the numbers depend."""
    file = Path("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.*)", file.read_text()) if file.exists() else None
    packages = (f"{name} {metadata.version(name)}" for name in ("numba", "llvmlite", "numpy"))
    processor = model[1] if model else platform.processor() or platform.machine()
    return ", ".join([processor, *packages, f"springblock {code_version(SIMULATE)}"])


@click.command()
@click.argument("parts", type=click.Choice(list(PARTS)), nargs=-1)
def main(parts: tuple[str, ...]) -> None:
    """Measure the speed of the solver: of all PARTS, or of those named."""
    rows = [{"part": part, **each} for part in tqdm(parts or PARTS) for each in PARTS[part]()]
    columns = ["part", "what", "value", "quartiles", "unit", "ratio", "note"]
    click.echo(pd.DataFrame(rows, columns=columns).fillna("").to_string(index=False))
    click.echo(f"{__doc__}\n{machine()}")
