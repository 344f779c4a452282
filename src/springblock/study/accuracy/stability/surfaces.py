"""Columns and surfaces: step, stiffness, strain, scatter, load, size, and too fast sliders."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.solver.integrators import INTEGRATORS, limit
from springblock.study.accuracy.stability.cases import PAPER, Case, Outcome, Pull, pulled_at

SEED = 1
#: Avalanches on pillars excite the highest modes.
PILLARS = Surface.draw(Pattern.pillars(8, 2, 2).contact, SEED)
OVERDAMPED = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))
#: Blocks of the row in which a rupture front runs, and those of its weak end.
ROW, WEAK = 200, 10
#: Displacement of the free column by the reference solution (`benchmarks/reference.py`), l, for
#: K_s/K_int and the strain.
COLUMNS = {
    (1e-4, 1e-9): 1.047745375789116e-09,
    (1e-2, 1e-9): 1.0486970104856194e-09,
    (1.0, 1e-9): 9.940711128988963e-10,
    (1e2, 1e-9): 9.955946150692076e-10,
    (1e4, 1e-9): 1.0123981025734757e-09,
    (1.0, 1e-7): 9.940710994405729e-08,
    (1.0, 1e-5): 9.940697536220505e-06,
    (1.0, 1e-3): 0.0009939353083808645,
    (1.0, 1e-2): 0.009927254277706177,
    (1.0, 0.02): 0.01982813920162867,
    (1.0, 0.1): 0.09817900442826516,
    (1.0, 0.3): 0.28916004029032416,
    (1.0, 0.6): 0.5688503896036586,
    (1.0, -0.1): 0.10091083627535245,
    (1.0, -0.3): 0.3146034171159195,
}


def steps(integrator: str) -> Iterator[Case]:
    """Yield steps up to the stability limit and beyond, with weak and with strong damping."""
    case = partial(Case, "step", integrator)
    stable = [("pillars", PAPER, share) for share in (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99)]
    for name, material, share in (*stable, ("strained pillars", HEAVY, 0.99)):
        attempt = partial(near_the_limit, material=material, share=share)
        yield case(f"{name} at {share:.0%} of the limit", share, attempt, "stable")
    unstable = [("pillars", PAPER, share) for share in (1.001, 1.01, 1.5, 10.0)]
    for name, material, share in (*unstable, ("overdamped pillars", OVERDAMPED, 1.01)):
        attempt = partial(beyond_the_limit, material=material, share=share)
        yield case(f"{name} at {share:g} times the limit", share, attempt, "refused")


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Judge the energy balance, which first shows that a step is too long."""
    pull = Pull.at(share, integrator, material)
    run = pull.simulate(PILLARS, every=max(1, round(2e-7 / pull.step)))
    word = "stable" if pull.keeps_energy(run) else "drifts"
    return Outcome(word, run.energy.relative_residual, "static friction", run.static_friction)


def beyond_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Pull with an unstable step."""
    try:
        Pull.at(share, integrator, material).simulate(PILLARS)
    except ValueError as error:
        return Outcome("refused" if "is unstable" in str(error) else str(error))
    return Outcome("accepted")


def stiffnesses(integrator: str) -> Iterator[Case]:
    """Yield cases of stiffness, strain and scatter."""
    case = partial(Case, "stiffness", integrator)
    for ratio in (1e-4, 1e-2, 1.0, 1e2, 1e4):
        attempt = partial(column, ratio=ratio, strain=1e-9)
        yield case(f"column at K_s/K_int = {ratio:g}", ratio, attempt)
        material, gamma = layer(ratio, 1e-3), PAPER.gamma / PAPER.omega_min
        material = pulled_at(0.01, replace(material, gamma=gamma * material.omega_min))
        attempt = partial(first_detachment, material=material)
        yield case(f"surface at K_s/K_int = {ratio:g}", ratio, attempt)
    case = partial(Case, "strain", integrator)
    for strain in (1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9):
        yield case(f"column at a strain of {strain:g}", strain, partial(column, strain=strain))
    case = partial(Case, "scatter", integrator)
    for sigma in (0.0, 0.05, 0.1, 0.25, 0.5):
        attempt = partial(first_detachment, material=scattered(sigma))
        yield case(f"surface with sigma = {sigma:g}", sigma, attempt)


def loads(integrator: str) -> Iterator[Case]:
    """Yield springs beyond the range of their series, and springs that collapse or burst."""
    case = partial(Case, "load", integrator)
    for strain in (0.02, 0.3, 0.6, -0.1, -0.3):
        name = f"column {'stretched' if strain > 0 else 'squeezed'} by {abs(strain):g}"
        yield case(name, abs(strain), partial(column, strain=strain))
    for strain, what in ((2.0, "stretched until it bursts"), (-1.0, "squeezed until it collapses")):
        yield case(f"column {what}", abs(strain), partial(broken_column, strain=strain), "raises")


def fronts(integrator: str) -> Iterator[Case]:
    """Yield rupture fronts in a chain, by the prestress."""
    case = partial(Case, "rupture front", integrator)
    for prestress in (0.5, 0.7, 0.9):
        attempt = partial(rupture_front, prestress=prestress)
        yield case(f"prestress {prestress:g}", prestress, attempt)


def rupture_front(integrator: str, prestress: float) -> Outcome:
    """Compare the speed of a rupture front in the second half of a row with its closed form.

    1/sqrt(1 - tau²) with tau = (tau_0 - mu_d)/(mu_s - mu_d), derived in
    `tests/validation/test_fronts.py`; tau_0 is the pull of the slider as the front passes.
    """
    material = pulled_at(0.1, layer(1e-7, 1e-3))
    pull = Pull.at(0.05, integrator, material)
    mu_s, mu_d = 1.0, 0.6
    strength = np.full((1, ROW), mu_s)
    strength[0, :WEAK] = mu_d + prestress * (mu_s - mu_d)
    passage = ROW * math.sqrt(material.k_s / material.k_int)  # at the speed of waves, 1/omega
    count = math.ceil((strength[0, 0] / pull.speed + passage) / pull.h)
    run = pull.simulate(Surface(np.ones((1, ROW), bool), strength, mu_d), count)
    half, last = run.t_det[0, [ROW // 2, -1]]
    speed = (ROW - 1 - ROW // 2) / (last - half) * math.sqrt(material.mass / material.k_int)
    tau_0 = pull.speed * material.omega_min * (half + last) / 2.0
    tau = (tau_0 - mu_d) / (mu_s - mu_d)
    name = "speed of a rupture front, l sqrt(K_int/m)"
    return pull.judge(run, name, speed, 1.0 / math.sqrt(1.0 - tau**2), 3e-3)


def layer(ratio: float, strain: float) -> Material:
    """Return a material without damping: K_s/K_int = `ratio`, and F_n/K_s = `strain` spacings."""
    material = replace(PAPER, thickness=PAPER.spacing / math.sqrt(ratio), gamma=0.0)
    return replace(material, pressure=strain * material.k_s / material.spacing)


def scattered(sigma: float, speed: float = 0.01) -> Material:
    """Return the paper's material with another scatter of mu_s; that of mu_d is half of it."""
    return pulled_at(speed, replace(PAPER, mu_static_std=sigma, mu_dynamic_std=sigma / 2.0))


