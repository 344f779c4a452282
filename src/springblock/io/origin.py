"""Where files of a study belong, and what they were made under: told by the files and the folder.

A study keeps, in `origin` of its results, a file for each scene and each step. Its name holds the
digests of code and conditions: where these change, the file is a new one, and what depends on it
is made again, whatever clocks and the workflow's memory say.
"""

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from springblock.files import MENDING, whole_file
from springblock.provenance import configuration_digest

#: Files whose folder names a scene, in the results folder of a study.
_OF_A_SCENE = re.compile(
    r"(?P<results>.*)/(?:realisations|preludes|correlations(?:/\w+)?)/"
    r"(?P<place>n_blocks-\d+/.*)"
)


def origin(results: str | Path, name: str, code: str, conditions: Mapping[str, Any]) -> Path:
    """File that stands for the code and the conditions of a scene or a step."""
    return Path(results, "origin", name, f"{configuration_digest(conditions)}-{code}.json")


def remember(file: Path, conditions: Mapping[str, Any]) -> None:
    """Write down conditions in the file that `origin` names, in place of what was there before."""
    for before in file.parent.glob("*.json"):
        before.unlink()
    with whole_file(file) as partial:
        partial.write_text(json.dumps(conditions, indent=1), encoding="utf-8")


def results_of(path: Path, place: str) -> Path | None:
    """Results folder that a file of a scene lies in; None where it lies in no study's.

    Raises
    ------
    ValueError
        Where it does not lie at the `place` that its content says.
    """
    found = _OF_A_SCENE.fullmatch(path.absolute().as_posix())
    if not found:
        return None
    if re.sub(r"more-\d+/", "", found["place"]) != place:
        raise ValueError(f"{path} holds what belongs in {place}; {MENDING}")
    return Path(found["results"])


def check_origin(path: Path, results: Path, scene: str, made_by: Mapping[str, str]) -> None:
    """Refuse a file of a scene that was made by other code, or under other conditions.

    `made_by` is the file's metadata: `code_version`, and `configuration` where it has one.

    Raises
    ------
    ValueError
        Naming what differs.
    """
    kept = next((results / "origin" / scene).glob("*.json"), None)
    if kept is None:
        return
    _, _, code = kept.stem.partition("-")
    if made_by.get("code_version", "").rpartition("+")[2] != code:
        raise ValueError(f"{path} was made by other code than its study is; {MENDING}")
    if "configuration" not in made_by:
        return
    try:
        ours = _flat(json.loads(kept.read_text(encoding="utf-8")))
    except ValueError:
        raise ValueError(f"{kept} is damaged; remove it, and its scene is made again") from None
    theirs = _flat(json.loads(made_by["configuration"]))
    other = [name for name in ours | theirs if ours.get(name) != theirs.get(name)]
    if other:
        raise ValueError(
            f"{other[0]} is {theirs.get(other[0])!r} in {path} and {ours.get(other[0])!r} in the "
            f"configuration; {MENDING}"
        )


def _flat(conditions: Mapping[str, Any]) -> dict[str, Any]:
    return {**conditions, **conditions.get("material", {}), "material": None}
