"""Machine code is kept for whoever can use it; who waits for the compiler is told so."""

from pathlib import Path

from kernels import COMPILING, run_kernels
from springblock.solver import compilation


def test_one_waits_once_and_is_told_so(tmp_path):
    assert run_kernels(tmp_path / "kept") == (["0", "0"], [COMPILING], 0)
    assert run_kernels(tmp_path / "kept") == (["1", "1"], [], 0)


def test_unlike_processors_share_a_folder_and_no_machine_code(tmp_path):
    unlike = ({}, {"NUMBA_CPU_NAME": "generic"}) * 2
    found = [run_kernels(tmp_path / "kept", **processor) for processor in unlike]
    assert [hits for hits, *_ in found] == [["0", "0"], ["0", "0"], ["1", "1"], ["1", "1"]]
    assert len(list(tmp_path.glob("kept/*/kernels.*"))) == 4


def test_who_has_no_home_keeps_it_where_he_works(monkeypatch):
    """As a container's users may have none, of whom nothing is known but a number."""
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr("os.path.expanduser", lambda path: path)
    assert compilation._caches() == Path(".cache/springblock")
