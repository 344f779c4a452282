"""Parts of the comparison become one table only if the same code has made them."""

import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner

from springblock.accuracy.work_precision import SCHEMA, rows_of
from springblock.cli import main
from springblock.io.parquet import rows_to_table, write


@pytest.fixture
def collect(tmp_path):
    """Collect parts of these versions; returns the outcome and the table."""

    def collected(*versions):
        parts, output = [], tmp_path / "table.parquet"
        for number, version in enumerate(versions):
            errors = [{"t_max": 3.0}, {"t_max": 4.0}]
            rows = rows_of("reference", "flat", "rk4", 1e-8, errors, cost=(1.0, 2.0))
            parts.append(tmp_path / f"{number}.parquet")
            write(rows_to_table(list(rows), SCHEMA), parts[-1], {"code_version": version})
        return CliRunner().invoke(main, ["collect", *map(str, parts), "--output", output]), output

    return collected


def test_a_table_of_parts_says_which_code_made_them(collect):
    outcome, output = collect("1+a", "1+a")
    assert outcome.exit_code == 0
    table = pq.read_table(output)
    assert table.schema.metadata[b"code_version"] == b"1+a"
    assert table["error"].to_pylist() == 2 * [pytest.approx(12.5**0.5)]


def test_parts_of_different_code_are_refused(collect):
    outcome, output = collect("1+a", "1+b")
    assert outcome.exit_code == 1
    assert "must be made by the same code; theirs is a and b" in outcome.output
    assert not output.exists()
