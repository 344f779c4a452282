"""Laws of friction from files: closed forms, other solvers, and what they may not be."""

import math
import pickle
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from specimens import flat, uniform
from springblock import Material, Pattern, Surface, compute_prelude, simulate
from springblock.io.identity import identity
from springblock.model.law import LawFile
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup

EXAMPLES = Path(__file__).parents[2] / "config/examples"
EXPONENTIAL, AGEING = EXAMPLES / "exponential_weakening.py", EXAMPLES / "rate_and_state.py"
PAPER = Material(gamma=0.0, mu_static_std=0.0, mu_dynamic_std=0.0)
#: The lattice of one block: it hangs on the slider alone.
K_S, MASS, LOAD = PAPER.k_s, PAPER.mass, PAPER.block_load


def ageing(**constants):
    """A material whose blocks creep from the start."""
    return replace(PAPER, mu_static=0.0, law=LawFile.read(AGEING, **constants))


def one_block(material, duration, step=2e-8):
    surface = uniform(1, material.mu_static, material.mu_dynamic)
    return simulate(surface, Setup(material, step=step), duration=duration)


def test_slip_weakening_from_a_file_is_the_built_in_law(tmp_path):
    """Blocks slip, stop and slip again: the same states in the same steps, but for rounding."""
    file = tmp_path / "linear.py"
    file.write_text(
        "CONSTANTS = {'d_c': (2e-8, 'm')}\nSTATE = {'slip': 0.0}\n"
        "def friction(mu_static, mu_dynamic, slip, d_c):\n"
        "    return mu_dynamic + max(mu_static - mu_dynamic, 0.0) * max(1.0 - slip / d_c, 0.0)\n"
        "def update(slip, speed, step):\n    return slip + speed * step\n"
    )
    surface = flat(4, seed=2)
    own, built_in = (
        simulate(surface, Setup(Material(**law)), duration=2e-4)
        for law in ({"law": file}, {"law": "slip_weakening", "slip_distance": 2e-8})
    )
    assert built_in.switches.sum() > 1.5 * 16
    np.testing.assert_array_equal(own.switches, built_in.switches)
    np.testing.assert_allclose(own.t_det, built_in.t_det, rtol=1e-12)
    np.testing.assert_allclose(own.displacement, built_in.displacement, rtol=1e-9)


def test_ageing_converges_at_first_order_to_an_implicit_solver():
    """The creep before sliding is stiff: friction is that at the end of a step there."""
    material = replace(ageing(a=0.02, b_2=0.005, d_1=1e-8, d_2=3e-8), slider_velocity=5e-3)
    law = material.law

    def mu(speed, *theta):
        state = dict(zip(law.initial, theta, strict=True))
        known = {**law.constants, **state, "mu_dynamic": 0.6, "speed": speed}
        return law.friction(*(known[name] for name in law.arguments("friction")))

    def motion(t, state):
        slip, speed, *theta = state
        pull = K_S * (material.slider_velocity * t - slip)
        ages = (
            1.0 - speed * x / law.constants[d] for x, d in zip(theta, ("d_1", "d_2"), strict=True)
        )
        return speed, (pull - LOAD * mu(speed, *theta)) / MASS, *ages

    start = (0.0, 0.0, *law.initial.values())
    end = 2e-5
    scale = np.array([1e-12, 1e-9, 1e-9, 1e-9])
    exact = solve_ivp(motion, (0.0, end), start, "Radau", rtol=1e-10, atol=1e-10 * scale)
    runs = [one_block(material, end, step) for step in (2e-8, 1e-8, 5e-9)]
    slips = np.array([run.displacement[0, 0, 0] for run in runs])
    errors = slips / exact.y[0, -1] - 1.0
    assert abs(errors[-1]) < 1e-3
    assert errors[:-1] / errors[1:] == pytest.approx(2.0, rel=0.2)
    assert abs(runs[0].energy.relative_residual) < 1e-6


@pytest.mark.parametrize("faster", [0.1, 3.0, 100.0])
def test_a_step_in_velocity_raises_friction_at_once_and_lowers_it_along_the_slip(faster):
    """a ln(V_2/V_1), then Σ b ln(θ V_1/d) with θ = d/V_2 + (d/V_1 - d/V_2) exp(-slip/d)."""
    law = LawFile.read(AGEING)
    of = law.constants
    distances, before, after = np.array([of["d_1"], of["d_2"]]), of["v_0"], of["v_0"] * faster
    theta, step = distances / before, 1e-6
    for i in range(40):
        known = {**of, "mu_dynamic": 0.6, "speed": after, "step": step}
        known |= dict(zip(law.initial, theta, strict=True))
        slip = i * after * step
        left = distances * (1.0 / after + (1.0 / before - 1.0 / after) * np.exp(-slip / distances))
        evolved = np.log(left * before / distances) @ [of["b_1"], of["b_2"]]
        expected = 0.6 + of["a"] * math.log(faster) + evolved
        found = law.friction(*(known[name] for name in law.arguments("friction")))
        assert found == pytest.approx(expected, rel=1e-10)
        theta = law.update(*(known[name] for name in law.arguments("update")))


