"""Ensembles in Python are those of single runs, and show themselves."""

import sys
import threading

import numpy as np
import pytest

import springblock
from springblock import Pattern, Surface, ensemble, simulate
from springblock.analysis.statistics import mean_interval
from springblock.simulation.threads import in_threads

PATTERN = Pattern.pillars(8, n_p=2, n_s=2)


@pytest.fixture(scope="module")
def runs():
    return ensemble(PATTERN, seeds=3, snapshot_times=[1e-4])


def test_runs_of_an_ensemble_are_single_runs_in_the_order_of_their_seeds(runs):
    for seed, run in enumerate(runs):
        alone = simulate(Surface.draw(PATTERN.contact, seed=seed), snapshot_times=[1e-4])
        np.testing.assert_array_equal(run.force, alone.force)
        assert runs.table().loc[seed, "t_max"] == alone.t_max
    assert runs.means()["t_avg"] == mean_interval([run.t_avg for run in runs])


def test_a_table_without_pandas_says_what_to_install(runs, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ModuleNotFoundError, match="pip install pandas"):
        runs.table()


def test_everything_public_that_has_a_picture_shows_it_in_a_notebook(runs):
    for shown in (PATTERN, Surface.draw(PATTERN, seed=0), runs, runs[0], runs[0].fields):
        assert shown._repr_png_().startswith(b"\x89PNG")
        assert "8 x 8 blocks" in repr(shown)
    with pytest.raises(TypeError, match="plot draws runs, fields, patterns and surfaces, not 3"):
        springblock.plot(3)


def test_a_picture_of_runs_in_which_nothing_detaches_has_no_map():
    stuck = ensemble(PATTERN, seeds=2, duration=1e-6)
    assert [ax.axison for ax in springblock.plot(stuck).axes] == [True, False, True]


def test_a_run_becomes_a_dataset_where_xarray_is_installed(runs, monkeypatch):
    assert float(runs[0].to_xarray().force.max()) == runs[0].force.max()
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ModuleNotFoundError, match="xarray is missing: pip install xarray"):
        runs[0].to_xarray()


def test_tasks_run_at_the_same_time_and_their_errors_are_raised():
    both = threading.Barrier(2, timeout=30.0)  # passed only if two wait for each other
    assert sorted(in_threads([both.wait, both.wait], jobs=2)) == [0, 1]
    started = []

    def fails():
        started.append(1)
        raise ValueError("no surface")

    with pytest.raises(ValueError, match="no surface"):
        list(in_threads([fails] * 99, jobs=1))
    assert len(started) == 1


@pytest.mark.parametrize("name", ["seeds", "jobs"])
def test_an_ensemble_has_a_run_and_a_core(name):
    with pytest.raises(ValueError, match=f"^{name} must be at least 1, not 0"):
        ensemble(PATTERN, **{name: 0})
