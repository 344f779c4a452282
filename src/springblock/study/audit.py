"""A results folder, held against what its files, its manifest and the code of today say."""

import hashlib
import json
from collections.abc import Container, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from springblock.files import MENDING, read_sealed, seal, whole_file
from springblock.io.parquet import load, origin_of
from springblock.model.blockmap import BlockMap
from springblock.provenance import code_version, configuration_digest, digest
from springblock.simulation.prelude import Prelude

#: Files that carry a checksum, and the command that makes them; the first that fits counts.
#: What is computed from others comes after them.
_SEALED = {
    "realisations/**/*.parquet": "simulate",
    "preludes/**/*.npz": "simulate",
    "surfaces/*.npy": "mask",
    "correlations/**/*.parquet": "correlation",
    "accuracy/production/*.parquet": "production",
    "accuracy/*.parquet": "measure",
    "tables/**/correlation*.parquet": "correlation",
    "tables/**/realisations.parquet": "aggregate",
    "tables/work_precision.parquet": "measure",
    "tables/production.parquet": "production",
    "tables/stability.parquet": "stability",
    "tables/claims.parquet": "claims",
}
#: Files that carry none.
_OTHERS = ("figures/*", "*.md")
_MANIFEST = "manifest.json"
_ASIDE = "set-aside"


class Fault(NamedTuple):
    """A file that cannot be used, and why."""

    file: Path
    reason: str


def faults(results: Path) -> Iterator[Fault]:
    """Files that are not whole, not in their place, or outdated, as they tell themselves."""
    unusable: set[Path] = set()
    for file, command in _sealed(results).items():
        try:
            _check(file, command, unusable)
        except (OSError, ValueError) as error:
            unusable.add(file.resolve())
            yield Fault(file, str(error))


def changes(results: Path) -> Iterator[Fault]:
    """What is not as it was when the study last came to an end here, by its manifest."""
    manifest, now = _read_manifest(results), _files(results)
    for name, before in manifest["files"].items():
        if name not in now:
            yield Fault(results / name, f"{results / name} is missing")
        elif now[name] != before:
            yield Fault(results / name, f"{results / name} is another than the study has written")


def other_origin(results: Path, lock: Path | None) -> Iterator[str]:
    """In what the manifest differs from the code of today, and from a lock file if one is given."""
    manifest = _read_manifest(results)
    for command, before in manifest["code"].items():
        if before != (now := _code(command)):
            yield f"springblock {command} was {before} and is {now}"
    if lock is not None and manifest["lock"] != (now := _digest(lock)):
        yield f"{lock} was {manifest['lock']} and is {now}"
    ours = configuration_digest(manifest["configuration"])
    for file in sorted((results / "tables").rglob("*.parquet")):
        theirs = origin_of(load(file, [])).get("configuration_digest", ours)
        if theirs != ours:
            yield f"the configuration is {ours}, and that of {file} {theirs}"


def set_aside(results: Path) -> Iterator[Fault]:
    """Move what cannot be used to the folder `set-aside`, in which it keeps its place."""
    for fault in list(faults(results)):
        place = results / _ASIDE / fault.file.relative_to(results)
        while place.exists():
            place = place.with_name(f"{place.name}.again")
        place.parent.mkdir(parents=True, exist_ok=True)
        fault.file.rename(place)
        yield fault


def write_manifest(results: Path, configuration: Mapping[str, Any], lock: Path) -> None:
    """Write down what a study that came to an end consists of, and what it was made with."""
    manifest = {
        "version": code_version("springblock.cli").partition("+")[0],
        "code": {command: _code(command) for command in sorted(set(_SEALED.values()))},
        "lock": _digest(lock) if lock.is_file() else "",
        "configuration": configuration,
        "files": _files(results),
    }
    with whole_file(results / _MANIFEST) as partial:
        partial.write_text(json.dumps(manifest, indent=1), encoding="utf-8")


def _read_manifest(results: Path) -> dict[str, Any]:
    try:
        manifest: dict[str, Any] = json.loads((results / _MANIFEST).read_text(encoding="utf-8"))
        return {key: manifest[key] for key in ("code", "lock", "configuration", "files")}
    except FileNotFoundError:
        raise ValueError(f"{results} has no {_MANIFEST}: no study has ended here") from None
    except (KeyError, TypeError, ValueError):
        raise ValueError(
            f"{results / _MANIFEST} is damaged; remove it, and the next study that ends writes it"
        ) from None


def _sealed(results: Path) -> dict[Path, str]:
    """Files that carry a checksum, with the command that makes them."""
    found: dict[Path, str] = {}
    for pattern, command in _SEALED.items():
        for file in sorted(results.glob(pattern)):
            found.setdefault(file, command)
    return found


def _files(results: Path) -> dict[str, str]:
    """Checksum of each file, by its place."""
    digests = {file: seal(file) for file in _sealed(results)}
    digests |= {file: _digest(file) for each in _OTHERS for file in sorted(results.glob(each))}
    return {file.relative_to(results).as_posix(): digest for file, digest in digests.items()}


def _check(file: Path, command: str, unusable: Container[Path]) -> None:
    """Raise ValueError, in one sentence, for a file that cannot be used."""
    if command == "mask":
        read_sealed(file)
        BlockMap.mask(file)
        return
    if file.suffix == ".npz":
        version = Prelude.read(file).code_version
    else:
        made_by = origin_of(load(file))
        version = made_by.get("code_version", "")
        for name, before in json.loads(made_by.get("inputs", "{}")).items():
            _check_input(file, (file.parent / name).resolve(), before, unusable)
    if version.rpartition("+")[2] != _code(command):
        raise ValueError(f"{file} was made by other code, {version}; {MENDING}")


def _check_input(file: Path, source: Path, before: str, unusable: Container[Path]) -> None:
    """Refuse a table whose input has changed or cannot be used; inputs may be missing."""
    if source in unusable:
        raise ValueError(f"{file} was computed from {source}, which cannot be used; {MENDING}")
    if source.exists() and seal(source) != before:
        raise ValueError(f"{file} was computed from another {source}; {MENDING}")


@cache
def _code(command: str) -> str:
    return digest(f"springblock.cli.{command}")


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]
