"""Results of the study: tables, pages and figures, each declared once, in `results.toml`.

Rules, commands, the report and digests of code follow from these entries. This module loads
neither matplotlib nor pandas: a dry run of the study starts quickly. Figures 1 to 9 are numbered as
in Costagliola, Bosia & Pugno, Int. J. Solids Struct. 243, 111525 (2022),
doi:10.1016/j.ijsolstr.2022.111525.
"""

import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path
from pkgutil import resolve_name
from typing import Any, Literal

from springblock.model.scene import Scene
from springblock.provenance import ANALYSE, SIMULATE, Code, digest, digest_of_data

HERE = Path(__file__).parent

Groups = Mapping[str, Sequence[Scene]]  #: scenes of a study by group; a group may be empty
Lengths = Mapping[str, Any]  #: of a scene, as the configuration gives them for a figure


def found(place: str) -> Any:
    """Return what a result names, MODULE:NAME in the folder of the study or in the package."""
    return resolve_name(place if place.startswith("springblock") else f"springblock.study.{place}")


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table of the study: its columns, and what computes its rows.

    That is a function of the name of one of its parts, or of realisations and tables, by name.
    """

    name: str
    columns: str
    made: str = ""
    parts: tuple[str, ...] = ()  #: each computed by a job of its own, without inputs
    groups: tuple[str, ...] = ()  #: of scenes, whose realisations it is computed from
    tables: tuple[str, ...] = ()  #: which it is computed from, too; they may be missing
    words: tuple[str, ...] = ()  #: files in the package, and keys of which its rows hold the words
    is_periodic: bool = False  #: whether its surfaces have periodic edges

    @property
    def chapter(self) -> str:
        """Return the folder of the chapter that computes it."""
        return self.made.partition(".")[0]

    @property
    def code(self) -> Code:
        """Return the parts of the package that compute it."""
        physics = (*SIMULATE, "analysis") if self.parts else ANALYSE
        return (*physics, "theory", f"{HERE.name}/{self.chapter}", *self.words)


@dataclass(frozen=True, kw_only=True)
class Page:
    """A page in Markdown: its template, `page.md` beside the function that computes its values."""

    name: str
    values: str
    tables: tuple[str, ...]
    parts: tuple[str, ...] = ()  #: of tables, all of which it shows

    @property
    def template(self) -> str:
        """Return the file of its template."""
        return f"{self.values.partition('.')[0]}/page.md"

    @property
    def digest(self) -> str:
        """Return the digest of its words and of the code that computes its values."""
        chapter = HERE / self.values.partition(".")[0]
        code = digest((*_SHOWING, f"{HERE.name}/pages.py", *_all_of(chapter)))
        words = sorted({*chapter.glob("*.md"), *chapter.glob("*.toml")})
        return digest_of_data([code, [file.read_text("utf-8") for file in words]])


@dataclass(frozen=True, kw_only=True)
class Figure:
    """Title, caption and data of a figure; `draws` names what its function takes.

    - nothing;
    - pattern: the one that the configuration gives under the figure's name, as large as the study's
      surfaces, or large enough for one pillar and its gap;
    - tables: those of the whole study;
    - realisations: of scenes, by the values of `keys`. Of several scenes with equal values the
      first is drawn. Without keys there is one scene, and the function takes its realisations;
    - correlations: the n_p that the configuration gives, and the tables.
    """

    name: str  #: of its file and of its command
    drawn: str
    title: str
    caption: str  #: what is plotted
    marks: str = ""  #: surfaces, realisations, and the meaning of bands, bars and symbols
    draws: Literal["nothing", "pattern", "tables", "realisations", "correlations"] = "realisations"
    groups: tuple[str, ...] = ()  #: of scenes, all of which a study must have
    also: tuple[str, ...] = ()  #: groups, or tables, that are drawn, too, where a study has them
    keys: tuple[str, ...] = ()  #: attributes of scenes that tell the realisations apart
    batches: int | None = None  #: that hold the first realisation, the one drawn; None for all
    tables: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()  #: of tables, all of which it shows

    @property
    def category(self) -> str:
        """Return the figure's part of the report: its chapter, or Figures for the paper's."""
        chapter = self.drawn.partition(".")[0]
        return "Figures" if chapter in ("paper", "springblock") else chapter.capitalize()

    @property
    def digest(self) -> str:
        """Return the digest of its words and of the code that draws it."""
        chapter = HERE / self.drawn.partition(".")[0]
        return digest_of_data([digest((*_SHOWING, "plotting", *_all_of(chapter))), asdict(self)])

    def function(self) -> Callable[..., Any]:
        """Return the function that draws it in the journal's style, as matplotlib's `Figure`."""
        from springblock.plotting.style import journal  # slow to load: it brings matplotlib along

        return journal(found(self.drawn))

    def described(self, **values: object) -> str:
        """Return the caption with N, n_p, sliding direction and number of runs of the data."""
        return f"{self.caption} {self.marks}".strip().format_map(values)

    def scenes(self, groups: Groups, lengths: Lengths) -> list[Scene]:
        """Return the scenes whose realisations are drawn, in order."""
        if self.draws != "realisations":
            return []
        every = chain.from_iterable(groups.get(group, []) for group in self.groups + self.also)
        first: dict[tuple[Any, ...], Scene] = {}
        for scene in having(lengths, every):
            first.setdefault(tuple(getattr(scene, key) for key in self.keys), scene)
        return list(first.values())

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


def file_name(scene: Scene) -> str:
    """Name the file of a surface's film, in letters, digits and _."""
    if scene.level < 0:
        return re.sub(r"\W", "_", str(scene.mask or scene.folder))
    kinds = ("flat_surface", "grooves", "grooves"), ("", "pillars", "grooved_pillars")
    rows = {"rows": scene.n_rows} if scene.n_rows != scene.n_blocks else {}
    sizes = scene.lengths | {"N": scene.n_blocks} | rows
    kind = kinds[scene.n_p > 0][min(scene.level, 2)]
    return "_".join([kind, *(f"{name}_{size}" for name, size in sizes.items())])


