"""The page on the mechanism, from its template and the tables."""

from collections.abc import Mapping
from itertools import pairwise, product
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import mean_interval, prominence
from springblock.io.rows import listed, markdown_table
from springblock.mechanism.elasticity import Array
from springblock.mechanism.pawls import TWO_PEAKS, pawl
from springblock.model.material import Material

#: Names of the models on the page, each with one effect more than the one before.
NAMES = {
    "independent": "stress alone",
    "quasi_static": "load transfer",
    "overshooting": "overshoot",
    "simulation": "full model",
}
_STEPS = list(pairwise(NAMES))
_ALONG = {"x": "along", "y": "across"}
_WIDE = (6, 10)  #: blocks, pawls on which the surfaces of training have two load peaks
_MEASURED_TWO = 1.0  #: %, prominence of the lesser load peak, at least
_SURFACE = ["n_p", "n_s2", "n_p2", "varied", "direction"]

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
    error = (means["overshooting"] / means["simulation"] - 1.0).abs()
    small = error.index[(error < 0.01).cummin()].max()
    minima, lines, steps = _minima(table), [], []
    for n_p, part in sizes:
        values = [written(part[name], 4) for name in NAMES]
        lines.append([f"{n_p}", f"{variation[n_p]:.3f}", *values])
        percent = 100.0 / part["simulation"].mean()
        changes = [written(percent * (part[to] - part[of]), 1) for of, to in _STEPS]
        steps.append([f"{n_p}", *changes])
    raised, lowered = _changed_by(table, "independent", "quasi_static")
    _, overshot = _changed_by(table, "quasi_static", "overshooting")
    header = [f"{NAMES[of]} → {NAMES[to]}" for of, to in _STEPS]
    return {
        "lowest": minima["simulation"].place,
        "raised": listed(raised),
        "lowered": _all_or(lowered, len(means) - len(raised), "all others"),
        "overshot": _all_or(overshot, len(means), "all sizes"),
        "small": small,
        "small_error": error.loc[:small].max(),
        "worst_error": error.max(),
        "most_uneven": variation.idxmax(),
        "largest_variation": variation.max(),
        "seeds": table["seed"].nunique(),
        "blocks": table["n_blocks"].min(),
        "friction": markdown_table(["n_p", "SD/mean of stress", *NAMES.values()], lines),
        "steps": markdown_table(["n_p", *header], steps),
        "minima": minima,
    }


def _all_or(sizes: list[str], most: int, words: str) -> str:
    return words if len(sizes) == most else f"those of {listed(sizes)}"


def _changed_by(table: pd.DataFrame, of: str, to: str) -> tuple[list[str], list[str]]:
    """Return the sizes on which a step raises friction significantly, and those it lowers."""
    steps = {n_p: mean_interval(part[to] - part[of]) for n_p, part in table.groupby("n_p")}
    raised = [str(n_p) for n_p, step in steps.items() if step.low > 0.0]
    return raised, [str(n_p) for n_p, step in steps.items() if step.high < 0.0]


def _of_variants(table: pd.DataFrame) -> Fields:
    """Return the fields on flat surfaces and on other gaps, layers and scatter."""
    flat = table[table["n_p"] == 0]
    pillars = table.drop(flat.index)
    cases = dict(iter(pillars.groupby(pillars.apply(_case, axis=1), sort=False)))
    lines, sentences, raising = [], [], []
    for name, rows in cases.items():
        uneven, found = rows.groupby("n_p")["stress_variation"].first(), _minima(rows)
        raised, _ = _changed_by(rows, "quasi_static", "overshooting")
        raising += [name] if str(found["simulation"].place) in raised else []
        most = f"{uneven.idxmax()} ({uneven.max():.2f})"
        lines.append([name, ", ".join(map(str, uneven.index)), most, *map(str, found.values())])
        sentences.append(_sentence(name, rows, found))
    thin, thick = cases["l_z = 5 µm"], cases["l_z = 40 µm"]
    near = _minima(thin)["simulation"].alike
    excess = 100.0 * (1.0 - thick["simulation"] / thick["overshooting"])
    header = ["case", "sizes n_p", "most uneven (SD/mean)", *NAMES.values()]
    return {
        "variants_seeds": table["seed"].nunique(),
        "variants": markdown_table(header, lines),
        "sentences": "\n".join(sentences),
        "flat": [written(flat[name], 3) for name in NAMES],
        "uneven": thin["stress_variation"].max(),
        "near": (min(near), max(near)),
        "raising": listed(raising) or "no case",
        "excess": written(excess.groupby(thick["seed"]).mean(), 1),
    }


