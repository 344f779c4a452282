"""Ensembles, and what changes between them."""

import numpy as np
import pytest

from springblock.analysis.ensembles import Change, Ensemble, from_first


def test_what_not_all_ensembles_have_is_no_parameter_that_changes():
    """As a constant of one law where another has none: it has one value."""
    assert list(from_first([Ensemble({}, []), Ensemble({"d_c": 1e-8}, [])])) == []


def test_a_change_is_that_of_the_seeds_that_have_a_value():
    """Dynamic friction is not defined for a run that ends early."""
    first, second = (
        Ensemble({}, [{"seed": seed, "mu": mu} for seed, mu in enumerate(values)])
        for values in ((0.5, 0.6, np.nan, 0.7), (0.6, 0.8, 0.9, np.nan))
    )
    assert Change({}, first, second, paired=True).of("mu").mean == pytest.approx(0.15)
    assert Change({}, first, second, paired=False).of("mu").mean == pytest.approx(2.3 / 3 - 0.6)
