"""The leapfrog in C, loop.c, compiled when it is asked for and called through ctypes."""

import ctypes
import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.timing import Missing
from springblock import Material, Pattern, Surface, draw_friction
from springblock.solver.integrators import LEAPFROG
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.loop import advance
from springblock.solver.springs import Springs

_INT, _DOUBLE, _ARRAY = ctypes.c_int, ctypes.c_double, np.ctypeslib.ndpointer(float)
#: Largest difference from the solver after CHECK_STEPS, relative to the largest value.
TOLERANCE = 1e-9
CHECK_STEPS = 500

#: Without start files: that of fast-math would make this process flush subnormal numbers to zero.
OPTIONS = ["-O3", "-march=native", "-ffast-math", "-shared", "-fPIC", "-nostartfiles"]


def compiled() -> ctypes.CDLL:
    """Return the library of loop.c; raises Missing without a compiler that takes it."""
    source = Path(__file__).with_name("loop.c")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "loop.so"
        command = ["gcc", *OPTIONS, "-o", str(library), str(source), "-lm"]
        try:
            subprocess.run(command, capture_output=True, text=True, check=True)
        except FileNotFoundError:
            raise Missing("no gcc on the path") from None
        except subprocess.CalledProcessError as failed:
            raise Missing(f"gcc failed: {failed.stderr.strip().splitlines()[-1]}") from None
        return ctypes.CDLL(str(library))


class CLoop:
    """One run of the leapfrog in C, pulled along x; units l and steps."""

    def __init__(
        self, contact: np.ndarray, mu_static: np.ndarray, mu_dynamic: np.ndarray, step: float
    ) -> None:
        m = Material()
        self.n = len(contact)
        self.taken = 0  #: steps
        compliance = step * LEAPFROG.force_time(step, m.gamma) / m.mass
        load = m.block_load * contact.size / contact.sum() * compliance / m.spacing
        # ux, uy, wx, wy, t_det, mu_s F_n, mu_d F_n, each with a column of border
        self._fields = np.zeros((7, self.n, self.n + 1))
        self._fields[4] = np.inf
        self._fields[5, :, :-1] = np.where(contact, mu_static * load, 0.0)
        self._fields[6, :, :-1] = np.where(contact, mu_dynamic * load, 0.0)
        self.displacement, self.velocity = self._fields[0:2, :, :-1], self._fields[2:4, :, :-1]
        self.t_det = self._fields[4, :, :-1]  #: (N, N) steps, infinite before
        series = np.array(Springs.of(m.k_int * compliance, 0.0).series)
        slide = m.slider_velocity * step / m.spacing
        numbers = (math.exp(-m.gamma * step), m.k_s * compliance, slide, 0.0)
        self._constants = (self._fields, self.n, series, *numbers)
        self._advance = compiled().advance
        self._advance.argtypes = [_ARRAY, _INT, _ARRAY, *4 * [_DOUBLE], _INT, _INT, _ARRAY]
        self._advance.restype = None

    def advance(self, steps: int) -> np.ndarray:
        """Take so many steps; returns the slider's force after each, (steps, 2)."""
        force = np.empty((steps, 2))
        self._advance(*self._constants, self.taken, steps, force)
        self.taken += steps
        return force


def differences(step: float = 1e-8) -> dict[str, float]:
    """Return the distances from the solver, over its largest values, after CHECK_STEPS.

    On pillars whose blocks have been thrown, slide, and stick for good; and, on a pulled surface,
    in the step in which the first block detaches. There the loop lets it go with the next step and
    the solver within the step, so that later motions differ.
    """
    pattern, material = Pattern.pillars(24, 6, 6), Material()
    contact, (mu_static, mu_dynamic) = pattern.contact, draw_friction(pattern.n_blocks, seed=1)
    thrown = contact, 1e9 * mu_static, 0.005 * mu_dynamic
    speed = np.random.default_rng(1).normal(scale=1e-4, size=(2, *contact.shape))
    pulled = contact, 0.005 * mu_static, 0.005 * mu_dynamic
    pairs = {}
    for surface, velocity in ((pulled, 0.0 * speed), (thrown, speed)):
        loop = CLoop(*surface, step)
        loop.velocity[:] = velocity
        force = loop.advance(CHECK_STEPS)
        state, constants = prepare(Surface(*surface), material, (1.0, 0.0), LEAPFROG, step)
        blocks, samples = state.blocks, Samples.empty(CHECK_STEPS)
        ours = [unpadded(field, constants.grid) for field in blocks]
        ours[2][:], ours[3][:] = velocity
        advance(LEAPFROG, state, constants, 0, CHECK_STEPS, 1, samples)
        if surface is pulled:
            pairs["first detachment"] = loop.t_det.min(), np.ceil(blocks.t_det.min())
    # Of the last surface, the thrown blocks.
    pairs["displacement"] = loop.displacement, np.stack(ours[:2])
    pairs["velocity"] = loop.velocity, np.stack(ours[2:4])
    pairs["force"] = force, np.stack([samples.force_x, samples.force_y], axis=1)
    return {
        name: float(np.abs(ours - theirs).max() / np.abs(theirs).max())
        for name, (ours, theirs) in pairs.items()
    }


def require() -> None:
    """Raise Missing unless the loop compiles here and does what the solver does."""
    name, worst = max(differences().items(), key=lambda item: item[1])
    if not worst < TOLERANCE:
        raise Missing(f"the C loop differs from the solver by {worst:.1e} in {name}")
