"""Run time and memory of jobs, from measured rates, for requests to a queue."""

import math

from springblock.model.scene import Scene
from springblock.simulation.scenes import setup_of
from springblock.solver.integrators import INTEGRATORS

_START = 10.0  #: s to start a job on a busy machine
_MARGIN = 3.0  #: for slower processors and strong disorder, which makes runs 1.4 times as long
_BASE = 350  #: MB for Python and its libraries, measured: 250
_PER_BLOCK = 600e-6  #: MB per block for lattice and prelude, measured: 400e-6
_PER_ROW = 130e-6  #: MB per block and realisation of a batch, measured: 90e-6


def cpu_seconds(scene: Scene) -> float:
    """CPU time in s of one realisation from zero, which is also the upper limit for a prelude.

    On all surfaces of this study, a run without duration lasts for 0.2 to 1.4 times the loading
    time of a block with the mean threshold, t = mu_s F_n/(K_s v).
    """
    loading = setup_of(scene).loading_time(scene.contact, scene.mu_static)
    steps = (scene.duration or loading) / scene.step
    return steps * math.prod(scene.shape) * INTEGRATORS[scene.integrator].rate


def minutes(scene: Scene, realisations: int = 1) -> int:
    """Wall-clock time to request, min, including the margin."""
    work = realisations * cpu_seconds(scene)
    return math.ceil(_MARGIN * (_START + work) / 60.0)


def memory(scene: Scene, realisations: int = 1) -> int:
    """Memory to request, MB, including the margin; a snapshot takes as much as a run."""
    rows = realisations * (1 + len(scene.snapshot_times))
    blocks = math.prod(scene.shape)
    return math.ceil(_BASE + blocks * (_PER_BLOCK + _PER_ROW * rows))
