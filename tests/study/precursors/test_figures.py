"""The figure of precursors shows every cell of its table, and the theory beside it."""

from functools import cache

import numpy as np
import pandas as pd
import pytest

from springblock.study.precursors.cases import AVALANCHES
from springblock.study.results import FIGURES
from study.precursors.chapter import APART, rows

DRAWINGS = {
    "precursors_lengths": lambda: FIGURES["precursors_lengths"].function()(pd.DataFrame(rows()))
}
drawn = cache(lambda name: DRAWINGS[name]())


def test_lengths_stand_over_the_load_that_is_handed_on():
    """But where all blocks of an edge go together, and no length can be read."""
    lengths = drawn("precursors_lengths").axes[0]
    shown = np.vstack([bars.lines[0].get_xydata() for bars in lengths.containers])
    known = pd.DataFrame(rows()).query("quantity == 'l_c'").dropna(subset="predicted")
    assert len(shown) == len(known) < len(AVALANCHES)
    assert sorted(shown[:, 1]) == pytest.approx(sorted(APART * known["predicted"]))
    handed = (known["mu_static"] - known["mu_dynamic"]) * known["t_1"]
    handed /= np.sqrt(2.0) * known["mu_static_std"]
    assert sorted(shown[:, 0]) == pytest.approx(sorted(handed))


def test_fronts_are_shown_on_two_lattices_beside_the_theory_of_the_finer():
    fronts = drawn("precursors_lengths").axes[1]
    assert len(fronts.containers) == 4
    lines = [line.get_xydata() for line in fronts.get_lines() if len(line.get_xdata()) == 5]
    assert [tuple(line[0]) for line in lines] == [(0.0, 1.0)] * 2
