"""Values of the page on the mechanism."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import Interval, mean_interval, number
from springblock.io.rows import Row
from springblock.model.material import Material
from springblock.study.mechanism.sensitivities import SIZE

#: Names of the models in words, each with one effect more than the one before.
NAMES = {
    "independent": "stress alone",
    "quasi_static": "load transfer",
    "sticking": "sticking and healing",
    "overshooting": "overshoot",
    "simulation": "full model",
}


def values(
    models: list[Row],
    strong: list[Row],
    springs: list[Row],
    grooves: list[Row],
    settings: list[Row],
) -> dict[str, Any]:
    """Return what the template names, from the rows of the tables."""
    tables = map(pd.DataFrame, (models, strong, springs, settings))
    friction, damped, other, sensitivities = tables
    means = {name: _by_size(friction[name], friction) for name in NAMES}
    change = {
        to: _by_size(100.0 * (friction[to] / friction[of] - 1.0), friction)
        for of, to in pairwise(NAMES)
    }
    changes = _by_setting(sensitivities)
    return {
        "header": ["n_p", *NAMES.values()],
        "seeds": friction["seed"].nunique(),
        "blocks": (friction["n_blocks"].min(), friction["n_blocks"].max()),
        "uneven": friction.groupby("n_p")["stress_variation"].first().to_dict(),
        "friction": means,
        "by_size": [
            [str(n_p), *(number(means[name][n_p]) for name in NAMES)] for n_p in means["simulation"]
        ],
        "change": change,
        "spans": {name: _span(intervals) for name, intervals in change.items()},
        "level": np.ptp(
            [means["sticking"][n_p].mean for n_p in means["sticking"] if 3 <= n_p <= 10]
        ),
        "minimum": {name: _minimum(friction, name) for name in NAMES},
        "springs": {
            f"{(Material.thickness / rows['thickness'].iloc[0]) ** 2:.2g}": {
                "minimum": {name: _minimum(rows, name) for name in NAMES},
                "uneven": rows[rows["n_p"] == SIZE]["stress_variation"].iloc[0],
            }
            for _, rows in other.groupby("thickness")
        },
        "grooves": {
            row["model"]: [
                Interval(row[name], row[f"{name}_low"], row[f"{name}_high"])
                for name in ("static_friction", "prominence")
            ]
            for row in grooves
        },
        "damped": {gamma: _of_damping(rows) for gamma, rows in damped.groupby("gamma")},
        "settings": changes,
        "least": lambda quantity, names: min(changes[name][quantity].low for name in names),
        "most": lambda quantity, names: max(changes[name][quantity].high for name in names),
    }


def _by_size(samples: pd.Series, table: pd.DataFrame) -> dict[int, Interval]:
    """Return the mean over seeds with its interval by n_p."""
    return {n_p: mean_interval(part) for n_p, part in samples.groupby(table["n_p"])}


def _span(intervals: dict[int, Interval]) -> tuple[float, float]:
    """Return the least and the largest mean."""
    means = [float(each.mean) for each in intervals.values()]
    return min(means), max(means)


def _minimum(table: pd.DataFrame, name: str) -> Lowest:
    """Return the n_p of lowest static friction in a model."""
    return lowest({n_p: part.to_numpy() for n_p, part in table.groupby("n_p")[name]})


def _of_damping(table: pd.DataFrame) -> dict[str, Any]:
    """Compare strongly damped simulations with load transfer in equilibrium, seed by seed.

    The slider also bears the viscous drag of all sliding blocks, gamma m v/(P l²).
    """
    material = Material(gamma=table["gamma"].iloc[0])
    drag = material.gamma * material.mass * material.slider_velocity / material.block_load
    # of a block between neighbours at rest
    critical = 2.0 * math.sqrt((material.k_s + 3.0 * material.k_int) / material.mass)
    excess = table["simulation"] - table["quasi_static"]
    return {
        "drag": drag,
        "critical": critical,
        "minimum": _minimum(table, "simulation"),
        "friction": _by_size(table["simulation"], table),
        "excess": _span(_by_size(excess, table)),
    }


def _by_setting(rows: pd.DataFrame) -> dict[str, dict[str, Interval]]:
    """Return the interval of each quantity by what differs from the paper's surfaces, in words."""
    found: dict[str, dict[str, Interval]] = {}
    for row in rows.to_dict("records"):
        edges = "periodic" if row["edges"] == "periodic" and row["varied"] != "edges" else ""
        name = " ".join(filter(None, (edges, row["varied"], row["value"])))
        interval = Interval(row["mean"], row["mean_low"], row["mean_high"])
        found.setdefault(name, {})[row["quantity"]] = interval
    return found
