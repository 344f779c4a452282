"""What is said of errors follows from the tables."""

import pytest

from springblock.analysis.suspects import suspects
from springblock.io.identity import identity
from springblock.model.scene import Scene
from springblock.study.claims.flat import ensemble_error


def rows(errors, n_p=20):
    scene = identity(Scene(120, n_p, n_p))
    return [scene | {"seed": seed, "energy_error": e} for seed, e in enumerate(errors)]


def test_the_ensemble_error_falls_with_the_root_of_the_number_of_seeds():
    scatter = {"ci_low": -0.01984217, "ci_high": 0.01984217, "realisations": 100}
    assert ensemble_error(scatter, 100) == pytest.approx(0.01, rel=1e-6)
    assert ensemble_error(scatter, 25) == pytest.approx(0.02, rel=1e-6)


def test_a_residual_ten_times_that_of_its_scene_is_suspect():
    assert suspects(rows([1e-6, -3e-5, 3e-5]) + rows([1e-4, 3e-4], n_p=6)) == []
    (row,) = suspects(rows([1e-5, -1e-5, 1e-5, 2e-5, 1.2e-4]) + rows([1.2e-4] * 3, n_p=6))
    assert (row["n_p"], row["seed"]) == (20, 4)


@pytest.mark.parametrize("error", [6e-4, -6e-4, float("nan")])
def test_a_large_residual_or_none_is_suspect_even_where_all_are_alike(error):
    assert len(suspects(rows([error] * 3))) == 3
