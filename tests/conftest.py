"""What every test may ask for."""

import shutil

import numpy as np
import pytest

from studies import ROOT, Study


@pytest.fixture
def rng():
    """Random numbers, the same in every run."""
    return np.random.default_rng(2022)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """A finished tiny study, with sources that a test may edit."""
    study = Study.begun(tmp_path_factory.mktemp("study"))
    shutil.copytree(ROOT / "src", study / "src")
    study.run()
    return study
