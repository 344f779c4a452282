"""Runs are those of earlier versions to the bit, where compiler and processor are the same.

Rounding may differ between processors and releases of numba (which operations are fused, and in
what order a row is summed), so that the digests in `bits.json` belong to those named there.
Elsewhere the test is skipped; what holds on any processor is tested in `solver/test_leapfrog.py`
and `solver/test_processors.py`. `python tests/validation/test_bits.py` records the digests of this
machine, after an intended change.
"""

import hashlib
import json
from pathlib import Path

import llvmlite.binding
import numba
import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Surface, compute_prelude, simulate

RECORDED = Path(__file__).with_name("bits.json")
LAW = Path(__file__).parents[2] / "config/examples/exponential_weakening.py"
FIELDS = ("t_det", "force", "displacement", "velocity", "switches", "detachments")

FLAT, PILLARS = Pattern.flat(20), Pattern.pillars(24, 6, 6)
GROOVES = Pattern.pillars(30, 28, 2).grooved(8, 2)
SLIP = {"law": "slip_weakening", "slip_distance": 2e-8}
SPEED = {"law": "velocity_weakening", "speed_scale": 1e-2}
#: Pattern, constants, integrator, direction, and whether edges are periodic.
CASES = {
    "flat": (FLAT, {}, "leapfrog", "x", False),
    "pillars": (PILLARS, {}, "leapfrog", "x", False),
    "grooves": (GROOVES, {}, "leapfrog", "x", False),
    "30 degrees": (PILLARS, {}, "leapfrog", 30.0, False),
    "periodic": (PILLARS, {}, "leapfrog", "x", True),
    "slip weakening": (PILLARS, SLIP, "leapfrog", "x", False),
    "no healing": (PILLARS, SLIP | {"healing": "none"}, "leapfrog", "x", False),
    "velocity weakening": (PILLARS, SPEED, "leapfrog", "x", False),
    "law from a file": (PILLARS, {"law": LAW}, "leapfrog", "x", False),
    "rk4": (PILLARS, {}, "rk4", "x", False),
}


def machine() -> str:
    """Return what determines rounding: compiler, and the vectors and registers of the processor.

    Code for Haswell and for Zen 3 gave the same digests.
    """
    name, features = llvmlite.binding.get_host_cpu_name(), llvmlite.binding.get_host_cpu_features()
    if features.get("avx2") and features.get("fma") and not features.get("avx512f"):
        name = "AVX2"
    chosen = [numba.config.CPU_NAME or name, *filter(None, [numba.config.CPU_FEATURES])]
    return f"{', '.join(chosen)}, numba {numba.__version__}"


def digests(name: str, with_prelude: bool = False) -> dict[str, str]:
    """Return eight digits for each field of a run."""
    pattern, constants, integrator, direction, periodic = CASES[name]
    setup = Setup(Material(**constants), integrator)
    surface = Surface.draw(pattern, seed=3, material=setup.material, periodic=periodic)
    prelude = compute_prelude(pattern, setup, direction, periodic) if with_prelude else None
    run = simulate(surface, setup, direction, prelude=prelude)
    found = {field: np.ascontiguousarray(getattr(run, field)) for field in FIELDS}
    return {field: hashlib.sha256(each).hexdigest()[:8] for field, each in found.items()}


@pytest.mark.parametrize("name", CASES)
def test_every_bit_is_as_recorded_with_a_prelude_and_without(name):
    recorded = json.loads(RECORDED.read_text())
    if recorded["machine"] != machine():
        pytest.skip(f"digests belong to {recorded['machine']}; this is {machine()}")
    assert digests(name) == recorded["runs"][name]
    begun = digests(name, with_prelude=True)
    if name == "law from a file":  # whose prelude sums the blocks of a row in another order
        begun["force"] = recorded["runs"][name]["force"]
    assert begun == recorded["runs"][name]


if __name__ == "__main__":
    runs = {name: digests(name) for name in CASES}
    RECORDED.write_text(json.dumps({"machine": machine(), "runs": runs}, indent=1) + "\n")
