"""Machine code is kept for whoever can use it; who waits for the compiler is told so."""

import os
from pathlib import Path

from kernels import COMPILING, KERNELS, run_kernels
from springblock.solver import compilation


def test_one_waits_once_and_is_told_so(tmp_path):
    assert run_kernels(tmp_path / "kept") == (["0", "0"], [COMPILING], 0)
    assert run_kernels(tmp_path / "kept") == (["1", "1"], [], 0)


def test_unlike_processors_share_a_folder_and_no_machine_code(tmp_path):
    unlike = ({}, {"NUMBA_CPU_NAME": "generic"}) * 2
    found = [run_kernels(tmp_path / "kept", **processor) for processor in unlike]
    assert [hits for hits, *_ in found] == [["0", "0"], ["0", "0"], ["1", "1"], ["1", "1"]]
    assert len(list(tmp_path.glob("kept/*/*"))) == 4


def test_other_settings_of_numba_have_other_machine_code(tmp_path):
    run_kernels(tmp_path / "kept")
    assert run_kernels(tmp_path / "kept", NUMBA_BOUNDSCHECK="1") == (["0", "0"], [COMPILING], 0)


def test_of_another_source_nothing_is_run(tmp_path):
    """A constant is part of the code; the kernels check what they compute."""
    run_kernels(tmp_path / "kept")
    changed = KERNELS.replace("FACTOR = 2.0", "FACTOR = 3.0")
    assert run_kernels(tmp_path / "kept", changed) == (["0", "0"], [COMPILING], 0)


def test_of_another_type_nothing_is_run(tmp_path):
    run_kernels(tmp_path / "kept")
    assert run_kernels(tmp_path / "kept", OF_TYPE="float32") == (["0", "1"], [COMPILING], 0)


def test_what_depends_on_more_than_its_source_is_not_kept(tmp_path):
    """Two functions of one name and place, made with other values."""
    closure = "def made(c):\n    @keep\n    @njit\n    def twice(x):\n        return c * x\n"
    closure += "    return twice\ntwice = made(FACTOR)\n@keep\n"
    within = KERNELS.replace("@kernel\ndef twice(x):\n    return FACTOR * x\n\n@keep\n", closure)
    assert within != KERNELS
    for hits in (["0", "0"], ["0", "1"]):
        assert run_kernels(tmp_path / "kept", within) == (hits, [COMPILING], 0)


def test_what_holds_addresses_of_its_process_is_not_kept(tmp_path):
    """As numba has code hold those of arrays above a megabyte."""
    large = KERNELS.replace("FACTOR = 2.0", "FACTOR, LARGE = 2.0, np.full(200_000, 2.0)")
    large = large.replace("return FACTOR * x", "return LARGE[int(2 * x)] * x")
    for hits in (["0", "0"], ["0", "1"]):
        assert run_kernels(tmp_path / "kept", large) == (hits, [COMPILING], 0)


def test_who_has_no_home_keeps_nothing(monkeypatch):
    """Users of containers may be no more than a number; the folder at hand may be a stranger's."""
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr("os.path.expanduser", lambda path: path)
    assert compilation._caches() == Path(os.devnull) / ".cache/springblock"
