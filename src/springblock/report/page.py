"""The page itself, from a template."""

from base64 import b64encode
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from springblock.claims import CLAIMS
from springblock.claims.page import anchor, decided, numbered_parts
from springblock.io.parquet import load
from springblock.io.rows import Row
from springblock.report import findings, markup, media

#: Parts of the page and their titles, in order; those of the study's own pages come last, as these
#: are called by their first heading.
FIGURES = {
    "figures": "Figures of the paper",
    "supplement": "What the paper leaves open",
    "sweeps": "Sweeps",
}
PAGES = {
    "claims": "What becomes of the paper's statements",
    "mechanism": "Why friction has a minimum",
    "accuracy": "What to trust",
    "beyond": "Beyond the paper",
    "benchmark": "How fast",
    "reliability": "How reliable",
}
#: Verdicts in the order in which they are listed.
VERDICTS = ("reproduced", "reproduced in part", "not reproduced", "not settled", "not tested")
_FIGURES = {claim.name: f"figure_{claim.figure}" for claim in CLAIMS}
_HERE = Path(__file__).parent


class Part(NamedTuple):
    """A part of the page: what a page of the study says, and figures."""

    name: str
    title: str
    body: Markup
    figures: list[dict[str, Any]]


def page(files: Iterable[Path], films: Mapping[Path, Path]) -> str:
    """Write the page of a study from its pictures, pages and tables, and films with their runs.

    Files are told by their suffix: .png, .md or .parquet.

    Raises
    ------
    ValueError
        Where a file has another suffix.
    """
    kinds: dict[str, list[Path]] = {".png": [], ".md": [], ".parquet": []}
    for file in files:
        if file.suffix not in kinds:
            raise ValueError(f"a report shows files of type {', '.join(kinds)}, not {file}")
        kinds[file.suffix].append(file)
    data = {file.stem: load(file) for file in kinds[".parquet"]}
    rows = {name: table.to_pylist() for name, table in data.items()}
    runs = findings.main_runs(rows.get("realisations", []))
    judged = statements(rows.get("claims", []))
    parts = _parts(kinds[".png"], kinds[".md"])
    return rendered(
        "page.html",
        headlines=findings.headlines(runs),
        sizes=findings.sizes(runs, rows.get("correlation_length", [])),
        grooves=findings.grooves(runs),
        labels={each["name"]: each["label"] for part in parts for each in part.figures},
        n_blocks=next(iter(runs)).n_blocks if runs else 0,
        statements=judged,
        counted=counted(judged),
        shown=[part for part in parts if part.name in FIGURES],
        films=[media.moving(file, batch) for file, batch in films.items()],
        written=[part for part in parts if part.name not in FIGURES],
        tables=[markup.shown(name, table) for name, table in data.items()],
        origin=origin(data),
    )


def statements(table: Sequence[Row]) -> list[Row]:
    """Return the first row of each statement of the table `claims`, with what the page adds to it.

    That is its figure, what decided its verdict, and the anchor of its part of the page.
    """
    return [
        {
            **part[0],
            "figure": _FIGURES.get(part[0]["claim"]),
            "decided": decided(part),
            "anchor": "claims-" + anchor(f"{number}. {part[0]['claim']}"),
        }
        for number, part in numbered_parts(table)
    ]


def counted(made: Sequence[Row]) -> dict[str, int]:
    """Count verdicts, those that occur, in their order."""
    found = Counter(statement["verdict"] for statement in made)
    return {verdict: found[verdict] for verdict in VERDICTS if found[verdict]}


def rendered(template: str, **content: Any) -> str:
    """Fill a template; every string is escaped that is not marked as HTML of our own."""
    environment = Environment(
        loader=FileSystemLoader(_HERE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["typeset"] = markup.typeset
    style, script = (_HERE.joinpath(f"page.{kind}").read_text("utf-8") for kind in ("css", "js"))
    digest = b64encode(sha256(script.encode()).digest()).decode()
    return environment.get_template(template).render(
        style=Markup(style), script=Markup(script), digest=digest, **content
    )


def _parts(figures: Iterable[Path], pages: Iterable[Path]) -> list[Part]:
    """Parts of the page that have something to show, in order; a page's figures follow its text."""
    texts = {file.stem: markup.rendered(file.stem, file.read_text("utf-8")) for file in pages}
    pictures: dict[str, list[dict[str, Any]]] = {}
    for picture in map(media.picture, sorted(figures)):
        pictures.setdefault(picture["category"].lower(), []).append(picture)
    titles = FIGURES | PAGES | {name: title for name, (title, _) in texts.items()}
    bodies = {name: body for name, (_, body) in texts.items()}
    return [
        Part(name, title, bodies.get(name, Markup()), pictures.get(name, []))
        for name, title in titles.items()
        if name in texts or name in pictures
    ]


def origin(data: Mapping[str, pa.Table]) -> dict[str, str]:
    """Return what the table of realisations was made with."""
    kept = data["realisations"].schema.metadata if "realisations" in data else {}
    names = {"code version": b"code_version", "configuration": b"configuration_digest"}
    return {name: kept[key].decode() for name, key in names.items() if key in (kept or {})}
