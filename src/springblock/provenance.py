"""Provenance of results: digests of code and configuration."""

import ast
import hashlib
import json
import os
import tomllib
from collections.abc import Iterable
from functools import cache
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from typing import Any

_ROOT = Path(__file__).parent
_PHYSICS = ("model", "solver", "simulation", "io")
_STATEMENTS = ("model", "io", "analysis", "accuracy", "mechanism")

#: Folders of the package whose code determines the results of each step of the study, and the files
#: of words that a page consists of, or keys of such a file. The command line is not among them,
#: since it only arranges, nor are descriptions of columns and the study's folder.
STEPS: dict[str, tuple[str, ...]] = {
    "compile": ("solver",),
    "mask": ("model",),
    "simulate": _PHYSICS,
    "analyse": ("model", "io", "analysis"),
    "accuracy": (*_PHYSICS, "analysis", "accuracy"),
    "mechanism": (*_PHYSICS, "analysis", "mechanism"),
    "claims": (*_STATEMENTS, "claims", "claims/statements.toml title section form"),
    "continuum": (*_PHYSICS, "analysis", "continuum"),
    "plot": (
        *("model", "io", "analysis", "accuracy", "mechanism", "continuum", "plotting"),
        "plotting/captions.toml",
    ),
    "accuracy.md": ("model", "io", "analysis", "accuracy", "pages", "pages/accuracy.md"),
    "mechanism.md": ("model", "io", "analysis", "mechanism", "pages", "pages/mechanism.md"),
    "continuum.md": ("model", "io", "analysis", "continuum", "pages", "pages/continuum.md"),
    "claims.md": (*_STATEMENTS, "claims", "claims/statements.toml", "pages", "pages/claims.md"),
    "report": (
        *(*_STATEMENTS, "continuum", "claims", "plotting", "report"),
        *("claims/statements.toml", "plotting/captions.toml"),
        *("report/*.html", "report/*.css", "report/*.js", "report/*.md"),
    ),
}
#: Modules of descriptions alone.
_DESCRIBING = {"schemas.py"}


#: Environment variable with the plan of the study that a job belongs to, see `planned`.
PLAN = "SPRINGBLOCK_PLAN"


def planned(study: str) -> str:
    """Return a plan for the jobs of a study: its digest, and for each step those of its code."""
    return json.dumps(
        {"study": study, "code": {step: [digest(step), _sources(step)] for step in STEPS}}
    )


def made_by(step: str) -> dict[str, str]:
    """Return metadata for the file that a step writes: the version of its code.

    A job of a study takes it from the plan. Raises ValueError if the code is no longer the planned.
    """
    plan = _plan()
    if not plan:
        return {"code_version": code_version(step)}
    code, sources = plan["code"][step]
    if sources != _sources(step):
        raise ValueError("the code changed while the study ran; run `snakemake` again")
    return {"code_version": f"{version('springblock')}+{code}"}


def of_study(step: str) -> dict[str, str]:
    """Return the same with the digest of the study, for tables of its realisations."""
    return made_by(step) | {"study": study()}


def study() -> str:
    """Return the digest of the study that this job belongs to, or ""."""
    return str(_plan().get("study", ""))


def _plan() -> dict[str, Any]:
    plan: dict[str, Any] = json.loads(os.environ.get(PLAN, "{}"))
    return plan


@cache
def digest(step: str) -> str:
    """Return the digest of the code of a step; 16 hexadecimal digits.

    It does not depend on comments, layout, docstrings and the text of `raise`.
    """
    return _short("".join(map(_of, STEPS[step])))


def _sources(step: str) -> str:
    """Return the digest of the bytes of the files of a step, as they are now."""
    content = hashlib.sha256()
    for part in STEPS[step]:
        name = part.split()[0]
        for file in sorted(_ROOT.glob(name if "." in name else f"{name}/**/*.py")):
            content.update(file.read_bytes())
    return content.hexdigest()[:16]


def digest_of(file: Path) -> str:
    """Return the digest of one module, likewise."""
    return _short("\n".join(_skeleton(ast.parse(file.read_bytes()))))


def code_version(step: str) -> str:
    """Return the package's version with the digest of a step, as 1.0.0+1234567890abcdef."""
    return f"{version('springblock')}+{digest(step)}"


def same_code(one: str, other: str) -> bool:
    """Return whether two versions have the same digest."""
    return one.rpartition("+")[2] == other.rpartition("+")[2]


def digest_of_files(files: Iterable[Path]) -> str:
    """Return the digest of the names of files and of their folders, in order; "" without files."""
    names = ["/".join(file.absolute().parts[-2:]) for file in files]
    return digest_of_data(names) if names else ""


def digest_of_data(data: Any) -> str:
    """Return the digest of data that JSON can hold, whatever the order of keys."""
    return _short(json.dumps(data, sort_keys=True))


@cache
def _of(part: str) -> str:
    """Return the digest of the code in a folder, or of the words in files or under some keys."""
    if "." in part:
        name, *keys = part.split()
        words = "".join(file.read_text("utf-8") for file in sorted(_ROOT.glob(name)))
        if keys:
            entries = tomllib.loads(words).items()
            words = repr([(entry, [values.get(key) for key in keys]) for entry, values in entries])
        return _short(words)
    texts = []
    for file in sorted((_ROOT / part).rglob("*.py")):
        if file.name not in _DESCRIBING:
            texts += [file.name, *_skeleton(ast.parse(file.read_bytes()))]
    return _short("\n".join(texts))


def _skeleton(node: Any) -> list[str]:
    """Return the nodes of a syntax tree without positions, docstrings and `raise` statements.

    Nodes are listed, since nested generators would pass each word on once per level of the tree.
    """
    if isinstance(node, list):
        return list(chain.from_iterable(map(_skeleton, node)))
    if not isinstance(node, ast.AST):
        return [repr(node)]
    if isinstance(node, ast.Raise):
        return ["Raise"]
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return []
    words = [type(node).__name__]
    for field in node._fields:
        value = getattr(node, field, None)
        if value is not None and value != []:
            words += [field, *_skeleton(value)]
    return words


def _short(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
