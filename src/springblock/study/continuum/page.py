"""Values of the page on the continuum limit."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, mean_interval
from springblock.io.rows import Row
from springblock.model.material import Material
from springblock.simulation.resolution import DECAY, STIFFNESS, ZONE
from springblock.study.continuum.cases import SCATTER, lowest_point
from springblock.theory.layer import KAPPA, MU_D, best_widths, sharp_minimum

#: First words of the series that the predictions are not for, and of those with the paper's gaps,
#: springs and mean coefficients.
_OTHERS, _EVEN = ("lattice", "Coulomb", "healing", "pawls", "disorder"), ("d_c", "l_z")
#: Least widths for which theory and solver are to agree: of stripes in lambda, of squares in l_z.
STRIPES, SQUARES = 3.0, 4.0
#: Squares of the page's table.
_SHOWN = ("d_c", "l_z", "mu_d", "K_s x 0.5")


def values(rows: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `continuum`."""
    cells = pd.DataFrame(rows)
    if not np.isfinite(cells["simulated"]).all():  # which maxima would pass over
        raise ValueError("the table continuum has runs without static friction")
    cells["apart"] = (cells["simulated"] - cells["predicted"]).abs()
    of = dict(list(cells.groupby("what")))
    plain = cells[~cells["what"].str.startswith(_OTHERS)]
    is_square = of["lattice"]["shape"] == "square"
    by_what = plain[plain["shape"] == "square"].groupby("what", sort=False)
    squares = {str(what): _minimum(series) for what, series in by_what}
    finer = of["lattice"][is_square].pivot(index="width", columns="spacing", values="simulated")
    finer = finer.sort_index(axis=1, ascending=False)
    steps = finer.diff(axis=1).iloc[:, 1:].abs()
    coulomb = _by_spacing(of["Coulomb"])
    usual, soft = squares["d_c = 100 nm"], squares["K_s x 0.5"]
    residual = usual["mu_dynamic"] / (usual["mu_static"] - usual["mu_dynamic"])
    ratios = {"d_c": usual, "kappa": squares["d_c = 50 nm"]}  # of half of K_s, which is alike in it
    return {
        **_agreement(plain),
        **_healed(of["healing"]),
        "worst": _resolved(of["lattice"][~is_square]),
        "disordered": _disordered(of["disorder, independent"]),
        "correlated": _disordered(of["disorder, correlated"]),
        "usual": usual,
        "softer": {
            name: soft["simulation"][0] / row["simulation"][0] for name, row in ratios.items()
        },
        "even": [row for what, row in squares.items() if what.startswith(_EVEN)],
        "larger": squares["mu_d = 0.3"]["place"],
        "shown": [row for what, row in squares.items() if what.startswith(_SHOWN)],
        "last": steps.iloc[:, -1].max(),
        "order": np.log2(steps.iloc[:, 0] / steps.iloc[:, 1]).min(),
        "coulomb": coulomb,
        "least": min(
            float(coarse.low - fine.high)
            for means in coulomb.values()
            for coarse, fine in pairwise(means)
        ),
        "seeds": of["Coulomb"]["seed"].nunique(),
        "refined": finer.T.to_dict("list"),
        "scatter": SCATTER,
        "sharp": tuple(sharp_minimum(residual, kappa)[0] for kappa in (0.01, 0.1, 0.5)),
        "second": of["pawls"]["prominence"].max(),
        "decay": {along: math.sqrt(ratio) for along, ratio in STIFFNESS.items()},
        "zone": ZONE,
        "lengths": DECAY,
        **_best_widths(),
    }


def _agreement(plain: pd.DataFrame) -> dict[str, Any]:
    """Return the largest differences on the named cells and on the others."""
    is_square = plain["shape"] == "square"
    least = np.where(is_square, SQUARES * plain["thickness"], STRIPES * plain["decay"])
    named = plain["width"] > 0.999 * least
    stripes, cells = (
        cells["apart"].groupby(named).max().to_dict()
        for cells in (plain[~is_square], plain[is_square])
    )
    return {"stripes": stripes, "cells": cells, "count": named.sum()}


def _minimum(cells: pd.DataFrame) -> dict[Any, Any]:
    """Return squares with predicted and simulated width of lowest friction, m, and friction."""
    theory, simulation = (
        lowest_point(cells["width"].to_numpy(), cells[name].to_numpy())
        for name in ("predicted", "simulated")
    )
    first = cells.iloc[0].to_dict()
    place = simulation[0] / first["thickness"]
    return first | {"theory": theory, "simulation": simulation, "place": place}


def _by_spacing(cells: pd.DataFrame) -> dict[Any, list[Interval]]:
    """Return mean friction by width, from the coarsest lattice on."""
    return {
        width: [mean_interval(each) for _, each in own.groupby("spacing")["simulated"]][::-1]
        for width, own in cells.groupby("width")
    }


def _resolved(cells: pd.DataFrame) -> dict[Any, float]:
    """Return the largest difference from the theory where the rule of resolution holds, or not."""
    finest = np.minimum(cells["process_zone"] / ZONE, cells["decay"] / DECAY)
    return cells["apart"].groupby(cells["spacing"] <= finest * (1.0 + 1e-9)).max().to_dict()


def _healed(cells: pd.DataFrame) -> dict[str, float]:
    """Return the largest differences with healing or the paper's damping, and with both.

    With both for the shortest d_c, since longer ones hardly differ.
    """
    is_both = (cells["healing"] == "instant") & (cells["gamma"] == Material.gamma)
    shortest = cells["slip_distance"] == cells["slip_distance"].min()
    apart = cells["apart"]
    return {"alone": apart[~is_both].max(), "both": apart[is_both & shortest].max()}


def _disordered(cells: pd.DataFrame) -> dict[str, Any]:
    """Return the size of lowest friction, in µm, and mean friction there."""
    by_width: Any = cells.groupby("width")["simulated"]
    samples = {round(1e6 * width): each.to_numpy() for width, each in by_width}
    best = lowest(samples)
    return {"best": best, "friction": mean_interval(samples[best.place])}


def _best_widths() -> dict[str, Any]:
    """Return the best widths of the theory, and their spread over mu_d where it is small."""
    best, kappa, mu_d = best_widths(), 2.0, 0.75
    settled = best[np.array(MU_D) <= mu_d][:, np.array(KAPPA) >= kappa]
    return {
        "best": (best.min(), best.max()),
        "settled": {"kappa": kappa, "mu_d": mu_d, "apart": np.ptp(settled, axis=0).max()},
        "mu_d": MU_D,
        "kappa": KAPPA,
    }
