"""The end of the onset, the observables up to it, and the friction of sliding after it."""

import math

import numpy as np
import pytest

from specimens import drawn, flat
from springblock import Pattern, Setup, simulate
from springblock.analysis.statistics import prominence
from springblock.simulation import onset

PILLARS = Pattern.pillars(24, 6, 6)


@pytest.mark.parametrize("surface", [flat(24, 0), drawn(PILLARS, 0)], ids=["flat", "pillars"])
def test_the_end_of_a_run_does_not_depend_on_the_sample_interval(surface):
    """Dynamic friction was the mean over the bottom of the first oscillation."""
    runs = [simulate(surface, Setup(sample_interval=h)) for h in (2e-8, 1e-7, 2e-7, 4e-7, 2e-6)]
    assert {round(1e8 * run.time[-1]) for run in runs} == {round(1e8 * runs[0].onset_end)}
    assert np.isnan([run.dynamic_friction for run in runs]).all()


@pytest.mark.parametrize("seed", range(4))
def test_observables_of_the_onset_do_not_depend_on_the_duration(seed):
    surface = drawn(PILLARS, seed)
    short, long = simulate(surface), simulate(surface, duration=1.4e-3)
    for name in ("static_friction", "t_max", "t_avg", "onset_end"):
        assert getattr(short, name) == getattr(long, name)
    assert prominence(short.force) == prominence(long.force[long.onset])


@pytest.mark.parametrize("surface", [flat(12, 0), drawn(PILLARS, 0)], ids=["flat", "pillars"])
def test_dynamic_friction_is_that_of_the_sliding_surface(surface):
    """It is the mean coefficient where a run covers several loading cycles."""
    contact = surface.contact
    reloading = Setup().loading_time(
        contact, (surface.mu_static - surface.mu_dynamic)[contact].mean()
    )
    long = simulate(surface, duration=2.4e-3)
    assert long.dynamic_friction == pytest.approx(surface.mu_dynamic[contact].mean(), abs=0.02)
    start = 1.5 * np.nanmax(long.t_det)
    for share, is_known in ((0.98, False), (1.02, True)):
        run = simulate(surface, duration=start + share * reloading)
        assert math.isfinite(run.dynamic_friction) == is_known


@pytest.mark.parametrize(
    ("force", "has_dropped"),
    [
        ([0, 5, 10, 10, 10], False),  # no drop yet
        ([0, 10, 0, 0.9], False),  # risen by less than a tenth of the drop
        ([0, 10, 0, 1.1], True),
        ([0, 10, 9, 9.3], False),  # a wiggle beside the peak is no minimum
        ([3, 1, 10, 10], False),  # what precedes the peak does not count
    ],
)
def test_the_main_drop_has_passed_once_the_force_rises(force, has_dropped):
    assert onset._has_dropped(np.array(force, float), sliding=6.0) == has_dropped
