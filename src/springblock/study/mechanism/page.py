"""Values of the page on the mechanism."""

import math
from itertools import pairwise
from typing import Any

import pandas as pd

from springblock.analysis.lowest import Lowest, lowest
from springblock.analysis.statistics import Interval, mean_interval
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
    sizes = friction.groupby("n_p")
    plain = sensitivities[sensitivities["edges"] == "free"]
    damping = sensitivities[sensitivities["varied"].isin(["", "gamma", "edges"])]
    return {
        "names": NAMES,
        "seeds": friction["seed"].nunique(),
        "blocks": (friction["n_blocks"].min(), friction["n_blocks"].max()),
        "uneven": sizes["stress_variation"].first().to_dict(),
        "friction": {name: _by_size(friction[name], friction) for name in NAMES},
        "change": {
            to: _by_size(100.0 * (friction[to] / friction[of] - 1.0), friction)
            for of, to in pairwise(NAMES)
        },
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
        "settings": _grouped(plain, "varied", "value")
        | _grouped(sensitivities[sensitivities["varied"] == "edges"], "varied", "value"),
        "peaks": _grouped(damping, "edges", "gamma"),
        "set_seeds": sensitivities["seeds"].min(),
    }


def _by_size(samples: pd.Series, table: pd.DataFrame) -> dict[int, Interval]:
    """Return the mean over seeds with its interval by n_p."""
    return {n_p: mean_interval(part) for n_p, part in samples.groupby(table["n_p"])}


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
    ratio = min(material.gamma / critical, 1.0)
    excess = table["simulation"] - table["quasi_static"]
    return {
        "drag": drag,
        "critical": critical,
        "overshoot": math.exp(-math.pi * math.tan(math.asin(ratio))),  # over that without damping
        "minimum": _minimum(table, "simulation"),
        "friction": _by_size(table["simulation"], table),
        "excess": _by_size(excess, table),
        "percent": _by_size(100.0 * excess / table["quasi_static"], table),
    }


def _grouped(rows: pd.DataFrame, *columns: str) -> dict[Any, dict[str, Interval]]:
    """Return the interval of each quantity, by the values of two columns."""
    found: dict[Any, dict[str, Interval]] = {}
    for row in rows.to_dict("records"):
        interval = Interval(row["mean"], row["mean_low"], row["mean_high"])
        found.setdefault(tuple(row[name] for name in columns), {})[row["quantity"]] = interval
    return found
