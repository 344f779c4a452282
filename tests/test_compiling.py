"""Who waits for the compiler is told so."""

import numba
import pytest

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
