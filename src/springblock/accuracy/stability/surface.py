"""Two columns of which one moves, and flat surfaces: stiffness, strain and scatter."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from springblock.accuracy.stability import schemes
from springblock.accuracy.stability.cases import FIRST, FRICTION, Case, Family, Outcome
from springblock.accuracy.stability.pull import PAPER, ROUNDING, SEED, Pull, pulled_at, release
from springblock.accuracy.surfaces import flat
from springblock.model.material import Material

#: Two columns of two blocks, the left one held fast. The free ones move by (a, b) and (a, -b): the
#: axial spring beside them, the one between them (strained by 2b), and a diagonal give K_int times
#: this matrix.
COLUMNS = np.array([[1.25, -0.25], [-0.25, 2.25]])
FREE_COLUMN = (
    np.array([[True, False], [True, False]]),
    np.array([[1e9, 0.0], [1e9, 0.0]]),
    np.zeros((2, 2)),
)


def material_of(ratio: float, strain: float, damping: bool = False) -> Material:
    """Material with K_s/K_int = `ratio` whose blocks slip by `strain` spacings, pulled slowly.

    The layer's thickness sets the ratio, and E the strain at the paper's pressure.
    """
    thickness = PAPER.spacing / math.sqrt(ratio)
    modulus = PAPER.pressure * thickness / PAPER.spacing / (0.75 * strain)
    material = Material(youngs_modulus=modulus, thickness=thickness)
    gamma = PAPER.gamma / PAPER.omega_min * material.omega_min if damping else 0.0
    return pulled_at(0.01, replace(material, gamma=gamma))


def free_column(integrator: str, material: Material) -> Outcome:
    """The springs are non-linear by their strain, and that is all that is missing."""
    pull, count = Pull.at(0.1, integrator, material), 400
    run = pull.simulate(FREE_COLUMN, count)
    stiffness = material.k_s * np.eye(2) + material.k_int * COLUMNS
    values, modes = np.linalg.eigh(stiffness)
    phase = pull.step * np.sqrt(values / material.mass)
    share = material.k_s * modes[0] / values  # of the slider's path, by mode
    closed_form = float(modes[0] @ (share * schemes.path(integrator, phase, count)))
    value = float(run.displacement[0, 0, 1])
    slide = material.slider_velocity * pull.step
    tolerance = abs(value) / material.spacing + ROUNDING
    return pull.judge(run, value / slide, closed_form, tolerance)


def first_detachment(integrator: str, material: Material, n: int = 8) -> Outcome:
    """On a flat surface the weakest block lets go first, at its own threshold."""
    pull, surface = Pull.at(0.2, integrator, material), flat(n, SEED, material)
    run = pull.simulate(surface)
    threshold = np.maximum(*surface[1:]).min()
    return pull.judge(run, run.t_first / release(material, 1.0), threshold, ROUNDING)


def mean_detachment(integrator: str, ratio: float) -> Outcome:
    """Far stiffer than the springs between them, the slider's springs pull each block alone.

    A block slips by about its threshold's share of F_n/K_s, and pulls its neighbours with
    K_int/K_s of that.
    """
    material = material_of(ratio, 1e-3, damping=True)
    pull, surface = Pull.at(0.2, integrator, material), flat(8, SEED, material)
    run = pull.simulate(surface)
    mean, unit = np.maximum(*surface[1:]).mean(), release(material, 1.0)
    return pull.judge(run, run.t_avg / unit, mean, pull.step / (mean * unit) + 2.0 / ratio)


def static_friction_at(integrator: str, strain: float) -> Outcome:
    """Avalanches on a surface, beside those at a ten-thousandth of the strain."""
    runs = []
    for slip in (strain, 1e-4 * strain):
        material = material_of(1.0, slip, damping=True)
        pull = Pull.at(0.2, integrator, material)
        runs.append(pull.simulate(flat(6, SEED, material)))
    value, linear = (run.static_friction for run in runs)
    return pull.judge(runs[0], value, linear, strain + ROUNDING)


def scattered(sigma: float) -> Material:
    """The paper's material with another scatter; mu_d has half that of mu_s, as in the paper."""
    return pulled_at(0.01, replace(PAPER, mu_static_std=sigma, mu_dynamic_std=sigma / 2.0))


def everything_at_once(integrator: str) -> Outcome:
    """sigma = 0: all blocks let go and move alike, along the slide alone, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(0.0))
    run = pull.simulate(flat(8, SEED, pull.material))
    alike = np.unique(run.t_det).size == 1 and np.unique(run.displacement[0]).size == 1
    word = "symmetric" if alike and not run.displacement[1].any() else "asymmetric"
    unit = release(pull.material, 1.0)
    return pull.judge(run, run.t_first / unit, 1.0, pull.step / unit, word)


def mirror_image(integrator: str, sigma: float) -> Outcome:
    """Mirrored across the slide, every avalanche is the mirror image, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(sigma))
    contact, *mu = flat(8, SEED, pull.material)
    run, mirrored = (
        pull.simulate((contact, static, dynamic))
        for static, dynamic in (mu, [field[::-1] for field in mu])
    )
    sign = np.array([1.0, -1.0])[:, None, None]
    same = np.array_equal(mirrored.t_det, run.t_det[::-1])
    same = same and np.array_equal(mirrored.displacement, sign * run.displacement[:, ::-1])
    word = "symmetric" if same else "asymmetric"
    # sums are taken in another order
    return pull.judge(run, mirrored.static_friction, run.static_friction, ROUNDING, word)


def cases(integrator: str) -> Iterator[Case]:
    """Stiffness, strain and scatter."""
    case, agrees = Family("stiffness", integrator).case, "agrees"
    path = "displacement, in steps of the slider"
    for ratio in (1e-4, 1e-2, 1.0, 1e2, 1e4):
        name, material = f"column at K_s/K_int = {ratio:g}", material_of(ratio, 1e-9)
        yield case(name, ratio, agrees, path, free_column, material)
        name, material = f"surface at K_s/K_int = {ratio:g}", material_of(ratio, 1e-3, damping=True)
        yield case(name, ratio, agrees, FIRST, first_detachment, material)
    for ratio in (1e2, 1e4):
        name, mean = f"blocks on their own at K_s/K_int = {ratio:g}", "mean detachment, F_n/(K_s v)"
        yield case(name, ratio, agrees, mean, mean_detachment, ratio)
    case = Family("strain", integrator).case
    for strain in (1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9):
        name, material = f"column at a strain of {strain:g}", material_of(1.0, strain)
        yield case(name, strain, agrees, path, free_column, material)
    for strain in (1e-1, 1e-5):
        name = f"surface at a strain of {strain:g}"
        yield case(name, strain, agrees, FRICTION, static_friction_at, strain)
    case, even = Family("scatter", integrator).case, "symmetric"
    yield case("surface with sigma = 0", 0.0, even, FIRST, everything_at_once)
    for sigma in (0.05, 0.1, 0.25, 0.5):
        name = f"surface with sigma = {sigma:g}"
        yield case(name, sigma, agrees, FIRST, first_detachment, scattered(sigma))
    yield case("mirror image with sigma = 0.5", 0.5, even, FRICTION, mirror_image, 0.5)
