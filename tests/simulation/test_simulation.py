"""`simulate`: its arguments, its errors and its results."""

import math
import re
import sys
from dataclasses import fields, replace

import numpy as np
import pytest

from specimens import bits, drawn, flat, uniform
from springblock import (
    Material,
    Pattern,
    Setup,
    SimulationError,
    Surface,
    compute_prelude,
    simulate,
)
from springblock.model.defaults import STEP
from springblock.simulation.run import percent
from springblock.solver.integrators import INTEGRATORS, limit
from springblock.specification import follow

PAPER = Material()
N = 12
PILLARS = Pattern.pillars(N, 4, 2)
PAUSE = 10  #: sample intervals between two looks at whether the run may end
STABLE = {name: limit(name, PAPER) for name in INTEGRATORS}


@pytest.fixture(scope="module")
def run():
    """A run without duration on a patterned surface."""
    return simulate(drawn(PILLARS, seed=1))


def assert_alike_while_both_last(one, other):
    n = min(len(one.time), len(other.time))
    for name in ("time", "force", "detachments", "switches"):
        np.testing.assert_array_equal(getattr(one, name)[:n], getattr(other, name)[:n])


@pytest.mark.parametrize("velocity", [1e-2, 5e-2])
def test_samples_are_close_enough_for_static_friction_however_fast_the_slider(velocity):
    """With 2e-7 s between samples it would be 3.6 % too low at the larger velocity."""
    material = Material(slider_velocity=velocity)
    surfaces = [drawn(PILLARS, seed, material) for seed in range(4)]
    usual, every_step = Setup(material), Setup(material, sample_interval=STEP)
    assert usual.interval == pytest.approx(max(STEP, 1e-7 * 1e-2 / velocity))
    found, exact = (
        np.mean([simulate(surface, setup).static_friction for surface in surfaces])
        for setup in (usual, every_step)
    )
    assert exact * (1.0 - 2e-3) < found <= exact


@pytest.mark.parametrize(
    ("step", "constants", "interval"),
    [
        *((2e-8, {"slider_velocity": velocity}, 2e-7) for velocity in (5e-5, 5e-4, 5e-3)),
        (2e-8, {"mu_static": 0.0}, 2e-7),  # it creeps from the start
        (5e-9, {}, 2e-7),
        (3e-8, {}, 1.8e-7),
        (7e-9, {"slider_velocity": 1e-2}, 1.05e-7),
    ],
)
def test_the_default_interval_is_the_papers_and_a_multiple_of_the_step(step, constants, interval):
    """2e-7 s to the bit where it can be; the interval that a message names is accepted."""
    setup = Setup(Material(**constants), step=step)
    assert setup.interval == pytest.approx(interval, rel=1e-12)
    assert (setup.interval == 2e-7) == (interval == 2e-7)
    with pytest.raises(ValueError, match="must be a multiple of step") as refusal:
        Setup(step=step, sample_interval=3.3 * step)
    advised = float(re.search(r"such as (\S+) s", str(refusal.value))[1])
    assert Setup(step=step, sample_interval=advised).every == 3


# --- what a run answers


def test_detachments_count_each_contact_block_once_at_its_time(run):
    detached = np.isfinite(run.t_det)
    np.testing.assert_array_equal(detached, PILLARS.contact)
    assert run.detachments.sum() == detached.sum()
    for so_far, time in zip(np.cumsum(run.detachments), run.time, strict=True):
        times = run.t_det[detached]
        assert np.sum(times < time - STEP) <= so_far <= np.sum(times < time + STEP)
    assert (run.switches >= run.detachments).all()


