"""The page on the mechanism, from its template and the tables."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import pandas as pd
from numpy.typing import ArrayLike

from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import mean_interval
from springblock.io.rows import listed, markdown_table

#: Names of the models on the page, each with one effect more than the one before.
NAMES = {
    "independent": "stress alone",
    "quasi_static": "load transfer",
    "overshooting": "overshoot",
    "simulation": "full model",
}
_STEPS = list(pairwise(NAMES))

Fields = dict[str, Any]  #: of the template, by name


def page(friction: pd.DataFrame, variants: pd.DataFrame) -> str:
    """Write the page from the tables of `surfaces.TABLES`, in their order."""
    text = Path(__file__).with_name("page.md").read_text(encoding="utf-8")
    return text.format(**_of_friction(friction), **_of_variants(variants))


def written(values: ArrayLike, digits: int) -> str:
    """Format the mean of values with its 95 % interval."""
    mean, low, high = (f"{value:.{digits}f}" for value in mean_interval(values))
    return f"{mean} [{low}, {high}]"


def _of_friction(table: pd.DataFrame) -> Fields:
    """Return the fields on static friction by size of pillars."""
    sizes = table.groupby("n_p")
    means, variation = sizes[[*NAMES]].mean(), sizes["stress_variation"].first()
    error = 100.0 * (means["overshooting"] / means["simulation"] - 1.0).abs()
    small = error.index[(error < 1.0).cummin()].max()
    lines, steps = [], []
    for n_p, part in sizes:
        values = [written(part[name], 4) for name in NAMES]
        lines.append([f"{n_p}", f"{variation[n_p]:.3f}", *values])
        percent = 100.0 / part["simulation"].mean()
        changes = [written(percent * (part[to] - part[of]), 1) for of, to in _STEPS]
        steps.append([f"{n_p}", *changes])
    transfer, overshoot, others = (
        {n_p: mean_interval(part[to] - part[of]) for n_p, part in sizes} for of, to in _STEPS
    )
    header = [f"{NAMES[of]} → {NAMES[to]}" for of, to in _STEPS]
    return {
        "sizes": len(means),
        "raised": listed([str(n_p) for n_p, change in transfer.items() if change.low > 0.0]),
        "lowered": sum(change.high < 0.0 for change in transfer.values()),
        "overshot": sum(change.high < 0.0 for change in overshoot.values()),
        "less": sum(change.high < 0.0 for change in others.values()),
        "small": small,
        "small_error": error.loc[:small].max(),
        "worst_error": error.max(),
        "most_uneven": variation.idxmax(),
        "largest_variation": variation.max(),
        "seeds": table["seed"].nunique(),
        "blocks": table["n_blocks"].min(),
        "friction": markdown_table(["n_p", "SD/mean of stress", *NAMES.values()], lines),
        "steps": markdown_table(["n_p", *header], steps),
        "minima": _minima(table),
    }


def _minima(rows: pd.DataFrame) -> dict[str, Lowest]:
    """Return where friction is lowest by model, n_p."""
    sizes = rows.groupby("n_p")
    return {name: lowest({n_p: part.to_numpy() for n_p, part in sizes[name]}) for name in NAMES}


def _of_variants(table: pd.DataFrame) -> Fields:
    """Return the fields on flat surfaces and on other gaps, layers and scatter."""
    flat, pillars = table[table["n_p"] == 0], table[table["n_p"] > 0]
    lines, raised = [], []
    for name, rows in pillars.groupby(pillars.apply(_case, axis=1), sort=False):
        uneven, found = rows.groupby("n_p")["stress_variation"].first(), _minima(rows)
        here = rows[rows["n_p"] == found["simulation"].place]
        changes = [written(100.0 * (here[to] / here[of] - 1.0), 1) for of, to in _STEPS]
        if mean_interval(here["overshooting"] / here["quasi_static"]).low > 1.0:
            raised.append(str(name))
        sizes, most = ", ".join(map(str, uneven.index)), f"{uneven.idxmax()} ({uneven.max():.2f})"
        lines.append([str(name), sizes, most, *map(str, found.values()), *changes])
    thick = pillars[pillars["thickness"] == pillars["thickness"].max()]
    excess = 100.0 * (1.0 - thick["simulation"] / thick["overshooting"])
    header = ["case", "sizes n_p", "most uneven stress (SD/mean)", *NAMES.values()]
    header += ["change by load transfer (%)", "by overshoot (%)", "by other effects (%)"]
    return {
        "variants_seeds": table["seed"].nunique(),
        "variants": markdown_table(header, lines),
        "flat": [written(flat[name], 3) for name in NAMES],
        "raised_by_overshoot": listed(raised) or "none of the other constants",
        "excess": written(excess.groupby(thick["seed"]).mean(), 1),
    }


def _case(row: pd.Series) -> str:
    constant = row["varied"].partition("=")[0]
    if constant == "thickness":
        return f"l_z = {1e6 * row['thickness']:g} µm"
    if constant == "mu_static_std":
        return f"scatter {row['mu_static_std']:g}"
    return f"n_s = {row['n_s'] / row['n_p']:g} n_p"
