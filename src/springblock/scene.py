"""A scene: one surface, pulled one way. What the study varies besides the seed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from springblock.direction import normalised
from springblock.pattern import Pattern

LENGTHS = ("n_p", "n_s", "n_p2", "n_s2", "n_p3", "n_s3")  #: of a scene, two for each level
#: Columns that tell scenes apart, in the order in which the rows of a table are sorted by them.
COLUMNS = ("n_blocks", "level", *LENGTHS, "direction")
_SIDE = 6  #: blocks of the shortest side along which a correlation is measured


@dataclass(frozen=True)
class Scene:
    """Pattern and sliding direction; lengths of 0 stand for no such level.

    The grooves of level 2 run along x, those of level 3 along y; a sliding direction y swaps their
    parts.

    Raises
    ------
    TypeError, ValueError
        Where a length is given without its partner or without the levels above it, or the
        direction is none.
    """

    n_blocks: int
    n_p: int = 0
    n_s: int = 0
    n_p2: int = 0
    n_s2: int = 0
    n_p3: int = 0
    n_s3: int = 0
    direction: str = "x"  #: "x", "y" or an angle from x in degrees, which is kept as text

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", normalised(self.direction))
        missing = [key for key in LENGTHS[: 2 * self.level] if key not in self.lengths]
        if missing:
            key, value = list(self.lengths.items())[-1]
            raise ValueError(f"{key} = {value} needs {missing[0]}")

    @classmethod
    def from_row(cls, row: Mapping[str, Any]) -> "Scene":
        """Return the scene that a row of a table belongs to."""
        return cls(**{key: row[key] for key in COLUMNS if key != "level"})

    @property
    def row(self) -> dict[str, Any]:
        """Its columns in a row of a table."""
        return {key: getattr(self, key) for key in COLUMNS}

    @property
    def lengths(self) -> dict[str, int]:
        """The lengths of its levels by their names."""
        return {key: getattr(self, key) for key in LENGTHS if getattr(self, key)}

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 flat, 1 pillars, 2 strips, 3 strips cut across."""
        return max((LENGTHS.index(key) // 2 + 1 for key in self.lengths), default=0)

    @property
    def pattern(self) -> Pattern:
        """The pattern; raises ValueError where its lengths do not fit."""
        pattern = Pattern.flat(self.n_blocks)
        if self.n_p:
            pattern = pattern.pillared(self.n_p, self.n_s)
        if self.n_p2:
            pattern = pattern.grooved(self.n_p2, self.n_s2, along="x")
        if self.n_p3:
            pattern = pattern.grooved(self.n_p3, self.n_s3, along="y")
        return pattern

    @property
    def sides(self) -> tuple[str, ...]:
        """Axes along which pillars have sides that nothing cuts, 6 blocks long or more."""
        if self.n_p < _SIDE:
            return ()
        return ((), ("x", "y"), ("x",), ())[self.level]

    @property
    def folder(self) -> str:
        """Hive-style folder of its realisations."""
        keys = ("n_blocks", "level", *self.lengths, "direction")
        return "/".join(f"{key}={getattr(self, key)}" for key in keys)

    @property
    def arguments(self) -> str:
        """The scene as options of `springblock simulate`."""
        keys = ("n_blocks", *self.lengths, "direction")
        return " ".join(f"--{key.replace('_', '-')} {getattr(self, key)}" for key in keys)
