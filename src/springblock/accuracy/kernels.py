"""Springs and a lattice without friction: by the compiled kernels, driven by hand, and exactly."""

import math
from typing import Any

import numpy as np

from springblock.accuracy.specimens import Array
from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.motion import SimulationError
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import Samples, close_edges, close_rows, prepare, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    Band,
    Grid,
    Springs,
    forces_on_band,
    scratch,
)

UNDAMPED = Material(gamma=0.0)
#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Springs and slider of a lattice by itself.
SPRINGS = Springs.of(STIFFNESS, 0.0), (0.0, 0.0)
#: Greatest stable omega h of a mode without damping.
STABLE = {"leapfrog": 2.0, "rk4": math.sqrt(8.0)}


def spring_forces(displacement: Array, band: int | None = None, periodic: bool = False) -> Array:
    """Return F_int/(K_int l), (2, N_y, N_x), by the compiled bands, for displacements in l.

    Bands are of as many rows as the solver chooses, or of `band`.
    """
    grid = Grid.of(displacement.shape[1:], periodic)
    (n_y, n_x), pitch = grid.shape, int(grid.pitch)
    ux, uy = (np.zeros((n_y + periodic) * pitch) for _ in displacement)
    for field, u in zip((ux, uy), displacement, strict=True):
        unpadded(field, grid)[:] = u
    close_edges(ux, uy, grid)
    close_rows(ux, uy, grid)
    s, every_row = scratch(), np.ones(n_y + 1, bool)
    band = band or int(grid.band_rows)
    forces = []
    for start in range(0, n_y, band):
        stop = min(start + band, n_y)
        rows = Band(np.uint64(start), np.uint64(stop), grid)
        y, x = map(int, forces_on_band(ux, uy, rows, every_row, s, *SPRINGS))
        if x:  # counted from one
            raise SimulationError(f"a spring of block ({y}, {x - 1}) has collapsed or burst")
        found = [s[int(field) :][: (stop - start) * pitch] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(found, (2, -1, pitch))[:, :, 1 : n_x + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def swing(
    displacement: Array,
    steps: int,
    step: float,
    integrator: str = "leapfrog",
    material: Material = UNDAMPED,
    periodic: bool = False,
) -> Array:
    """Let a frictionless lattice go from `displacement` (2, N_y, N_x), in l, the slider at rest.

    Returns its displacement after so many steps.
    """
    method, shape = INTEGRATORS[integrator], displacement.shape[1:]
    surface = Surface(np.ones(shape, bool), 0.0, 0.0, periodic)
    state, constants = prepare(surface, material, (0.0, 0.0), method, step)
    blocks, grid = state.blocks, constants.grid
    blocks.static[:] = 0.0
    for field, u in zip((blocks.ux, blocks.uy), displacement, strict=True):
        unpadded(field, grid)[:] = u
    close_edges(blocks.ux, blocks.uy, grid)
    done = method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0]
    if done < steps:
        raise SimulationError(f"a spring has collapsed or burst in step {done}")
    return np.stack([unpadded(u, grid) for u in (blocks.ux, blocks.uy)])


def limit_of_damping(integrator: str, material: Material) -> float:
    """Return the largest stable step far overdamped, s.

    Leapfrog's omega² h/gamma stays below 2. In Runge-Kutta, the fastest decay of all, that of the
    lowest mode, stays within the real interval where |1 + z + z²/2 + z³/6 + z⁴/24| < 1.
    """
    gamma = material.gamma
    if integrator == "leapfrog":
        return 2.0 * gamma / material.omega_max**2
    decay = gamma / 2.0 + math.sqrt(gamma**2 / 4.0 - material.omega_min**2)
    return 2.785293563405282 / decay


def turn(phase: Array | float) -> Any:
    """Return a mode's factor per Runge-Kutta step: the Taylor polynomial of exp(i omega h)."""
    z = 1j * np.asarray(phase)
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def swing_factor(integrator: str, phase: float, taken: int) -> float:
    """Return a mode's amplitude after so many steps of phase omega h, from 1 at rest.

    Leapfrog is at rest half a step before: cos((k + 1/2) theta)/cos(theta/2), where
    sin(theta/2) = omega h/2; beyond its limit, theta is complex.
    """
    if integrator == "leapfrog":
        half = np.arcsin(complex(phase / 2.0))
        return float((np.cos((2 * taken + 1) * half) / np.cos(half)).real)
    return float((turn(phase) ** taken).real)


def path(integrator: str, phase: Array, taken: int) -> Array:
    """Return the displacement of modes (k,) of phase omega h, in steps of the slider.

    Exact solution of the schemes for u" = omega² (t - u), from u = u' = 0 at t = 0, time in steps:
    the straight line t, and the scheme's own oscillation about it.
    """
    if integrator == "leapfrog":  # sin(theta/2) = omega h/2; u = 0 also one step before
        theta = 2.0 * np.arcsin(phase / 2.0)
        return taken - 1.0 / np.sin(theta) * np.sin(taken * theta)
    return taken - (turn(phase) ** taken).imag / phase