def test_means_and_extremes_follow_from_the_fields(run):
    assert run.t_avg == pytest.approx(run.t_det[PILLARS.contact].mean(), rel=1e-14, abs=0)
    assert run.t_first == run.t_det[PILLARS.contact].min()
    assert run.static_friction == run.force.max() / run.normal_force
    assert run.force[run.time == run.t_max] == run.force.max()
    later = replace(run, force=np.append(run.force, 2.0), time=np.append(run.time, 1.0))
    assert (later.static_friction, later.t_max) == (run.static_friction, run.t_max)
    load = PAPER.pressure * (N * PAPER.spacing) ** 2
    assert run.normal_force == pytest.approx(load, rel=1e-14, abs=0)


def test_a_run_in_which_nothing_detaches_has_no_detachment_times():
    run = simulate(uniform(2, 1.0, 0.6), duration=1e-5)
    assert np.isnan([*run.t_det.flat, run.t_avg, run.t_first]).all()
    assert not run.detachments.any()
    assert run.t_max == run.time[-1] == pytest.approx(1e-5, rel=1e-14, abs=0)


def test_a_duration_of_whole_intervals_is_sampled_to_its_end():
    """Also where their quotient rounds down: 1.2e-7 s over 4e-8 s gives 2.9999999999999996."""
    for number, duration in ((3, 1.2e-7), (4, 1.6e-7)):
        run = simulate(uniform(2, 1.0, 0.6), Setup(sample_interval=4e-8), duration=duration)
        assert len(run.time) == number + 1
        assert run.time[-1] == pytest.approx(duration, rel=1e-14, abs=0)


def test_blocks_without_a_measured_value_are_not_in_contact():
    """They are masked, as SurfaceTopography leaves them; what lies below the mask is arbitrary."""
    holes = np.ma.masked_array(PILLARS.contact | True, mask=~PILLARS.contact)
    masked = np.ma.masked_array(np.full((N, N), 1e3), mask=~PILLARS.contact)
    for contact in (holes, holes.astype(int), list(holes)):
        surface = Surface(contact, masked, 0.6)
        np.testing.assert_array_equal(surface.contact, PILLARS.contact)
        np.testing.assert_array_equal(surface.mu_static, 1e3 * PILLARS.contact)
    full = np.ones((N, N), bool)
    for how in (lambda mu: Surface(full, 1.0, mu), lambda mu: compute_prelude(full, mu_static=mu)):
        for mu in (masked, np.ma.masked):
            with pytest.raises(ValueError, match="not masked, on all blocks in contact"):
                how(mu)


@pytest.mark.parametrize("more", ["units", "unit", "dims"])
def test_arrays_that_mean_more_than_their_values_are_refused(more):
    """As those of pint, astropy and xarray: 60 % is not 60, and (x, y) is not (y, x)."""
    labelled = type("Labelled", (np.ndarray,), {more: "percent"})
    values = np.full((2, 2), 60).view(labelled)
    for surface in ({"contact": values}, {"mu_static": values}):
        with pytest.raises(TypeError, match=f"must be a plain array, without {more} = percent"):
            pull(**surface)


def test_coefficients_and_masks_may_have_any_numeric_type():
    """Outside the contact coefficients are ignored."""
    contact, mu_static = PILLARS.contact.copy(), drawn(PILLARS, seed=1).mu_static
    mu_dynamic = np.full((N, N), 0.6)
    plain = simulate(Surface(contact, mu_static, mu_dynamic), duration=1.5e-4)
    for mask, static, dynamic in (
        (contact.tolist(), mu_static.tolist(), np.where(contact, 0.6, np.nan)),
        (contact.astype(np.uint8), mu_static, 0.6),
        (contact, mu_static.astype(np.longdouble), mu_dynamic.astype(np.longdouble)),
    ):
        numbers = simulate(Surface(mask, static, dynamic), duration=1.5e-4)
        assert bits(plain) == bits(numbers)
        assert (numbers.contact == contact).all()
    surface = Surface(contact, mu_static, mu_dynamic)
    mu_static[:], contact[:] = np.nan, False  # a surface keeps what was checked
    assert bits(plain) == bits(simulate(surface, duration=1.5e-4))


