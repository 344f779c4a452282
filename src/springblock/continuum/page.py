"""Values of the page on the continuum limit, whose sentences are in `pages/continuum.md`."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from springblock.analysis.statistics import mean_interval, number
from springblock.continuum.cases import PLAIN, lowest_point
from springblock.continuum.theory import STIFFNESS, Groups, sharp_minimum
from springblock.io.rows import Row, select
from springblock.simulation.resolution import BLOCKS, LAYERS

#: First words of the series that the predictions are not for.
_OTHERS = ("lattice", "Coulomb", "healing", "pawls", "disorder")
#: Least widths for which theory and solver are to agree: of stripes in lambda, of squares in l_z.
STRIPES, SQUARES = 3.0, 4.0
_BOTH = ("predicted", "simulated")
#: Series of the paper's gaps, springs and mean coefficients; and its mu_d/(mu_s - mu_d).
_EVEN = ("d_c", "l_z")
_RESIDUAL = PLAIN.mu_dynamic / (PLAIN.mu_static - PLAIN.mu_dynamic)
_MICRO, _NANO = 1e6, 1e9


def values(cells: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `continuum`."""
    plain = [row for row in cells if not row["what"].startswith(_OTHERS)]
    lattice = select(cells, what="lattice")
    minima = {key: _minimum(rows) for key, rows in _by(plain, "shape", "what").items()}
    even = [own for key, own in minima.items() if key[0] == "square" and key[1][:3] in _EVEN]
    coulomb = _by_spacing(select(cells, what="Coulomb"))
    zones = _zones(select(lattice, shape="across"))
    return {
        **_agreement(plain),
        **_converged(select(lattice, shape="square")),
        **_healed(select(cells, what="healing")),
        **_disordered([row for row in cells if row["what"].startswith("disorder")]),
        "usual": minima["square", "d_c = 100 nm"],
        "span": sorted(own["simulated"][0] / own["unit"] for own in even),
        "minima": [_in_words(key, own) for key, own in minima.items()],
        "coulomb": coulomb,
        "fallen": all(np.diff(friction).max() < 0.0 for friction in coulomb.values()),
        "zones": [words for _, _, words in zones],
        "blocks": BLOCKS,
        "layers": LAYERS,
        "resolved": max(error for fine, error, _ in zones if fine),
        "unresolved": max(error for fine, error, _ in zones if not fine),
        "pawls": [_pawls(row) for row in select(cells, what="pawls")],
        "second": {
            healing: 100.0 * max(row["prominence"] for row in rows)
            for (healing,), rows in _by(select(cells, what="pawls"), "healing").items()
        },
        "sharp": [f"{sharp_minimum(_RESIDUAL, kappa)[0]:.1f}" for kappa in (0.01, 0.1, 0.5)],
        "decay": {
            along: Groups.of(PLAIN, along, 0.5).decay / PLAIN.thickness for along in STIFFNESS
        },
    }


def _by(rows: Iterable[Row], *names: str) -> dict[tuple[Any, ...], list[Row]]:
    """Group rows by the values of columns, in order of appearance."""
    found: dict[tuple[Any, ...], list[Row]] = {}
    for row in rows:
        found.setdefault(tuple(row[name] for name in names), []).append(row)
    return found


def _apart(rows: Iterable[Row]) -> float:
    """Return the largest difference of theory and simulation."""
    return max(abs(row["simulated"] - row["predicted"]) for row in rows)


def _agreement(plain: Sequence[Row]) -> dict[str, Any]:
    """Return the largest differences on the named cells and on the others, and switches."""

    def is_named(row: Row) -> bool:
        if row["shape"] == "square":
            return bool(row["width"] >= (SQUARES - 1e-9) * row["thickness"])
        return bool(row["width"] >= STRIPES * row["decay"])

    kinds: dict[tuple[bool, bool], list[Row]] = {}
    for row in plain:
        kinds.setdefault((row["shape"] == "square", is_named(row)), []).append(row)
    return {
        "worst": {"stripes": _apart(kinds[False, True]), "squares": _apart(kinds[True, True])},
        "narrow": {"stripes": _apart(kinds[False, False]), "squares": _apart(kinds[True, False])},
        "count": len(kinds[False, True]) + len(kinds[True, True]),
        "switched": max(row["switches"] for row in plain),
    }


