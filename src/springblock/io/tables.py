"""Parquet files: their columns, what they mean, and reading them back."""

import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from springblock.files import BLANK, MENDING, read_sealed, seal, write_sealed
from springblock.io.origin import check_origin, results_of
from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.simulation.run import Visible


def column(name: str, kind: pa.DataType, unit: str, meaning: str) -> pa.Field:
    """Return a column that carries its unit and meaning in its metadata."""
    return pa.field(name, kind, nullable=False, metadata={"unit": unit, "meaning": meaning})


#: What tells one scene from another, as `Scene` names it.
SCENE = pa.schema(
    [
        column("level", pa.int8(), "1", "levels of the pattern; 0 if flat, -1 with a mask instead"),
        column("n_p", pa.int32(), "blocks", "side of a pillar; 0 without pillars"),
        column("n_s", pa.int32(), "blocks", "distance between pillars; 0 without pillars"),
        column("n_p2", pa.int32(), "blocks", "width of a pawl; 0 without grooves"),
        column("n_s2", pa.int32(), "blocks", "width of a groove along x; 0 without grooves"),
        column("n_p3", pa.int32(), "blocks", "size of what cuts leave of a pawl; 0 without"),
        column("n_s3", pa.int32(), "blocks", "width of a groove between these; 0 without"),
        column("along_3", pa.string(), "x or y", "axis that these grooves run along; '' without"),
        column("varied", pa.string(), "name=value", "constants other than the study's own"),
        column("direction", pa.string(), "x, y or degrees", "sliding direction"),
        column("n_blocks", pa.int32(), "blocks", "side N of the surface, along x"),
        column("n_rows", pa.int32(), "blocks", "side along y, the same on a square surface"),
        column("edges", pa.string(), "free or periodic", "edges of the surface, both ways"),
        column("mask", pa.string(), "name", "file and digest of the contact mask; '' without"),
        column("mu_static_field", pa.string(), "name", "the same of mu_static; '' where drawn"),
        column("mu_dynamic_field", pa.string(), "name", "the same of mu_dynamic; '' where drawn"),
    ]
)

#: How a realisation was computed: `Setup.constants`.
SETUP = pa.schema(
    [
        column("youngs_modulus", pa.float64(), "Pa", "E"),
        column("density", pa.float64(), "kg/m³", "rho"),
        column("pressure", pa.float64(), "Pa", "P, over the whole nominal area"),
        column("slider_velocity", pa.float64(), "m/s", "v"),
        column("spacing", pa.float64(), "m", "l, distance between blocks"),
        column("thickness", pa.float64(), "m", "l_z, of the layer"),
        column("gamma", pa.float64(), "1/s", "damping frequency"),
        column("mu_static", pa.float64(), "1", "mean of the static coefficients"),
        column("mu_static_std", pa.float64(), "1", "their standard deviation"),
        column("mu_dynamic", pa.float64(), "1", "mean of the dynamic coefficients"),
        column("mu_dynamic_std", pa.float64(), "1", "their standard deviation"),
        column("distribution", pa.string(), "1", "of both coefficients, where they are drawn"),
        column("correlation_length", pa.float64(), "m", "of both: exp(-r²/ℓ²) of their normals"),
        column("law", pa.string(), "1", "of friction: coulomb, slip_ or velocity_weakening"),
        column("slip_distance", pa.float64(), "m", "d_c of slip weakening; 0 with other laws"),
        column("speed_scale", pa.float64(), "m/s", "v_c of velocity weakening; 0 with others"),
        column("integrator", pa.string(), "1", "leapfrog or rk4"),
        column("step", pa.float64(), "s", "integration step h"),
        column("sample_interval", pa.float64(), "s", "time between two samples"),
    ]
)

#: What results may be drawn over: numbers that tell scenes apart, and the direction.
AXES = [field.name for field in (*SCENE, *SETUP) if not pa.types.is_string(field.type)]
AXES = [name for name in AXES if name != "level"] + ["direction"]

#: One row per realisation; t_* and *_friction in the paper's names.
SUMMARY = pa.schema(
    [
        *SCENE,
        *SETUP,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        column("static_friction", pa.float64(), "1", "maximum of the force over P l² N²"),
        column(
            "dynamic_friction",
            pa.float64(),
            "1",
            "mean force over P l² N² from the first minimum after the peak to the end of the run; "
            "settled only where the scene has a duration well past t_max; NaN without a minimum",
        ),
        column("t_max", pa.float64(), "s", "time of the force maximum"),
        column("t_avg", pa.float64(), "s", "mean first detachment time of the contact blocks"),
        column("t_first", pa.float64(), "s", "time of the first detachment of all"),
        column("energy_error", pa.float64(), "1", "residual of the energy balance over the work"),
        column("steps", pa.int64(), "1", "integration steps"),
    ]
)

