"""Identity of realisations: all that determines their numbers, besides the seed.

A digest of it ends the name of the folder of realisations, as in
realisations/pillars-6-6-x-3fa9c1e2/0-19.parquet, and stands in the file: what is computed with
other constants or other code is another file.
"""

import json
from pathlib import Path
from typing import Any

import pyarrow as pa

from springblock.files import MENDING
from springblock.io.schemas import BATCH, SNAPSHOTS
from springblock.model.law import LawFile
from springblock.model.scene import Scene
from springblock.provenance import SIMULATE, digest_of_data, made_by


def identity(scene: Scene) -> dict[str, Any]:
    """Return the columns of a scene, as JSON stores them.

    Constants of a law from a file that have the name of a column are a ValueError.
    """
    own = scene.law.constants if isinstance(scene.law, LawFile) else {}
    if taken := own.keys() & {*BATCH.names, *SNAPSHOTS.names, "runs", "from"}:
        raise ValueError(f"{scene.law}: {min(taken)!r} is a column of tables; rename it")
    return {"level": scene.level, **dict(scene.items())}


def name_of(scene: Scene, code: str) -> str:
    """Return the name of the folder of its realisations; a digest, of the code too, ends it."""
    return f"{scene.folder}-{_digest(scene, code)}"


def _digest(scene: Scene, code: str) -> str:
    return digest_of_data([identity(scene), code])[:8]


def metadata(scene: Scene) -> dict[str, str]:
    """Return the metadata of a batch: identity of its runs, code, and the digest of both."""
    origin = made_by(SIMULATE)
    code = origin["code_version"].rpartition("+")[2]
    own = {"configuration": json.dumps(identity(scene), sort_keys=True)}
    return origin | own | {"digest": _digest(scene, code)}


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
