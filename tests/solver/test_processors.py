"""Different processors: vectors and fused operations change only the last bits."""

import os
import platform
import subprocess
import sys

import numpy as np
import pytest

from specimens import drawn
from springblock import Pattern, simulate

#: Of force and times up to the peak. Rounding differs by 1e-16 a step and grows over some thousand
#: steps; beyond the peak of patterned surfaces, avalanches reorder (docs/accuracy.md).
TOLERANCE = 1e-9

ELSEWHERE = """
import sys
import numpy as np
from springblock import Pattern, Surface, simulate
run = simulate(Surface.draw(Pattern.pillars(24, 8, 4).contact, 1))
np.savez(sys.argv[1], force=run.force, t_det=run.t_det, t_max=run.t_max)
"""


def test_any_processor_finds_the_same_run_up_to_its_peak(tmp_path):
    """Compared with a processor without AVX and fused multiply-adds."""
    file = tmp_path / "run.npz"
    environment = {**os.environ, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    subprocess.run([sys.executable, "-c", ELSEWHERE, str(file)], env=environment, check=True)
    generic = np.load(file)
    here = simulate(drawn(Pattern.pillars(24, 8, 4), 1))
    assert generic["t_max"] == here.t_max
    peak = int(np.argmax(here.force)) + 1
    np.testing.assert_allclose(generic["force"][:peak], here.force[:peak], rtol=TOLERANCE)
    before = here.t_det < here.t_max
    assert before.sum() > 50
    np.testing.assert_allclose(generic["t_det"][before], here.t_det[before], rtol=TOLERANCE)


#: On x86-64, whatever the processor, the command line on one with AVX-512; elsewhere on this one.
WIDE = """
import platform
from pathlib import Path
import llvmlite.binding as llvm
from springblock import cli
if platform.machine() == "x86_64":
    has = {"avx512f": True, "avx512vl": True}
    llvm.get_host_cpu_name = lambda: "skylake-avx512"
    llvm.get_host_cpu_features = lambda: llvm.targets.FeatureMap(has)
    cli._PROCESSOR = Path(__file__)
cli.use_long_vectors()
from numba import float64
from springblock.solver.compilation import add, kernel

@kernel
def doubled(x):
    for i in range(len(x)):
        x[i] = add(x[i], x[i])

doubled.compile((float64[::1],))
print(*("zmm" in code for code in doubled.inspect_asm().values()))
"""


X86 = platform.machine() == "x86_64"


@pytest.mark.parametrize(
    ("chosen", "wide"),
    [({}, X86), ({"NUMBA_CPU_NAME": "skylake-avx512" if X86 else "generic"}, False)],
)
def test_vectors_are_as_wide_as_the_processor_has_them(chosen, wide, tmp_path):
    """512 bits (zmm) with AVX-512, unless the user has chosen a processor; none elsewhere."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), **chosen}
    environment.pop("NUMBA_CPU_FEATURES", None)  # of a command called before in this process
    script = tmp_path / "wide.py"
    script.write_text(WIDE)
    command = [sys.executable, str(script)]
    found = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    assert found.stdout.split() == [str(wide)]
