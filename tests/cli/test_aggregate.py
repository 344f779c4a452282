"""springblock aggregate."""

import pyarrow as pa
import pyarrow.parquet as pq

from springblock.io.parquet import write


def test_a_large_energy_residual_is_reported(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 0))
    where = table.schema.get_field_index("energy_error")
    write(table.set_column(where, "energy_error", pa.array([0.25])), tmp_path / "bad", {})
    words = (tmp_path / "bad", "--output", tmp_path / "a")
    said = springblock("aggregate", *words)
    assert said.startswith("warning: energy residual 2.5e-01 at n_blocks = 12, seed = 0")
