"""springblock make claims."""

import re

import pyarrow.parquet as pq
import pytest

from springblock.study.claims.rule import ENOUGH


def judged(table):
    return {row["claim"]: row for row in pq.read_table(table).to_pylist()}


@pytest.fixture
def outputs(tmp_path):
    return ("--output", tmp_path / "a.parquet")


def test_statements_are_tested_on_what_was_simulated(springblock, batch, outputs, tmp_path):
    springblock("make", "claims", batch(0, ENOUGH - 1), *outputs)
    found = judged(tmp_path / "a.parquet")
    assert found["t_max < t_avg on flat surfaces"]["verdict"] != "not tested"
    assert found["t_max < t_avg on flat surfaces"]["realisations"] == ENOUGH
    assert found["Correlation length grows with n_p"]["verdict"] == "not tested"
    springblock("make", "claims", tmp_path / "a.parquet", "--output", tmp_path / "page.md")
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert re.search(r"\| Correlation length grows with n_p \|.+\*\*not tested\*\*", text)


def test_surfaces_are_judged_by_enough_realisations(springblock, batch, outputs, tmp_path):
    springblock("make", "claims", batch(0, ENOUGH - 2), *outputs)
    assert (
        judged(tmp_path / "a.parquet")["t_max < t_avg on flat surfaces"]["verdict"] == "not tested"
    )
