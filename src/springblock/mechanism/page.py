"""The page on the mechanism, from its template and the tables."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import PROMINENT, mean_interval, prominence
from springblock.io.rows import listed, markdown_table
from springblock.mechanism.pawls import TWO_PEAKS, pawl
from springblock.model.material import Material
from springblock.model.numbers import Array

#: Names of the models on the page, each with one effect more than the one before.
NAMES = {
    "independent": "stress alone",
    "quasi_static": "load transfer",
    "overshooting": "overshoot",
    "simulation": "full model",
}
_STEPS = list(pairwise(NAMES))
_ALONG = {"x": "along", "y": "across"}
_CONSTANTS = {"": "the paper's", "mu_dynamic": "other $\\mu_d$", "mu_static_std": "other w"}
_WIDE = (6, 10)  #: blocks, pawls on which the surfaces of training have two load peaks
_MEASURED_TWO = 100.0 * PROMINENT  #: %
_GROOVES = ["varied", "n_p", "n_s2", "n_p2"]

Fields = dict[str, Any]  #: of the template, by name


def page(
    friction: pd.DataFrame, variants: pd.DataFrame, peaks: pd.DataFrame, budget: pd.DataFrame
) -> str:
    """Write the page from the tables of `surfaces.TABLES`, in their order."""
    text = Path(__file__).with_name("page.md").read_text(encoding="utf-8")
    return text.format(
        **_of_friction(friction),
        **_of_variants(variants),
        **_of_budget(budget),
        **_of_pawls(),
        **_of_peaks(peaks),
    )


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


def _of_budget(table: pd.DataFrame) -> Fields:
    """Return the fields on the forces on edges and core."""
    lines, falls = [], {}
    for (direction, model), rows in table.groupby(["direction", "model"], sort=False):
        runs = np.array([_milestones(run) for _, run in rows.groupby("seed")])
        cells = [written(*each) for each in zip(runs.T, (2, 0, 2, 2, 0, 1), strict=True)]
        lines.append([_ALONG[str(direction)], NAMES[str(model)], *cells])
        falls[direction, model] = runs[:, -1]
    simulated = table[table["model"] == "simulation"]
    by_seed = simulated.groupby(["direction", "seed"])["edge_event"]
    header = ["grooves", "model", "edges, maximum", "at (µs)", "edges, at the core's maximum"]
    header += ["core, maximum", "at (µs)", "fall of the load (%)"]
    return {
        "budget_seeds": table["seed"].nunique(),
        "edge_share": 100.0 * table["edge_share"].iloc[0],
        "budget": markdown_table(header, lines),
        "event": [written(sizes, 1) for _, sizes in by_seed.first().groupby("direction")],
        "deeper": written(falls["x", "simulation"] - falls["x", "overshooting"], 1),
    }


def _milestones(run: pd.DataFrame) -> Array:
    """Return the largest force on edges and its time, their force and that on the core when the
    latter is largest, the time of that, and the prominence of the lesser load peak, (6,).

    Per block over F_n, in µs, and in percent.
    """
    edges = (run["edge"] / run["edge_share"]).to_numpy()
    core = (run["core"] / (1.0 - run["edge_share"])).to_numpy()
    time, first, last = 1e6 * run["time"].to_numpy(), np.nanargmax(edges), np.nanargmax(core)
    load = (run["edge"] + run["core"] + run["free"]).dropna().to_numpy()
    fall = 100.0 * prominence(load)
    return np.array([edges[first], time[first], edges[last], core[last], time[last], fall])


def _of_pawls() -> Fields:
    """Return the fields on the elasticity of pawls of 8 between grooves of 2."""
    paper = Material()
    along, across = (pawl(8, 2, is_across, paper) for is_across in (False, True))
    # stress on the rows next to edges that have overshot, over F_n
    swept = [
        along.next_to * paper.mu_static + 2.0 * along.handed_on * (paper.mu_static - mu_d)
        for mu_d in (0.5, 0.6, 0.7)
    ]
    shared = [100.0 * each.shared for each in (along, across)]
    return {"along": along, "across": across, "shared": shared, "swept": swept}


def _of_peaks(table: pd.DataFrame) -> Fields:
    """Return the fields on predicted and measured load peaks."""
    trained, tested = (_surfaces(table[table["trained"] == which]) for which in (True, False))
    ratio = (trained["mean"] / trained["predicted"])[trained["has_two"]]
    counts = _counts(tested)
    papers = tested[tested["varied"] == ""]
    hits, misses = papers[papers["is_right"]], papers[~papers["is_right"]]
    wrong = misses[misses["direction"] == "x"]
    across = tested[tested["direction"] == "y"]
    foreseen = across[across["should_have_two"]]
    whole = papers[(papers["direction"] == "x") & (papers["n_p"] == 0)]
    names = [f"{_CONSTANTS[constant]}, {_ALONG[way]}" for constant, way in counts.index]
    every = counts.sum()
    lines = zip([*names, "all"], [*counts.to_numpy(), every], strict=True)
    return {
        "threshold": TWO_PEAKS,
        "ratio": (ratio.min(), ratio.max()),
        "surfaces": len(tested) // 2,
        "peaks_seeds": table["seed"].nunique(),
        "wide": _WIDE,
        "counts": markdown_table(
            ["constants, direction", *counts.columns],
            [[name, *map(str, numbers)] for name, numbers in lines],
        ),
        "every": every,
        "papers": _rights(counts.loc[[""]]),
        "others": _rights(counts.drop("")),
        "hits": len(hits),
        "misses": len(misses),
        "two_across": [part["has_two"].sum() for part in (foreseen, across)],
        "close": [part["is_close"].sum() for part in (misses, hits)],
        "wrong": len(wrong),
        "wrong_pawls": _widths(wrong),
        "wrong_most": wrong["predicted"].max(),
        "two": _widths(whole[whole["has_two"]]),
        "one": _widths(whole[~whole["has_two"]]),
        "peaks": _prominences(tested),
    }


def _surfaces(table: pd.DataFrame) -> pd.DataFrame:
    """Return a row per surface and direction: its prediction and the measured mean over seeds."""
    by_surface = table.groupby([*_GROOVES, "direction"], sort=False)
    found = by_surface["predicted"].first().reset_index()
    samples = [values for _, values in by_surface["measured"]]
    found[["mean", "low", "high"]] = np.array([mean_interval(values) for values in samples])
    found["measured"] = [written(values, 2) for values in samples]
    found["should_have_two"] = found["predicted"] > TWO_PEAKS
    found["has_two"] = found["mean"] >= _MEASURED_TWO
    found["is_right"] = found["should_have_two"] == found["has_two"]
    found["is_close"] = found["low"].le(_MEASURED_TWO) & found["high"].ge(_MEASURED_TWO)
    return found


def _counts(tested: pd.DataFrame) -> pd.DataFrame:
    """Count outcomes, and the cases in which each guess is right, by constant and direction."""
    predicted, measured = tested["should_have_two"], tested["has_two"]
    by_rule = (tested["direction"] == "x") & tested["n_p2"].between(*_WIDE)
    outcomes = pd.DataFrame(
        {
            "cases": True,
            "two peaks predicted and measured": predicted & measured,
            "two predicted, one measured": predicted & ~measured,
            "one predicted, two measured": ~predicted & measured,
            "one predicted and measured": ~predicted & ~measured,
            "prediction right": tested["is_right"],
            "rule right": by_rule == measured,
            "one peak right": ~measured,
        }
    )
    constant = tested["varied"].str.partition("=")[0]
    return outcomes.groupby([constant, tested["direction"]]).sum()


def _rights(counts: pd.DataFrame) -> str:
    """Write in how many of all cases the prediction, the rule and one peak everywhere are right."""
    total = counts.sum()
    rights = [str(total[f"{guess} right"]) for guess in ("prediction", "rule", "one peak")]
    return f"{listed(rights)} of {total['cases']}"


def _widths(surfaces: pd.DataFrame) -> str:
    return listed([str(n_p2) for n_p2 in np.unique(surfaces["n_p2"])])


def _prominences(tested: pd.DataFrame) -> str:
    """Tabulate predicted and measured prominences by pawl and groove."""
    lines = []
    for (constants, *lengths), part in tested.groupby(_GROOVES):
        cells = [*map(str, lengths), str(constants)]
        for each in part.itertuples():
            missed = "" if each.is_right else " (miss)"
            cells += [f"{each.predicted:.2f}", f"{each.measured}{missed}"]
        lines.append(cells)
    header = [f"{what} {way}" for way in _ALONG.values() for what in ("predicted", "measured")]
    return markdown_table([*_GROOVES[1:], "constants", *header], lines)
