"""Machine code is cached by the solver's sources; numba is left as it was found."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from springblock.solver import compilation
from springblock.solver.compilation import _digest

#: Two small kernels for numbers of one type, and whether each came from the cache.
KERNELS = """
import logging
import sys
import numpy as np
from springblock.solver.compilation import kernel

logging.basicConfig(format="%(message)s")

@kernel
def doubled(x):
    return 2.0 * x[0]

@kernel
def summed(x):
    return x[0] + x[1]

x = np.ones(2, sys.argv[1])
assert doubled(x) == summed(x) == 2.0
if hasattr(doubled, "stats"):
    print(*(sum(function.stats.cache_hits.values()) for function in (doubled, summed)))
"""
COMPILING = "compiling once for this processor and this kind of run, some 15 s"


def run_kernels(
    folder: Path, before: str = "", kinds: tuple[str, ...] = ("float64",), **environment: str
) -> list[tuple[list[str], list[str], int]]:
    """Run the kernels with the cache in `folder`, for numbers of these kinds at the same time.

    Returns whether each kernel came from the cache, 0 or 1, what was said, and exit code.
    """
    script = folder.parent / "kernels.py"
    if not script.exists():  # numba may judge a source by its time
        script.write_text(before + KERNELS)
    ours = {**os.environ, "NUMBA_CACHE_DIR": str(folder), **environment}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    jobs = [subprocess.Popen([sys.executable, script, kind], env=ours, **pipes) for kind in kinds]
    done = [(*job.communicate(), job.wait()) for job in jobs]
    return [(hits.split(), said.splitlines(), code) for hits, said, code in done]


def test_each_kind_of_processor_compiles_once(tmp_path):
    """The number of threads does not count."""
    unlike = ({}, {"NUMBA_CPU_NAME": "generic"}) * 2
    found = [
        run_kernels(tmp_path / "cache", NUMBA_NUM_THREADS=str(1 + i // 2), **setting)[0]
        for i, setting in enumerate(unlike)
    ]
    assert found == [(["0", "0"], [COMPILING], 0)] * 2 + [(["1", "1"], [], 0)] * 2
    assert len(list(tmp_path.glob("cache/springblock/*/lock"))) == 1


def test_a_full_disk_stops_no_run(tmp_path):
    full = "import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))\n"
    [(hits, said, code)] = run_kernels(tmp_path / "cache", full)
    assert (hits, said[:1], code) == (["0", "0"], [COMPILING], 0)
    (warned,) = (line for line in said if "cannot be cached" in line)  # once
    assert warned.startswith(f"machine code cannot be cached in {tmp_path}")
    assert warned.endswith("File too large")


def test_each_process_compiles_where_nothing_can_be_written(tmp_path):
    (tmp_path / "cache").write_text("a file where a folder should be")
    [(hits, (said,), code)] = run_kernels(tmp_path / "cache")
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
        import springblock.solver, springblock.study.accuracy.plain_rk4
        assert dict(vars(numba.config)) == before
    """
    subprocess.run([sys.executable, "-c", script], check=True)


def test_processes_that_save_code_for_different_types_do_not_mix_it(tmp_path):
    """numba would give both files one name if neither index held the other's when it was read."""
    kinds = ("float64", "float32", "complex128")
    first, second = (run_kernels(tmp_path / "cache", kinds=kinds) for _ in range(2))
    assert first == [(["0", "0"], [COMPILING], 0)] * 3
    assert second == [(["1", "1"], [], 0)] * 3


def test_kernels_work_without_private_parts_of_numba_and_without_compiling(tmp_path):
    lost = """if True:
        from numba.core import compiler
        private = vars(compiler).pop("Compiler")
        import springblock.solver.compilation
        compiler.Compiler = private
    """
    assert run_kernels(tmp_path / "cache", f"{lost}\n") == [(["0", "0"], [], 0)]
    assert run_kernels(tmp_path / "cache", NUMBA_DISABLE_JIT="1") == [([], [], 0)]
