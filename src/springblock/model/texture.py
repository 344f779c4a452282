"""Textures from lengths in metres: discs, holes, squares, pits and lamellae, in periodic arrays."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.model.notebook import Shown, in_words
from springblock.model.pattern import MAX_BLOCKS

#: Kinds of textures; features of all but holes and pits are in contact.
KINDS = ("discs", "holes", "squares", "pits", "lamellae")
ARRANGEMENTS = ("square", "hexagonal")
#: Least blocks across a feature and across the gap between two, for a recognisable shape.
LEAST = 4


class Period(NamedTuple):
    """Periods along x and y, m, and the centres of the features in one of them."""

    x: float
    y: float
    centres: tuple[tuple[float, float], ...]


@dataclass(frozen=True, repr=False)
class Texture(Shown):
    """Contact mask of features on a lattice of blocks, in whole periods.

    The side is that nearest to `width` which whole periods fill. A block is in a feature if its
    centre is.

    Raises
    ------
    ValueError
        If a length is not positive, features overlap, or they or their gaps are narrower than
        `LEAST` blocks.
    """

    kind: str
    feature: float  #: m, diameter of a disc or hole; width of a square, pit or lamella
    pitch: float  #: m, distance between the centres of neighbours
    width: float  #: m, side of the surface
    spacing: float  #: m, lattice spacing l
    arrangement: str = "square"  #: or hexagonal, with rows along x; lamellae run along x

    def __post_init__(self) -> None:
        for name, known in (("kind", KINDS), ("arrangement", ARRANGEMENTS)):
            if getattr(self, name) not in known:
                value = getattr(self, name)
                raise ValueError(f"{name} must be one of {', '.join(known)}, not {value!r}")
        for name in ("feature", "pitch", "width", "spacing"):
            if not 0.0 < (value := getattr(self, name)) < math.inf:
                raise ValueError(f"a texture needs {name}, a length in m, not {value}")
        narrowest = min(self.feature, self.pitch - self.feature)
        if narrowest <= 0.0:
            raise ValueError(
                f"features of {self.feature:g} m at a pitch of {self.pitch:g} m overlap; choose a "
                "larger pitch"
            )
        if narrowest < (LEAST - 0.5) * self.spacing:
            raise ValueError(
                f"features or the gaps between them, {narrowest:g} m, have fewer than {LEAST} "
                f"blocks of {self.spacing:g} m; choose spacing = {narrowest / LEAST:g} or less"
            )
        if max(self.shape) > MAX_BLOCKS:
            raise ValueError(
                f"the surface has {max(self.shape)} blocks a side; choose at most {MAX_BLOCKS}; "
                "lengths are in m"
            )

    @property
    def period(self) -> Period:
        """Return the periods, and the centres of features in the first."""
        p = self.pitch
        if self.kind == "lamellae":
            return Period(self.spacing, p, ((0.0, p / 2.0),))
        if self.arrangement == "square":
            return Period(p, p, ((p / 2.0, p / 2.0),))
        high = math.sqrt(3.0) * p
        return Period(p, high, ((p / 2.0, high / 4.0), (0.0, 3.0 * high / 4.0)))

    @property
    def shape(self) -> tuple[int, int]:
        """Return blocks along y and along x, those of whole periods."""
        numbers = (max(1, round(self.width / each)) for each in (self.period.y, self.period.x))
        lengths = zip(numbers, (self.period.y, self.period.x), strict=True)
        rows, columns = (round(number * each / self.spacing) for number, each in lengths)
        return rows, columns

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Return the blocks in contact, (N_y, N_x) bool, [y, x]."""
        y, x = np.ogrid[: self.shape[0], : self.shape[1]]
        inside = np.zeros(self.shape, bool)
        for at_x, at_y in self.period.centres:
            from_x, from_y = (
                np.abs((self.spacing * (each + 0.5) - at + period / 2.0) % period - period / 2.0)
                for each, at, period in ((x, at_x, self.period.x), (y, at_y, self.period.y))
            )
            half = self.feature / 2.0 * (1.0 - 1e-9)  # a centre on the rim is outside
            if self.kind in ("discs", "holes"):
                inside |= from_x**2 + from_y**2 < half**2
            elif self.kind == "lamellae":
                inside |= np.broadcast_to(from_y < half, self.shape)
            else:
                inside |= (from_x < half) & (from_y < half)
        return ~inside if self.kind in ("holes", "pits") else inside

    def __repr__(self) -> str:
        rows, columns = (self.spacing * each for each in self.shape)
        return (
            f"<{self.kind} of {self.feature:g} m at {self.pitch:g} m, {columns:g} x {rows:g} m: "
            f"{in_words(self.contact)}>"
        )
