"""The page on precursors has the values of its table, and refuses sentences that it contradicts."""

import pytest

from springblock.study.pages import rendered
from springblock.study.precursors.page import values
from study.precursors.chapter import rows


def test_the_page_compares_every_cell_with_its_prediction():
    found = values(rows())
    assert found["agreeing"] == len(found["lengths"])
    text = rendered("precursors/page.md", **found)
    assert "where a chain of thresholds without a fitted\nconstant gives 2.72, " in text
    assert "| scatter = 0.03 | together |  | 1.57 | 1.60 [1.52, 1.68] |" in text
    assert "Chain and simulation agree within the interval, or 10 %, in" in text


def test_cells_that_disagree_are_named():
    changed = [
        row | {"simulated": 9.0, "simulated_low": 8.0, "simulated_high": 10.0}
        if (row["edge"], row["what"], row["quantity"]) == ("along", "mu_d = 0.8", "l_c")
        else row
        for row in rows()
    ]
    assert "not in mu_d = 0.8 along (" in rendered("precursors/page.md", **values(changed))


def test_a_length_that_the_chain_misses_is_refused():
    other = [row | {"simulated": 5.0} if row["quantity"] == "l_c" else row for row in rows()]
    with pytest.raises(ValueError, match="the tables contradict"):
        rendered("precursors/page.md", **values(other))
