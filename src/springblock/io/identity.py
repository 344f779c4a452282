"""Identity of realisations: what, besides the seed and the code, determines them.

Each batch stores the identity of its runs, and the record of a study (`study.record`) that of the
runs which it needs. Wherever files are joined, these are compared.
"""

import json
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import pyarrow as pa

from springblock.files import MENDING
from springblock.io.schemas import ASKED, BATCH, SNAPSHOTS
from springblock.model.material import law_units
from springblock.model.scene import Scene
from springblock.provenance import configuration_digest, same_code
from springblock.simulation.setup import Setup

RECORD = "study.json"  #: file of a folder of results, see `study.record`


def identity(
    scene: Scene, setup: Setup, duration: float | None, snapshot_times: Sequence[float] = ()
) -> dict[str, Any]:
    """Return scene, constants and times of runs, by name, as JSON stores them.

    The columns `ASKED` are among them. Constants of a law from a file that have the name of a
    column are a ValueError.
    """
    taken = law_units(setup.constants).keys() & {*BATCH.names, *SNAPSHOTS.names, "runs", "from"}
    if taken:
        raise ValueError(f"{setup.material.law}: {min(taken)!r} is a column of tables; rename it")
    times = dict(zip(ASKED.names, (duration or 0.0, max(snapshot_times, default=0.0)), strict=True))
    return {**scene.row, **setup.constants, **times, "snapshot_times": list(snapshot_times)}


def metadata(identity: Mapping[str, Any], code_version: str) -> dict[str, str]:
    """Return the metadata of a batch: identity of its runs, and code."""
    return {
        "code_version": code_version,
        "configuration": json.dumps(identity, sort_keys=True),
        "configuration_digest": configuration_digest(identity),
    }


def results_of(file: Path) -> Path | None:
    """Return the folder of results, with the record of a study, that holds a file."""
    return next((each for each in file.absolute().parents if (each / RECORD).is_file()), None)


def read_record(results: Path) -> dict[str, Any]:
    """Return the record of a folder of results; a damaged one is a ValueError."""
    file = results / RECORD
    return _read(file, file.stat().st_mtime_ns)


@lru_cache(maxsize=4)
def _read(file: Path, changed: int) -> dict[str, Any]:
    """Read a record, once for each time at which it was changed; older ones name no files."""
    try:
        record: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        _ = record["identity"], record["made"][-1]["configuration"]["realisations_per_job"]
        _ = record["made"][-1]["code"]["simulate"], record.get("ensembles", {}).items()
    except (AttributeError, LookupError, TypeError, ValueError):
        raise ValueError(
            f"{file} is damaged; restore it from a copy, or choose another folder with the key "
            "results"
        ) from None
    return {"ensembles": {}, "files": [], "spare": [], **record}


def refuse_foreign(file: Path, table: pa.Table) -> None:
    """Refuse realisations in the place of those that the study of their folder needs.

    Files outside of a study, or of scenes that it does not have, are not compared.
    """
    results = results_of(file)
    if results is None or not file.absolute().is_relative_to(results / "realisations"):
        return
    record = read_record(results)
    place = file.absolute().relative_to(results / "realisations")
    needed = record["ensembles"].get(place.parent.as_posix())
    seeds = (needed or {"batches": {}})["batches"].get(place.stem.removeprefix("batch-"))
    if needed is None or seeds is None:
        return
    origin = {key.decode(): value.decode() for key, value in (table.schema.metadata or {}).items()}
    if not same_code(origin.get("code_version", ""), record["made"][-1]["code"]["simulate"]):
        made_by = origin.get("code_version", "")
        raise ValueError(f"{file} was made by different code, {made_by}; {MENDING}")
    found, wanted = json.loads(origin["configuration"]), needed["identity"]
    for name in {**wanted, **found}:
        if found.get(name) != wanted.get(name):
            raise ValueError(
                f"{name} is {found.get(name)!r} in {file}, but {wanted.get(name)!r} in the study; "
                f"{MENDING}"
            )
    if table["seed"].to_pylist() != list(range(seeds[0], seeds[1] + 1)):
        raise ValueError(f"{file} must hold the seeds {seeds[0]} to {seeds[1]}; {MENDING}")
