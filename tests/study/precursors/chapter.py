"""A table of precursors for tests: the registered predictions, and simulations close to them."""

from functools import cache
from pathlib import Path

import pandas as pd

from springblock.study.precursors.cases import AVALANCHES, CELLS, PASSAGES

REGISTER = Path(__file__).parents[3] / "docs/registration"
APART = 1.02  #: simulation over prediction
_QUANTITIES = ("c_1", "c_2", "c_3", "c_6", "l_c", "load")
_OF_FRONTS = ("c_5_um", "c_10_um", "c_15_um", "c_20_um", "reach", "scatter")


@cache
def rows():
    """Rows of the table `precursors`, with the columns that figures and page show."""
    chain, front = (pd.read_csv(REGISTER / f"{name}.csv") for name in ("chain", "front"))
    found = []
    for cell, (_, known) in zip(AVALANCHES, chain.iterrows(), strict=True):
        found += _of(cell, known, _QUANTITIES, known["t_1"])
    for cell, (_, known) in zip(PASSAGES, front.iterrows(), strict=True):
        if cell in CELLS["precursors-fronts"]:
            found += _of(cell, known, _OF_FRONTS, float("nan"))
    return found


def _of(cell, known, quantities, t_1):
    same = cell.setup.constants | {"edge": cell.shape, "what": cell.what, "seeds": cell.seeds}
    return [
        same
        | {"t_1": t_1, "quantity": name, "predicted": float(known[name])}
        | {f"simulated{end}": float(known[name]) * factor for end, factor in _ENDS.items()}
        for name in quantities
    ]


_ENDS = {"": APART, "_low": 0.95 * APART, "_high": 1.05 * APART}