@pytest.mark.parametrize("softer", [0.85, 1.15])
def test_a_block_sticks_and_slips_below_a_critical_stiffness(softer):
    """K_s < F_n (b - a)/d (1 + m V²/(F_n a d)): Rice & Ruina 1983, doi:10.1115/1.3167042.

    With d in the place of the stiffness: `softer` is its ratio to the d at which they are equal.
    """
    a, b, speed = 0.01, 0.02, PAPER.slider_velocity
    inertia = MASS * speed**2 / (LOAD * a)
    ratio = LOAD * (b - a) / K_S
    critical = 0.5 * ratio + math.sqrt(0.25 * ratio**2 + ratio * inertia)
    d = softer * critical
    law = {"a": a, "b_1": b, "b_2": 0.0, "d_1": d, "v_0": speed, "theta_0": d / speed}
    run = one_block(ageing(**law), 3e-4)
    late = (run.force / run.normal_force)[3 * len(run.force) // 4 :]
    assert (np.ptp(late) > 0.1) == (softer < 1.0)
    if softer > 1.0:
        assert np.ptp(late) < 2e-3


@pytest.mark.parametrize("law", [EXPONENTIAL, AGEING], ids=lambda file: file.stem)
def test_energy_closes_and_nothing_depends_on_a_prelude(law):
    stuck = {"mu_static": 0.0, "mu_static_std": 0.0} if law == AGEING else {}
    material = Material(law=law, slider_velocity=5e-3, **stuck)
    pattern = Pattern.pillars(24, 4, 4).contact
    surface = Surface.draw(pattern, seed=3, material=material)
    how = {"setup": Setup(material), "duration": 3e-5}
    run = simulate(surface, **how)
    assert abs(run.energy.relative_residual) < 1e-3
    again = simulate(surface, **how, prelude=compute_prelude(pattern, Setup(material)))
    np.testing.assert_array_equal(again.displacement, run.displacement)
    np.testing.assert_array_equal(again.switches, run.switches)
    # preludes sum the blocks of a row in another order
    np.testing.assert_allclose(again.force, run.force, rtol=1e-14)


FRICTION = "def friction(mu_dynamic):\n    return mu_dynamic\n"
CONSTANTS, STATE = "CONSTANTS = {{{}}}\n" + FRICTION, "STATE = {{{}}}\n" + FRICTION
OF_SPEED = "def friction(speed):\n    return {}\n"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("friction = 1\n", "must define the function friction"),
        ("1 / 0\n" + FRICTION, "cannot be run: ZeroDivisionError"),
        ("import sys\nsys.exit(0)\n", r"cannot be run: SystemExit\(0\)"),
        ("def friction(:\n", "cannot be run: SyntaxError"),
        ("# coding: latin-99\n" + FRICTION, "cannot be read: unknown encoding"),
        ("def friction(mu):\n    return mu\n", "argument 'mu'; choose from mu_static, mu_dynamic"),
        (CONSTANTS.format("'a': 1.0"), r"CONSTANTS\['a'\] must be \(number, unit\)"),
        (CONSTANTS.format("'speed': (1.0, '')"), "the name 'speed' has two meanings"),
        (CONSTANTS.format("'gamma': (1.0, '')"), "'gamma' is a constant of the material"),
        ("STATE = ['s']\n" + FRICTION, "STATE must be a dictionary"),
        (STATE.format("'s': 'a'"), r"STATE\['s'\] must be a number or the name of"),
        (STATE.format("'s': 0.0"), "must define the function update"),
        (STATE.format("'s': 0.0") + "def update(s):\n    return s, s\n", "must return 1 finite"),
        (OF_SPEED.format("-1.0"), r"not negative, not -1.0 at rest \(speed = 0\)"),
        (OF_SPEED.format("1.0 / speed"), r"friction fails at rest \(speed = 0\): ZeroDivision"),
        (OF_SPEED.format("len({1: speed, 'a': 2})"), "cannot be compiled by numba"),
    ],
)
def test_a_file_that_is_no_law_is_refused_in_one_sentence(text, sentence, tmp_path):
    file = tmp_path / "law.py"
    file.write_text(text)
    with pytest.raises(ValueError, match=sentence) as refused:
        one_block(Material(law=file), 1e-6)
    assert re.match(rf"{re.escape(str(tmp_path))}/law.py|law-[0-9a-f]{{8}}", str(refused.value))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("friction", "update", "sentence"),
    [
        # not with the mean coefficient
        ("{} + checked(slip * (mu_dynamic != 0.6))", "{}", "friction fails{}: ValueError"),
        ("{}", "{} if slip < 1e-8 else inf", "update must return 1 finite numbers, not inf"),
    ],
)
def test_a_law_that_fails_within_a_run_ends_it_in_one_sentence(
    springblock, friction, update, sentence, tmp_path
):
    """In Python's words, with the state and the speed; nothing is written."""
    file = tmp_path / "law.py"
    file.write_text(
        "from math import inf\nSTATE = {'slip': 0.0}\n"
        f"def friction(mu_dynamic, slip):\n    return {friction.format('mu_dynamic')}\n"
        f"def update(slip, speed, step):\n    return {update.format('slip + speed * step')}\n"
        "def checked(slip):\n    if slip > 1e-8:\n        raise ValueError('beyond the data')\n"
        "    return 0.0\n"
    )
    run = ("simulate", "--n-blocks", 2, "--slider-velocity", "5e-2", "--law", file)
    said = springblock(*run, "--output", tmp_path / "run.parquet", refused=True)
    where = r" at 0\.\d+ m/s with slip = \d\.\d+e-\d+"
    assert re.search(rf": before t = \S+ s: {file}: {sentence.format(where)}", said)
    assert re.search(where, said)
    assert list(tmp_path.iterdir()) == [file]


