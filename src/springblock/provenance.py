"""Provenance of results: digests of code and configuration."""

import ast
import hashlib
import json
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from typing import Any

_ROOT = Path(__file__).parent
_PHYSICS = ("model", "solver", "simulation", "io")
_PAGES = ("accuracy", "mechanism", "claims", "beyond")

#: Folders of the package that determine the results of each step of the study. The command line is
#: not among them, since it only arranges, nor are descriptions of columns and the study's folder.
STEPS: dict[str, tuple[str, ...]] = {
    "compile": ("solver",),
    "mask": ("model",),
    "simulate": _PHYSICS,
    "analyse": ("model", "io", "analysis"),
    "accuracy": (*_PHYSICS, "analysis", "accuracy"),
    "claims": ("model", "io", "analysis", "accuracy", "mechanism", "claims"),
    "beyond": ("model", "io", "analysis", "mechanism", "beyond"),
    "mechanism": (*_PHYSICS, "analysis", "mechanism"),
    "plot": ("model", "io", "analysis", "accuracy", "mechanism", "beyond", "plotting"),
    "report": ("model", "io", "analysis", *_PAGES, "plotting", "report"),
}
#: Steps that write pages, on whose templates and data their results depend.
_WRITING = {"claims", "beyond", "report"}
#: Modules of descriptions alone.
_DESCRIBING = {"schemas.py"}
#: Folders whose docstrings are part of the results: the criteria of statements.
_SAYING = {"claims"}


@cache
def digest(step: str) -> str:
    """Return the digest of the code of a step; 16 hexadecimal digits.

    It does not depend on comments, layout, the text of `raise` and, but for `claims`, docstrings.
    """
    return _short("".join(_of_folder(folder, step in _WRITING) for folder in STEPS[step]))


def digest_of(file: Path) -> str:
    """Return the digest of one module, likewise."""
    return _short("\n".join(_skeleton(ast.parse(file.read_bytes()), docstrings=False)))


def code_version(step: str) -> str:
    """Return the package's version with the digest of a step, as 1.0.0+1234567890abcdef."""
    return f"{version('springblock')}+{digest(step)}"


def same_code(one: str, other: str) -> bool:
    """Return whether two versions have the same digest."""
    return one.rpartition("+")[2] == other.rpartition("+")[2]


def configuration_digest(configuration: Mapping[str, Any]) -> str:
    """Return the digest of the configuration of a study or of a batch."""
    return _short(json.dumps(configuration, sort_keys=True))


@cache
def _of_folder(folder: str, templates: bool) -> str:
    texts = []
    for file in sorted((_ROOT / folder).rglob("*")):
        if file.suffix == ".py" and file.name not in _DESCRIBING:
            texts += [file.name, *_skeleton(ast.parse(file.read_bytes()), folder in _SAYING)]
        elif templates and file.suffix in (".html", ".css", ".js", ".md", ".csv"):
            texts.append(file.read_text(encoding="utf-8"))
    return _short("\n".join(texts))


def _skeleton(node: Any, docstrings: bool) -> list[str]:
    """Return the nodes of a syntax tree without their positions and without `raise` statements.

    Docstrings are included only if `docstrings` is true. Nodes are listed, since nested generators
    would pass each word on once per level of the tree.
    """
    if isinstance(node, list):
        return list(chain.from_iterable(_skeleton(part, docstrings) for part in node))
    if not isinstance(node, ast.AST):
        return [repr(node)]
    if isinstance(node, ast.Raise):
        return ["Raise"]
    if not docstrings and isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return []
    words = [type(node).__name__]
    for field in node._fields:
        value = getattr(node, field, None)
        if value is not None and value != []:
            words += [field, *_skeleton(value, docstrings)]
    return words


def _short(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
