"""The verification problems in Siconos: Moreau-Jean time stepping, contacts with dry friction.

Scheme and contacts are those of Acary & Brogliato 2008 (doi:10.1007/978-3-540-75392-6). A program
for the Python that has Siconos; nothing of this package is imported.

    OMP_NUM_THREADS=1 /usr/bin/python3 siconos_blocks.py SURFACE STEP DURATION T_DET FORCE

reads surface.csv, writes t_det and force as tables that benchmarks/verification/README.md defines,
and prints the number of force evaluations and the CPU seconds of all steps.

Every block is a Lagrangian system with three degrees of freedom: x, y and the height z. F_n presses
blocks in contact on a plane, so that friction on this unilateral contact is at most mu F_n in any
direction. Springs, slider and damping are internal forces from a plug-in in C. The scheme has
theta = 1/2 and is implicit; Newton's iteration takes the mass for its matrix.

A contact in Siconos has one coefficient of friction. It is switched between steps: mu_static at
rest, mu_dynamic in motion. A step in which a block starts to slide or turns back is computed again
with the other coefficient for this block. Detachment is at the beginning of the first step in which
a block slides. This switch is what makes the method one of first order.
"""

import csv
import ctypes
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
import siconos.kernel as siconos
from numpy.typing import NDArray

STIFFNESS, MASS, SPACING, DAMPING, SPEED, PRESSURE = 75.0, 1.2e-12, 1e-5, 5e3, 5e-4, 5e4
SAMPLED = 2e-7  #: interval of the force, s
#: Units in which K_int, m and P l² are one, because the tolerances of Siconos are absolute.
FORCE = PRESSURE * SPACING**2  #: N
METRE, SECOND = STIFFNESS / FORCE, math.sqrt(STIFFNESS / MASS)  # SI units in these
NEWTON, CONTACT = 1e-9, 1e-12  #: tolerances of Newton's iteration and of the contacts

PLUGIN = """
#include <math.h>
static int n;
static double spacing, damping, speed, **q;
long calls;

void prepare(int blocks, double l, double gamma, double v0, double **positions)
{
    n = blocks, spacing = l, damping = gamma, speed = v0, q = positions;
}

/* z holds the number of the block and the force that presses it on the plane. */
void internal(double t, unsigned size, double *own, double *v, double *f, unsigned m, double *z)
{
    int block = z[0], y = block / n, x = block % n;
    f[0] = own[0] - speed * t + damping * v[0];
    f[1] = own[1] + damping * v[1];
    f[2] = z[1];
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            if ((!dx && !dy) || y + dy < 0 || y + dy >= n || x + dx < 0 || x + dx >= n)
                continue;
            double *other = q[block + dy * n + dx];
            double rest = spacing * sqrt(dx * dx + dy * dy), k = dx && dy ? 0.5 : 1.0;
            double rx = dx * spacing + other[0] - own[0], ry = dy * spacing + other[1] - own[1];
            double pull = k * (1.0 - rest / sqrt(rx * rx + ry * ry));
            f[0] -= pull * rx;
            f[1] -= pull * ry;
        }
    calls++;
}
"""


def compiled(folder: str) -> Path:
    """Compile the plug-in and return its path."""
    library = Path(folder) / "blocks.so"
    command = ["gcc", "-O3", "-shared", "-fPIC", "-x", "c", "-", "-o", str(library), "-lm"]
    subprocess.run(command, input=PLUGIN, text=True, check=True)
    return library


class Answer(NamedTuple):
    """What is written and printed."""

    t_det: list[float]  #: s, of all blocks; NaN where never
    force: list[float]  #: N
    evaluations: int  #: of the force on all blocks
    seconds: float  #: of CPU time


