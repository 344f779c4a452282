"""Refinement: the same surface on finer lattices, and what its friction is said to do."""

from types import SimpleNamespace

import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Texture, refine
from springblock.analysis import refine as module
from springblock.analysis.ensembles import OBSERVABLES
from springblock.analysis.refine import Refined
from springblock.analysis.runs import Runs


def refined(*means, scatter=1e-3):
    """Three runs a lattice, with these means of static friction and of all else."""

    def run(value):
        return SimpleNamespace(**dict.fromkeys(OBSERVABLES, value), contact=np.eye(2, dtype=bool))

    runs = [Runs(run(mean + scatter * i) for i in (-1, 0, 1)) for mean in means]
    return Refined([1e-5 / 2**i for i in range(len(means))], runs)


@pytest.mark.parametrize(
    ("means", "scatter", "word"),
    [
        ((0.70, 0.65, 0.62), 1e-3, "not converged"),
        ((0.70, 0.66, 0.659), 1e-3, "converged within 1 %"),
        ((0.70, 0.66, 0.659), 1e-2, "not settled"),
        ((0.66, 0.655, 0.60), 1e-2, "not converged"),
    ],
)
def test_friction_has_converged_where_halving_the_spacing_changes_less_than_a_percent(
    means, scatter, word
):
    assert refined(*means, scatter=scatter).verdict.startswith(word)


def test_the_observed_order_is_that_of_the_changes():
    found = refined(1.0 + 0.16, 1.0 + 0.04, 1.0 + 0.01)
    assert found.order == pytest.approx(2.0)
    assert "observed order 2.0; " in repr(found)
    assert np.isnan(refined(0.7, 0.68, 0.64).order)


def test_one_lattice_shows_no_convergence():
    with pytest.raises(ValueError, match="levels must be at least 2, not 1"):
        refine(Pattern.pillars(12, 3, 3), Setup(), levels=1)


@pytest.mark.parametrize(
    "surface", [Pattern.pillars(12, 3, 3), Texture("squares", 4e-5, 8e-5, 1.6e-4, 1e-5)]
)
def test_lengths_in_metres_are_those_of_the_first_lattice(surface, monkeypatch):
    """The mask, the disorder, and steps in units of the stability limit."""
    taken = []
    monkeypatch.setattr(module, "ensemble", lambda *given, **_: taken.append(given))
    refine(surface, Setup(Material(thickness=2e-5)), levels=3)
    masks = [np.asarray(mask) for mask, *_ in taken]
    setups = [setup for _, setup, *_ in taken]
    for parts, mask, setup in zip((1, 2, 4), masks, setups, strict=True):
        np.testing.assert_array_equal(mask, np.kron(masks[0], np.ones((parts, parts), bool)))
        assert setup.material.spacing * len(mask) == pytest.approx(1e-5 * len(masks[0]))
        assert setup.material.correlation_length == 1e-5
        assert setup.material.thickness == 2e-5
        limit = setups[0].step * setups[0].material.omega_max
        assert setup.step * setup.material.omega_max == pytest.approx(limit, rel=0.1)


def test_the_command_refuses_joined_edges_and_given_coefficients(springblock, tmp_path):
    """Which no finer lattice shares."""
    mu = tmp_path / "mu.npy"
    np.save(mu, np.full((4, 4), 0.5))
    given = ("--mu-static-field", mu, "--mu-dynamic-field", mu)
    for options in (("--edges", "periodic"), given):
        said = springblock("refine", "--n-blocks", 4, *options, refused=True)
        assert "refine needs free edges and coefficients that are drawn" in said