def _case(row: pd.Series) -> str:
    constant = row["varied"].partition("=")[0]
    if constant == "thickness":
        return f"l_z = {1e6 * row['thickness']:g} µm"
    if constant == "mu_static_std":
        return f"scatter {row['mu_static_std']:g}"
    return f"n_s = {row['n_s'] / row['n_p']:g} n_p"


def _minima(rows: pd.DataFrame) -> dict[str, Lowest]:
    """Return where friction is lowest by model, n_p."""
    sizes = rows.groupby("n_p")
    return {name: lowest({n_p: part.to_numpy() for n_p, part in sizes[name]}) for name in NAMES}


def _sentence(name: str, rows: pd.DataFrame, found: Mapping[str, Lowest]) -> str:
    """Say where the full model is lowest, and from which model on all may be lowest there.

    A model may be lowest where its friction does not differ significantly from its lowest, if
    that at another size does.
    """
    full, sizes = found["simulation"].place, rows["n_p"].unique()
    *simpler, _ = found.values()
    agree = [full in each.alike and len(each.alike) < len(sizes) for each in simpler]
    words = (
        "in all simpler models the minimum may be there too",
        "with load transfer and with overshoot the minimum may be there too",
        "with overshoot the minimum may be there too",
        "with overshoot no minimum is resolved there",
    )
    first = next(i for i in range(len(words)) if all(agree[i:]))
    bound = ", the largest computed" if full == max(sizes) else ""
    here = rows[rows["n_p"] == full]
    changes = [written(100.0 * (here[to] / here[of] - 1.0), 1) for of, to in _STEPS]
    return fill(
        f"- **{name}**: friction is lowest at n_p = {found['simulation']}{bound}; {words[first]}. "
        f"At n_p = {full} load transfer changes friction by {changes[0]} %, overshoot by "
        f"{changes[1]} %, and the other effects of the full model by {changes[2]} %.",
        width=100,
        subsequent_indent="  ",
    )


