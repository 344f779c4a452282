"""springblock claims."""

import re

import pyarrow.parquet as pq
import pytest

from springblock.claims.rule import ENOUGH


def verdicts(table):
    return {row["claim"]: row["verdict"] for row in pq.read_table(table).to_pylist()}


@pytest.fixture
def outputs(tmp_path):
    return ("--configuration", "0123", "--output", tmp_path / "a", "--page", tmp_path / "page.md")


def test_statements_are_tested_on_what_was_simulated(springblock, batch, outputs, tmp_path):
    flat, table = batch(0, ENOUGH - 1), tmp_path / "realisations"
    springblock("aggregate", flat, "--configuration", "0123", "--output", table)
    springblock("claims", flat, "--realisations", table, *outputs)
    found = verdicts(tmp_path / "a")
    assert found["t_max < t_avg on flat surfaces"] != "not tested"
    assert found["Correlation length grows with n_p"] == "not tested"
    text = (tmp_path / "page.md").read_text(encoding="utf-8")
    listed = (
        r"\| \[\d+\. Correlation length grows with n_p\]\(#.+\) \| \*\*not tested\*\* \| Missing"
    )
    assert re.search(listed, text)


def test_surfaces_are_judged_by_enough_realisations(springblock, batch, outputs, tmp_path):
    """Those of two tables are the later one's, and of that one only surfaces with batches."""
    few, many, other = batch(0, 2), batch(0, ENOUGH - 1), batch(0, ENOUGH - 1, "--direction", 30)
    tables = {}
    for name, batches in (("few", [few]), ("many", [many]), ("others", [many, other])):
        tables[name] = tmp_path / name
        springblock("aggregate", *batches, "--configuration", "0123", "--output", tables[name])

    def counted(flat, *names):
        given = [word for name in names for word in ("--realisations", tables[name])]
        springblock("claims", flat, *given, *outputs)
        rows = pq.read_table(tmp_path / "a").to_pylist()
        name = "t_max < t_avg on flat surfaces"
        return [row["realisations"] for row in rows if row["claim"] == name]

    assert counted(few, "few") == [0]  # not tested
    assert counted(many, "few", "many") == counted(many, "few", "others") == [ENOUGH]
