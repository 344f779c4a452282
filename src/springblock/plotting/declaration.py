"""Declarations of figures: title, caption and data.

Command line and workflow are built from these declarations.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, Literal, NamedTuple

from springblock.model.scene import Scene

Groups = Mapping[str, Sequence[Scene]]  #: scenes of a study by group; a group may be empty
Lengths = Mapping[str, Any]  #: of a scene, as the configuration gives them for a figure


class Need(NamedTuple):
    """A table of one scene or, without a scene, of the whole study."""

    table: str
    scene: Scene | None = None
    batches: int | None = None  #: of its realisations, from the first seed on; None for all


@dataclass(frozen=True, kw_only=True)
class Declaration:
    """Title, caption and data of a figure; `draws` names what its function takes.

    - nothing;
    - pattern: the one that the configuration gives under the figure's name, as large as the study's
      surfaces, or large enough for one pillar and its gap;
    - tables: those of the whole study; one that it does not make is left out;
    - realisations: of scenes, by the values of `keys`. Of several scenes with equal values the
      first is drawn. Without keys there is one scene, and the function takes its realisations;
    - correlations: the tables of correlations, and the n_p that the configuration gives.
    """

    name: str  #: of its file and of its command
    title: str
    module: str  #: of `plotting`, whose function of the figure's name draws it
    caption: str  #: what is plotted; lines may break anywhere
    marks: str = ""  #: surfaces, realisations, and the meaning of bands, bars and symbols
    draws: Literal["nothing", "pattern", "tables", "realisations", "correlations"] = "realisations"
    groups: tuple[str, ...] = ()  #: of scenes, all of which a study must have
    also: tuple[str, ...] = ()  #: groups that are drawn, too, where a study has them
    keys: tuple[str, ...] = ()  #: attributes of scenes that tell the realisations apart
    batches: int | None = None  #: that hold the first realisation, the one drawn; None for all
    tables: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("caption", "marks"):
            object.__setattr__(self, name, " ".join(getattr(self, name).split()))

    @property
    def category(self) -> str:
        """Return the figure's part of the report: Figures, or the name of its module."""
        return "Figures" if self.module.startswith("paper_") else self.module.capitalize()

    def described(self, **values: object) -> str:
        """Return the caption with N, n_p, sliding direction and number of runs of the data."""
        return f"{self.caption} {self.marks}".strip().format_map(values)

    def is_part_of(self, groups: Groups) -> bool:
        """Return whether a study has all groups of scenes that the figure needs."""
        return all(groups.get(group) for group in self.groups)

    def needs(self, groups: Groups, lengths: Lengths) -> list[Need]:
        """Return the tables that are drawn, in the order in which the command takes them."""
        every = chain.from_iterable(groups.get(group, []) for group in self.groups + self.also)
        if self.draws == "realisations":
            drawn = first_of_each(self.keys, having(lengths, every))
            return [Need("realisations", scene, self.batches) for scene in drawn]
        return [Need(table) for table in self.tables]

    def options(self, n_blocks: int, lengths: Lengths) -> str:
        """Return further options of the command."""
        if self.draws == "correlations":
            return f"--n-p {lengths['n_p']}"
        if self.draws != "pattern":
            return ""
        return Scene(max(n_blocks, lengths["n_p"] + lengths["n_s"]), **lengths).options


def having(lengths: Lengths, scenes: Iterable[Scene]) -> list[Scene]:
    """Return the scenes that have all these lengths."""
    wanted = lengths.items()
    return [s for s in scenes if all(getattr(s, key) == length for key, length in wanted)]


def first_of_each(keys: Sequence[str], scenes: Iterable[Scene]) -> list[Scene]:
    """Return the first scene of each value of `keys`; without keys the first of all."""
    first: dict[tuple[Any, ...], Scene] = {}
    for scene in scenes:
        first.setdefault(tuple(getattr(scene, key) for key in keys), scene)
    return list(first.values())


def span(values: Iterable[int]) -> str:
    """Return the range of some numbers: 20, or 20 to 300."""
    lowest, *_, highest = sorted([*values] * 2)
    return f"{lowest}" if lowest == highest else f"{lowest} to {highest}"


def file_name(scene: Scene) -> str:
    """Name the file of a surface's film, in letters, digits and _."""
    if scene.mask:
        return re.sub(r"\W", "_", str(scene.mask))
    kinds = ("flat_surface", "grooves", "grooves"), ("", "pillars", "grooved_pillars")
    rows = {"rows": scene.n_rows} if scene.n_rows != scene.n_blocks else {}
    sizes = scene.lengths | {"N": scene.n_blocks} | rows
    kind = kinds[scene.n_p > 0][min(scene.level, 2)]
    return "_".join([kind, *(f"{name}_{size}" for name, size in sizes.items())])
