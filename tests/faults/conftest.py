"""A finished tiny study, and a copy of it for each fault to be tried on."""

import pytest
from click.testing import CliRunner

from faults.studies import Study, copy
from springblock.cli import main


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


@pytest.fixture(scope="session")
def springblock():
    """Call `springblock` with these words; return the exit status and what it says."""

    def call(*words) -> tuple[int, str]:
        outcome = CliRunner().invoke(main, [str(word) for word in words])
        assert outcome.exception is None or isinstance(outcome.exception, SystemExit), outcome
        return outcome.exit_code, outcome.output

    return call