def solve(surface: Path, step: float, duration: float, library: Path) -> Answer:
    """Pull the blocks from rest."""
    with surface.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    held = [b for b, row in enumerate(rows) if row["contact"] == "1"]
    static, dynamic = ([float(row[f"mu_{name}"]) for row in rows] for name in ("static", "dynamic"))
    system = siconos.NonSmoothDynamicalSystem(0.0, 2.0 * duration * SECOND)
    blocks = [siconos.LagrangianDS(np.zeros(3), np.zeros(3), np.eye(3)) for _ in rows]
    for b, block in enumerate(blocks):
        block.setzPtr([float(b), len(rows) / len(held) if b in held else 0.0])
        block.setComputeFIntFunction(str(library), "internal")
        system.insertDynamicalSystem(block)
    laws = {b: siconos.NewtonImpactFrictionNSL(0.0, 0.0, static[b], 3) for b in held}
    for b, law in laws.items():
        axes = siconos.LagrangianLinearTIR(np.eye(3)[[2, 0, 1]])  # the normal comes first
        system.link(siconos.Interaction(law, axes), blocks[b])
    scheme, friction = siconos.MoreauJeanOSI(0.5), siconos.FrictionContact(3)
    scheme.setConstraintActivationThreshold(1.0)  # z = 0 is in contact, whatever the rounding
    friction.setMStorageType(1)  # sparse blocks
    friction.numericsSolverOptions().dparam[0] = CONTACT
    steps = siconos.TimeDiscretisation(0.0, step * SECOND)
    simulation = siconos.TimeStepping(system, steps, scheme, friction)
    simulation.setNewtonTolerance(NEWTON)
    simulation.setNewtonMaxIteration(50)

    position, velocity = ([getattr(each, name)() for each in blocks] for name in ("q", "velocity"))
    pointers = (ctypes.c_void_p * len(rows))(*(q.ctypes.data for q in position))
    plugin, pull = ctypes.CDLL(str(library)), SPEED * METRE / SECOND
    numbers = (SPACING * METRE, DAMPING / SECOND, pull)
    plugin.prepare(math.isqrt(len(rows)), *map(ctypes.c_double, numbers), pointers)

    t_det, force = dict.fromkeys(held, math.nan), [0.0]
    before = dict.fromkeys(held, (0.0, 0.0))  # velocities
    start = time.process_time()
    for k in range(round(duration / step)):
        simulation.computeOneStep()
        left = set(held)  # blocks whose coefficient may still change in this step
        while changed := {b for b in left if _changes(before[b], velocity[b])}:
            left -= changed
            for b in changed:
                starts = before[b] == (0.0, 0.0)
                laws[b].setMu(dynamic[b] if starts else static[b])
                if starts and math.isnan(t_det[b]):
                    t_det[b] = k * step
            simulation.computeOneStep()
        for b in held:
            before[b] = velocity[b][0], velocity[b][1]
            laws[b].setMu(static[b] if before[b] == (0.0, 0.0) else dynamic[b])
        simulation.nextStep()
        if (k + 1) % round(SAMPLED / step) == 0:
            slider = len(rows) * pull * (k + 1) * step * SECOND
            x, y, _ = np.sum(position, axis=0)
            force.append(math.hypot(slider - x, y) * FORCE)
    seconds = time.process_time() - start
    evaluations = ctypes.c_long.in_dll(plugin, "calls").value // len(rows)
    return Answer([t_det.get(b, math.nan) for b in range(len(rows))], force, evaluations, seconds)


def main(surface: str, step: str, duration: str, t_det: str, force: str) -> None:
    """Solve one problem and write its tables."""
    with tempfile.TemporaryDirectory() as folder:
        answer = solve(Path(surface), float(step), float(duration), compiled(folder))
    n = math.isqrt(len(answer.t_det))
    blocks = (f"{b // n},{b % n},{t!r}\n" for b, t in enumerate(answer.t_det))
    curve = (f"{k * SAMPLED!r},{value!r}\n" for k, value in enumerate(answer.force))
    Path(t_det).write_text("y,x,t_det\n" + "".join(blocks))
    Path(force).write_text("time,force\n" + "".join(curve))
    print(answer.evaluations, answer.seconds)


def _changes(before: tuple[float, float], now: NDArray[np.float64]) -> bool:
    """Whether a block starts to slide or turns back within a step."""
    if before == (0.0, 0.0):
        return bool(now[0] != 0.0 or now[1] != 0.0)
    return bool(before[0] * now[0] + before[1] * now[1] < 0.0)


if __name__ == "__main__":
    main(*sys.argv[1:])