def pulled_column(ratio: float, strain: float) -> tuple[Surface, Material, float]:
    """Return two columns of two blocks, of which one is fixed, the material, and a duration, s.

    The slider moves the free column away by about `strain` spacings, or towards the other if
    strain < 0; the springs between them have 1.25 K_int at small strains. The duration is 13
    periods of the highest mode.
    """
    contact = [[1, 0], [1, 0]] if strain > 0.0 else [[0, 1], [0, 1]]
    material = layer(ratio, abs(strain))
    duration = 80.0 / material.omega_max
    slide = (1.0 + 1.25 / ratio) * abs(strain) * material.spacing
    surface = Surface(contact, mu_static=1e9, mu_dynamic=0.0)
    return surface, replace(material, slider_velocity=slide / duration), duration


def column(integrator: str, strain: float, ratio: float = 1.0) -> Outcome:
    """Compare a free column with the reference solution, at a hundredth of the stable step.

    The error may be omega_max h to the power of the order.
    """
    surface, material, duration = pulled_column(ratio, strain)
    count = math.ceil(duration / (0.01 * limit(integrator, material)))
    pull = Pull(integrator, material, duration / count)
    run = pull.simulate(surface, count)
    value = float(run.displacement[0, ~surface.contact][0]) / material.spacing
    tolerance = (material.omega_max * pull.step) ** INTEGRATORS[integrator].order
    return pull.judge(run, "displacement, l", value, COLUMNS[ratio, strain], tolerance)


def broken_column(integrator: str, strain: float) -> Outcome:
    """Strain the springs beyond half or twice their length."""
    surface, material, duration = pulled_column(1.0, strain)
    pull = Pull.at(0.01, integrator, material)
    return pull.ends_in_error(surface, math.ceil(duration / pull.step))


def first_detachment(
    integrator: str, material: Material, n: int = 8, count: int | None = None
) -> Outcome:
    """Compare the first detachment on a flat surface with the lowest threshold, to rounding."""
    pull = Pull.at(0.2, integrator, material)
    surface = Surface.draw(Pattern.flat(n).contact, SEED, material)
    run, weakest = pull.simulate(surface, count), np.maximum(surface.mu_static, surface.mu_dynamic)
    first = run.t_first * material.omega_min * pull.speed
    return pull.judge(run, "first detachment, F_n/(K_s v)", first, weakest.min(), 1e-12)


def sizes(integrator: str) -> Iterator[Case]:
    """Yield surfaces from one block to a million."""
    case = partial(Case, "size", integrator)
    for n, speed, count in ((1, 0.01, None), (2, 0.01, None), (3, 0.01, None), (1000, 0.1, 60)):
        material = scattered(0.1, speed)
        attempt = partial(first_detachment, material=material, n=n, count=count)
        yield case(f"{n} x {n} blocks", n, attempt)


def overflows(integrator: str) -> Iterator[Case]:
    """Yield sliders that are too fast to be integrated."""
    case = partial(Case, "overflow", integrator)
    for name, n, speed in (
        ("speed whose energy overflows", 1, 1e160),
        ("largest speed", 1, 1e308),
        ("speed that tears the springs", 3, 1e160),
    ):
        yield case(name, speed, partial(too_fast, n=n, speed=speed), "raises")


def too_fast(integrator: str, n: int, speed: float) -> Outcome:
    """Take ten steps under a slider of this speed, m/s."""
    pull = Pull(integrator, replace(PAPER, slider_velocity=speed), 2e-8)
    return pull.ends_in_error(Surface.draw(Pattern.flat(n).contact, SEED), 10)
