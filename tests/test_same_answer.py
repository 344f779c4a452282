"""The same tables whatever batches and order."""

import pyarrow.parquet as pq

from springblock.analysis.comparison import differences


def test_batches_and_order_change_no_bit_of_a_table(springblock, tmp_path):
    """One batch of three runs, or three of one in the other order."""

    def simulated(first, last):
        file = tmp_path / f"{first}-{last}.parquet"
        words = ("--n-blocks", 12, "--n-p", 6, "--n-s", 6, "--first-seed", first)
        springblock("simulate", *words, "--last-seed", last, "--output", file)
        return file

    tables = []
    for files in ([simulated(0, 2)], [simulated(seed, seed) for seed in (2, 1, 0)]):
        outputs = [tmp_path / name for name in ("table", "correlation", "length")]
        springblock("aggregate", *files, "--output", outputs[0])
        given = ("--output-correlation", outputs[1], "--output-length", outputs[2])
        springblock("correlation", *files, *given)
        tables.append([pq.read_table(output) for output in outputs])
    assert not any(differences(one, two) for one, two in zip(*tables, strict=True))
