"""Record of what a results folder holds: its configurations, their code, and all files.

Snakemake stores how each file was made in `.snakemake`, and makes it again after a change. Without
that folder it has only time stamps, and would accept results of another configuration; the record
prevents this. With it, each file is checked against what the last configuration needs.
"""

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from springblock.files import write_text
from springblock.io.identity import RECORD, identity, read_record
from springblock.model.direction import heading
from springblock.provenance import STEPS, configuration_digest, digest
from springblock.simulation.setup import Setup
from springblock.study.configuration import Planned

#: Folder with an empty file for each results folder that belongs to this `.snakemake`, by identity.
MEMORY = Path(".snakemake", "springblock")


def refuse_unknown(results: Path, configuration: Mapping[str, Any], unseen: str = "") -> None:
    """Refuse results of unknown origin, which may be of another configuration or other code.

    `unseen` is the reason why Snakemake does not see such changes, if it does not. Writes nothing,
    so that dry runs may call it.
    """
    record = read_record(results) if (results / RECORD).exists() else None
    if record is None:
        if any((results / part).exists() for part in ("preludes", "realisations")):
            raise ValueError(
                f"{results} holds results without {RECORD}, the record of their configuration; "
                "restore it from a copy, or choose another folder with the key results"
            )
        return
    before = record["made"][-1]["configuration"]
    if before["realisations_per_job"] != configuration["realisations_per_job"]:
        raise ValueError(
            f"realisations_per_job must remain {before['realisations_per_job']}, with which "
            f"{results} was made, since other batches would repeat its seeds; keep it, or choose "
            "another folder with the key results"
        )
    if not (MEMORY / record["identity"]).exists():
        unseen = "Snakemake's metadata on them are missing"
    now = _now(configuration)
    for made in record["made"] if unseen else []:
        for part in ("configuration", "code"):
            was, here = made[part], now[part]
            differs = [key for key in was | here if was.get(key, ...) != here.get(key, ...)]
            if differs:
                raise ValueError(
                    f"{results} may hold results of another {part} ({', '.join(differs)}), and "
                    f"{unseen}; choose another folder with the key results"
                )


def begin(
    results: Path,
    configuration: Mapping[str, Any],
    contents: Mapping[str, Any],
    remembers: bool = True,
) -> None:
    """Record configuration, code and contents of a study before the first job of a run.

    `contents` has `ensembles`, by folder, as `_needed` describes them; `files`, which the study has
    when it is finished; and `spare`, files that it may also have.
    `remembers` says whether Snakemake stores metadata on what it makes.
    """
    record = read_record(results) if (results / RECORD).exists() else None
    if record is None:
        record = {"identity": uuid4().hex, "made": []}
        MEMORY.mkdir(parents=True, exist_ok=True)
        (MEMORY / record["identity"]).touch()
    if not remembers:
        (MEMORY / record["identity"]).unlink(missing_ok=True)
    now = _now(configuration)
    made = [each for each in record["made"] if each != now]
    write_text(results / RECORD, json.dumps({**record, "made": [*made, now], **contents}, indent=1))


def contents(
    configuration: Mapping[str, Any],
    ensembles: Mapping[str, Planned],
    setups: Mapping[str, Setup],
    files: Iterable[str],
    spare: Iterable[str],
) -> dict[str, Any]:
    """Return `contents` of `begin`, from ensembles and setups by folder, and paths of files."""
    size, results = configuration["realisations_per_job"], configuration["results"]
    needed, other = ({os.path.relpath(file, results) for file in some} for some in (files, spare))
    return {
        "ensembles": {name: _needed(each, setups[name], size) for name, each in ensembles.items()},
        "files": sorted(needed),
        "spare": sorted(other - needed),
    }


def _needed(ensemble: Planned, setup: Setup, size: int) -> dict[str, Any]:
    """Return the identity of runs, the digest of their prelude, and the seeds of each batch."""
    from springblock.simulation.prelude import conditions  # loads numba

    scene, times = ensemble.scene, ensemble.snapshot_times
    loading = conditions(scene.contact, setup, heading(scene.direction), scene.is_periodic)
    return {
        "identity": identity(scene, setup, ensemble.duration, times),
        "prelude": configuration_digest({"conditions": loading}),
        "batches": {i: [seeds[0], seeds[-1]] for i, seeds in ensemble.batches(size).items()},
    }


def _now(configuration: Mapping[str, Any]) -> dict[str, Any]:
    plain = json.loads(json.dumps(configuration))  # as it will be read back
    return {"configuration": plain, "code": {step: digest(step) for step in STEPS}}