_CONSTANTS = [name for name, _ in Material().items()]

_SIDE = [
    *SCENE,
    *SETUP,
    column(
        "side",
        pa.string(),
        "x, y or grooves",
        "axis along which the sides of the pillars run, or edges along the grooves within them",
    ),
    column("realisations", pa.int32(), "1", "realisations k that are averaged over"),
]

#: One row per scene, side and distance.
CORRELATION = pa.schema(
    [
        *_SIDE,
        column("r", pa.int32(), "blocks", "distance along the side from its middle"),
        column("correlation", pa.float64(), "1", "c(r) of first detachment times, c(0) = 1"),
        column("ci_low", pa.float64(), "1", "lower limit of its 95 % interval"),
        column("ci_high", pa.float64(), "1", "upper limit"),
        column("bias", pa.float64(), "1", "jackknife estimate of its bias; not subtracted"),
        column("residual", pa.float64(), "1", "c(r) - A exp(-r/l_c); NaN beyond the fit"),
        column("residual_low", pa.float64(), "1", "lower limit of its 95 % interval"),
        column("residual_high", pa.float64(), "1", "upper limit"),
        column("samples", pa.int32(), "1", "sides averaged over: realisations × pillars × 2"),
    ]
)

#: One row per scene and side; lengths of 0.1 stand for no correlation.
CORRELATION_LENGTH = pa.schema(
    [
        *_SIDE,
        column("l_c", pa.float64(), "blocks", "weighted least-squares fit of exp(-r/l_c)"),
        column("ci_low", pa.float64(), "blocks", "lower limit of its 95 % interval"),
        column("ci_high", pa.float64(), "blocks", "upper limit"),
        column("bias", pa.float64(), "blocks", "jackknife estimate of its bias; not subtracted"),
        column(
            "r_last",
            pa.int32(),
            "blocks",
            "end of the fits, which begin at r = 1: 6 for all sides, n_p/3 on shorter ones",
        ),
        column("deviation", pa.float64(), "standard errors", "largest |c(r) - exp(-r/l_c)|"),
        column("integral", pa.float64(), "blocks", "length with the same sum of exp(-r/l) as c(r)"),
        column("integral_low", pa.float64(), "blocks", "lower limit of its 95 % interval"),
        column("integral_high", pa.float64(), "blocks", "upper limit"),
        column("tail", pa.float64(), "blocks", "l_c in A exp(-r/l_c); NaN if r_last < 3"),
        column("tail_low", pa.float64(), "blocks", "lower limit of its 95 % interval"),
        column("tail_high", pa.float64(), "blocks", "upper limit"),
        column("amplitude", pa.float64(), "1", "A of that fit"),
        column("amplitude_low", pa.float64(), "1", "lower limit of its 95 % interval"),
        column("amplitude_high", pa.float64(), "1", "upper limit"),
        column(
            "design_effect",
            pa.float64(),
            "1",
            "variance of c(r) over that if the pillars of a realisation were independent",
        ),
    ]
)

#: A batch of realisations also holds what the figures draw.
BATCH = pa.schema(
    [
        *SUMMARY,
        column("force", pa.list_(pa.float64()), "N", "|ΣF_s|, one per sample from t = 0"),
        column(
            "detachments",
            pa.list_(pa.int32()),
            "blocks",
            "blocks that detached for the first time since the sample before",
        ),
        column(
            "switches",
            pa.list_(pa.int32()),
            "blocks",
            "switches from rest to sliding since the sample before",
        ),
        column(
            "t_det",
            pa.list_(pa.float64()),
            "s",
            "first detachment time of each block, row by row from y = 0; NaN where none",
        ),
        column("normal_force", pa.float64(), "N", "P l² N²"),
        column(
            "contact",
            pa.list_(pa.bool_()),
            "1",
            "whether each block is in contact, row by row from y = 0",
        ),
    ]
)

#: What a batch holds beside that where snapshots were asked for.
SNAPSHOTS = pa.schema(
    [
        column("snapshot_times", pa.list_(pa.float64()), "s", "when displacements were kept"),
        column(
            "snapshots",
            pa.list_(pa.float64()),
            "m",
            "displacements at these times, one after another: along x row by row from y = 0, then "
            "along y",
        ),
    ]
)


