"""What a results folder was made under: configurations and code, in one file of the folder.

Snakemake remembers how each file was made and makes it again where that changes. The record serves
where this memory, the folder `.snakemake`, is lost: only time stamps are left to Snakemake then,
and it would take results of another configuration for up to date.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from springblock.files import whole_file
from springblock.provenance import STEPS, digest

RECORD = "study.json"
#: A results folder and the memory that belongs to it share the name of a file in here.
MEMORY = Path(".snakemake", "springblock")


def refuse_unknown(results: Path, configuration: Mapping[str, Any]) -> None:
    """Refuse results that may be of another configuration or code, of which no memory is left.

    Writes nothing, so that a dry run may ask.

    Raises
    ------
    ValueError
        With one sentence.
    """
    record = read(results)
    if record is None:
        if any((results / part).exists() for part in ("preludes", "realisations")):
            raise ValueError(
                f"{results} holds results without {RECORD}, which says how they were made; remove "
                "them, or choose another folder: results"
            )
        return
    before = record["made"][-1]["configuration"]
    if before["realisations_per_job"] != configuration["realisations_per_job"]:
        raise ValueError(
            f"realisations_per_job: {results} was made with {before['realisations_per_job']}, and "
            "batches of another size would hold its seeds twice; keep it, or choose another folder"
        )
    if not (MEMORY / record["identity"]).exists():
        _refuse_other(results, record, configuration, "Snakemake's memory of it is lost")


def begin(results: Path, configuration: Mapping[str, Any], touched: bool) -> None:
    """Write down what a run makes results with, before its first job.

    Raises
    ------
    ValueError
        Where `snakemake --touch` would declare up to date what was made otherwise.
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
    with whole_file(results / RECORD) as partial:
        partial.write_text(json.dumps(record, indent=1), encoding="utf-8")


def read(results: Path) -> dict[str, Any] | None:
    """Return the record of a results folder, None where it has none.

    Raises
    ------
    ValueError
        Where the file is none.
    """
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
    """Raise ValueError unless all results were made under this configuration, by this code."""
    now = _now(configuration)
    for made in record["made"]:
        for part in ("configuration", "code"):
            differs = [key for key in now[part] if made[part].get(key) != now[part][key]]
            if differs or made[part].keys() != now[part].keys():
                raise ValueError(
                    f"{results} may hold results of another {part} ({', '.join(differs)}), and "
                    f"{reason}; remove {results}, or choose another folder: results"
                )


def _now(configuration: Mapping[str, Any]) -> dict[str, Any]:
    plain = json.loads(json.dumps(configuration))  # as it will be read back
    return {"configuration": plain, "code": {step: digest(step) for step in STEPS}}
