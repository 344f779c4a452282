"""The same answer on any processor: vectors and fused operations change the last bits alone."""

import os
import subprocess
import sys

import numpy as np
import pytest

from springblock import Pattern, compute_prelude, simulate
from springblock.accuracy.specimens import drawn

#: Of force and times up to the peak. Rounding differs by 1e-16 a step and grows over some thousand
#: steps; beyond the peak of patterned surfaces, avalanches reorder (docs/accuracy.md).
TOLERANCE = 1e-9
PILLARS = Pattern.pillars(24, 8, 4)

ELSEWHERE = """
import sys
import numpy as np
from springblock import Pattern, compute_prelude, draw_friction, simulate
from springblock.accuracy.specimens import drawn
pillars = Pattern.pillars(24, 8, 4)
run = simulate(*drawn(pillars, 1), prelude=compute_prelude(pillars.contact))
np.savez(sys.argv[1], force=run.force, t_det=run.t_det, t_max=run.t_max)
"""


@pytest.fixture(scope="module")
def generic(tmp_path_factory):
    """A run on a processor without AVX and without fused multiply-adds."""
    file = tmp_path_factory.mktemp("generic") / "run.npz"
    environment = {**os.environ, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    subprocess.run([sys.executable, "-c", ELSEWHERE, str(file)], env=environment, check=True)
    with np.load(file) as stored:
        return dict(stored)


def test_any_processor_finds_the_same_run_up_to_its_peak(generic):
    here = simulate(*drawn(PILLARS, 1), prelude=compute_prelude(PILLARS.contact))
    assert generic["t_max"] == here.t_max
    peak = int(np.argmax(here.force)) + 1
    np.testing.assert_allclose(generic["force"][:peak], here.force[:peak], rtol=TOLERANCE)
    before = here.t_det < here.t_max
    assert before.sum() > 50
    np.testing.assert_allclose(generic["t_det"][before], here.t_det[before], rtol=TOLERANCE)


def test_vectors_do_not_depend_on_what_is_imported_first():
    """Numba looks at the features of the processor once: when the first function is declared."""
    chosen = "from numba.core.registry import cpu_target as cpu; import springblock.solver; "
    chosen += "print(cpu.target_context.codegen().magic_tuple())"
    first = ("springblock.solver", "springblock.accuracy.plain_rk4")
    found = {
        subprocess.check_output([sys.executable, "-c", f"import {module}; {chosen}"])
        for module in first
    }
    assert len(found) == 1