def _of_budget(table: pd.DataFrame) -> Fields:
    """Return the fields on the forces on edges and core."""
    lines, falls = [], {}
    for direction, model in product(_ALONG, ("simulation", "overshooting")):
        rows = table[(table["direction"] == direction) & (table["model"] == model)]
        runs = np.array([_milestones(run) for _, run in rows.groupby("seed")])
        cells = [written(*each) for each in zip(runs.T, (2, 0, 2, 2, 0, 1), strict=True)]
        lines.append([_ALONG[direction], NAMES[model], *cells])
        falls[direction, model] = runs[:, -1]
    header = ["grooves", "model", "edges, largest", "at (µs)", "edges, at core's largest"]
    header += ["core, largest", "at (µs)", "fall of the load (%)"]
    return {
        "budget_seeds": table["seed"].nunique(),
        "edge_share": table["edge_share"].iloc[0],
        "budget": markdown_table(header, lines),
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
    return {"along": along, "across": across, "swept": swept}


def _of_peaks(table: pd.DataFrame) -> Fields:
    """Return the fields on predicted and measured load peaks."""
    tested = _surfaces(table[~table["trained"]])
    is_papers = tested["varied"] == ""
    papers, others = tested[is_papers], tested[~is_papers]
    parts = {"the paper's": papers, "other": others, "all": tested}
    scores = {name: _scores(part) for name, part in parts.items()}
    hits, misses = papers[papers["is_right"]], papers[~papers["is_right"]]
    wrong = misses[misses["direction"] == "x"]
    across = tested[(tested["direction"] == "y") & tested["has_two"]]
    along = papers[papers["direction"] == "x"]
    whole = along[along["n_p"] == 0]
    two, one = (whole.loc[whole["has_two"] == it, "n_p2"] for it in (True, False))
    return {
        "threshold": TWO_PEAKS,
        "surfaces": len(tested) // 2,
        "peaks_seeds": table["seed"].nunique(),
        "confusion": _confusion(tested),
        "wide": _WIDE,
        "scores": markdown_table(
            ["constants", "cases", "prediction", "rule", "one peak everywhere"],
            [[name, str(len(parts[name])), *map(str, hits)] for name, hits in scores.items()],
        ),
        "than_rule": _compared(*scores["all"][:2]),
        "than_one": _compared(scores["other"][0], scores["other"][2]),
        "across_two": len(across),
        "across_found": across["should_have_two"].sum() or "none",
        "close": [part["is_close"].sum() for part in (misses, hits)],
        "misses": len(misses),
        "hits": len(hits),
        "right": (*_scores(along)[:2], len(along)),
        "wrong": len(wrong),
        "wrong_pawls": " or ".join(map(str, sorted(set(wrong["n_p2"])))),
        "wrong_most": wrong["predicted"].max(),
        "two": ", ".join(map(str, sorted(set(two)))),
        "one": ", ".join(map(str, sorted(set(one)))),
        "peaks": _prominences(tested),
    }


def _surfaces(table: pd.DataFrame) -> pd.DataFrame:
    """Return a row per surface and direction: its prediction and the measured mean over seeds."""
    by_surface = table.groupby(_SURFACE, sort=False)
    found = by_surface["predicted"].first().reset_index()
    samples = [values for _, values in by_surface["measured"]]
    found[["mean", "low", "high"]] = np.array([mean_interval(values) for values in samples])
    found["measured"] = [written(values, 2) for values in samples]
    found["should_have_two"] = found["predicted"] > TWO_PEAKS
    found["has_two"] = found["mean"] >= _MEASURED_TWO
    found["is_right"] = found["should_have_two"] == found["has_two"]
    found["is_close"] = found["low"].le(_MEASURED_TWO) & found["high"].ge(_MEASURED_TWO)
    return found


def _scores(surfaces: pd.DataFrame) -> list[int]:
    """Return how often the prediction, the rule, and one peak everywhere are right."""
    by_rule = (surfaces["direction"] == "x") & surfaces["n_p2"].between(*_WIDE)
    guesses = surfaces["should_have_two"], by_rule, False
    return [int(np.count_nonzero(surfaces["has_two"] == guess)) for guess in guesses]


def _compared(hits: int, others: int) -> str:
    if hits == others:
        return "as often as"
    return "more often than" if hits > others else "less often than"


def _confusion(tested: pd.DataFrame) -> str:
    """Tabulate predictions against measurements, by constants and direction."""
    words = {"": "the paper's", "mu_dynamic": "other $\\mu_d$", "mu_static_std": "other w"}
    constant = tested["varied"].str.partition("=")[0]
    kinds = {
        f"{words[own]}, {way}": tested[(constant == own) & (tested["direction"] == direction)]
        for own, (direction, way) in product(words, _ALONG.items())
    }
    ways, lines = ((True, True), (True, False), (False, True), (False, False)), []
    for name, part in {**kinds, "all": tested}.items():
        both = list(zip(part["should_have_two"], part["has_two"], strict=True))
        lines.append([name, *(str(both.count(it)) for it in ways)])
    header = ["constants, direction", "two: predicted and measured", "only predicted"]
    return markdown_table([*header, "only measured", "one: predicted and measured"], lines)


def _prominences(tested: pd.DataFrame) -> str:
    names, lines = ["n_p", "n_s2", "n_p2", "varied"], []
    for _, part in tested.groupby(["varied", *names[:3]]):
        cells = [str(part[name].iloc[0]) for name in names]
        for _, each in part.iterrows():
            missed = "" if each["is_right"] else " (miss)"
            cells += [f"{each['predicted']:.2f}", f"{each['measured']}{missed}"]
        lines.append(cells)
    header = [f"{what} {way}" for way in _ALONG.values() for what in ("predicted", "measured")]
    return markdown_table([*names[:3], "constants", *header], lines)
