"""The same tables whatever cores, batches and order."""

import pyarrow.parquet as pq
import pytest

from faults.studies import copy
from springblock.analysis.comparison import compare

SEEDS = 3


@pytest.fixture(scope="module")
def batches(springblock, tmp_path_factory):
    """The same realisations in one batch of three, and in three of one."""
    folder, scene = tmp_path_factory.mktemp("batches"), ("--n-blocks", 12, "--n-p", 6, "--n-s", 6)

    def simulated(first, last, *more):
        file = folder / f"{first}-{last}{'-'.join(map(str, more))}.parquet"
        seeds = ("--first-seed", first, "--last-seed", last)
        assert springblock("simulate", *scene, *seeds, *more, "--output", file)[0] == 0
        return file

    whole = [simulated(0, SEEDS - 1)]
    single = [simulated(seed, seed, "--cores", 2) for seed in range(SEEDS)]
    return whole, single, single[::-1]


@pytest.mark.parametrize("other", [1, 2], ids=["one by one", "in the other order"])
def test_batches_order_and_cores_change_no_bit_of_a_table(springblock, batches, tmp_path, other):
    tables = {}
    for name, files in (("a", batches[0]), ("b", batches[other])):
        outputs = [tmp_path / f"{name}{i}" for i in range(3)]
        springblock("aggregate", *files, "--configuration", "0", "--output", outputs[0])
        given = ("--output-correlation", outputs[1], "--output-length", outputs[2])
        springblock("correlation", *files, *given)
        tables[name] = [pq.read_table(output) for output in outputs]
    assert all(compare(one, two).same for one, two in zip(tables["a"], tables["b"], strict=True))


def test_a_study_on_two_cores_and_in_other_batches_has_the_same_tables(undisturbed, tmp_path):
    other = copy(undisturbed, tmp_path / "study")
    other.configure(realisations_per_job=1, results="elsewhere")
    other.run("--cores", "2", "--scheduler", "greedy")
    assert other.tables_in("elsewhere") == undisturbed.tables
