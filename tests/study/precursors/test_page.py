"""The page on precursors has the values of its table, and refuses sentences that it contradicts."""

import pytest

from springblock.study.pages import rendered
from springblock.study.precursors.page import values
from study.precursors.chapter import rows

FINE = ("l = 5 µm", "l = 2.5 µm", "l = 1.25 µm")


def finer(rows, factor=0.5):
    """Rows whose lengths on finer lattices are less than the chain's."""
    ends = ("simulated", "simulated_low", "simulated_high")
    return [
        row | {end: factor * row[end] for end in ends}
        if row["quantity"] == "l_c" and row["what"] in FINE
        else row
        for row in rows
    ]


def test_the_page_compares_every_cell_with_its_prediction():
    found = values(finer(rows()))
    assert found["agreeing"] == len(found["lengths"]) - 2 * len(FINE)
    text = rendered("precursors/page.md", **found)
    assert "where a chain of thresholds without a fitted\nconstant gives 2.72, " in text
    assert "| scatter = 0.03 | together |  | 1.57 | 1.60 [1.52, 1.68] |" in text
    assert "| l = 5 µm | 7.78† | " in text
    assert "with l = 2.5 µm 2.0 times as\nlong as the simulation" in text


def test_a_length_that_the_chain_misses_is_refused():
    long = [row | {"simulated": 5.0} if row["quantity"] == "l_c" else row for row in rows()]
    for other in (long, rows()):  # the latter is right on finer lattices, too
        with pytest.raises(ValueError, match="the tables contradict"):
            rendered("precursors/page.md", **values(other))