def test_static_friction_of_a_rectangle_is_that_of_its_blocks():
    """The normal force is P l² N_y N_x; like blocks let go together, at mu_s F_n each."""
    surface = Surface(np.ones((3, 7), bool), 0.9, 0.5)
    run = simulate(surface, duration=1.6e-4)
    assert run.normal_force == pytest.approx(PAPER.pressure * PAPER.spacing**2 * 21)
    assert run.static_friction == pytest.approx(0.9, rel=0.01)


# --- when a run ends


def test_a_run_ends_with_the_onset(run):
    assert run.onset_end == run.time[-1] > np.nanmax(run.t_det)
    before = simulate(drawn(PILLARS, seed=1), duration=run.time[-1 - PAUSE])
    assert math.isnan(before.onset_end)
    assert_alike_while_both_last(run, before)


def test_a_run_with_small_oscillations_ends_after_the_first():
    """mu_d = mu_s: without a stress drop, blocks oscillate by K_s v/omega about mu_d F_n."""
    run = simulate(uniform(2, 0.6, 0.6))
    ripple = PAPER.k_s * PAPER.slider_velocity / PAPER.omega_min / PAPER.block_load
    assert run.static_friction == pytest.approx(0.6 + ripple, abs=ripple)
    longer = simulate(uniform(2, 0.6, 0.6), duration=2.0 * run.t_first)
    assert longer.dynamic_friction == pytest.approx(0.6, abs=ripple)
    period = 2.0 * math.pi / PAPER.omega_min
    assert 0.0 < run.time[-1] - run.t_first < period + (PAUSE + 1) * 2e-7


def test_a_run_whose_force_never_drops_lasts_half_as_long_again():
    """Overdamped, gamma > 2 omega: the force tends to mu_d F_n + gamma m v from below."""
    thick = Material(gamma=1e8)
    run = simulate(uniform(2, 0.6, 0.6), Setup(thick))
    rounding = 1e-12 * run.t_first  # the last time is a multiple of the step, too
    assert 1.5 * run.t_first - rounding < run.time[-1] <= 1.5 * run.t_first + (PAUSE + 1) * 2e-7
    drag = thick.gamma * thick.mass * thick.slider_velocity / thick.block_load
    assert run.static_friction == pytest.approx(0.6 + drag, rel=1e-3)  # gamma h = 2
    assert run.dynamic_friction == pytest.approx(run.static_friction, rel=1e-3)


# --- what is refused


def array(value, dtype=float, shape=(2, 2)):
    return np.full(shape, value, dtype)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"contact": array(1.0)}, "contact must be an array of bool, or of 0 and 1"),
        ({"contact": array(True, bool, (2,))}, r"contact must have the shape \(N_y, N_x\)"),
        ({"contact": array(True, bool, (2, 5000))}, r"\(2, 5000\); .* may have at most 4096"),
        ({"contact": array(False, bool)}, "contact is False everywhere"),
        ({"contact": [[0, 1], [1, -1]]}, "contact must hold bool, or 0 and 1, not -1"),
        ({"mu_static": array(1, bool)}, "mu_static must be an array of real numbers"),
        ({"mu_static": array(1.0, shape=(3, 3))}, r"mu_static must have the shape .* = \(2, 2\)"),
        ({"mu_static": math.nan}, "mu_static must be finite and not negative"),
        ({"mu_dynamic": array(1j, complex)}, "mu_dynamic must be an array of real numbers"),
        ({"mu_dynamic": array(-0.1)}, "mu_dynamic must be finite and not negative"),
        ({"surface": array(True, bool)}, "surface must be a Surface, not array"),
        ({"setup": PAPER}, "setup must be a Setup, not Material"),
        ({"material": {"pressure": 5e4}}, "material must be a Material"),
        ({"integrator": "euler"}, f"must be one of {', '.join(INTEGRATORS)}, not 'euler'"),
        ({"direction": "z"}, "direction must be 'x', 'y' or an angle"),
        ({"periodic": 1}, "periodic must be True or False, not 1"),
        ({"periodic": True, "contact": array(True, bool, (2, 3))}, "each side .* at least 3"),
        ({"periodic": True, "contact": array(True, bool, (3, 2))}, "each side .* at least 3"),
        ({"step": 0.0}, "step must be finite and positive"),
        ({"step": 3e-8, "sample_interval": 2e-7}, "sample_interval must be a multiple of step"),
        ({"sample_interval": 5e-9}, "sample_interval must be a multiple of step"),
        ({"sample_interval": 1e308}, "sample_interval must be a multiple of step"),
        (
            {"material": Material(slider_velocity=0.2), "sample_interval": 1e-6},
            r"too long for slider_velocity = 0.2 m/s.* 2e-08 s",
        ),
        ({"duration": 1e-7}, "duration must be at least one sample_interval"),
        ({"duration": 1e9}, r"5e\+16 steps of 4 blocks would take 29 years"),
        ({"duration": "long", "snapshot_times": [2e-7]}, "duration must be a number"),
        ({"snapshot_times": ["2e-7"]}, "snapshot_times must be a number"),
        ({"snapshot_times": [3e-7]}, "snapshot_times must be a multiple of sample_interval"),
        ({"snapshot_times": [2e-7, 2e-7]}, "snapshot_times must be in ascending order"),
        ({"snapshot_times": [4e-6]}, "snapshot_times must lie within the duration"),
    ],
)
def test_invalid_arguments_are_refused_by_name(change, message):
    with pytest.raises((TypeError, ValueError), match=message):
        pull(**change)


