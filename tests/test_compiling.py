"""Who waits for the compiler is told so, and what it leaves can be shared."""

import os
import subprocess
import sys

import numba
import pytest
from numba.core import caching

import springblock.solver.compilation  # noqa: F401, says how machine code is kept
from springblock.compiling import announce


@pytest.fixture
def cache(monkeypatch, tmp_path):
    """An empty folder for machine code."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    announce.cache_clear()
    yield tmp_path
    announce.cache_clear()


def test_an_empty_cache_is_announced_once(cache, caplog):
    announce("leapfrog", 1)
    announce("leapfrog", 1)
    assert [record.getMessage() for record in caplog.records] == [
        "compiling leapfrog once, about 15 s"
    ]


def test_each_kernel_is_announced_for_itself(cache, caplog):
    (cache / "solver").mkdir()
    (cache / "solver" / "leapfrog.advance-371.py311.nbi").touch()
    announce("leapfrog", 1)
    assert not caplog.records
    announce("rk4", 1)
    announce("leapfrog", 2)
    assert len(caplog.records) == 2


KERNEL = """
from springblock.solver.compilation import kernel

@kernel
def twice(x):
    return x + x

assert twice(1.5) == 3.0
print(sum(twice.stats.cache_hits.values()))
"""


def test_unlike_processors_share_a_folder_and_no_machine_code(tmp_path):
    (tmp_path / "kernel.py").write_text(KERNEL)
    found = []
    for processor in ({}, {"NUMBA_CPU_NAME": "generic"}, {}, {"NUMBA_CPU_NAME": "generic"}):
        ours = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), **processor}
        command = [sys.executable, str(tmp_path / "kernel.py")]
        done = subprocess.run(command, env=ours, capture_output=True, text=True, check=True)
        found.append(int(done.stdout))
    assert found == [0, 0, 1, 1]  # each compiles once, and finds its own again
    assert len(list(tmp_path.rglob("kernel.twice-*.nbi"))) == 1


def test_processes_that_compile_at_a_time_load_only_their_own(tmp_path):
    """One of them stores all of its machine code between the two halves of the other's."""
    one, other, reader = (
        caching.IndexDataCacheFile(str(tmp_path), "kernel", "stamp") for _ in range(3)
    )
    keep = one._save_data

    def keep_late(name, data):
        other.save("float32", "of float32")
        keep(name, data)

    one._load_index = other._load_index = dict  # both have seen an empty folder
    one._save_data = keep_late
    one.save("float64", "of float64")
    assert reader.load("float32") in (None, "of float32")
    assert reader.load("float64") in (None, "of float64")
