"""Machine code is cached for its user alone; numba is left as it was found."""

import fcntl
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numba import typeof

from kernels import COMPILING, run_kernels
from springblock import Material, Surface
from springblock.solver import compilation
from springblock.solver.compilation import _cache_folder, _digest, _OneCompiler
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import prepare


def test_each_kind_of_processor_and_each_setting_compiles_once(tmp_path):
    """And has a folder of its own. The number of threads does not count."""
    unlike = ({"NUMBA_OPT": "0"}, {}, {"NUMBA_CPU_NAME": "generic"}) * 2
    found = [
        run_kernels(tmp_path / "cache", NUMBA_NUM_THREADS=str(1 + i // 3), **setting)
        for i, setting in enumerate(unlike)
    ]
    assert found == [(["0", "0"], [COMPILING], 0)] * 3 + [(["1", "1"], [], 0)] * 3
    assert len(list(tmp_path.glob("cache/springblock/*/lock"))) == 3  # see `_OneCompiler`


def flipped(file, at):
    content = bytearray(file.read_bytes())
    content[int(at * (len(content) - 1))] ^= 4
    file.write_bytes(content)


DAMAGES = {
    "empty": lambda file: file.write_bytes(b""),
    "text": lambda file: file.write_text("text"),
    "truncated": lambda file: file.write_bytes(file.read_bytes()[:-100]),
    "missing": lambda file: file.unlink(),
    "flipped first bit": lambda file: flipped(file, 0.0),
    "flipped bit": lambda file: flipped(file, 0.3),
    "flipped bit in the checksum": lambda file: flipped(file, 1.0),
}


@pytest.fixture(scope="module")
def warm(tmp_path_factory):
    """A folder with the machine code of both kernels."""
    cache = tmp_path_factory.mktemp("warm") / "cache"
    assert run_kernels(cache)[0] == ["0", "0"]
    return cache


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_machine_code_is_compiled_again(warm, damage):
    """The index of one kernel, the code of the other; both are whole afterwards."""
    (index,), (code,) = warm.rglob("*doubled*.nbi"), warm.rglob("*summed*.nbc")
    for file in (index, code):
        DAMAGES[damage](file)
    assert run_kernels(warm) == (["0", "0"], [COMPILING], 0)
    assert run_kernels(warm) == (["1", "1"], [], 0)


def test_a_full_disk_stops_no_run(tmp_path):
    full = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))\n"
    hits, said, code = run_kernels(tmp_path / "cache", full)
    assert (hits, said[:1], code) == (["0", "0"], [COMPILING], 0)
    assert said[1].startswith(f"machine code cannot be cached in {tmp_path}")
    assert said[1].endswith("File too large")
    assert len(said) == 2


@pytest.mark.parametrize("by_link", [False, True])
def test_a_folder_is_refused_if_others_can_replace_one_above_it(tmp_path, monkeypatch, by_link):
    open_to_all = tmp_path / "open"
    (open_to_all / "own").mkdir(parents=True)
    (tmp_path / "link").symlink_to(open_to_all / "own")
    given = tmp_path / "link" if by_link else open_to_all / "own"
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(given))
    for mode in (0o777, 0o775):
        open_to_all.chmod(mode)
        with pytest.raises(PermissionError, match=f"others can write to {open_to_all}$"):
            _cache_folder()
    open_to_all.chmod(0o1777)  # as /tmp
    assert _cache_folder().is_relative_to(open_to_all / "own")


@pytest.mark.parametrize("mode", [0o777, 0o770])
@pytest.mark.parametrize("level", ["springblock", "springblock/*"])
def test_a_folder_is_refused_that_is_not_the_users_alone(tmp_path, monkeypatch, mode, level):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    assert _cache_folder().is_relative_to(tmp_path)
    (folder,) = tmp_path.glob(level)
    assert folder.stat().st_mode & 0o777 == 0o700
    folder.chmod(mode)
    with pytest.raises(PermissionError, match=f"others can write to {folder}$"):
        _cache_folder()
    folder.chmod(0o700)
    monkeypatch.setattr(os, "access", lambda *how: False)
    with pytest.raises(PermissionError, match=r"springblock/\w+ is read-only$"):
        _cache_folder()
    monkeypatch.setattr(os, "getuid", lambda: tmp_path.stat().st_uid + 1)
    with pytest.raises(PermissionError, match=f"others can write to {tmp_path}"):
        _cache_folder()


def test_each_process_compiles_where_nothing_can_be_written(tmp_path):
    (tmp_path / "cache").write_text("a file where a folder should be")
    hits, (said,), code = run_kernels(tmp_path / "cache")
    assert (hits, code) == (["0", "0"], 0)
    assert said.startswith("compiling for this process alone, some 15 s, because nothing is cached")


def test_changed_sources_use_another_folder(tmp_path, monkeypatch):
    before = _digest()
    copies = shutil.copytree(Path(compilation.__file__).parent, tmp_path / "solver")
    monkeypatch.setattr(compilation, "__file__", str(copies / "compilation.py"))
    assert _digest() == before
    with (copies / "friction.py").open("a") as source:
        source.write("\n")
    assert _digest() != before


def test_an_import_changes_no_setting_of_numba():
    script = """if True:
        import numba
        before = dict(vars(numba.config))
        import springblock.solver, springblock.accuracy.plain_rk4
        assert dict(vars(numba.config)) == before
    """
    subprocess.run([sys.executable, "-c", script], check=True)


def test_numba_tells_the_work_arrays_of_all_integrators_apart():
    """By their names, by which machine code is linked: a step would be that of another one."""
    names = set()
    for each in INTEGRATORS.values():
        how = Surface([[True]], 1.0, 0.6), Material(), (1.0, 0.0), each, 2e-8
        names.add(typeof(each.kernels.Work.of(*prepare(*how))).name)
    assert len(names) == len(INTEGRATORS)


def test_one_process_compiles_at_a_time(tmp_path):
    """From the first of nested compilations until all of them are written."""

    def is_locked() -> bool:
        with (tmp_path / "lock").open("w") as another:
            try:
                fcntl.flock(another, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
        return False

    lock = _OneCompiler(tmp_path / "lock")
    seen = [is_locked()]
    for change in (lock.on_start, lock.on_start, lock.on_end, lock.on_end):
        change(None)
        seen.append(is_locked())
    assert seen == [False, True, True, True, False]


def test_kernels_work_with_public_parts_of_numba_alone(tmp_path):
    lost = "import sys, numba\nsys.modules['numba.core.event'] = None  # cannot be imported\n"
    assert run_kernels(tmp_path / "cache", lost) == (["0", "0"], [], 0)


def test_kernels_work_without_compiling(tmp_path):
    assert run_kernels(tmp_path / "cache", NUMBA_DISABLE_JIT="1") == ([], [], 0)
