"""The leapfrog on several cores, for one large surface; results are those of one core to the bit.

Each core advances a part of the rows, made up of adjacent bands. Only the first and the last band
of a part are coupled to rows of another part: all cores compute the forces on these two before any
block moves, and then advance their parts.
"""

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from springblock.solver.compilation import kernel
from springblock.solver.lattice import Constants, Lattice, Totals, band_from, close_rows, slider_at
from springblock.solver.leapfrog import (
    Rows,
    make_rows,
    move_band,
    place_releases,
    totals,
    wake,
)
from springblock.solver.release import Releases, make_releases
from springblock.solver.springs import ONE, Band, Scratch, U, forces_on_band


class Part(NamedTuple):
    """Rows [start, stop) that one core advances, with its work arrays."""

    start: np.uint64
    stop: np.uint64
    last: np.uint64  #: first row of the last band
    lower: Scratch  #: of all bands but the last
    upper: Scratch  #: of the last band
    released: Releases


def parts_of(constants: Constants, cores: int) -> list[Part]:
    """Divide the bands of a lattice among this many cores, or one each if there are fewer bands."""
    size, (n_y, n_x) = int(constants.band_rows), constants.grid.shape
    bands = -(-n_y // size)
    cuts = np.unique(np.linspace(0, bands, min(cores, bands) + 1).astype(int)) * size
    parts = []
    for start, stop in zip(cuts[:-1].tolist(), np.minimum(cuts[1:], n_y).tolist(), strict=True):
        released = make_releases((stop - start) * n_x)
        last = (stop - 1) // size * size
        parts.append(Part(U(start), U(stop), U(last), Scratch.empty(), Scratch.empty(), released))
    return parts


@kernel
def _forces_on_end(blocks, rows, band, s, springs, slider):
    """Compute the forces on a band, after those that the row below exerts on it."""
    if band.start > 0:
        below = Band(band.start - ONE, band.start, band.grid)
        row, column = forces_on_band(blocks.ux, blocks.uy, below, rows.awake, s, springs, slider)
        if column > 0:
            return row, column
    return forces_on_band(blocks.ux, blocks.uy, band, rows.awake, s, springs, slider)


@kernel
def _forces_at_ends(blocks, rows, constants, slider, part):
    """Compute the forces on the first and the last band of a part, before any block moves.

    Returns row and column of a broken spring; column 0 if none is.
    """
    first = band_from(part.start, constants)
    row, column = _forces_on_end(blocks, rows, first, part.lower, constants.springs, slider)
    if column > 0 or first.stop == part.stop:
        return row, column
    last = band_from(part.last, constants)
    return _forces_on_end(blocks, rows, last, part.upper, constants.springs, slider)


@kernel
def _move_part(blocks, law, peak, rows, constants, slider, now, part):
    """Advance the rows of a part by one step.

    Returns switches and releases, and row and column of a broken spring; column 0 if none is.
    """
    springs, switches, count = constants.springs, np.int64(0), np.int64(0)
    for start in range(part.start, part.stop, constants.band_rows):
        band = band_from(start, constants)
        s = part.upper if start == part.last and start > part.start else part.lower
        if part.start < start < part.last:
            row, column = forces_on_band(blocks.ux, blocks.uy, band, rows.awake, s, springs, slider)
            if column > 0:
                return switches, count, row, column
        more, count = move_band(
            blocks, law, peak, rows, part.released, count, band, s, constants, now
        )
        switches += more
    return switches, count, U(0), U(0)


class Work(NamedTuple):
    """Work arrays of the leapfrog on several cores, and the threads that use them."""

    rows: Rows
    released: Releases  #: those of all parts
    parts: list[Part]
    executor: ThreadPoolExecutor

    @classmethod
    def of(
        cls, state: Lattice, constants: Constants, cores: int, executor: ThreadPoolExecutor
    ) -> "Work":
        """Return work arrays for the steps of one call."""
        n_y, n_x = constants.grid.shape
        rows = make_rows(state.in_contact, constants.grid.periodic is not None)
        return cls(rows, make_releases(n_y * n_x), parts_of(constants, cores), executor)

    @staticmethod
    def take_step(
        work: "Work", state: Lattice, constants: Constants, k: int
    ) -> tuple[Totals, int, int, int]:
        """Take step k as the leapfrog does, see `integrators`."""
        rows, blocks, law, slider = work.rows, state.blocks, state.law, slider_at(constants, k)
        if state.peak is None:
            wake(rows, k, constants.grid.periodic is not None)
        close_rows(blocks.ux, blocks.uy, constants.grid)
        ends = partial(_forces_at_ends, blocks, rows, constants, slider)
        for row, column in list(work.executor.map(ends, work.parts)):
            if column > 0:
                return totals(rows), 0, row, column
        move = partial(_move_part, blocks, law, state.peak, rows, constants, slider, k)
        switches, count = 0, 0
        moved = list(work.executor.map(move, work.parts))
        for part, (more, detached, row, column) in zip(work.parts, moved, strict=True):
            if column > 0:
                return totals(rows), 0, row, column
            for merged, own in zip(work.released[:5], part.released[:5], strict=True):
                merged[count : count + detached] = own[:detached]
            switches, count = switches + more, count + detached
        if count > 0:
            place_releases(blocks, law, rows, work.released, count, constants, k)
        return totals(rows), switches, 0, 0