def digest_of_report() -> str:
    """Return the digest of the words and the code of the report."""
    chapters = chain.from_iterable(_all_of(HERE / name) for name in ("report", "claims"))
    kinds = ("report/*.*", "results.toml", "claims/statements.toml", "findings/full_study.md")
    files = chain.from_iterable(sorted(HERE.glob(kind)) for kind in kinds)
    return digest_of_data(
        [digest((*_SHOWING, "plotting", *chapters)), [file.read_text("utf-8") for file in files]]
    )


#: Parts of the package that all pages and figures show results with.
_SHOWING = (*ANALYSE, "theory")


def _all_of(chapter: Path) -> Code:
    """Return all modules of a chapter, with those that only show its results."""
    return tuple(f"{HERE.name}/{file.relative_to(HERE)}" for file in sorted(chapter.rglob("*.py")))


def _read(kind: Callable[..., Any], entries: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return the entries of one kind by name."""
    return {
        name: kind(name=name, **{key: _value(given) for key, given in entry.items()})
        for name, entry in entries.items()
    }


def _value(given: Any) -> Any:
    """Return a value of an entry: words on one line, with those that are shared, and tuples."""
    if isinstance(given, str):
        return " ".join(given.format(**_SHARED).split())
    return tuple(given) if isinstance(given, list) else given


_ENTRIES = tomllib.loads((HERE / "results.toml").read_text(encoding="utf-8"))
_SHARED = _ENTRIES["shared"]
TABLES: dict[str, Table] = _read(Table, _ENTRIES["tables"])
PAGES: dict[str, Page] = _read(Page, _ENTRIES["pages"])
#: `springblock figure NAME` draws one; the report sorts them by name.
FIGURES: dict[str, Figure] = _read(Figure, _ENTRIES["figures"])
#: Tables by the name of each of their parts.
PARTS = {part: table for table in TABLES.values() for part in table.parts}
