"""A finished tiny study, and a copy of it for each fault to be tried on."""

from dataclasses import replace

import pytest

from studies import FEWER, Study


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory) -> Study:
    """A finished study on one core, which no test changes."""
    begun = Study.begun(tmp_path_factory.mktemp("faults") / "study", **FEWER)
    study = replace(begun, options=("--cores", "1"), targets=("aggregate", "correlations"))
    study.run()
    return study


@pytest.fixture
def study(undisturbed, tmp_path) -> Study:
    """A finished study, to be disturbed."""
    return undisturbed.copied(tmp_path / "study")
