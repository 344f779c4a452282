"""Check of a results folder: missing, superfluous, damaged, foreign and outdated files."""

import json
import re
from collections.abc import Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from springblock.files import MENDING
from springblock.io.identity import RECORD, read_record, refuse_foreign
from springblock.io.parquet import load, origin_of
from springblock.model.blockmap import BlockMap
from springblock.provenance import code_version, configuration_digest, same_code
from springblock.simulation.fields import import_xarray
from springblock.simulation.prelude import Prelude

#: Folders in which a study writes, and the steps that make their files.
_FOLDERS = dict.fromkeys(("realisations", "preludes", "fields"), "simulate")
_FOLDERS |= {"surfaces": "mask", "correlations": "analyse", "accuracy": "accuracy"}
_FOLDERS |= {"mechanism": "mechanism", "continuum": "continuum"}
_FOLDERS |= dict.fromkeys(("tables", "figures", "films"), "")
#: Steps that make tables, by the first word of their names.
_TABLES = {"realisations": "simulate", "correlation": "analyse", "work": "accuracy"}
_TABLES |= {"production": "accuracy", "stability": "accuracy"}
_TABLES |= dict.fromkeys(("mechanism", "sensitivities"), "mechanism")
_TABLES |= {"continuum": "continuum", "claims": "claims"}
#: Name of a file that was being written when its job was killed, see `files.whole_file`.
_PARTIAL = re.compile(r"\..+\.[0-9a-f]{32}")


class Fault(NamedTuple):
    """A file that cannot be used, with the reason."""

    file: Path
    reason: str


def needed(results: Path) -> dict[str, Any]:
    """Return the record of a results folder; without one, nothing can be checked."""
    if not (results / RECORD).is_file():
        raise ValueError(f"{results} is not a folder of results of a study: it has no {RECORD}")
    record = read_record(results)
    if not record["files"]:
        raise ValueError(f"{results / RECORD} names no files yet; run `snakemake`, which adds them")
    return record


def all_faults(results: Path) -> list[Fault]:
    """Return the faults of a results folder, and the files that it needs but does not have."""
    absent = [results / name for name in needed(results)["files"] if not (results / name).exists()]
    lost = [Fault(file, f"{file} is missing; `snakemake` makes it") for file in absent]
    return [*lost, *faults(results)]


def faults(results: Path) -> Iterator[Fault]:
    """Yield the files that are superfluous, damaged, or not those which the study needs."""
    record = needed(results)
    known = {*record["files"], *record["spare"]}
    there = {results / name for name in known if (results / name).exists()}
    for file in sorted({*there, *_files(results)}):
        name = file.relative_to(results)
        try:
            if name.as_posix() not in known:
                raise ValueError(
                    f"{file} is not part of the study; `snakemake repair` sets it aside"
                )
            _check(file, name, record)
        except (OSError, ValueError) as error:
            yield Fault(file, str(error))


def set_aside(results: Path) -> Iterator[Fault]:
    """Move files that cannot be used to the folder `set-aside`, with their relative paths."""
    for fault in list(faults(results)):
        place = results / "set-aside" / fault.file.relative_to(results)
        while place.exists():
            place = place.with_name(f"{place.name}.again")
        place.parent.mkdir(parents=True, exist_ok=True)
        fault.file.rename(place)
        yield fault


def _files(results: Path) -> Iterator[Path]:
    """Yield the files in the folders of a study, and those that were never finished."""
    for file in chain(results.glob(".*"), *((results / name).rglob("*") for name in _FOLDERS)):
        if not file.is_dir() and (_PARTIAL.fullmatch(file.name) or not file.name.startswith(".")):
            yield file


def _check(file: Path, name: Path, record: Mapping[str, Any]) -> None:
    """Raise ValueError, with the reason, for a file that cannot be used."""
    folder, last = name.parts[0], record["made"][-1]["configuration"]
    step = _FOLDERS.get(folder) or _TABLES.get(name.stem.split("_")[0], "")
    if file.suffix not in (".parquet", ".npz", ".nc", ".npy"):
        return
    place = name.parent if file.suffix == ".parquet" else name.with_suffix("")
    ensemble = record["ensembles"].get(place.relative_to(folder).as_posix(), {})
    wanted = configuration_digest(ensemble.get("identity", last))
    if folder == "surfaces":
        BlockMap.mask(file)
        return
    if folder == "preludes":
        prelude, wanted = Prelude.read(file), ensemble["prelude"]
        version = prelude.code_version
        found = configuration_digest({"conditions": prelude.conditions})
    elif folder == "fields":
        with import_xarray().open_dataset(file) as data:
            attributes = data.load().attrs
        version = str(attributes.get("source", ""))
        found = configuration_digest(json.loads(attributes.get("identity", "{}")))
    else:
        table = load(file)
        refuse_foreign(file, table)
        version = origin_of(table).get("code_version", "")
        found = origin_of(table).get("configuration_digest", wanted)
    if not same_code(version, code_version(step)):
        raise ValueError(f"{file} was made by different code, {version}; {MENDING}")
    if found != wanted:
        raise ValueError(f"{file} was made with another configuration; {MENDING}")
