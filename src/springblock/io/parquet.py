"""Writing and reading of tables as Parquet files; tables of different studies are not mixed."""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from springblock.files import MENDING, whole_file
from springblock.io.identity import refuse_misplaced
from springblock.io.rows import scene_of
from springblock.io.schemas import BATCH, SCENE
from springblock.provenance import study

_NONE = pa.schema([])


def write(table: pa.Table, path: Path, metadata: Mapping[str, str]) -> None:
    """Write a table of at least one row, with its `metadata`, whole or not at all."""
    if not table.num_rows:
        raise ValueError(f"{path}: the table has no rows; nothing was written")
    described = table.replace_schema_metadata(dict(metadata))
    # numbers of curves and fields rarely repeat, but their leading bytes do
    split = [
        f"{field.name}.list.element"
        for field in table.schema
        if pa.types.is_list(field.type) and pa.types.is_floating(field.type.value_type)
    ]
    plain = [field.name for field in table.schema if not pa.types.is_list(field.type)]
    how = {"compression": "zstd", "use_dictionary": plain, "use_byte_stream_split": split}
    with whole_file(path) as partial:
        pq.write_table(described, partial, write_page_checksum=True, **how)


def rows_to_table(rows: Sequence[Mapping[str, Any]], schema: pa.Schema) -> pa.Table:
    """Build a table with exactly the columns of `schema`; other entries of rows are ignored."""
    columns = []
    for field in schema:
        build = pa.array if field.nullable else _array
        columns.append(build([row[field.name] for row in rows], field.type))
    return pa.Table.from_arrays(columns, schema=schema)


def _array(values: Sequence[Any] | NDArray[Any], kind: pa.DataType) -> pa.Array:
    """Return `pa.array(values, kind)`, without importing pandas as that does."""
    if pa.types.is_list(kind):
        ends = np.cumsum([0, *map(len, values)])
        if ends[-1] > np.iinfo(np.int32).max:
            raise ValueError(f"a column holds no {ends[-1]} numbers; give fewer runs or samples")
        offsets = _array(ends, pa.int32())
        return pa.ListArray.from_arrays(
            offsets, _array(np.concatenate(values or [[]]), kind.value_type)
        )
    if pa.types.is_string(kind):
        text = [value.encode() for value in values]
        offsets = np.cumsum([0, *map(len, text)], dtype=np.int32)
        return pa.Array.from_buffers(
            kind, len(text), [None, *map(pa.py_buffer, (offsets, b"".join(text)))]
        )
    numbers = np.asarray(values, dtype=str(kind))  # "double", "int64", "int32" or "bool"
    packed = np.packbits(numbers, bitorder="little") if pa.types.is_boolean(kind) else numbers
    return pa.Array.from_buffers(kind, len(numbers), [None, pa.py_buffer(packed)])


def load(
    path: Path, columns: Sequence[str] | None = None, optional: Sequence[str] = ()
) -> pa.Table:
    """Read a file that `write` or pandas has written: all its columns, or those given.

    Of `optional`, those that the file has are added to the columns given.

    A file that is damaged, not a table, or lacks a column is a ValueError.
    """
    try:
        file = pq.ParquetFile(path, page_checksum_verification=True)
        present = file.schema_arrow.names
        missing = [name for name in columns or () if name not in present]
        if not missing:
            if columns is not None:
                columns = [*columns, *(name for name in optional if name in present)]
            # its threads may abort a process on exit
            return _with_nan(file.read(columns, use_threads=False))
    except (pa.ArrowException, OSError) as error:
        if isinstance(error, FileNotFoundError):
            raise
        raise ValueError(f"{path} is damaged, or not a table (Parquet); {MENDING}") from None
    raise ValueError(f"{path} lacks the column {missing[0]!r}; it holds {present}")


def _with_nan(table: pa.Table) -> pa.Table:
    """Return a table whose observables are NaN where pandas has written null instead."""
    for name in ({*BATCH.names} - {*SCENE.names}) & {*table.column_names}:
        place, values = table.column_names.index(name), table[name]
        if values.null_count and pa.types.is_floating(values.type):
            table = table.set_column(place, table.field(place), values.fill_null(math.nan))
    return table


def origin_of(table: pa.Table) -> dict[str, str]:
    """Return the metadata of a table as text, without those that pandas adds."""
    every = (table.schema.metadata or {}).items()
    return {key.decode(): value.decode() for key, value in every if key != b"pandas"}


def refuse_other_study(file: Path, table: pa.Table) -> None:
    """Refuse a table of another study than that which this job belongs to, if any."""
    held, wanted = origin_of(table).get("study"), study()
    if held and wanted and held != wanted:
        raise ValueError(f"{file} is of another configuration; {MENDING}")


def read(paths: Iterable[Path], schema: pa.Schema, optional: pa.Schema = _NONE) -> pa.Table:
    """Read the columns of `schema` from several files of one study, concatenated.

    Those of `optional` are read where a file has them, and null elsewhere. Files of different code,
    with the same realisation, or under the name of others, are a ValueError.
    """
    tables = [(path, load(path, schema.names, optional.names)) for path in paths]
    for path, table in tables:
        refuse_misplaced(path, table)
    refuse_mixed_code(tables)
    _refuse_repetition(tables)
    known = pa.schema([*schema, *optional])
    cast = [table.cast(pa.schema(map(known.field, table.column_names))) for _, table in tables]
    return pa.concat_tables(cast, promote_options="default")


def refuse_mixed_code(tables: Iterable[tuple[Path, pa.Table]]) -> None:
    """Refuse tables, given with their files, that were made by different code."""
    versions = ((origin_of(table).get("code_version"), path) for path, table in tables)
    # a table that was filtered with pandas has none
    known = {version.rpartition("+")[2]: path for version, path in versions if version}
    if len(known) > 1:
        (one, first), (other, second), *_ = known.items()
        raise ValueError(
            f"{first} and {second} were made by different code, {one} and {other}; "
            f"for the older one, {MENDING}"
        )


def _refuse_repetition(tables: Iterable[tuple[Path, pa.Table]]) -> None:
    keys = [*SCENE.names, "seed"]
    known: dict[str, Path] = {}
    for path, table in tables:
        if not set(keys) <= set(table.column_names):
            return
        for row in table.select(keys).to_pylist():
            key = repr(row)
            if key in known:
                what = f"seed {row['seed']} of {scene_of(row)}"
                raise ValueError(f"{known[key]} and {path} both hold {what}; {MENDING}")
            known[key] = path
