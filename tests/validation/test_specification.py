"""The compiled solver, step by step, against the model in NumPy (`springblock.specification`)."""

from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from springblock import (
    Material,
    Pattern,
    Setup,
    Surface,
    compute_prelude,
    draw_friction,
    simulate,
    specification,
)
from springblock.model.direction import heading
from springblock.model.law import LawFile
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import HEAT, SQUARES, WORK, Samples, prepare, unpadded
from springblock.solver.law_file import FromFile
from springblock.solver.laws import SlipWeakening
from springblock.solver.loop import advance

STEP, ANGLE = 2e-8, 30.0
#: Loads a hundred times faster than the paper's: blocks soon detach, stop and detach again.
FAST = Material(slider_velocity=5e-2, gamma=5e4)
LAW_FILES = Path(__file__).parents[2] / "config/examples"
LAWS = {
    "coulomb": FAST,
    "no damping": replace(FAST, gamma=0.0),
    "slip": replace(FAST, law="slip_weakening", slip_distance=2e-8),
    "no healing": replace(FAST, law="slip_weakening", slip_distance=2e-8, healing="none"),
    "slip within a step": replace(FAST, law="slip_weakening", slip_distance=3e-10),
    "velocity": replace(FAST, law="velocity_weakening", speed_scale=0.1),
    # so that some turn back within a step and slide on
    "slippery": replace(
        FAST, law="velocity_weakening", speed_scale=0.1, mu_static=0.02, mu_dynamic=0.01
    ),
}
FILES = {
    # with a floor above some mu_s
    "exponential, from a file": replace(
        FAST, law=LawFile.read(LAW_FILES / "exponential_weakening.py", floor=0.7)
    ),
    # with direct effects so strong that the creep before sliding exceeds rounding
    "rate and state": replace(
        FAST,
        law=LawFile.read(LAW_FILES / "rate_and_state.py", a=0.05, b_1=0.06, b_2=0.02),
        mu_static=0.0,
    ),
}
#: Bound on differences in one step: the polynomial of the springs has a relative error of 1.7e-9,
#: and springs change velocities by more than their values while blocks turn.
SERIES_ERROR = 1e-7
SURFACES = {
    "flat": Pattern.flat(5).contact,
    "pillars": Pattern.pillars(8, 3, 1).contact,
    "grooves": Pattern.pillars(6, 5, 1).grooved(2, 1, along="x").contact,
}


def scattered(contact, material, periodic):
    """Wide scatter: some blocks have mu_s < mu_d, and some nearly no friction."""
    wide = {
        "mu_static_std": 0.3 * material.mu_static,
        "mu_dynamic_std": min(0.2, 0.5 * material.mu_dynamic),
    }
    mu = draw_friction(contact.shape, 1, replace(material, **wide), periodic)
    return Surface(contact, *mu, periodic)


class Kernel:
    """The compiled integrator, a step at a time, seen in SI units."""

    def __init__(self, surface, material, integrator):
        self.material, self.integrator, self.k = material, INTEGRATORS[integrator], 0
        how = heading(ANGLE), self.integrator, STEP
        self.state, self.constants = prepare(surface, material, *how)

    def advance(self):
        """Take a step; what the ledger holds is of this step alone."""
        samples = Samples.empty(1)
        self.state.ledger[:] = 0.0
        how = self.integrator, self.state, self.constants
        assert advance(*how, self.k, 1, 1, samples)[0] == 1
        self.k += 1
        return self.seen(int(samples.switches[0]))

    def seen(self, switches=0):
        """The state of all blocks as the specification has it."""
        m, spacing, law = self.material, self.material.spacing, self.state.law
        blocks, ledger = self.state.blocks, self.state.ledger
        fields = [unpadded(field, self.constants.grid) for field in blocks]
        ux, uy, vx, vy, t_det = (np.array(field) for field in fields[:5])
        if isinstance(law, FromFile):
            names, kept = self.material.law.initial, law.state.T[:, : len(blocks.ux)]
        else:
            slip = getattr(law, "slip", np.zeros(len(blocks.ux)))[: len(blocks.ux)]
            names, kept = ["slip"], [spacing * slip]
        joule = m.mass * spacing**2 / (STEP * self.integrator.force_time(STEP, m.gamma))
        return specification.State(
            k=self.k,
            u=spacing * np.stack([ux, uy]),
            v=spacing / STEP * np.stack([vx, vy]),
            memory={
                name: np.array(unpadded(field, self.constants.grid))
                for name, field in zip(names, kept, strict=True)
            },
            t_det=STEP * t_det,
            switches=switches,
            work=joule * ledger[WORK],
            heat=joule * ledger[HEAT],
            path=spacing**2 / STEP * ledger[SQUARES],
        )


def assert_same(found, exact, scale, name, error=SERIES_ERROR):
    np.testing.assert_allclose(found, exact, rtol=0.0, atol=error * scale, err_msg=name)


