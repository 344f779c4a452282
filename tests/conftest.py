"""Fixtures for all tests."""

import fcntl
import os

import numba
import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import settings

if numba.config.DISABLE_JIT:
    import interpreted  # noqa: F401
from springblock.__main__ import main
from studies import Study

# The same draws in every run.
settings.register_profile("springblock", max_examples=25, deadline=None, derandomize=True)
settings.load_profile("springblock")


@pytest.fixture
def rng():
    """Random numbers, the same in every run."""
    return np.random.default_rng(2022)


@pytest.fixture(scope="session")
def springblock():
    """Call `springblock` with these words; return its output, or its refusal of bad input."""

    def call(*words, refused=False):
        outcome = CliRunner().invoke(main, [str(word) for word in words])
        assert (outcome.exit_code != 0) == refused, outcome.output
        assert outcome.exception is None or isinstance(outcome.exception, SystemExit)
        return outcome.output.splitlines()[-1] if refused else outcome.output

    return call


@pytest.fixture(scope="session")
def study(tmp_path_factory) -> Study:
    """A tiny study, run once for all processes of a test run; no test may change its results."""
    own = tmp_path_factory.getbasetemp()
    folder = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "study"
    with folder.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.exists():
            Study.begun(folder).run()
    return Study(folder)
