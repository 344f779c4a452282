"""A finished tiny study, and a copy of it for each fault."""

import pytest

from studies import FEWER, Study


@pytest.fixture(scope="session")
def undisturbed(finished) -> Study:
    """A finished study on one core, which no test changes."""
    return finished(
        "undisturbed", ("--cores", "1"), ("simulate", "aggregate", "correlations"), **FEWER
    )


@pytest.fixture
def study(undisturbed, tmp_path) -> Study:
    """A finished study, to be disturbed."""
    return undisturbed.copied(tmp_path / "study")
