"""Realisations whose balance of energy does not close are named."""

import pytest

from springblock.analysis.suspects import suspects
from springblock.io.identity import identity
from springblock.model.scene import Scene


def rows(errors, n_p=20):
    scene = identity(Scene(120, n_p, n_p))
    return [scene | {"seed": seed, "energy_error": e} for seed, e in enumerate(errors)]


def test_a_residual_ten_times_that_of_its_scene_is_suspect():
    assert suspects(rows([1e-6, -3e-5, 3e-5]) + rows([1e-4, 3e-4], n_p=6)) == []
    (row,) = suspects(rows([1e-5, -1e-5, 1e-5, 2e-5, 1.2e-4]) + rows([1.2e-4] * 3, n_p=6))
    assert (row["n_p"], row["seed"]) == (20, 4)


@pytest.mark.parametrize("error", [6e-4, -6e-4, float("nan")])
def test_a_large_residual_or_none_is_suspect_even_where_all_are_alike(error):
    assert len(suspects(rows([error] * 3))) == 3
