"""springblock claims."""

import re

import pyarrow.parquet as pq
import pytest


@pytest.fixture
def outputs(tmp_path):
    return ("--configuration", "0123", "--output", tmp_path / "a", "--page", tmp_path / "page.md")


def test_statements_are_tested_on_what_was_simulated(springblock, batch, outputs, tmp_path):
    flat, table = batch(0, 2), tmp_path / "realisations"
    springblock("aggregate", flat, "--configuration", "0123", "--output", table)
    springblock("claims", flat, "--realisations", table, *outputs)
    verdicts = {row["claim"]: row["verdict"] for row in pq.read_table(tmp_path / "a").to_pylist()}
    assert verdicts["t_max < t_avg on flat surfaces"] != "not tested"
    assert verdicts["Correlation length grows with n_p"] == "not tested"
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    listed = (
        r"\| \[\d+\. Correlation length grows with n_p\]\(#.+\) \| \*\*not tested\*\* \| Missing"
    )
    assert re.search(listed, text)


def test_stress_is_that_of_preludes(springblock, pillars, outputs, tmp_path):
    prelude, table = tmp_path / "prelude.npz", tmp_path / "realisations"
    springblock("aggregate", *pillars, "--configuration", "0123", "--output", table)
    springblock("prelude", "--n-blocks", 12, "--n-p", 6, "--n-s", 6, "--output", prelude)
    judged = {}
    for given in ((), ("--prelude", prelude)):
        springblock("claims", *pillars, "--realisations", table, *given, *outputs)
        rows = pq.read_table(tmp_path / "a").to_pylist()
        judged[given] = {row["claim"]: row["verdict"] for row in rows}
    name = "Edges across the sliding direction bear more"
    assert [verdicts[name] for verdicts in judged.values()] == ["not tested", "reproduced"]


def test_what_is_no_table_is_refused(springblock, batch, outputs, tmp_path):
    (text := tmp_path / "text").write_text("text")
    refusal = springblock("claims", batch(0, 2), "--realisations", text, *outputs, refused=True)
    assert "Parquet" in refusal
    assert list(tmp_path.iterdir()) == [text]