def test_what_turns_negative_or_holds_forever_is_refused(tmp_path):
    surface, fast = uniform(1, 1.0, 0.6), {"slider_velocity": 5e-2}
    (tmp_path / "firm.py").write_text("def friction(mu_static):\n    return 100.0 * mu_static\n")
    with pytest.raises(RuntimeError, match="1 contact blocks have not detached; if this is"):
        simulate(surface, Setup(Material(law=tmp_path / "firm.py", **fast)))
    falling = "STATE = {'s': 0.5}\ndef friction(s):\n    return s\n"
    falling += "def update(s, speed):\n    return s - speed\n"
    (tmp_path / "falling.py").write_text(falling.replace("- speed", "- 0.1 * (speed < 1.0)"))
    with pytest.raises(
        RuntimeError, match=r"falling.py: friction must return one number, .* not -0\."
    ):
        simulate(surface, Setup(Material(law=tmp_path / "falling.py", **fast)))
    with pytest.raises(ValueError, match="integrator must be leapfrog with the law exponential"):
        Setup(Material(law=EXPONENTIAL), integrator="rk4")
    (tmp_path / "taken.py").write_text(CONSTANTS.format("'seed': (1.0, '')"))
    with pytest.raises(ValueError, match="'seed' is a column of tables; rename it"):
        identity(Scene(4, law=tmp_path / "taken.py"))
    with pytest.raises(ValueError, match=r"gone.py does not exist"):
        LawFile.read(tmp_path / "gone.py")
    with pytest.raises(ValueError, match="floor must be a finite number, not nan"):
        LawFile.read(EXPONENTIAL, floor=math.nan)
    with pytest.raises(ValueError, match=r"unknown constant 'd_1'; choose from d_0, floor"):
        Material(law=EXPONENTIAL).vary({"d_1": 1.0})


def test_tables_and_other_processes_keep_the_law_with_its_constants():
    law = LawFile.read(AGEING, a=0.02)
    material = Material(law=law)
    Setup(material)  # runs the file
    assert pickle.loads(pickle.dumps(material)) == material
    kept = LawFile.named(law.described)
    assert kept.constants == law.constants
    assert kept.units == law.units
    assert kept.described == law.described
    assert LawFile.read(AGEING) != law
    assert law.vary({"b_1": 0.03}).constants == {**law.constants, "b_1": 0.03}
    with pytest.raises(ValueError, match="not available, only its name"):
        Setup(Material(law=law.described))


def test_a_law_is_another_one_when_a_file_that_it_lists_changes(tmp_path):
    file, data = tmp_path / "law.py", tmp_path / "mu.txt"
    file.write_text(
        "from pathlib import Path\nimport numpy as np\nINPUTS = ['mu.txt']\n"
        "def mu(factor=np.loadtxt(Path(__file__).with_name('mu.txt'))[-1]):\n    return factor\n"
        "def friction(mu_dynamic):\n    return mu_dynamic * mu()\n"
    )
    names = []
    for last in (1.0, 1.0, 1.5):
        np.savetxt(data, [*np.ones(2000), last])
        names.append(LawFile.read(file).name)
    assert names[0] == names[1] != names[2]
    data.unlink()
    file.write_text("INPUTS = ['mu.txt']\n" + FRICTION)
    with pytest.raises(ValueError, match=r"law.py: INPUTS must be a list of files: .*mu.txt"):
        LawFile.read(file)
