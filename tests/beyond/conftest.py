"""Fewer bootstrap resamples, which leave intervals slightly less certain."""

import pytest


@pytest.fixture(autouse=True)
def fewer_resamples(monkeypatch):
    monkeypatch.setattr("springblock.analysis.statistics._RESAMPLES", 200)