def test_more_snapshots_than_memory_holds_are_refused():
    times = 2e-7 * np.arange(1, 10)
    with pytest.raises(ValueError, match="has 9 times; of 16777216 blocks at most 8 snapshots"):
        Setup().plan(np.ones((4096, 4096), bool), 1.0, snapshot_times=times)


def pull(**changes):
    """Two by two blocks, pulled for ten intervals."""
    blocks = {"contact": array(True, bool), "mu_static": 1.0, "mu_dynamic": 0.6, "periodic": False}
    surface = Surface(**{name: changes.pop(name, value) for name, value in blocks.items()})
    names = [field.name for field in fields(Setup) if field.name in changes]
    setup = Setup(**{name: changes.pop(name) for name in names})
    return simulate(**{"surface": surface, "setup": setup, "duration": 2e-6, **changes})


CORRELATED = {"correlation_length": 3e-5}


@pytest.mark.parametrize(
    ("drawn_with", "constants", "sentence"),
    [
        ({}, {"mu_static": 0.5}, "mu_static = 1.0, but the setup has 0.5"),
        ({}, {"mu_dynamic_std": 0.0}, "mu_dynamic_std = 0.05, but the setup has 0.0"),
        ({}, {"distribution": "weibull"}, "distribution = 'normal', but the setup has 'weibull'"),
        ({}, CORRELATED, "correlation_length = 0.0, but the setup has 3e-05"),
        (CORRELATED, {**CORRELATED, "spacing": 2e-5}, "spacing = 1e-05, but the setup has 2e-05"),
    ],
)
def test_a_surface_is_simulated_with_the_coefficients_it_was_drawn_with(
    drawn_with, constants, sentence
):
    """Its arrays may be given to any material, which then has no effect on them."""
    surface, setup = drawn(PILLARS, 1, Material(**drawn_with)), Setup(Material(**constants))
    for run in (simulate, lambda *given: next(follow(*given))):
        with pytest.raises(ValueError, match=f"^the surface was drawn with {sentence}; draw the"):
            run(surface, setup)
    given = Surface(surface.contact, surface.mu_static, surface.mu_dynamic)
    assert simulate(given, setup, duration=2e-6).steps > 0


