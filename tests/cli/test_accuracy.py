"""springblock accuracy."""

import pyarrow as pa
import pytest

from precision import precision_rows, production_rows
from springblock.io.parquet import write


@pytest.fixture
def page(springblock, batch, tmp_path):
    """Write the page with these options; returns its text."""

    def written(*options):
        stability = [{"family": "size", "expected": "agrees", "outcome": "agrees"}] * 3
        tables = {"precision": precision_rows(), "stability": stability}
        for name, rows in tables.items():
            write(pa.Table.from_pylist(rows), tmp_path / name, {})
        files = (*(tmp_path / name for name in tables), batch(0, 0))
        springblock("accuracy", *files, *options, "--output", tmp_path / "page.md")
        return (tmp_path / "page.md").read_text(encoding="utf-8")

    return written


def test_the_page_says_what_the_tables_hold(page):
    text = page()
    assert "3 of 3 cases came out as expected, in these families: size." in text
    assert "The largest energy residual of 1 realisations" in text
    assert "| static friction | 1.0e-01 | 1.0e-01 | 1.0e-01 |" in text


def test_without_errors_at_full_size_the_page_says_how_to_measure_them(page):
    assert "`snakemake production` measures errors" in page()
    assert "total error" not in page()


def test_with_errors_at_full_size_the_page_gives_each_value_both_errors(page, tmp_path):
    write(pa.Table.from_pylist(production_rows()), tmp_path / "production", {})
    text = page("--production", tmp_path / "production")
    assert "this page was written without" not in text
    # t(29) = 2.045 times 10/30^0.5; 1.4 times a bias of 2/16
    assert "| l_c |  | 80.0 ± 3.7 ± 0.2 (blocks) |  |" in text
    assert "| static friction | 80.0 ± 3.7 ± 0.2 | 80.0 ± 3.7 ± 0.2 | 80.0 ± 3.7 ± 0.2 |" in text
    assert "| +0.250 [+0.150, +0.350] (4.47) |" in text  # of a scale of 50; 20 % over 20 seeds
    # 20 seeds of half a second each, or twice as many at twice the step and four times the bias
    assert "| static friction | flat | 10.5 | 4.479 [4.475, 4.486] | 4e-08 x 40 |" in text
    assert "| step (s) | 5e-09 | 1e-08 | 2e-08 | 4e-08 | 8e-08 |\n" in text
    assert "of t_max and t_avg |" in text


def test_a_table_that_is_missing_is_named(springblock, tmp_path):
    files = [tmp_path / name for name in ("precision", "stability", "realisations")]
    refusal = springblock("accuracy", *files, "--output", tmp_path / "page.md", refused=True)
    assert f"'PRECISION': File '{files[0]}' does not exist" in refusal
