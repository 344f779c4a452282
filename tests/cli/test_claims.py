"""springblock make claims."""

import re

import pyarrow.parquet as pq

from springblock.study.claims.rule import ENOUGH


def judged(table):
    return {row["claim"]: row for row in pq.read_table(table).to_pylist()}


def test_statements_are_tested_on_what_was_simulated_if_it_is_enough(springblock, batch, tmp_path):
    outputs = ("--output", tmp_path / "a.parquet")
    springblock("make", "claims", batch(0, ENOUGH - 2), *outputs)
    found = judged(tmp_path / "a.parquet")
    assert found["t_max < t_avg on flat surfaces"]["verdict"] == "not tested"
    springblock("make", "claims", batch(0, ENOUGH - 1), *outputs)
    found = judged(tmp_path / "a.parquet")
    assert found["t_max < t_avg on flat surfaces"]["verdict"] != "not tested"
    assert found["t_max < t_avg on flat surfaces"]["realisations"] == ENOUGH
    assert found["Correlation length grows with n_p"]["verdict"] == "not tested"
    springblock("make", "claims", tmp_path / "a.parquet", "--output", tmp_path / "page.md")
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    assert re.search(r"\| Correlation length grows with n_p \|.+\*\*not tested\*\*", text)