def _minimum(rows: Sequence[Row]) -> dict[str, Any]:
    """Return predicted and simulated width of lowest friction, m, and that friction."""
    widths = np.array([row["width"] for row in rows])
    own = {name: lowest_point(widths, np.array([row[name] for row in rows])) for name in _BOTH}
    unit = rows[0]["thickness" if rows[0]["shape"] == "square" else "decay"]
    return {"kappa": rows[0]["kappa"], "unit": unit, **own}


def _in_words(key: tuple[Any, ...], own: dict[str, Any]) -> list[str]:
    (a, mu), (a_simulated, simulated) = (own[name] for name in _BOTH)
    widths = [f"{_MICRO * a:.0f}", f"{_MICRO * a_simulated:.0f}"]
    ratio = f"{a_simulated / own['unit']:.1f}"
    return [*key, f"{own['kappa']:.2f}", *widths, ratio, f"{mu:.4f}", f"{simulated:.4f}"]


def _by_spacing(rows: Sequence[Row]) -> dict[float, list[float]]:
    """Return friction by width, µm, from the coarsest lattice on."""
    ordered = sorted(rows, key=lambda row: (row["width"], -row["spacing"]))
    return {
        round(_MICRO * width, 6): [row["simulated"] for row in own]
        for (width,), own in _by(ordered, "width").items()
    }


def _converged(rows: Sequence[Row]) -> dict[str, Any]:
    """Return friction by width and spacing, and the order of convergence."""
    found = _by_spacing(rows)
    steps = np.abs(np.diff(list(found.values())))
    orders = np.log2(steps[:, 0] / steps[:, 1])
    lines = [
        [f"{width:g}", *(f"{value:.4f}" for value in values), f"{order:.1f}"]
        for (width, values), order in zip(found.items(), orders, strict=True)
    ]
    return {"lattices": lines, "orders": orders, "last_step": steps[:, 1].max()}


def _zones(rows: Sequence[Row]) -> list[tuple[bool, float, list[str]]]:
    """Return whether the rule holds, the largest difference from the theory, and both in words."""
    found = []
    for (d_c, spacing, zone), own in _by(rows, "slip_distance", "spacing", "process_zone").items():
        if np.isfinite(zone):
            known = [f"{_NANO * d_c:g}", f"{_MICRO * spacing:g}", f"{zone / spacing:.1f}"]
            fine = spacing <= own[0]["thickness"] / LAYERS and zone >= BLOCKS * spacing
            found.append((fine, _apart(own), [*known, f"{_apart(own):.4f}"]))
    return found


def _healed(rows: Sequence[Row]) -> dict[str, Any]:
    """Return friction and switches with healing and without it, and what they change."""
    lines, changes = [], dict[tuple[Any, ...], float]()
    for (shape, d_c, width), own in _by(rows, "shape", "slip_distance", "width").items():
        known = [f"{_MICRO * width:.0f}", f"{_NANO * d_c:g}", f"{own[0]['predicted']:.4f}"]
        found = [f"{row['simulated']:.4f} ({row['switches']:.2f})" for row in own]
        lines.append([shape, *known, *found])
    for key, own in _by(rows, "healing", "gamma", "slip_distance").items():
        changes[key[0], key[1], round(_NANO * key[2])] = _apart(own)
    return {"healing": lines, "change": changes}


def _disordered(rows: Sequence[Row]) -> dict[str, Any]:
    """Return mean friction by size for each kind of disorder, and where it is lowest."""
    lines, best = list[list[str]](), list[float]()
    for (what, healing), own in _by(rows, "what", "healing").items():
        sizes = {
            width: mean_interval([row["simulated"] for row in each])
            for (width,), each in _by(own, "width").items()
        }
        best.append(_MICRO * min(sizes, key=lambda width: float(sizes[width].mean)))
        means = [number(each) for each in sizes.values()]
        lines.append([what.partition(", ")[2], healing, *means, f"{best[-1]:.0f}"])
    widths = [f"{_MICRO * width:.0f} µm" for (width,) in _by(rows, "width")]
    seeds = len(_by(rows, "seed"))
    return {"disorder": lines, "best": best, "sizes": widths, "seeds": seeds}


def _pawls(row: Row) -> list[str]:
    d_c, friction = f"{_NANO * row['slip_distance']:g}", f"{row['simulated']:.4f}"
    times, second = f"{row['switches']:.2f}", f"{100.0 * row['prominence']:.2f}"
    return [d_c, row["healing"], f"{row['gamma']:g}", friction, times, second]
