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

#: Parts of the package that decide the results of a step: folders, modules, or files of words, of
#: which some keys alone may count. The command line is not among them, since it only arranges.
Code = tuple[str, ...]
COMPILE: Code = ("solver",)
MASK: Code = ("model",)
SIMULATE: Code = ("model", "solver", "simulation", "io")
ANALYSE: Code = ("model", "io", "analysis")
#: Modules of a folder that describe or show results, and do not compute them.
_SHOWING = {"schemas.py", "figures.py", "page.py"}


#: Environment variable with the plan of the study that a job belongs to, see `planned`.
PLAN = "SPRINGBLOCK_PLAN"


def planned(study: str, steps: Iterable[Code]) -> str:
    """Return a plan for the jobs of a study: its digest, and for each step those of its code."""
    code = {"|".join(step): [digest(step), _sources(step)] for step in steps}
    return json.dumps({"study": study, "code": code})


def made_by(step: Code) -> dict[str, str]:
    """Return metadata for the file that a step writes: the version of its code.

    A job of a study takes it from the plan. Raises ValueError if the code is no longer the planned.
    """
    plan = _plan()
    if not plan:
        return {"code_version": code_version(step)}
    code, sources = plan["code"]["|".join(step)]
    if sources != _sources(step):
        raise ValueError("the code changed while the study ran; run `snakemake` again")
    return {"code_version": f"{version('springblock')}+{code}"}


def of_study(step: Code) -> dict[str, str]:
    """Return the same with the digest of the study, for tables of its realisations."""
    return made_by(step) | {"study": study()}


def study() -> str:
    """Return the digest of the study that this job belongs to, or ""."""
    return str(_plan().get("study", ""))


def _plan() -> dict[str, Any]:
    plan: dict[str, Any] = json.loads(os.environ.get(PLAN, "{}"))
    return plan


@cache
def digest(step: Code) -> str:
    """Return the digest of the code of a step; 16 hexadecimal digits.

    It does not depend on comments, layout, docstrings and the text of `raise`.
    """
    return _short("".join(map(_of, step)))


def _sources(step: Code) -> str:
    """Return the digest of the bytes of the files of a step, as they are now."""
    content = hashlib.sha256()
    for file in chain.from_iterable(map(_files, step)):
        content.update(file.read_bytes())
    return content.hexdigest()[:16]


def _files(part: str) -> list[Path]:
    """Return the files of a part: itself, or the modules of a folder that compute."""
    place = _ROOT / part.split()[0]
    if place.suffix:
        return [place]
    return [file for file in sorted(place.rglob("*.py")) if file.name not in _SHOWING]


def code_version(step: Code) -> str:
    """Return the package's version with the digest of a step, as 1.0.0+1234567890abcdef."""
    return f"{version('springblock')}+{digest(step)}"


def same_code(one: str, other: str) -> bool:
    """Return whether two versions have the same digest."""
    return one.rpartition("+")[2] == other.rpartition("+")[2]


def digest_of_data(data: Any) -> str:
    """Return the digest of data that JSON can hold, whatever the order of keys."""
    return _short(json.dumps(data, sort_keys=True))


@cache
def _of(part: str) -> str:
    """Return the digest of the code of a part, or of words in a file, or under some of its keys."""
    place, *keys = part.split()
    if keys:
        entries = tomllib.loads((_ROOT / place).read_text("utf-8")).items()
        words = repr([(name, [values.get(key) for key in keys]) for name, values in entries])
        return _short(words)
    return _short("\n".join(f"{file.name} {_of_module(file)}" for file in _files(part)))


@cache
def _of_module(file: Path) -> str:
    """Return the digest of the code of a module."""
    return _short("\n".join(_skeleton(ast.parse(file.read_bytes()))))


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