@pytest.mark.parametrize("integrator", STABLE)
def test_a_step_is_stable_up_to_the_limit_of_the_highest_mode(integrator):
    below, above = 0.999 * STABLE[integrator], 1.001 * STABLE[integrator]
    assert pull(integrator=integrator, step=below, sample_interval=below).steps > 0
    with pytest.raises(ValueError, match=rf"unstable: {integrator} needs less than") as refusal:
        pull(integrator=integrator, step=above, sample_interval=above)
    named = float(str(refusal.value).split("less than ")[1].split()[0])
    assert named == pytest.approx(STABLE[integrator], rel=1e-3, abs=0)


@pytest.mark.parametrize("integrator", STABLE)
def test_a_spring_that_collapses_ends_the_run_with_time_and_place(integrator):
    """Under a thousand times the load, a block slips by several spacings when it detaches.

    The weakest block is the last of its row: the spring on its west, of block 2, collapses.
    """
    heavy = Material(pressure=5e7, slider_velocity=5.0)
    scene = flat(4, seed=0)
    assert np.argmin(scene.mu_static) == 4 * 1 + 3
    with pytest.raises(SimulationError, match=r"at t = .* block \(y, x\) = \(1, 2\)") as failure:
        simulate(scene, Setup(heavy, integrator))
    time = float(str(failure.value).split("t = ")[1].split()[0])
    first = scene.mu_static.min() * heavy.block_load / (heavy.k_s * heavy.slider_velocity)
    assert first < time < 1.1 * first


def test_a_run_whose_energy_overflows_is_refused():
    with pytest.raises(SimulationError, match="the energy is"):
        pull(material=Material(spacing=1e100))


@pytest.mark.parametrize("beyond", [-7, 3 * PAUSE + 1])
def test_a_run_lasts_until_its_last_snapshot_but_does_not_end_before_its_time(run, beyond):
    """The last snapshot is so many sample intervals beyond the end of the run without any.

    Each snapshot is the end of a shorter run.
    """
    scene, number = drawn(PILLARS, seed=1), len(run.time) - 1 + beyond
    times = [1e-4, number * 2e-7]
    watched = simulate(scene, snapshot_times=times)
    assert watched.snapshot_times == pytest.approx(times, rel=1e-14)
    assert_alike_while_both_last(watched, run)
    intervals = len(watched.time) - 1
    assert intervals == len(run.time) - 1 if beyond < 0 else number <= intervals <= number + PAUSE
    for time, u, v in zip(times, watched.snapshots, watched.fields.velocity, strict=True):
        shorter = simulate(scene, duration=time)
        assert_alike_while_both_last(watched, shorter)
        assert shorter.displacement.tobytes() == u.tobytes()
        assert shorter.velocity.tobytes() == v.tobytes()


def test_detachments_in_percent_are_of_the_blocks_that_detach(run):
    some = replace(run, t_det=np.where(run.t_det < np.nanmedian(run.t_det), run.t_det, np.nan))
    count = np.count_nonzero(np.isfinite(some.t_det))
    assert 0 < count < np.count_nonzero(some.contact)
    assert percent(some, np.array([0, count])).tolist() == [0.0, 100.0]


def test_a_run_is_summarised_in_one_line(run):
    said = f"static friction {run.static_friction:.4f}, t_max {1e6 * run.t_max:.1f} µs"
    assert repr(run) == f"<12 x 12 blocks: {said}, t_avg {1e6 * run.t_avg:.1f} µs>"
    assert repr(pull()).endswith("t_max 2.0 µs, nothing has detached>")


def test_progress_is_shown_on_a_terminal_or_on_request(capsys, monkeypatch):
    pull()
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    pull()
    assert capsys.readouterr().err == ""  # too short a run
    monkeypatch.setattr("springblock.simulation.simulate._SOON", 0.0)
    plain = pull(progress=False)
    assert capsys.readouterr().err == ""
    assert bits(plain) == bits(pull())
    said = capsys.readouterr()
    assert "10/10" in said.err
    assert said.out == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: False)
    pull(progress=True)
    assert "10/10" in capsys.readouterr().err