def write(
    table: pa.Table, path: Path, metadata: Mapping[str, str], inputs: Iterable[Path] = ()
) -> None:
    """Write a table whole or not at all; `metadata` adds to what its columns say of themselves.

    Of `inputs`, the files that it was computed from, it keeps the places and the checksums.

    Raises
    ------
    ValueError
        Where the table has no row.
    """
    if not table.num_rows:
        raise ValueError(f"there is nothing to write to {path}")
    own = {"checksum": BLANK.decode()}
    if inputs:
        own["inputs"] = json.dumps(
            {os.path.relpath(file, path.parent): seal(file) for file in inputs}
        )
    described = table.replace_schema_metadata({**metadata, **own})
    # curves and fields: their numbers hardly repeat, but their leading bytes do
    split = [
        f"{field.name}.list.element"
        for field in table.schema
        if pa.types.is_list(field.type) and pa.types.is_floating(field.type.value_type)
    ]
    content = pa.BufferOutputStream()
    pq.write_table(
        described,
        content,
        compression="zstd",
        use_dictionary=not split,
        use_byte_stream_split=split,
    )
    write_sealed(path, memoryview(content.getvalue()))


def rows_to_table(rows: Sequence[Mapping[str, Any]], schema: pa.Schema) -> pa.Table:
    """Build a table of exactly the columns of `schema`; whatever else rows hold is left out."""
    columns = [_array([row[field.name] for row in rows], field.type) for field in schema]
    return pa.Table.from_arrays(columns, schema=schema)


def _array(values: Sequence[Any] | NDArray[Any], kind: pa.DataType) -> pa.Array:
    """`pa.array` without pandas, which that loads to see whether it is given a Series."""
    if pa.types.is_list(kind):
        offsets = _array(np.cumsum([0, *map(len, values)]), pa.int32())
        return pa.ListArray.from_arrays(
            offsets, _array(np.concatenate(values or [[]]), kind.value_type)
        )
    if pa.types.is_string(kind):
        text = [value.encode() for value in values]
        offsets = np.cumsum([0, *map(len, text)], dtype=np.int32)
        return pa.Array.from_buffers(
            kind, len(text), [None, *map(pa.py_buffer, (offsets, b"".join(text)))]
        )
    numbers = np.asarray(values, dtype=kind.to_pandas_dtype())
    packed = np.packbits(numbers, bitorder="little") if pa.types.is_boolean(kind) else numbers
    return pa.Array.from_buffers(kind, len(numbers), [None, pa.py_buffer(packed)])


def load(path: Path, columns: Sequence[str] | None = None) -> pa.Table:
    """Read one file that `write` wrote; all its columns, or these.

    Raises
    ------
    ValueError
        With one sentence, where it is not as it was written, lacks a column, or is not the file of
        its scene, its seeds, its study's configuration and code that its place says.
    """
    content = read_sealed(path)
    try:
        file = pq.ParquetFile(pa.BufferReader(content))
    except pa.ArrowInvalid:
        raise ValueError(f"{path} is no table (Parquet); {MENDING}") from None
    present = file.schema_arrow.names
    missing = [name for name in columns or () if name not in present]
    if missing:
        raise ValueError(f"{path} lacks the column {missing[0]!r}; it holds {present}")
    table = file.read(columns)
    _check_place(path, table)
    return table


def origin_of(table: pa.Table) -> dict[str, str]:
    """What made a table: its metadata as text."""
    return {key.decode(): value.decode() for key, value in (table.schema.metadata or {}).items()}


def _check_place(path: Path, table: pa.Table) -> None:
    """Refuse a file of a scene that lies where another belongs."""
    if not set(SCENE.names) <= set(table.column_names):
        return
    first, last = re.fullmatch(r"seeds-(\d+)-(\d+)|.*", path.stem).groups()  # type: ignore[union-attr]
    for row in table.group_by(SCENE.names).aggregate([]).to_pylist():
        scene = Scene.from_row(row).folder
        results = results_of(path, f"{scene}/{path.name}")
        if results is None:
            return
        if first is not None:
            check_origin(path, results, scene, origin_of(table))
    if first is not None and table["seed"].to_pylist() != [*range(int(first), int(last) + 1)]:
        raise ValueError(f"{path} does not hold the seeds {first} to {last}; {MENDING}")


