"""What every test may ask for."""

import shutil

import numpy as np
import pytest
from click.testing import CliRunner

from springblock.cli import main
from studies import ROOT, Study


@pytest.fixture
def rng():
    """Random numbers, the same in every run."""
    return np.random.default_rng(2022)


@pytest.fixture(scope="session")
def springblock():
    """Call `springblock` with these words; return what it says, or its refusal of bad input."""

    def call(*words, refused=False):
        outcome = CliRunner().invoke(main, [str(word) for word in words])
        assert (outcome.exit_code != 0) == refused, outcome.output
        assert outcome.exception is None or isinstance(outcome.exception, SystemExit)
        return outcome.output.splitlines()[-1] if refused else outcome.output

    return call


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """A finished tiny study, with sources that a test may edit."""
    study = Study.begun(tmp_path_factory.mktemp("study"))
    shutil.copytree(ROOT / "src", study / "src")
    study.run()
    return study
