"""Values of the page on the continuum limit."""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, mean_interval
from springblock.io.rows import Row, select
from springblock.simulation.resolution import DECAY, STIFFNESS, ZONE
from springblock.study.continuum.cases import SCATTER, lowest_point
from springblock.theory.layer import KAPPA, MU_D, PLAIN, best_widths, sharp_minimum

#: First words of the series that the predictions are not for, and of those with the paper's gaps,
#: springs and mean coefficients.
_OTHERS, _EVEN = ("lattice", "Coulomb", "healing", "pawls", "disorder"), ("d_c", "l_z")
#: Least widths for which theory and solver are to agree: of stripes in lambda, of squares in l_z.
STRIPES, SQUARES = 3.0, 4.0
_HEALED = ("healing", "gamma", "slip_distance")  #: on which depends what healing changes


def values(cells: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `continuum`."""
    cells = [row | {"apart": abs(row["simulated"] - row["predicted"])} for row in cells]
    plain = [row for row in cells if not row["what"].startswith(_OTHERS)]
    lattice, pawls = select(cells, what="lattice"), select(cells, what="pawls")
    healed = select(cells, what="healing")
    minima = [_minimum(rows) for rows in _by(plain, "shape", "what").values()]
    squares = select(minima, shape="square")
    residual = PLAIN.mu_dynamic / (PLAIN.mu_static - PLAIN.mu_dynamic)
    return {
        **_agreement(plain),
        **_zones([row for row in lattice if row["shape"] != "square"]),
        **_disordered([row for row in cells if row["what"].startswith("disorder")]),
        "usual": select(squares, what="d_c = 100 nm")[0],
        "span": sorted(row["place"] for row in squares if row["what"].startswith(_EVEN)),
        "minima": minima,
        "squares": _converged(select(lattice, shape="square")),
        "coulomb": _refined(select(cells, what="Coulomb")),
        "scatter": SCATTER,
        "healing": [*_by(healed, "shape", "slip_distance", "width").values()],
        "change": {
            (healing, gamma, round(1e9 * d_c)): max(row["apart"] for row in rows)
            for (healing, gamma, d_c), rows in _by(healed, *_HEALED).items()
        },
        "pawls": pawls,
        "second": max(row["prominence"] for row in pawls),
        "sharp": [sharp_minimum(residual, kappa)[0] for kappa in (0.01, 0.1, 0.5)],
        "decay": {along: math.sqrt(ratio) for along, ratio in STIFFNESS.items()},
        "zone": ZONE,
        "lengths": DECAY,
        **_best_widths(),
    }


def _by(rows: Iterable[Row], *names: str) -> dict[tuple[Any, ...], list[Row]]:
    """Group rows by the values of columns, in order of appearance."""
    found: dict[tuple[Any, ...], list[Row]] = {}
    for row in rows:
        found.setdefault(tuple(row[name] for name in names), []).append(row)
    return found


def _agreement(plain: Sequence[Row]) -> dict[str, Any]:
    """Return the largest differences on the named cells and on the others, and switches."""
    kinds: dict[tuple[bool, bool], list[float]] = {}
    for row in plain:
        square = row["shape"] == "square"
        least = SQUARES * row["thickness"] if square else STRIPES * row["decay"]
        kinds.setdefault((square, row["width"] > 0.999 * least), []).append(row["apart"])
    return {
        "stripes": {is_named: max(kinds[False, is_named]) for is_named in (True, False)},
        "cells": {is_named: max(kinds[True, is_named]) for is_named in (True, False)},
        "count": len(kinds[False, True]) + len(kinds[True, True]),
        "switched": max(row["switches"] for row in plain),
    }


def _minimum(rows: Sequence[Row]) -> Row:
    """Return the series with predicted and simulated width of lowest friction, m, and friction."""
    widths = np.array([row["width"] for row in rows])
    theory, simulation = (
        lowest_point(widths, np.array([row[name] for row in rows]))
        for name in ("predicted", "simulated")
    )
    unit = rows[0]["thickness" if rows[0]["shape"] == "square" else "decay"]
    place = simulation[0] / unit
    return rows[0] | {"theory": theory, "simulation": simulation, "place": place}


def _converged(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return friction by width, from the coarsest lattice on, its last change and the order."""
    found = []
    ordered = sorted(rows, key=lambda row: (row["width"], -row["spacing"]))
    for (width,), own in _by(ordered, "width").items():
        friction = [row["simulated"] for row in own]
        first, last = np.diff(friction)
        order = math.log2(abs(first / last))
        found.append({"width": width, "friction": friction, "last": last, "order": order})
    return found


def _refined(rows: Sequence[Row]) -> dict[str, Any]:
    """Return friction by width, from the coarsest lattice on, and the least gap of intervals."""
    means: dict[float, list[Interval]] = {}
    ordered = sorted(rows, key=lambda row: (row["width"], -row["spacing"]))
    for (width, _), own in _by(ordered, "width", "spacing").items():
        means.setdefault(width, []).append(mean_interval([row["simulated"] for row in own]))
    least = min(
        float(coarse.low - fine.high) for own in means.values() for coarse, fine in pairwise(own)
    )
    return {"means": means, "least": least, "seeds": len(_by(rows, "seed"))}


def _zones(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the largest difference from the theory by d_c and l, and by the rule of resolution."""
    found = []
    for own in _by(rows, "shape", "mu_dynamic", "slip_distance", "spacing").values():
        row = own[0]
        finest = min(row["process_zone"] / ZONE, row["decay"] / DECAY)
        fine = row["spacing"] <= finest * (1.0 + 1e-9)
        found.append(row | {"worst": max(each["apart"] for each in own), "fine": fine})
    worst = {fine: max(row["worst"] for row in select(found, fine=fine)) for fine in (True, False)}
    return {"zones": [row for row in found if math.isfinite(row["process_zone"])], "worst": worst}


def _disordered(rows: Sequence[Row]) -> dict[str, Any]:
    """Return mean friction by size, in µm, for each kind of disorder, and where it is lowest."""
    found = []
    for own in _by(rows, "what").values():
        samples = {
            round(1e6 * width): np.array([row["simulated"] for row in each])
            for (width,), each in _by(own, "width").items()
        }
        means = {width: mean_interval(each) for width, each in samples.items()}
        seeds = len(_by(own, "seed"))
        switched = max(row["switches"] for row in own)
        kind = {"means": means, "best": lowest(samples), "seeds": seeds, "switched": switched}
        found.append(own[0] | kind)
    widths = sorted({width for each in found for width in each["means"]})
    return {"disorder": found, "widths": widths}


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
