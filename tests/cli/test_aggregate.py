"""springblock aggregate."""

import pyarrow as pa
import pyarrow.parquet as pq

from springblock.io.parquet import write
from springblock.io.schemas import SUMMARY

CONFIGURATION = ("--configuration", "0123")


def test_one_table_holds_every_realisation_in_order(springblock, batch, pillars, tmp_path):
    output = tmp_path / "a.parquet"
    flat = batch(0, 0)
    springblock("aggregate", *reversed(pillars), flat, *CONFIGURATION, "--output", output)
    table = pq.read_table(output)
    assert table.schema.names == SUMMARY.names
    assert table.schema.metadata[b"configuration_digest"] == b"0123"
    found = [(row["level"], row["seed"]) for row in table.to_pylist()]
    assert found == [(0, 0), (1, 0), (1, 1), (1, 2)]


def test_a_realisation_given_twice_is_refused(springblock, batch, tmp_path):
    words = (batch(0, 0), batch(0, 0), *CONFIGURATION, "--output", tmp_path / "a")
    assert "both hold seed 0 of n_blocks = 12" in springblock("aggregate", *words, refused=True)
    assert list(tmp_path.iterdir()) == []


def test_a_large_energy_residual_is_reported(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 0))
    where = table.schema.get_field_index("energy_error")
    write(table.set_column(where, "energy_error", pa.array([0.25])), tmp_path / "bad", {})
    output = ("--output", tmp_path / "a")
    said = springblock("aggregate", tmp_path / "bad", *CONFIGURATION, *output)
    assert said.startswith("warning: energy residual 2.5e-01 at n_blocks = 12, level = 0")