KEEPERS = [name for name, each in INTEGRATORS.items() if each.keeps_state]
#: All surfaces under Coulomb's law, and all laws on grooves.
STEPPED = [
    *product(INTEGRATORS, ["coulomb"], SURFACES, [False]),
    *product(INTEGRATORS, ["coulomb"], ["pillars"], [True]),
    *product(["leapfrog"], sorted(LAWS.keys() - {"coulomb", "no healing"}), ["grooves"], [True]),
    *product(["rk4"], sorted(LAWS.keys() - {"coulomb", "no healing"}), ["grooves"], [False]),
    *product(KEEPERS, [*FILES, "no healing"], ["grooves"], [False]),
]


@pytest.mark.parametrize(("integrator", "law", "name", "periodic"), STEPPED)
def test_each_step_is_that_of_the_specification(integrator, law, name, periodic):
    contact, material = SURFACES[name], {**LAWS, **FILES}[law]
    surface = scattered(contact, material, periodic)
    kernel = Kernel(surface, material, integrator)
    model = specification.Problem(surface, Setup(material, integrator, STEP), ANGLE)
    step = specification.SCHEMES[integrator]
    here, switches = kernel.seen(), 0
    keeps_state = isinstance(kernel.state.law, SlipWeakening | FromFile)
    for _ in range(150 * contact.size // contact.sum()):
        exact = step(model, replace(here, switches=0, work=0.0, heat=0.0, path=0.0))
        here = kernel.advance()
        speed = max(np.abs(here.v).max(), material.slider_velocity)
        assert_same(here.u, exact.u, STEP * speed, "displacement")
        assert_same(here.v, exact.v, speed, "velocity")
        np.testing.assert_array_equal(here.v == 0.0, exact.v == 0.0)
        np.testing.assert_array_equal(np.isinf(here.t_det), np.isinf(exact.t_det))
        known = np.isfinite(here.t_det)
        assert_same(here.t_det[known], exact.t_det[known], STEP, "t_det")
        for name in here.memory if keeps_state else ():
            found, kept = here.memory[name][contact], exact.memory[name][contact]
            assert_same(found, kept, max(abs(kept).max(), 1e-300), name)
        assert here.switches == exact.switches
        power = model.load.max() * speed * STEP * contact.size
        assert_same(here.work, exact.work, power, "work")
        assert_same(here.heat, exact.heat, power, "heat")
        assert_same(here.path, exact.path, STEP * speed**2 * contact.size, "damping")
        switches += here.switches
    assert np.isfinite(here.t_det[contact]).mean() > 0.9
    if law != "rate and state":
        assert switches > 1.2 * contact.sum()  # some have stopped and detached again
        assert law == "slippery" or not here.v[:, contact].all()


@pytest.mark.parametrize(
    ("integrator", "periodic", "surface"),
    [
        ("leapfrog", False, "pillars"),
        ("leapfrog", True, "grooves"),
        *((name, True, "pillars") for name in INTEGRATORS if name != "leapfrog"),
    ],
)
def test_whole_runs_are_those_of_the_specification(integrator, periodic, surface):
    """What the solver skips, stores and samples changes nothing, with a prelude or without."""
    contact = SURFACES[surface]
    drawn, setup = Surface.draw(contact, 1, periodic=periodic), Setup(FAST, integrator, STEP)
    *states, ahead = specification.follow(drawn, setup, ANGLE, steps=151)
    last = states[-1]
    known = np.isfinite(last.t_det) & contact
    assert known.sum() > 3
    slider = FAST.slider_velocity * STEP * np.outer(np.arange(1, 151), heading(ANGLE))
    pull = FAST.k_s * (slider * contact.size - [each.u.sum(axis=(1, 2)) for each in states])
    then = ahead if INTEGRATORS[integrator].staggered else last
    velocity, heat = (last.v + then.v) / 2, (last.heat + then.heat) / 2
    setup = replace(setup, sample_interval=STEP)
    for prelude in (None, compute_prelude(contact, setup, ANGLE, periodic)):
        run = simulate(drawn, setup, ANGLE, duration=150 * STEP, prelude=prelude)
        np.testing.assert_array_equal(np.isfinite(run.t_det), known)
        np.testing.assert_allclose(run.t_det[known], last.t_det[known], rtol=0.0, atol=1e-6 * STEP)
        switches = [each.switches for each in states]
        np.testing.assert_array_equal(np.cumsum(run.switches)[1:], switches)
        np.testing.assert_allclose(run.force[1:], np.hypot(*pull.T), rtol=SERIES_ERROR)
        for found, exact in ((run.displacement, last.u), (run.velocity, velocity)):
            assert_same(found, exact, abs(exact).max(), "motion")
        np.testing.assert_allclose(run.energy.friction, heat, rtol=SERIES_ERROR)
