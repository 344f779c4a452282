"""Stored reference solutions are those that the reference computes, and those of the benchmarks."""

import numpy as np
import pytest

from benchmarks.verification.problems import PROBLEMS, read_reference
from springblock.accuracy import solutions
from springblock.accuracy.conventions import SAMPLE_INTERVAL
from springblock.accuracy.solutions import FILE, SMALL, refuse_changed, solve, stored


def test_the_solutions_are_stored_in_a_small_file():
    runs = [(row["scene"], row["seed"]) for row in stored()]
    assert runs == [(scene, seed) for scene, small in SMALL.items() for seed in range(small.seeds)]
    assert FILE.stat().st_size < 300_000


def test_the_quickest_solution_comes_out_as_stored():
    recorded = next(row for row in stored() if (row["scene"], row["seed"]) == ("grooved", 0))
    row = solve("grooved", 0)
    refuse_changed([row], [recorded])
    with pytest.raises(ValueError, match=r"^grooved, seed 0: t_avg differs from the stored"):
        refuse_changed([row | {"t_avg": 1.00001 * row["t_avg"]}], [recorded])
    with pytest.raises(ValueError, match=r"^grooved, seed 0: t_det differs from the stored"):
        refuse_changed([row | {"t_det": [np.nan, *row["t_det"][1:]]}], [recorded])


@pytest.mark.parametrize("name", ["pillared", "grooved"])
def test_solutions_agree_with_those_that_other_codes_are_compared_with(name):
    """The same surfaces, solved there to smaller tolerances and sampled every 2e-7 s."""
    problem, reference = PROBLEMS[name], read_reference(PROBLEMS[name])
    found = solutions.solutions(name)[problem.seed]
    assert problem.pattern == SMALL[name].pattern
    late = ~(reference.t_det < SMALL[name].duration)
    assert (np.isnan(found.t_det) == late).all()
    apart = np.abs(found.t_det - reference.t_det)[~late]
    assert (apart <= reference.t_det_uncertainty[~late] + 1e-14).all()
    both = SAMPLE_INTERVAL * 5.0  # 4e-7 s, a multiple of both intervals
    assert both == pytest.approx(2.0 * problem.time[1])
    here, there = found.force[::5], reference.force[::2]
    by = reference.force_uncertainty[::2][: len(here)]
    assert (np.abs(here - there[: len(here)]) <= by + 1e-7 * there.max()).all()


def test_solutions_of_another_material_or_code_are_refused(monkeypatch):
    monkeypatch.setattr(solutions, "SAMPLE_INTERVAL", 1e-7)
    with pytest.raises(ValueError, match="holds solutions of other constants, surfaces or code"):
        stored()
