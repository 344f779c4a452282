"""Values of the page on the continuum limit."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, mean_interval, number
from springblock.io.rows import Row, select
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


def values(cells: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `continuum`."""
    cells = [row | {"apart": abs(row["simulated"] - row["predicted"])} for row in cells]
    plain = [row for row in cells if not row["what"].startswith(_OTHERS)]
    lattice = select(cells, what="lattice")
    minima = [_minimum(rows) for rows in _by(plain, "shape", "what").values()]
    squares = {row["what"]: row for row in select(minima, shape="square")}
    converged = _converged(select(lattice, shape="square"))
    coulomb = _refined(select(cells, what="Coulomb"))
    usual, soft = squares["d_c = 100 nm"], squares["K_s x 0.5"]
    residual = usual["mu_dynamic"] / (usual["mu_static"] - usual["mu_dynamic"])
    ratios = {"d_c": usual, "kappa": squares["d_c = 50 nm"]}  # of half of K_s, which is alike in it
    return {
        **_agreement(plain),
        **_healed(select(cells, what="healing")),
        "worst": _resolved([row for row in lattice if row["shape"] != "square"]),
        "disordered": _disordered(select(cells, what="disorder, independent")),
        "correlated": _disordered(select(cells, what="disorder, correlated")),
        "usual": usual,
        "softer": {
            name: soft["simulation"][0] / row["simulation"][0] for name, row in ratios.items()
        },
        "even": [row for what, row in squares.items() if what.startswith(_EVEN)],
        "larger": squares["mu_d = 0.3"]["place"],
        "shown": [_compared(row) for what, row in squares.items() if what.startswith(_SHOWN)],
        "squares": converged,
        "coulomb": coulomb,
        "refined": [*_finer(coulomb["means"], converged)],
        "scatter": SCATTER,
        "sharp": tuple(sharp_minimum(residual, kappa)[0] for kappa in (0.01, 0.1, 0.5)),
        "second": max(row["prominence"] for row in select(cells, what="pawls")),
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
    """Return the largest differences on the named cells and on the others."""
    kinds: dict[tuple[bool, bool], list[float]] = {}
    for row in plain:
        square = row["shape"] == "square"
        least = SQUARES * row["thickness"] if square else STRIPES * row["decay"]
        kinds.setdefault((square, row["width"] > 0.999 * least), []).append(row["apart"])
    return {
        "stripes": {is_named: max(kinds[False, is_named]) for is_named in (True, False)},
        "cells": {is_named: max(kinds[True, is_named]) for is_named in (True, False)},
        "count": len(kinds[False, True]) + len(kinds[True, True]),
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


def _compared(row: Row) -> list[str]:
    """Return what differs, kappa, and a* in µm, a*/l_z and mu* by theory and simulation."""
    widths, frictions = zip(row["theory"], row["simulation"], strict=True)
    place = [f"{1e6 * width:.0f}" for width in widths] + [f"{row['place']:.1f}"]
    return [row["what"], f"{row['kappa']:.2f}", *place, *(f"{mu:.4f}" for mu in frictions)]


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


def _finer(means: dict[float, list[Interval]], squares: Iterable[Row]) -> Iterator[list[str]]:
    """Yield the lines of friction by spacing; slip weakening lacks the coarsest."""
    for width, coulomb in means.items():
        yield ["Coulomb", f"{1e6 * width:.0f}", *map(number, coulomb), ""]
    for row in squares:
        friction = (f"{each:.4f}" for each in row["friction"])
        yield ["slip weakening", f"{1e6 * row['width']:.0f}", "", *friction]


def _resolved(rows: Sequence[Row]) -> dict[bool, float]:
    """Return the largest difference from the theory where the rule of resolution holds, or not."""
    worst = {True: 0.0, False: 0.0}
    for row in rows:
        finest = min(row["process_zone"] / ZONE, row["decay"] / DECAY)
        fine = row["spacing"] <= finest * (1.0 + 1e-9)
        worst[fine] = max(worst[fine], row["apart"])
    return worst


def _healed(rows: Sequence[Row]) -> dict[str, float]:
    """Return the largest differences with healing or the paper's damping, and with both.

    With both for the shortest d_c, since longer ones hardly differ.
    """
    found: dict[bool, list[Row]] = {True: [], False: []}
    for row in rows:
        found[row["healing"] == "instant" and row["gamma"] == Material.gamma].append(row)
    d_c = min(row["slip_distance"] for row in rows)
    return {
        "alone": max(row["apart"] for row in found[False]),
        "both": max(row["apart"] for row in select(found[True], slip_distance=d_c)),
    }


def _disordered(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the size of lowest friction, in µm, and mean friction there."""
    samples = {
        round(1e6 * width): np.array([row["simulated"] for row in each])
        for (width,), each in _by(rows, "width").items()
    }
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
