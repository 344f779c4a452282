"""Ensembles, and what changes between them."""

from springblock.analysis.ensembles import Ensemble, extremes


def test_what_not_all_ensembles_have_is_no_parameter_that_changes():
    """As a constant of one law where another has none: there is no lowest value."""
    assert list(extremes([Ensemble({}, []), Ensemble({"d_c": 1e-8}, [])])) == []
