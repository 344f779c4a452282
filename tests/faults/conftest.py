"""A finished tiny study, and a copy of it for each fault to be tried on."""

import pytest

from faults.studies import Study, copy


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory) -> Study:
    """A finished study, which no test changes."""
    study = Study.begun(tmp_path_factory.mktemp("faults") / "study")
    study.run()
    return study


@pytest.fixture
def study(undisturbed, tmp_path) -> Study:
    """A finished study, to be disturbed."""
    return copy(undisturbed, tmp_path / "study")
