"""springblock accuracy."""

import pyarrow as pa
import pyarrow.parquet as pq

from precision import precision_rows


def test_the_page_says_what_the_tables_hold(springblock, batch, tmp_path):
    stability = [{"family": "size", "expected": "agrees", "outcome": "agrees"}] * 3
    tables = {"precision": precision_rows(), "stability": stability}
    for name, rows in tables.items():
        pq.write_table(pa.Table.from_pylist(rows), tmp_path / name)
    files = (*(tmp_path / name for name in tables), batch(0, 0))
    springblock("accuracy", *files, "--output", tmp_path / "page.md")
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert "3 of 3 cases came out as expected, in these families: size." in text
    assert "The largest energy residual of 1 realisations" in text
    assert "| static friction | 1.0e-01 | 1.0e-01 | 1.0e-01 |" in text


def test_a_table_that_is_missing_is_named(springblock, tmp_path):
    files = [tmp_path / name for name in ("precision", "stability", "realisations")]
    refusal = springblock("accuracy", *files, "--output", tmp_path / "page.md", refused=True)
    assert f"'PRECISION': File '{files[0]}' does not exist" in refusal
