"""Record of the configurations and the code of a results folder, in one of its files.

Snakemake stores how each file was made in `.snakemake`, and makes it again after a change. Without
that folder it has only time stamps, and would accept results of another configuration; the record
prevents this.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from springblock.files import write_text
from springblock.provenance import STEPS, digest

RECORD = "study.json"
#: Folder with an empty file for each results folder that belongs to this `.snakemake`, by identity.
MEMORY = Path(".snakemake", "springblock")


def refuse_unknown(results: Path, configuration: Mapping[str, Any]) -> None:
    """Refuse results of unknown origin, which may be of another configuration or other code.

    Writes nothing, so that dry runs may call it.
    """
    record = read(results)
    if record is None:
        if any((results / part).exists() for part in ("preludes", "realisations")):
            raise ValueError(
                f"{results} holds results without {RECORD}, the record of their configuration; "
                "remove them, or choose another folder with the key results"
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
        _refuse_other(results, record, configuration, "Snakemake's metadata on them are missing")


def begin(results: Path, configuration: Mapping[str, Any], touched: bool) -> None:
    """Record configuration and code of a run before its first job.

    `snakemake --touch`, which marks any results as up to date, may not change either.
    """
    record = read(results)
    if touched and record is not None:
        _refuse_other(results, record, configuration, "--touch does not compare them")
    if record is None:
        record = {"identity": uuid4().hex, "made": []}
        MEMORY.mkdir(parents=True, exist_ok=True)
        (MEMORY / record["identity"]).touch()
    now = _now(configuration)
    if now in record["made"]:
        record["made"].remove(now)
    record["made"].append(now)
    write_text(results / RECORD, json.dumps(record, indent=1))


def read(results: Path) -> dict[str, Any] | None:
    """Return the record of a results folder, or None without one."""
    try:
        record: dict[str, Any] = json.loads((results / RECORD).read_text(encoding="utf-8"))
        _ = record["identity"], record["made"][-1]["configuration"]["realisations_per_job"]
    except FileNotFoundError:
        return None
    except (LookupError, TypeError, ValueError):
        raise ValueError(f"{results / RECORD} is damaged; remove {results}") from None
    return record


def _refuse_other(
    results: Path, record: Mapping[str, Any], configuration: Mapping[str, Any], reason: str
) -> None:
    """Raise ValueError unless all results are of this configuration and code."""
    now = _now(configuration)
    for made in record["made"]:
        for part in ("configuration", "code"):
            was, here = made[part], now[part]
            differs = [key for key in was | here if was.get(key, ...) != here.get(key, ...)]
            if differs:
                raise ValueError(
                    f"{results} may hold results of another {part} ({', '.join(differs)}), and "
                    f"{reason}; remove {results}, or choose another folder with the key results"
                )


def _now(configuration: Mapping[str, Any]) -> dict[str, Any]:
    plain = json.loads(json.dumps(configuration))  # as it will be read back
    return {"configuration": plain, "code": {step: digest(step) for step in STEPS}}
