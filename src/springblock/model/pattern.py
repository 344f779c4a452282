"""Contact masks of flat, pillared and hierarchically grooved surfaces.

Each level cuts the surface along x, along y or along both, so that a pattern is the product of two
one-dimensional profiles. A profile is a list of contact segments, given by first block and length.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from springblock.model.notebook import Shown, in_words
from springblock.model.numbers import check_whole

#: Largest number of blocks along a side, for which the solver is laid out.
MAX_BLOCKS = 4096

Segments = list[tuple[int, int]]


@dataclass(frozen=True)
class Level:
    """One level of the hierarchy: `size` blocks in contact, separated by gaps of `gap` blocks."""

    size: int
    gap: int
    along: str | None = None  #: direction of its grooves, "x" or "y"; None for pillars

    def __str__(self) -> str:
        kind = f"grooves along {self.along}" if self.along else "pillars"
        return f"{kind} {self.size}/{self.gap}"


def _cut_surface(name: str, n: int, level: Level) -> Segments:
    """Lay the first level over n blocks, with margins of half a gap (section 3.2)."""
    period = level.size + level.gap
    if n % period:
        raise ValueError(
            f"the period of size and gap = {level.size} + {level.gap} = {period} "
            f"must divide {name} = {n}; it leaves {n % period} blocks over"
        )
    return [(start, level.size) for start in range(level.gap // 2, n, period)]


def _cut_segment(segment: tuple[int, int], level: Level) -> Segments:
    """Cut one segment; contact begins and ends at the edges of the segment."""
    start, length = segment
    period = level.size + level.gap
    if level.gap >= length:
        raise ValueError(
            f"a groove of {level.gap} blocks does not fit into a pillar of {length} blocks"
        )
    if (length + level.gap) % period:
        raise ValueError(
            f"pawls of {level.size} and grooves of {level.gap} blocks do not fill a pillar of "
            f"{length} blocks from edge to edge: {length} + {level.gap} must be a multiple "
            f"of {period}"
        )
    return [(s, level.size) for s in range(start, start + length, period)]


@dataclass(frozen=True, repr=False)
class Pattern(Shown):
    """Contact pattern of any number of levels on N x N blocks, or N_y rows of N_x blocks.

    Start from `flat` or `pillars` and add levels with `grooved` and `pillared`. The first level
    that cuts an axis has a margin of n_s/2 to the edges of the surface (floor and ceiling of n_s/2
    if n_s is odd); deeper ones fill a pillar from edge to edge.

    Raises
    ------
    TypeError, ValueError
        If a length is not a positive whole number, a side is too long, the first period does not
        divide N, or a level does not fit into the one above it.
    """

    n_blocks: int  #: blocks along x
    levels: tuple[Level, ...] = ()
    n_rows: int | None = None  #: blocks along y; None for a square surface

    def __post_init__(self) -> None:
        object.__setattr__(self, "n_blocks", check_whole("N", self.n_blocks))
        rows = self.n_blocks if self.n_rows is None else check_whole("n_rows", self.n_rows)
        object.__setattr__(self, "n_rows", rows)
        for name, blocks in (("N", self.n_blocks), ("n_rows", rows)):
            if blocks > MAX_BLOCKS:
                raise ValueError(f"{name} must be at most {MAX_BLOCKS}, not {blocks}")
        self.profile("x"), self.profile("y")  # refuses levels that do not fit

    @classmethod
    def flat(cls, n_blocks: int, n_rows: int | None = None) -> "Pattern":
        """Return a flat surface, with all blocks in contact."""
        return cls(n_blocks, n_rows=n_rows)

    @classmethod
    def pillars(cls, n_blocks: int, n_p: int, n_s: int, n_rows: int | None = None) -> "Pattern":
        """Return a surface with square pillars of n_p blocks, n_s blocks apart."""
        return cls(n_blocks, n_rows=n_rows).pillared(n_p, n_s)

    def pillared(self, n_p: int, n_s: int) -> "Pattern":
        """Add a level of pillars of n_p blocks, n_s blocks apart."""
        return self._refined(Level(check_whole("n_p", n_p), check_whole("n_s", n_s)))

    def grooved(self, n_p2: int, n_s2: int, along: str = "x") -> "Pattern":
        """Add a level of pawls of n_p2 blocks between grooves of n_s2 blocks that run `along`."""
        if along not in ("x", "y"):
            raise ValueError(f"along must be 'x' or 'y', not {along!r}")
        pawl, groove = check_whole("n_p2", n_p2), check_whole("n_s2", n_s2)
        return self._refined(Level(pawl, groove, along))

    def _refined(self, level: Level) -> "Pattern":
        return replace(self, levels=(*self.levels, level))

    def profile(self, axis: str, depth: int | None = None) -> Segments:
        """Return the contact segments (first block, length) along `axis`.

        Only the first `depth` levels are considered, by default all.
        """
        rows, columns = self.shape
        n, name = (columns if axis == "x" else rows), ("N" if rows == columns else f"N_{axis}")
        segments = [(0, n)]
        for level in self.levels[:depth]:
            if axis == level.along:  # grooves do not cut the axis along which they run
                continue
            if segments == [(0, n)]:
                segments = _cut_surface(name, n, level)
            else:
                segments = [cut for s in segments for cut in _cut_segment(s, level)]
        return segments

    @property
    def shape(self) -> tuple[int, int]:
        """Blocks along y and along x."""
        return self.n_rows or self.n_blocks, self.n_blocks

    @cached_property
    def contact(self) -> NDArray[np.bool_]:
        """Blocks in contact with the substrate, (N_y, N_x) bool, indexed [y, x]; read-only."""
        along = {axis: np.zeros(n, bool) for axis, n in zip("yx", self.shape, strict=True)}
        for axis, mask in along.items():
            for start, length in self.profile(axis):
                mask[start : start + length] = True
        contact = np.outer(along["y"], along["x"])
        contact.flags.writeable = False
        return contact

    def __repr__(self) -> str:
        levels = ", ".join(map(str, self.levels)) or "flat"
        return f"<{levels}: {in_words(self.contact)}>"

    @property
    def origins(self) -> NDArray[np.intp]:
        """First block (y, x) of each first-level pillar, (pillars, 2)."""
        starts = [[start for start, _ in self.profile(axis, depth=1)] for axis in "yx"]
        return np.array([(y, x) for y in starts[0] for x in starts[1]], dtype=np.intp)
