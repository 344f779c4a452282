"""The page itself, from a template."""

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from springblock.analysis.ensembles import Ensemble, constants, doubts, ensembles, mean
from springblock.analysis.means import UNITS, changes_from_first, in_words, means
from springblock.io.parquet import load, origin_of
from springblock.io.rows import Row, alike, scene_of
from springblock.model.material import Material
from springblock.model.scene import differing
from springblock.study.claims.page import judged
from springblock.study.findings.page import FILE
from springblock.study.report import markup, media

#: Parts of the page in their order, before further pages.
ORDER = ("figures", "claims", "mechanism", "continuum", "accuracy", "glossary")
#: Figures that stand in the text before all parts.
IN_TEXT = {"findings": ["figure_6"], "method": ["figure_1", "figure_2", "figure_3"]}
OBSERVED = ("static_friction", "t_max", "t_avg")  #: whose means the page shows
_HERE = Path(__file__).parent

Figures = dict[str, dict[str, Any]]  #: by name


def report_page(files: Iterable[Path], films: Mapping[Path, Path], own: bool = False) -> str:
    """Write the page of a study from its pictures, pages and tables, and films with their runs.

    Files are told by their suffix: .png, .md or .parquet. With `own` it is a study of one's own
    scenes, which has pictures and the table `realisations`.
    """
    kinds: dict[str, list[Path]] = {".png": [], ".md": [], ".parquet": []}
    for file in files:
        if file.suffix not in kinds:
            raise ValueError(f"a report shows files of type {', '.join(kinds)}, not {file}")
        kinds[file.suffix].append(file)
    data = {file.stem: load(file) for file in kinds[".parquet"]}
    figures = {file.stem: media.picture(file) for file in sorted(kinds[".png"])}
    known = {file.stem for file in kinds[".md"]} | figures.keys()
    pages = {
        file.stem: markup.rendered(file.stem, file.read_text("utf-8"), known)
        for file in kinds[".md"]
    }
    rows = {name: table.to_pylist() for name, table in data.items()}
    if own and "realisations" not in rows:
        raise ValueError("a report on own scenes needs the table realisations.parquet")
    runs = rows.get("realisations", [])
    members = ensembles(runs if own else alike(runs))
    shown = means(members, OBSERVED) if own else _on_surfaces(members)
    content = _of_own(members) if own else _of_study(figures, pages, rows.get("claims", []))
    return rendered(
        "own.html" if own else "page.html",
        **content,
        means=in_words(shown) if shown else (),
        n_runs=len(runs),
        figures=figures,
        pages=pages,
        films=[media.moving(file, batch) for file, batch in films.items()],
        tables=[markup.shown(name, table) for name, table in data.items()],
        files={
            file.stem: media.address("application/octet-stream", file.read_bytes())
            for file in kinds[".parquet"]
        },
        origin=origin_of(data["realisations"]) if "realisations" in data else {},
    )


def _of_own(members: Sequence[Ensemble]) -> dict[str, Any]:
    """Return changes between ensembles, and common parameters other than the paper's."""
    paper = dict(Material().items())
    changes = changes_from_first(members, ["static_friction"])
    return {
        "changes": in_words(changes) if changes else (),
        "doubts": doubts(members),
        "common": [
            f"{name} = {value} {UNITS.get(name, '')}".strip()
            for name, value in constants(members).items()
            if value and value != paper.get(name)
        ],
    }


def _on_surfaces(members: Sequence[Ensemble]) -> list[Row]:
    """Return a row of means for each surface, named by what tells it apart, the shortest first."""
    apart = differing(each.names for each in members)
    rows: list[Row] = []
    for each in members:
        scene = scene_of(each.rows[0])
        told = [f"{name} = {value}" for name, value in scene.given.items() if name in apart]
        surface = ["flat"] * (scene.level == 0)
        observed = {name: mean(each, name) for name in OBSERVED}
        rows.append({"surface": ", ".join([*surface, *told])} | observed | {"runs": len(each.rows)})
    return sorted(rows, key=lambda row: row["surface"].count(","))


def _of_study(
    figures: Figures, pages: Mapping[str, markup.Page], claims: Iterable[Row]
) -> dict[str, Any]:
    """Return findings, those of the full study by default, and verdicts and parts of the page."""
    findings, pages = pages.get("findings"), {k: p for k, p in pages.items() if k != "findings"}
    return {
        "findings": (findings or markup.rendered("findings", FILE.read_text("utf-8"), pages)).body,
        "statements": judged(claims),
        "in_text": IN_TEXT,
        "parts": _parts(figures, pages),
        "version": version("springblock"),
    }


def rendered(template: str, **content: Any) -> str:
    """Fill a template; every string is escaped that is not marked as HTML of our own."""
    environment = Environment(
        loader=FileSystemLoader(_HERE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"typeset": markup.typeset}
    style, script = (_HERE.joinpath(f"page.{kind}").read_text("utf-8") for kind in ("css", "js"))
    digest = b64encode(sha256(script.encode()).digest()).decode()
    return environment.get_template(template).render(
        style=Markup(style), script=Markup(script), digest=digest, **content
    )


def _parts(figures: Figures, pages: Mapping[str, markup.Page]) -> dict[str, list[dict[str, Any]]]:
    """Figures of the parts that have something to show, in order, without those in the text."""
    left: dict[str, list[dict[str, Any]]] = {}
    for name, figure in figures.items():
        if name not in chain.from_iterable(IN_TEXT.values()):
            part = figure["category"].lower()
            left.setdefault(part if part in pages else "figures", []).append(figure)
    names = [name for name in dict.fromkeys([*ORDER, *pages, *left]) if name in {*pages, *left}]
    return {name: left.get(name, []) for name in names}
