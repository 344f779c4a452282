"""The force that each block exerts on the substrate at one instant."""

import math

import numpy as np

from springblock.model.numbers import Array
from springblock.solver.compilation import kernel
from springblock.solver.lattice import Constants, Lattice, band_from, close_rows
from springblock.solver.laws import resistance, state_now
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, Scratch, U, forces_on_band


def shear_forces(state: Lattice, constants: Constants, steps: int, velocity: Array) -> Array:
    """Force of each block on the substrate after `steps` steps, (2, lattice), in kernel units.

    `velocity`, (2, lattice), is that of the same instant. A block at rest exerts F_mot, one that
    slides the friction of its law at its speed, along its velocity; one without contact nothing.
    """
    force = np.zeros_like(velocity)
    slider = constants.slider_x * steps, constants.slider_y * steps
    every_row = np.ones(constants.grid.shape[0] + 1, np.bool_)
    _enter(state.blocks, state.law, constants, slider, velocity, every_row, Scratch.empty(), force)
    return force


@kernel
def _enter(blocks, law, constants, slider, velocity, every_row, s, force):
    """Enter the forces of all blocks; `s` is scratch for a band of rows."""
    grid = constants.grid
    close_rows(blocks.ux, blocks.uy, grid)
    for start in range(U(0), grid.n_y, constants.band_rows):
        band = band_from(start, constants)
        forces_on_band(blocks.ux, blocks.uy, band, every_row, s, constants.springs, slider)
        for row in range(band.start, band.stop):
            i, own = row * grid.pitch, (row - band.start) * grid.pitch
            for x in range(ONE, grid.n_x + ONE):
                b, static = i + x, blocks.static[i + x]
                vx, vy = velocity[0, b], velocity[1, b]
                speed = math.hypot(vx, vy)
                if static > 0.0 and speed == 0.0:
                    force[0, b], force[1, b] = (
                        s.force[FORCE_X + own + x],
                        s.force[FORCE_Y + own + x],
                    )
                elif static > 0.0:
                    friction = resistance(
                        law, state_now(law, b), speed, 0.0, static, blocks.dynamic[b]
                    )
                    force[0, b], force[1, b] = friction * vx / speed, friction * vy / speed
