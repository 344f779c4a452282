"""springblock aggregate."""

import pyarrow as pa
import pyarrow.parquet as pq

from springblock.analysis.comparison import differences
from springblock.io.parquet import write


def test_a_large_energy_residual_is_reported(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 0))
    where = table.schema.get_field_index("energy_error")
    write(table.set_column(where, "energy_error", pa.array([0.25])), tmp_path / "bad", {})
    words = (tmp_path / "bad", "--output", tmp_path / "a")
    said = springblock("aggregate", *words)
    assert said.startswith("warning: energy residual 2.5e-01 at n_blocks = 12, seed = 0")


def test_batches_and_order_change_no_bit_of_a_table(springblock, batch, tmp_path):
    """One batch of three runs, or three of one in the other order."""
    scene, tables = ("--n-p", 6, "--n-s", 6), []
    for seeds in ([(0, 2)], [(2, 2), (1, 1), (0, 0)]):
        files = [batch(*each, *scene) for each in seeds]
        outputs = [tmp_path / name for name in ("table", "correlation", "length")]
        springblock("aggregate", *files, "--output", outputs[0])
        given = ("--output-correlation", outputs[1], "--output-length", outputs[2])
        springblock("correlation", *files, *given)
        tables.append([pq.read_table(output) for output in outputs])
    assert not any(differences(one, two) for one, two in zip(*tables, strict=True))
