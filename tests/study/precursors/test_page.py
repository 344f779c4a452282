"""Page and figure of precursors show their table, made up of the registered predictions."""

from functools import cache
from itertools import chain

import numpy as np
import pandas as pd
import pytest

from springblock.io.rows import limits
from springblock.study.pages import rendered
from springblock.study.precursors.cases import AVALANCHES, CELLS, PASSAGES
from springblock.study.precursors.page import values
from springblock.study.results import FIGURES
from studies import ROOT

REGISTER = ROOT / "docs/registration"
APART = 1.02  #: simulation over prediction
#: Cells of each register, and what is shown of them.
REGISTERED = {
    "chain": (AVALANCHES, ("c_1", "c_2", "c_3", "c_6", "l_c", "load")),
    "front": (PASSAGES, ("c_5_um", "c_10_um", "c_15_um", "c_20_um", "reach", "scatter")),
}
FINE = ("l = 5 µm", "l = 2.5 µm", "l = 1.25 µm")


@cache
def rows():
    """Rows of the table `precursors`, with the columns that figures and page show."""
    found, simulated = [], [*chain.from_iterable(CELLS.values())]
    for file, (cells, quantities) in REGISTERED.items():
        register = pd.read_csv(REGISTER / f"{file}.csv").to_dict("records")
        for cell, known in zip(cells, register, strict=True):
            same = cell.setup.constants | {"edge": cell.shape, "what": cell.what}
            same |= {"seeds": cell.seeds, "t_1": cell.handed}
            for name in quantities if cell in simulated else ():
                value = APART * known[name]
                own = {"quantity": name, "predicted": known[name]}
                ends = limits("simulated", (value, 0.95 * value, 1.05 * value))
                found.append(same | own | ends)
    return found


def finer(rows):
    """Rows whose lengths on finer lattices are half of the chain's."""
    ends = ("simulated", "simulated_low", "simulated_high")
    return [
        row | {end: 0.5 * row[end] for end in ends}
        if row["quantity"] == "l_c" and row["what"] in FINE
        else row
        for row in rows
    ]


DRAWINGS = {
    "precursors_lengths": lambda: FIGURES["precursors_lengths"].function()(pd.DataFrame(rows()))
}


def test_lengths_stand_over_the_load_that_is_handed_on():
    """But where all blocks of an edge go together, and no length can be read."""
    lengths, _ = DRAWINGS["precursors_lengths"]().axes
    shown = np.vstack([bars.lines[0].get_xydata() for bars in lengths.containers])
    known = pd.DataFrame(rows()).query("quantity == 'l_c'").dropna(subset="predicted")
    assert len(shown) == len(known) < len(AVALANCHES)
    assert sorted(shown[:, 1]) == pytest.approx(sorted(APART * known["predicted"]))
    handed = (known["mu_static"] - known["mu_dynamic"]) * known["t_1"]
    handed /= np.sqrt(2.0) * known["mu_static_std"]
    assert sorted(shown[:, 0]) == pytest.approx(sorted(handed))


def test_fronts_are_shown_on_two_lattices_beside_the_theory_of_the_finer():
    _, fronts = DRAWINGS["precursors_lengths"]().axes
    assert len(fronts.containers) == 4
    lines = [line.get_xydata() for line in fronts.get_lines() if len(line.get_xdata()) == 5]
    assert [tuple(line[0]) for line in lines] == [(0.0, 1.0)] * 2


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
