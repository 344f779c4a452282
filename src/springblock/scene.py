"""A scene: one surface, pulled one way. What the study varies besides the seed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from springblock.direction import normalised
from springblock.material import Material
from springblock.pattern import Pattern

LENGTHS = ("n_p", "n_s", "n_p2", "n_s2", "n_p3", "n_s3")  #: of a scene, two for each level
#: Columns that tell scenes apart, in the order in which the rows of a table are sorted by them.
COLUMNS = ("n_blocks", "level", *LENGTHS, "along_3", "varied", "direction")
#: What else a scene may have of its own, instead of the study's.
CONSTANTS = (*dict(Material().items()), "integrator", "step")
TEXTS = ("integrator", "law")  #: those of them that are no numbers
_SIDE = 6  #: blocks of the shortest side along which a correlation is measured

Varied = tuple[tuple[str, Any], ...]  #: names and values of constants, in the order of `CONSTANTS`


@dataclass(frozen=True)
class Scene:
    """Pattern and sliding direction; lengths of 0 stand for no such level.

    Without pillars the grooves of level 2 cross the whole surface. They run along x, those of
    level 3 along y unless `along_3` says otherwise; a sliding direction y swaps their parts.

    Raises
    ------
    TypeError, ValueError
        Where a length is given without its partner or without the level above it, the direction
        is none, or a constant that is varied has no such name or value.
    """

    n_blocks: int
    n_p: int = 0
    n_s: int = 0
    n_p2: int = 0
    n_s2: int = 0
    n_p3: int = 0
    n_s3: int = 0
    direction: str = "x"  #: "x", "y" or an angle from x in degrees, which is kept as text
    along_3: str = ""  #: axis that the grooves of level 3 run along; "" without them
    varied: Varied = ()  #: constants of its own, instead of the study's

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", normalised(self.direction))
        object.__setattr__(self, "varied", in_order(dict(self.varied)))
        for size, gap in zip(LENGTHS[::2], LENGTHS[1::2], strict=True):
            for one, other in ((size, gap), (gap, size)):
                if getattr(self, one) and not getattr(self, other):
                    raise ValueError(f"{one} = {getattr(self, one)} needs {other}")
        if self.n_p3 and not self.n_p2:
            raise ValueError(f"n_p3 = {self.n_p3} needs n_p2")
        along = self.along_3 or ("y" if self.n_p3 else "")
        if along not in (("x", "y") if self.n_p3 else ("",)):
            fit = "'x' or 'y'" if self.n_p3 else "left out without n_p3"
            raise ValueError(f"along_3 must be {fit}, not {self.along_3!r}")
        object.__setattr__(self, "along_3", along)

    @classmethod
    def from_row(cls, row: Mapping[str, Any]) -> "Scene":
        """Return the scene that a row of a table belongs to."""
        named = {key: row[key] for key in COLUMNS if key not in ("level", "varied")}
        pairs = [pair.split("=") for pair in row["varied"].split(", ") if pair]
        return cls(**named, varied=tuple((name, value) for name, value in pairs))

    @property
    def row(self) -> dict[str, Any]:
        """Its columns in a row of a table."""
        varied = ", ".join(f"{name}={value}" for name, value in self.varied)
        return {key: getattr(self, key) for key in COLUMNS} | {"varied": varied}

    @property
    def lengths(self) -> dict[str, int]:
        """The lengths of its levels by their names."""
        return {key: getattr(self, key) for key in LENGTHS if getattr(self, key)}

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 for a flat surface."""
        return len(self.lengths) // 2

    @property
    def pattern(self) -> Pattern:
        """The pattern; raises ValueError where its lengths do not fit."""
        pattern = Pattern.flat(self.n_blocks)
        if self.n_p:
            pattern = pattern.pillared(self.n_p, self.n_s)
        if self.n_p2:
            pattern = pattern.grooved(self.n_p2, self.n_s2, along="x")
        if self.n_p3:
            pattern = pattern.grooved(self.n_p3, self.n_s3, along=self.along_3)
        return pattern

    @property
    def sides(self) -> tuple[str, ...]:
        """Axes along which pillars have sides that nothing cuts, 6 blocks long or more."""
        if self.n_p < _SIDE or self.along_3 == "y":
            return ()
        return ("x",) if self.n_p2 else ("x", "y")

    @property
    def names(self) -> dict[str, Any]:
        """Lengths of its levels, and what else tells patterns of them apart, by name."""
        return self.lengths | ({"along_3": self.along_3} if self.along_3 else {})

    @property
    def folder(self) -> str:
        """Hive-style folder of its realisations."""
        size = {"n_blocks": self.n_blocks, "level": self.level}
        named = {**size, **self.names, **dict(self.varied), "direction": self.direction}
        return "/".join(f"{key}={value}" for key, value in named.items())

    @property
    def arguments(self) -> str:
        """The scene as options of `springblock simulate`."""
        named = {"n_blocks": self.n_blocks, **self.names, "direction": self.direction}
        options = [f"--{key.replace('_', '-')} {value}" for key, value in named.items()]
        return " ".join(options + [f"--vary {name}={value}" for name, value in self.varied])


def in_order(constants: Mapping[str, Any]) -> Varied:
    """Constants in the one order, and numbers as numbers, even where they come as text.

    Raises
    ------
    ValueError
        Where there is no constant of that name, or it is no number.
    """
    for name in constants:
        if name not in CONSTANTS:
            raise ValueError(f"{name!r} is no constant; there are {', '.join(CONSTANTS)}")
    return tuple((name, _value(name, constants[name])) for name in CONSTANTS if name in constants)


def _value(name: str, value: Any) -> str | float:
    if name in TEXTS:
        return str(value)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a number, not {value!r}") from None
