"""What every test may ask for."""

from pathlib import Path

import numpy as np
import pytest
import yaml


@pytest.fixture
def rng():
    """Random numbers, the same in every run."""
    return np.random.default_rng(2022)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished tiny study in a folder of its own."""
    from test_workflow import TINY, copied, snakemake

    folder = copied(tmp_path_factory.mktemp("study"))
    (folder / "tiny.yaml").write_text(yaml.safe_dump(TINY))
    outcome = snakemake(folder)
    assert outcome.returncode == 0, outcome.stderr
    return folder
