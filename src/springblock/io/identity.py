"""Identity of realisations: all that determines their numbers, besides the seed.

A digest of it ends the name of the folder of realisations, as in
realisations/pillars-6-6-x-3fa9c1e2/0-19.parquet, and stands in the file: what is computed with
other constants or other code is another file.
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa

from springblock.files import MENDING
from springblock.io.schemas import ASKED, BATCH, SNAPSHOTS
from springblock.model.material import law_units
from springblock.model.scene import Scene
from springblock.provenance import digest_of_data, made_by
from springblock.simulation.setup import Setup


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


def digest_with(identity: Mapping[str, Any], code: str) -> str:
    """Return the digest of an identity and of the code of its runs; 8 hexadecimal digits."""
    return digest_of_data([identity, code])[:8]


def metadata(identity: Mapping[str, Any]) -> dict[str, str]:
    """Return the metadata of a batch: identity of its runs, code, and the digest of both."""
    origin = made_by("simulate")
    code = origin["code_version"].rpartition("+")[2]
    own = {"configuration": json.dumps(identity, sort_keys=True)}
    return origin | own | {"digest": digest_with(identity, code)}


def refuse_misplaced(file: Path, table: pa.Table) -> None:
    """Refuse a batch of a study whose folder names another identity, or whose name other seeds."""
    folder, (first, _, last) = file.absolute().parent, file.stem.partition("-")
    if folder.parent.name != "realisations":
        return
    seeds = table["seed"].to_pylist()
    held = (table.schema.metadata or {}).get(b"digest", b"").decode(), str(seeds[0]), str(seeds[-1])
    if held != (folder.name.rpartition("-")[2], first, last):
        raise ValueError(
            f"{file} holds seeds {seeds[0]} to {seeds[-1]} of {held[0]}, not those of its name; "
            f"{MENDING}"
        )
