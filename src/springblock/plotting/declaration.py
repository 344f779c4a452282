"""Declarations of figures: title, caption and data.

Command line and workflow are built from these declarations.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.plotting.caption import material_in_words, sample_in_words, surface_in_words

if TYPE_CHECKING:  # reads configurations, which a plain installation cannot
    from springblock.study.configuration import Planned

    Ensembles = Mapping[str, Sequence[Planned]]  #: of a study by group

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
    caption: str  #: what is plotted, for which surfaces; lines may break anywhere
    marks: str = ""  #: meaning of bands, bars and symbols; follows surfaces and realisations
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

    @property
    def usual_caption(self) -> str:
        """Return the caption without a study."""
        return f"{self.caption} {self.marks}".strip()

    def caption_in(self, ensembles: "Ensembles", lengths: Lengths, material: Material) -> str:
        """Return the caption with the surfaces, seeds and material of a study."""
        drawn = self.data_in_words(ensembles, lengths, material)
        return " ".join(filter(None, (self.caption, drawn, self.marks)))

    def data_in_words(self, ensembles: "Ensembles", lengths: Lengths, material: Material) -> str:
        """Describe the data in a study, in whole sentences: surfaces, seeds and material."""
        if self.draws == "pattern":
            return f"Drawn with {surface_in_words(lengths)}."
        groups = {name: [e.scene for e in members] for name, members in ensembles.items()}
        known = {e.scene: e.seeds for members in ensembles.values() for e in members}
        sample = {
            need.scene: known[need.scene] if need.batches is None else known[need.scene][:1]
            for need in self.needs(groups, lengths)
            if need.scene
        }
        return f"{sample_in_words(sample)} {material_in_words(material)}" if sample else ""

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
        return Scene(max(n_blocks, lengths["n_p"] + lengths["n_s"]), **lengths).arguments


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
