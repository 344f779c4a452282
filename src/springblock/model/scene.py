"""Scenes: all that decides the numbers of a run besides the seed, declared field by field.

Options of commands, columns of tables, the schema of configurations, names of folders and the
identity of runs follow from these declarations.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from itertools import chain, product
from pathlib import Path
from shlex import quote
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.blockmap import BlockMap
from springblock.model.defaults import INTEGRATOR, INTEGRATORS, STEP
from springblock.model.direction import normalised
from springblock.model.law import LawFile
from springblock.model.material import LAWS, Material, number, word
from springblock.model.pattern import Pattern
from springblock.model.surface import as_coefficients
from springblock.model.texture import ARRANGEMENTS, KINDS, Texture

LENGTHS = ("n_p", "n_s", "n_p2", "n_s2", "n_p3", "n_s3")  #: lengths of a scene, two per level
MAPS = ("mask", "mu_static_field", "mu_dynamic_field")  #: fields read from files
_LONGEST = 200  #: bytes in the name of a folder; file systems take 255
_SIDE = 6  #: least number of blocks of a side along which a correlation is measured

Row = dict[str, Any]


def _blocks(meaning: str) -> Any:
    return field(default=0, metadata={"unit": "blocks", "meaning": meaning})


def _map(meaning: str, kind: str) -> Any:
    """Declare a field from a file, which the method of `BlockMap` of this name reads."""

    def read(file: str) -> BlockMap:
        found: BlockMap = getattr(BlockMap, kind)(Path(file))
        return found

    said = {
        "unit": "name",
        "meaning": f"file of the {meaning}, in tables its name and digest; '' without one",
        "read": read,
    }
    return field(default=None, metadata=said)


def _times(given: Any) -> tuple[float, ...]:
    """Read times in s from a list, or from a text with commas."""
    return tuple(map(float, given.split(",") if isinstance(given, str) else given))


@dataclass(frozen=True)
class Geometry:
    """Surface and sliding direction; a length of 0 means no such level.

    Grooves of level 2 run along x, from edge to edge of a surface without pillars; grooves of level
    3 run along `along_3`, by default y. A texture or mask replaces pattern and N; coefficients from
    files replace those that are drawn.
    """

    n_blocks: int = _blocks("side N of the surface along x; that of the mask, if there is one")
    n_p: int = _blocks("side of a pillar; 0 without pillars")
    n_s: int = _blocks("distance between pillars; 0 without pillars")
    n_p2: int = _blocks("width of a pawl; 0 without grooves")
    n_s2: int = _blocks("width of a groove; 0 without grooves")
    n_p3: int = _blocks("size of the parts of a pawl between grooves of level 3, or 0")
    n_s3: int = _blocks("width of a groove of level 3, or 0")
    direction: str = word("x", "sliding direction: x, y or degrees from x", read=normalised)
    along_3: str = word("", "direction of the grooves of level 3, by default y", ("", "x", "y"))
    n_rows: int = _blocks("side of the surface along y; by default N")
    edges: str = word("free", "edges of the surface: free or periodic", ("free", "periodic"))
    texture: str = word("", "periodic texture, from lengths in m; '' without one", ("", *KINDS))
    feature: float = number(0.0, "m", "diameter of a disc or hole, width of others", True)
    pitch: float = number(0.0, "m", "distance between centres of features", True)
    arrangement: str = word("square", "arrangement of the features", ARRANGEMENTS)
    width: float = number(0.0, "m", "side of a textured surface, to the nearest period", True)
    mask: BlockMap | None = _map("contact mask", "mask")  # noqa: RUF009 - fields
    mu_static_field: BlockMap | None = _map("static coefficients", "coefficients")  # noqa: RUF009
    mu_dynamic_field: BlockMap | None = _map("dynamic coefficients", "coefficients")  # noqa: RUF009

    def __post_init__(self) -> None:
        self._set(direction=normalised(self.direction))
        for name in MAPS:
            if isinstance(given := getattr(self, name), str):  # from a table
                self._set(**{name: BlockMap(given) if given else None})
        self._check_levels()
        self._check_texture()
        self._check_maps()

    def _set(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _check_levels(self) -> None:
        own = [*self.lengths, *(["along_3"] if self.along_3 else [])]
        own += ["texture"] if self.texture and self.mask else []
        for name in ("mask", "texture"):
            if getattr(self, name) and (others := [each for each in own if each != name]):
                raise ValueError(
                    f"{name} cannot be combined with {', '.join(others)}, since it defines all "
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
        self._set(along_3=self.along_3 or ("y" if self.n_p3 else ""))

    def _check_texture(self) -> None:
        """Give a textured surface the blocks of whole periods."""
        given = [name for name in ("feature", "pitch", "width") if getattr(self, name)]
        if not self.texture and given:
            raise ValueError(f"{given[0]} needs texture: {', '.join(KINDS)}")
        if self.texture:
            rows, columns = self.textured.shape
            self._check_size("texture", rows, columns)

    def _check_size(self, what: str, rows: int, columns: int) -> None:
        if self.n_blocks not in (0, columns) or self.n_rows not in (0, rows):
            raise ValueError(
                f"n_blocks and n_rows must be those of the {what}, {columns} and {rows}, "
                f"not {self.n_blocks} and {self.n_rows or self.n_blocks}"
            )
        self._set(n_blocks=columns, n_rows=rows)

    def _check_maps(self) -> None:
        if self.mask and self.mask.values is not None:
            self._check_size("mask", *self.mask.values.shape)
        elif not (self.mask or self.n_blocks):
            raise ValueError("the surface has no size; give n_blocks or a mask")
        self._set(n_rows=self.n_rows or self.n_blocks)
        if not self.mask:
            Pattern.flat(self.n_blocks, self.n_rows)  # refuses invalid numbers of blocks
        for given in (self.mu_static_field, self.mu_dynamic_field):
            if given and given.values is not None:
                as_coefficients(str(given), given.values, self.contact)  # refuses invalid ones

    @property
    def lengths(self) -> dict[str, int]:
        """Lengths of its levels, by name."""
        return {key: getattr(self, key) for key in LENGTHS if getattr(self, key)}

    @property
    def level(self) -> int:
        """Number of levels of the pattern: 0 for a flat surface, -1 for a texture or a mask."""
        return -1 if self.mask or self.texture else len(self.lengths) // 2

    @property
    def shape(self) -> tuple[int, int]:
        """Blocks along y and along x."""
        return self.n_rows, self.n_blocks

    @property
    def is_periodic(self) -> bool:
        """Whether the edges are periodic."""
        return self.edges == "periodic"

    @property
    def is_papers(self) -> bool:
        """Whether the surface is of the paper's kind: square, with free edges, without files."""
        is_square = self.n_rows == self.n_blocks
        own = self.texture or any(getattr(self, key) for key in MAPS)
        return is_square and not (self.is_periodic or own)

    @property
    def is_drawn(self) -> bool:
        """Whether any coefficient is drawn; otherwise all seeds give the same run."""
        return not (self.mu_static_field and self.mu_dynamic_field)

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Blocks in contact with the substrate, (N_y, N_x) bool, [y, x]."""
        if self.texture:
            return self.textured.contact
        if self.mask is None:
            return self.pattern.contact
        if self.mask.values is None:
            raise ValueError(f"the values of the mask {self.mask} are not available, only its name")
        return self.mask.values

    @property
    def textured(self) -> Texture:
        """The texture, from lengths in m."""
        spacing = getattr(self, "spacing")  # noqa: B009 - of the material of a scene
        lengths = self.feature, self.pitch, self.width, spacing
        return Texture(self.texture, *lengths, self.arrangement)

    @property
    def pattern(self) -> Pattern:
        """The pattern of pillars and grooves; a mask or texture has none."""
        if self.level < 0:
            what = f"mask {self.mask}" if self.mask else f"texture {self.texture}"
            raise ValueError(f"the {what} is not a pattern of pillars and grooves")
        pattern = Pattern.flat(self.n_blocks, self.n_rows)
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


@dataclass(frozen=True)
class Scene(Material, Geometry):
    """Surface, direction, material, method and times of runs, with every constant resolved.

    `Scene(**row)` of the columns of a table is the scene again; fields from files are then only
    names.

    Raises
    ------
    TypeError, ValueError
        If a length lacks its partner or the level above it, a constant is not valid, or fields from
        files do not fit.
    """

    integrator: str = word(INTEGRATOR, f"time integrator: {' or '.join(INTEGRATORS)}", INTEGRATORS)
    step: float = number(STEP, "s", "integration step h")
    sample_interval: float = number(
        0.0, "s", "time between samples of the force, by default 2e-7 s or less", may_vanish=True
    )
    duration: float = number(
        0.0, "s", "simulated time; 0: until after the force peak", may_vanish=True
    )
    snapshot_times: tuple[float, ...] = field(
        default=(),
        metadata={
            "unit": "s",
            "meaning": "times at which displacements are stored; a run lasts at least until then",
            "read": _times,
        },
    )

    def __post_init__(self) -> None:
        Geometry.__post_init__(self)
        Material.__post_init__(self)
        interval = self.sample_interval or self.usual_interval(self.step)
        self._set(sample_interval=interval, snapshot_times=_times(self.snapshot_times))

    @property
    def material(self) -> Material:
        """Constants of the model alone."""
        return Material(**{each.name: getattr(self, each.name) for each in fields(Material)})

    @property
    def constants(self) -> Row:
        """Constants of the model, integrator and step, by name."""
        return {name: getattr(self, name) for name in CONSTANTS}

    def items(self) -> Iterator[tuple[str, Any]]:
        """Yield name and value of each column of a table but `level`."""
        for name, value in super().items():
            yield name, str(value or "") if name in MAPS else value

    @property
    def values(self) -> Row:
        """Value of every field, by name, and of the constants of a law from a file."""
        own = self.law.constants if isinstance(self.law, LawFile) else {}
        return dict(self.items()) | {"law": str(self.law)} | own

    @property
    def given(self) -> Row:
        """Values that differ from the defaults and do not follow from others, by name.

        Those of constants of a law from a file come last.
        """
        usual: Row = {each.name: each.default for each in fields(self)}
        usual |= {"n_rows": self.n_blocks, "sample_interval": self.usual_interval(self.step)}
        if self.level < 0:
            usual |= {"n_blocks": self.n_blocks, "n_rows": self.n_rows}
        values = {name: getattr(self, name) for name in usual}
        own = dict(self.law.given) if isinstance(self.law, LawFile) else {}
        return {name: value for name, value in values.items() if value != usual[name]} | own

    @property
    def options(self) -> str:
        """The scene as options of a command, with the files of its fields and of its law."""
        told = []
        for name, value in self.given.items():
            text = ",".join(map(str, value)) if isinstance(value, tuple) else value
            text = quote(str(getattr(value, "file", None) or text))
            option = f"--{name.replace('_', '-')} {text}" if name in FIELDS else ""
            told.append(option or f"--constant {name}={text}")
        return " ".join(told)

    @property
    def files(self) -> list[str]:
        """Files of its fields and of its law."""
        files = (getattr(getattr(self, name), "file", None) for name in (*MAPS, "law"))
        return [str(file) for file in files if file]

    @property
    def folder(self) -> str:
        """Readable part of the name of the folder of its realisations, as pillars-6-6-x."""
        kind = ("flat", "pillars" if self.n_p else "grooves", "grooves", "hierarchy")[self.level]
        along = [self.along_3] if self.along_3 else []
        others = FIELDS.keys() - set(CONSTANTS)
        own = chain.from_iterable(each for each in self.given.items() if each[0] not in others)
        sizes = [f"{1e6 * each:g}um" for each in (self.feature, self.pitch) if each]
        parts = (
            self.mask or self.texture or kind,
            *sizes,
            *self.lengths.values(),
            *along,
            self.direction,
            *own,
        )
        return "-".join(map(str, parts)).encode()[:_LONGEST].decode(errors="ignore")

    def __str__(self) -> str:
        """Return its name in captions and titles."""
        return ", ".join(f"{name} = {value}" for name, value in self.given.items())


FIELDS = {each.name: each for each in fields(Scene)}
GEOMETRY = tuple(each.name for each in fields(Geometry))
#: Constants of the model and the method, without the times of samples.
CONSTANTS = (*(each.name for each in fields(Material)), "integrator", "step")
#: Those of them that only some built-in laws have.
OF_LAWS = (*filter(None, LAWS.values()), "healing")
#: Lengths and constants that are numbers, and the direction: possible axes of figures.
AXES = [name for name, each in FIELDS.items() if each.type in (int, float) and name != "duration"]
AXES.append("direction")


def differing(every: Iterable[Mapping[str, Any]]) -> list[str]:
    """Return the names whose values are not the same in all of these, such as `Scene.values`."""
    rows = list(every)
    names = dict.fromkeys(name for row in rows for name in row)
    return [name for name in names if len({row.get(name) for row in rows}) > 1]


def listed(given: Any) -> list[Any]:
    """Return a list of one or more values."""
    return given if isinstance(given, list) else [given]


def expand(lists: Mapping[str, Any]) -> Iterator[Row]:
    """Yield every combination of values, given one by one or in lists, by name.

    n_s may be a multiple or a part of n_p. Of several laws, each has only its own constants.
    """
    names = sorted(lists, key=lambda name: [*FIELDS, name].index(name))
    known = {name: [_read(name, value) for value in listed(lists[name])] for name in names}
    laws = known.get("law", [])
    of_laws = set(OF_LAWS).union(*map(constants_of, laws)) if len(laws) > 1 else set()
    for values in product(*known.values()):
        row = dict(zip(names, values, strict=True))
        others = of_laws.difference(constants_of(row["law"])) if of_laws else set()
        row = {name: value for name, value in row.items() if name not in others}
        if "n_s" in row:
            row["n_s"] = gap_of(row["n_s"], row.get("n_p", 0))
        yield row


def _read(name: str, value: Any) -> Any:
    """Return the value of a field as `Scene` takes it: files by name are read."""
    read = FIELDS[name].metadata.get("read") if name in FIELDS else None
    return value if read is None or isinstance(value, BlockMap) else read(value)


def constants_of(law: str | LawFile) -> list[str]:
    """Return the names of the constants that only this law has, in their order."""
    if isinstance(law, LawFile):
        return [*law.constants]
    return [*filter(None, [LAWS[law]]), *["healing"] * (law == "slip_weakening")]


def gap_of(given: int | str, n_p: int) -> int:
    """Read n_s, possibly as a multiple or a part of n_p: "2n_p", "n_p/3"."""
    if not (isinstance(given, str) and "n_p" in given):
        return int(given)
    times, parts = given.split("n_p")
    return int(times or 1) * n_p // int(parts.removeprefix("/") or 1)


def scene_of(row: Mapping[str, Any]) -> Scene:
    """Return the scene of values as users give them, with constants of a law from a file."""
    scene = Scene(**{name: _read(name, value) for name, value in row.items() if name in FIELDS})
    others = {name: value for name, value in row.items() if name not in FIELDS}
    return scene.vary(others) if others else scene
