"""Digests of the package's own sources and of configurations: what made a result."""

import hashlib
import json
import re
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

_PACKAGE = "springblock"
_ROOT = Path(__file__).parent
_TEMPLATES = (".html", ".css", ".js", ".md")


def _file(module: str) -> Path | None:
    """Source file of a module of this package; None if there is no such module."""
    path = _ROOT.joinpath(*module.split(".")[1:])
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if candidate.is_file():
            return candidate
    return None


#: An import of this package, at the top of a line or inside a function; `ast` would take 0.2 s.
_IMPORT = re.compile(
    rf"""
    ^[ \t]* (?: from [ ] ({_PACKAGE} [.\w]*) [ ] import [ ] ( \( [^)]* \) | [^#\n]* )
             | import [ ] ({_PACKAGE} [.\w]*) )
    """,
    re.MULTILINE | re.VERBOSE,
)


@cache
def imports(file: Path) -> frozenset[str]:
    """Names of this package that a source file imports, at its top or inside a function."""
    names: set[str] = set()
    for home, members, module in _IMPORT.findall(file.read_text()):
        names.add(module or home)
        names.update(f"{home}.{member}" for member in re.findall(r"(\w+)(?: as \w+)?", members))
    return frozenset(names)


def files(*modules: str) -> list[Path]:
    """Source files of modules of this package and of all that they import from it.

    To a package belong the templates beside it.
    """
    found: set[Path] = set()
    waiting = list(modules)
    while waiting:
        file = _file(waiting.pop())
        if file and file not in found:
            found.add(file)
            if file.name == "__init__.py":
                found.update(path for path in file.parent.iterdir() if path.suffix in _TEMPLATES)
            waiting.extend(imports(file))
    return sorted(found)


def digest(*modules: str) -> str:
    """Digest of the sources that these modules consist of; 16 hexadecimal digits."""
    content = hashlib.sha256()
    for file in files(*modules):
        content.update(file.relative_to(_ROOT).as_posix().encode() + file.read_bytes())
    return content.hexdigest()[:16]


def configuration_digest(configuration: Mapping[str, Any]) -> str:
    """Digest of a configuration, of the study or of one batch; 16 hexadecimal digits."""
    text = json.dumps(configuration, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def code_version(*modules: str) -> str:
    """Version of the package with the digest of these modules, as 0.1.0+1234567890abcdef."""
    return f"{version(_PACKAGE)}+{digest(*modules)}"
