"""Check of a results folder: damaged, misplaced and outdated files."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from springblock.files import MENDING
from springblock.io.fields import read_fields
from springblock.io.parquet import load, origin_of
from springblock.io.rows import Row
from springblock.model.blockmap import BlockMap
from springblock.model.material import Material, expanded
from springblock.model.scene import Scene
from springblock.provenance import code_version, same_code
from springblock.simulation.prelude import Prelude
from springblock.simulation.setup import Setup
from springblock.study.record import read

#: Files that are checked, by the step that makes them.
_MADE_BY = {
    "simulate": (
        "realisations/**/*.parquet",
        "preludes/**/*.npz",
        "fields/**/*.nc",
        "tables/realisations.parquet",
    ),
    "mask": ("surfaces/*.npy",),
    "analyse": ("correlations/**/*.parquet", "tables/correlation*.parquet"),
    "accuracy": (
        "accuracy/**/*.parquet",
        *(f"tables/{name}.parquet" for name in ("work_precision", "production", "stability")),
    ),
    "mechanism": ("mechanism/*.parquet", "tables/mechanism*.parquet"),
    "claims": ("tables/claims.parquet",),
}


class Fault(NamedTuple):
    """A file that cannot be used, with the reason."""

    file: Path
    reason: str


def faults(results: Path) -> Iterator[Fault]:
    """Yield the files that are damaged, misplaced, or made by different code."""
    constants = _constants(results)
    for step, patterns in _MADE_BY.items():
        for file in sorted(file for pattern in patterns for file in results.glob(pattern)):
            try:
                _check(file, results, step, constants)
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


def _constants(results: Path) -> dict[str, Any]:
    """Return the constants of the study from its record; none without a record."""
    record = read(results)
    if record is None:
        return {}
    last = record["made"][-1]["configuration"]
    times = {key: last[key] for key in ("integrator", "step", "sample_interval")}
    return Setup(Material().vary(last["material"]), **times).constants


def _check(file: Path, results: Path, step: str, constants: dict[str, Any]) -> None:
    """Raise ValueError, with the reason, for a file that cannot be used."""
    if step == "mask":
        BlockMap.mask(file)
        return
    if file.suffix == ".npz":
        version = Prelude.read(file).code_version
    elif file.suffix == ".nc":
        version = str(read_fields(file)[1].get("source", ""))
    else:
        table = load(file)
        version = origin_of(table).get("code_version", "")
        if file.is_relative_to(results / "realisations"):
            _check_batch(file, results, table.slice(0, 1).to_pylist()[0], constants)
    if not same_code(version, code_version(step)):
        raise ValueError(f"{file} was made by different code, {version}; {MENDING}")


def _check_batch(file: Path, results: Path, row: Row, constants: dict[str, Any]) -> None:
    """Refuse realisations of a scene or a study other than that of their folder."""
    scene = Scene.from_row(row)
    if file.parent != results / "realisations" / scene.folder:
        raise ValueError(f"{file} is misplaced, since it holds {scene}; {MENDING}")
    found, varied = expanded(row), dict(scene.varied)
    expected = (constants if "law" in varied else expanded(constants)) | varied
    for name, value in expected.items():
        if found[name] != (str(value) if name == "law" else value):
            raise ValueError(
                f"{name} is {found[name]!r} in {file}, but {value!r} in the study; {MENDING}"
            )
