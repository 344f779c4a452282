"""Different processors: vectors and fused operations change only the last bits."""

import os
import subprocess
import sys

import llvmlite.binding as llvm
import numpy as np
import pytest

from specimens import drawn
from springblock import Pattern, cli, read, simulate

#: Of force and times up to the peak. Rounding differs by 1e-16 a step and grows over some thousand
#: steps; beyond the peak of patterned surfaces, avalanches reorder (docs/accuracy.md).
TOLERANCE = 1e-9


def test_any_processor_finds_the_same_run_up_to_its_peak(tmp_path):
    """Compared with a processor without AVX and fused multiply-adds."""
    file, scene = tmp_path / "run.parquet", "--n-blocks 24 --n-p 8 --n-s 4 --first-seed 1"
    words = [sys.executable, "-m", "springblock", "simulate", *scene.split(), "--output", file]
    environment = {**os.environ, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    subprocess.run(words, env=environment, check=True)
    (generic,) = read(file)
    here = simulate(drawn(Pattern.pillars(24, 8, 4), 1))
    assert generic.t_max == here.t_max
    peak = int(np.argmax(here.force)) + 1
    np.testing.assert_allclose(generic.force[:peak], here.force[:peak], rtol=TOLERANCE)
    before = here.t_det < here.t_max
    assert before.sum() > 50
    np.testing.assert_allclose(generic.t_det[before], here.t_det[before], rtol=TOLERANCE)


@pytest.mark.parametrize(
    ("chosen", "added"),
    [({}, {"NUMBA_CPU_FEATURES": "+avx512f,-prefer-256-bit"}), ({"NUMBA_CPU_NAME": "generic"}, {})],
)
def test_commands_prefer_long_vectors_unless_the_user_has_chosen(
    monkeypatch, tmp_path, chosen, added
):
    """Of 512 bits, on a processor with AVX-512."""
    (tmp_path / "cpuinfo").write_text("flags : avx2 avx512f")
    monkeypatch.setattr(cli, "_PROCESSOR", tmp_path / "cpuinfo")
    features = llvm.targets.FeatureMap({"avx512f": True})
    monkeypatch.setattr(llvm, "get_host_cpu_features", lambda: features)
    monkeypatch.setattr(os, "environ", dict(chosen))
    cli.use_long_vectors()
    assert os.environ == chosen | added