def read(paths: Iterable[Path], schema: pa.Schema) -> pa.Table:
    """Read the columns of `schema` from several files of one study, one after another.

    Raises
    ------
    ValueError
        As `load` does; or where two were computed differently, or by different code.
    """
    paths = list(paths)
    tables = [load(path, schema.names) for path in paths]
    refuse_mixture(zip(paths, tables, strict=True))
    _refuse_mixed_code(zip(paths, tables, strict=True))
    return pa.concat_tables([table.cast(schema) for table in tables])


def _refuse_mixed_code(tables: Iterable[tuple[Path, pa.Table]]) -> None:
    known: dict[str, Path] = {}
    for path, table in tables:
        version = origin_of(table).get("code_version", "")
        known.setdefault(version.rpartition("+")[2], path)
    if len(known) > 1:
        (one, first), (other, second), *_ = known.items()
        raise ValueError(
            f"{first} and {second} must be made by the same code; theirs is {one} and {other}; "
            f"of the older one, {MENDING}"
        )


def refuse_mixture(tables: Iterable[tuple[Path, pa.Table]]) -> None:
    """Refuse tables that were computed with different constants, given with the file of each.

    Constants that a scene has of its own are part of the scene, and may differ.

    Raises
    ------
    ValueError
        With the name of the constant, both values and both files.
    """
    known: dict[str, tuple[Any, Path]] = {}
    for path, table in tables:
        for row in _constants(table):
            own = {pair.partition("=")[0] for pair in row.pop("varied").split(", ")}
            for name in [name for name in row if name not in own]:
                value, (before, first) = row[name], known.setdefault(name, (row[name], path))
                if value != before:
                    raise ValueError(
                        f"{name} is {before!r} in {first} and {value!r} in {path}: runs of "
                        "different studies do not belong together"
                    )


def _constants(table: pa.Table) -> list[dict[str, Any]]:
    """Each combination of constants in a table of scenes, and which are a scene's own."""
    names = ["varied", *SETUP.names]
    if not set(names) <= set(table.column_names):
        return []
    return table.group_by(names).aggregate([]).to_pylist()


@dataclass(frozen=True, eq=False, repr=False)
class Record(Visible):
    """One realisation as it was stored: its scene, its seed and the fields of `Realisation`."""

    scene: Scene
    seed: int
    time: NDArray[np.float64]
    force: NDArray[np.float64]
    normal_force: float
    detachments: NDArray[np.int32]
    switches: NDArray[np.int32]
    t_det: NDArray[np.float64]
    t_max: float
    t_avg: float
    static_friction: float
    constants: Mapping[str, Any] = field(default_factory=lambda: dict(Material().items()))
    snapshot_times: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    snapshots: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2, 0, 0)))

    @property
    def material(self) -> Material:
        """The layer that was pulled."""
        return Material(**{name: self.constants[name] for name in _CONSTANTS})

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Blocks in contact with the substrate, (N, N), [y, x]."""
        return self.scene.contact

    @property
    def name(self) -> str:
        """Its scene and its seed."""
        return f"{self.scene}, seed = {self.seed}"


def _scene(row: pa.Table) -> Scene:
    """Return the scene of a row of a batch, with its mask if it has one of its own."""
    scene = Scene.from_row(row.select(SCENE.names).to_pylist()[0])
    if scene.mask is None:
        return scene
    contact = row["contact"][0].values.to_numpy(zero_copy_only=False).reshape(scene.shape)
    return replace(scene, mask=replace(scene.mask, values=contact))


def read_records(paths: Iterable[Path]) -> list[Record]:
    """Read stored realisations in order of their seeds."""
    table = read(paths, BATCH)
    records = []
    for i in range(table.num_rows):
        row = table.slice(i, 1)
        scene = _scene(row)
        force = row["force"][0].values.to_numpy()
        records.append(
            Record(
                scene=scene,
                seed=row["seed"][0].as_py(),
                time=np.arange(len(force)) * row["sample_interval"][0].as_py(),
                force=force,
                normal_force=row["normal_force"][0].as_py(),
                detachments=row["detachments"][0].values.to_numpy(),
                switches=row["switches"][0].values.to_numpy(),
                t_det=row["t_det"][0].values.to_numpy(zero_copy_only=False).reshape(scene.shape),
                t_max=row["t_max"][0].as_py(),
                t_avg=row["t_avg"][0].as_py(),
                static_friction=row["static_friction"][0].as_py(),
                constants=row.select(SETUP.names).to_pylist()[0],
            )
        )
    return sorted(records, key=lambda record: record.seed)
