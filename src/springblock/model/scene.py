"""Scenes: surface, sliding direction and constants that a study varies besides the seed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import product
from pathlib import Path
from shlex import quote
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.blockmap import BlockMap
from springblock.model.direction import normalised
from springblock.model.law import LawFile
from springblock.model.material import HEALING, LAWS, Material, as_law
from springblock.model.pattern import Pattern
from springblock.model.surface import as_coefficients

LENGTHS = ("n_p", "n_s", "n_p2", "n_s2", "n_p3", "n_s3")  #: lengths of a scene, two per level
_PATTERN = ("n_blocks", "level", *LENGTHS, "along_3", "varied", "direction")
#: Fields read from files, with the option of the command line for each.
MAPS = {"mask": "--mask", "mu_static_field": "--mu-static", "mu_dynamic_field": "--mu-dynamic"}
#: Columns that identify a scene, in the order by which the rows of a table are sorted.
COLUMNS = (*_PATTERN, "n_rows", "edges", *MAPS)
EDGES = ("free", "periodic")
#: Constants that a scene may vary.
CONSTANTS = (*dict(Material().items()), "integrator", "step")
#: Constants that are not numbers.
TEXTS = ("integrator", *(each.name for each in fields(Material) if "choices" in each.metadata))
_LONGEST = 200  #: bytes in the name of a folder; file systems take 255
_SIDE = 6  #: least number of blocks of a side along which a correlation is measured

Varied = tuple[tuple[str, Any], ...]  #: names and values of constants, in the order of `CONSTANTS`


@dataclass(frozen=True)
class Scene:
    """Surface, sliding direction and varied constants; a length of 0 means no such level.

    Grooves of level 2 run along x, from edge to edge of a surface without pillars; grooves of level
    3 run along `along_3`, by default y. A mask replaces pattern and N, and coefficients from files
    replace those that are drawn.

    Raises
    ------
    TypeError, ValueError
        If a length lacks its partner or the level above it, the direction or a varied constant is
        not valid, or fields from files do not fit.
    """

    n_blocks: int = 0  #: N, along x; 0 to take it from the mask
    n_p: int = 0
    n_s: int = 0
    n_p2: int = 0
    n_s2: int = 0
    n_p3: int = 0
    n_s3: int = 0
    direction: str = "x"  #: "x", "y" or an angle from x in degrees, as text
    along_3: str = ""  #: direction of the grooves of level 3; "" without them
    varied: Varied = ()  #: constants that replace those of the study
    n_rows: int = 0  #: N_y; 0 for a square surface
    edges: str = "free"  #: "free" or "periodic", along x and y
    mask: BlockMap | None = None  #: blocks in contact
    mu_static_field: BlockMap | None = None  #: coefficients from a file, instead of drawn ones
    mu_dynamic_field: BlockMap | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", normalised(self.direction))
        object.__setattr__(self, "varied", in_order(dict(self.varied)))
        self._check_levels()
        self._check_maps()
        if not self.mask:
            Pattern.flat(self.n_blocks, self.n_rows or None)  # refuses invalid numbers of blocks
        if self.n_rows == self.n_blocks:
            object.__setattr__(self, "n_rows", 0)

    def _check_levels(self) -> None:
        if self.mask and self.names:
            raise ValueError(
                f"mask cannot be combined with {', '.join(self.names)}, since it defines all "
                "blocks in contact; leave out one of them"
            )
        for size, gap in zip(LENGTHS[::2], LENGTHS[1::2], strict=True):
            for one, other in ((size, gap), (gap, size)):
                if getattr(self, one) and not getattr(self, other):
                    raise ValueError(f"{one} = {getattr(self, one)} needs {other}")
        if self.n_p3 and not self.n_p2:
            raise ValueError(f"n_p3 = {self.n_p3} needs n_p2")
        if self.along_3 and not self.n_p3:
            raise ValueError(f"along_3 must be left out without n_p3, not {self.along_3!r}")
        object.__setattr__(self, "along_3", self.along_3 or ("y" if self.n_p3 else ""))

    def _check_maps(self) -> None:
        if self.mask and self.mask.values is not None:
            rows, columns = self.mask.values.shape
            if self.n_blocks not in (0, columns) or self.n_rows not in (0, rows):
                raise ValueError(
                    f"n_blocks and n_rows must be those of the mask, {columns} and {rows}, "
                    f"not {self.n_blocks} and {self.n_rows or self.n_blocks}"
                )
            object.__setattr__(self, "n_blocks", columns)
            object.__setattr__(self, "n_rows", rows)
        for name in ("mu_static", "mu_dynamic"):
            field = getattr(self, f"{name}_field")
            for constant in (name, f"{name}_std"):
                if field and constant in dict(self.varied):
                    raise ValueError(f"{constant} cannot be varied if {name} is read from {field}")
            if field and field.values is not None:
                as_coefficients(str(field), field.values, self.contact)  # refuses invalid ones
        idle = {"distribution", "correlation_length"} & dict(self.varied).keys()
        if idle and not self.is_drawn:
            raise ValueError(f"{min(idle)} cannot be varied if all coefficients are from files")

    @classmethod
    def from_row(cls, row: Mapping[str, Any]) -> "Scene":
        """Return the scene of a row of a table, in which fields from files are only names."""
        named = {key: row[key] for key in COLUMNS if key not in ("level", "varied", *MAPS)}
        named |= {key: BlockMap(row[key]) for key in MAPS if row[key]}
        pairs = [pair.split("=") for pair in row["varied"].split(", ") if pair]
        return cls(**named, varied=tuple((name, value) for name, value in pairs))

    @property
    def row(self) -> dict[str, Any]:
        """Its columns for a row of a table."""
        varied = ", ".join(f"{name}={value}" for name, value in self.varied)
        maps = {key: str(getattr(self, key) or "") for key in MAPS}
        own = {"varied": varied, "n_rows": self.shape[0], **maps}
        return {key: getattr(self, key) for key in COLUMNS} | own

    @property
    def lengths(self) -> dict[str, int]:
        """Lengths of its levels, by name."""
        return {key: getattr(self, key) for key in LENGTHS if getattr(self, key)}

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 for a flat surface, -1 for a mask."""
        return -1 if self.mask else len(self.lengths) // 2

    @property
    def shape(self) -> tuple[int, int]:
        """Blocks along y and along x."""
        return self.n_rows or self.n_blocks, self.n_blocks

    @property
    def is_periodic(self) -> bool:
        """Whether the edges are periodic."""
        return self.edges == "periodic"

    @property
    def is_papers(self) -> bool:
        """Whether the surface is of the paper's kind: square, with free edges, without files."""
        return not (self.n_rows or self.is_periodic or any(getattr(self, key) for key in MAPS))

    @property
    def is_drawn(self) -> bool:
        """Whether any coefficient is drawn; otherwise all seeds give the same run."""
        return not (self.mu_static_field and self.mu_dynamic_field)

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Blocks in contact with the substrate, (N_y, N_x) bool, [y, x]."""
        if self.mask is None:
            return self.pattern.contact
        if self.mask.values is None:
            raise ValueError(f"the values of the mask {self.mask} are not available, only its name")
        return self.mask.values

    @property
    def pattern(self) -> Pattern:
        """The pattern of pillars and grooves; a mask has none."""
        if self.mask:
            raise ValueError(f"the mask {self.mask} is not a pattern of pillars and grooves")
        pattern = Pattern.flat(self.n_blocks, self.n_rows or None)
        if self.n_p:
            pattern = pattern.pillared(self.n_p, self.n_s)
        if self.n_p2:
            pattern = pattern.grooved(self.n_p2, self.n_s2, along="x")
        if self.n_p3:
            pattern = pattern.grooved(self.n_p3, self.n_s3, along=self.along_3)
        return pattern

    @property
    def sides(self) -> tuple[str, ...]:
        """Axes along which pillars have uncut sides of at least 6 blocks."""
        if self.n_p < _SIDE or self.along_3 == "y":
            return ()
        return ("x",) if self.n_p2 else ("x", "y")

    @property
    def names(self) -> dict[str, Any]:
        """Lengths of its levels and `along_3`, by name."""
        return self.lengths | ({"along_3": self.along_3} if self.along_3 else {})

    @property
    def named(self) -> dict[str, str]:
        """All properties that identify the scene, by name."""
        named: dict[str, Any] = {"n_blocks": self.n_blocks}
        if self.n_rows:
            named["n_rows"] = self.n_rows
        if not self.mask:
            named["level"] = self.level
        named |= self.names | {key: getattr(self, key) for key in MAPS if getattr(self, key)}
        if self.is_periodic:
            named["edges"] = self.edges
        named |= {**dict(self.varied), "direction": self.direction}
        return {key: str(value) for key, value in named.items()}

    @property
    def folder(self) -> str:
        """Name for the folder of its realisations, as pillars-6-6-x; others may have the same."""
        kind = ("flat", "pillars" if self.n_p else "grooves", "grooves", "hierarchy")[self.level]
        parts = self.mask or kind, *self.names.values(), self.direction
        varied = (part for pair in self.varied for part in pair)
        return "-".join(map(str, (*parts, *varied))).encode()[:_LONGEST].decode(errors="ignore")

    def __str__(self) -> str:
        """Return its name in captions and titles."""
        return ", ".join(f"{key} = {value}" for key, value in self.named.items())

    @property
    def arguments(self) -> str:
        """The scene as options of `springblock simulate`, with the files of its fields."""
        varied, files, options = dict(self.varied), self.files, []
        for name, value in self.named.items():
            if name in varied:
                given = getattr(varied[name], "file", None) or value
                options.append(f"--vary {quote(f'{name}={given}')}")
            elif name in files:
                options.append(f"{MAPS[name]} {quote(str(files[name]))}")
            elif name != "level" and not (self.mask and name in ("n_blocks", "n_rows")):
                options.append(f"--{name.replace('_', '-')} {value}")
        return " ".join(options)

    @property
    def files(self) -> dict[str, Path]:
        """Files of its fields and of its law, by column."""
        maps = {key: getattr(self, key) for key in MAPS}
        maps["law"] = dict(self.varied).get("law")
        files = {key: getattr(each, "file", None) for key, each in maps.items()}
        return {key: file for key, file in files.items() if file}


def gap_of(given: int | str, n_p: int) -> int:
    """Read n_s, possibly as a multiple or a fraction of n_p: "2n_p", "n_p/3"."""
    if not (isinstance(given, str) and "n_p" in given):
        return int(given)
    times, parts = given.split("n_p")
    return int(times or 1) * n_p // int(parts.removeprefix("/") or 1)


def grid_of(lists: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Yield every combination of the values of constants, by name.

    Where the law is one of them, constants that it does not use have no effect: those of other
    built-in laws are zero, and those of other files are left out.
    """
    laws = [as_law(law) for law in lists.get("law", ())]
    own = {str(law): law.constants.keys() for law in laws if isinstance(law, LawFile)}
    for values in product(*lists.values()):
        constants = dict(zip(lists, values, strict=True))
        if "law" in constants:
            constants["law"] = law = as_law(constants["law"])
            others = set().union(*own.values()) - own.get(str(law), set())
            constants = {name: constants[name] for name in constants if name not in others}
            constants |= {name: 0.0 for other, name in LAWS.items() if name and other != law}
            if law != "slip_weakening":
                constants["healing"] = HEALING[0]
        yield constants


def in_order(constants: Mapping[str, Any]) -> Varied:
    """Sort constants in the order of `CONSTANTS`, and convert numbers given as text.

    Other names come last; they belong to a law from a file, and `Setup.vary` checks them.
    """
    for name in constants:
        if name == "direction":
            raise ValueError(
                "direction is not a constant of the material; give it as the option --direction, "
                "or as the key direction of a group of scenes"
            )
        if not name.isidentifier():
            raise ValueError(f"unknown constant {name!r}; choose from {', '.join(CONSTANTS)}")
    names = [*CONSTANTS, *sorted(constants.keys() - set(CONSTANTS))]
    return tuple((name, _value(name, constants[name])) for name in names if name in constants)


def _value(name: str, value: Any) -> str | float | LawFile:
    if name == "law":
        return as_law(value)
    if name in TEXTS:
        return str(value)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a number, not {value!r}") from None
