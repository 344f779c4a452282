"""Tables of a study as the page shows them."""

from typing import Any, NamedTuple

import pyarrow as pa


class Column(NamedTuple):
    """A column of a table."""

    name: str
    unit: str  #: empty for numbers of no unit and for words
    meaning: str
    is_number: bool


class Table(NamedTuple):
    """A table: what is the same in all its rows, and the rows without that."""

    name: str
    same: list[str]  #: as name = value unit
    columns: list[Column]
    rows: list[list[str]]


def shown(name: str, table: pa.Table) -> Table:
    """Lay out a table; numbers have six digits."""
    columns = {field.name: _column(field) for field in table.schema}
    values = {name: [_text(value) for value in table[name].to_pylist()] for name in columns}
    same = {name: texts[0] for name, texts in values.items() if len(set(texts)) == 1}
    if table.num_rows == 1:
        same = {}
    told = [f"{name} = {text} {columns[name].unit}".strip() for name, text in same.items() if text]
    kept = [name for name in columns if name not in same]
    rows = [list(row) for row in zip(*(values[name] for name in kept), strict=True)]
    return Table(name, told, [columns[name] for name in kept], rows)


def _column(field: pa.Field) -> Column:
    says = {key.decode(): value.decode() for key, value in (field.metadata or {}).items()}
    number = pa.types.is_floating(field.type) or pa.types.is_integer(field.type)
    unit = says.get("unit", "1")
    unit = unit if number and unit != "1" else ""
    return Column(
        field.name, unit if number and unit != "1" else "", says.get("meaning", ""), number
    )


def _text(value: Any) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return "" if value is None else str(value)
