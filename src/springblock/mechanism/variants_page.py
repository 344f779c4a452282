"""The part of the page on flat surfaces, other gaps, layers of other thickness and scatter."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from textwrap import fill

import numpy as np

from springblock.analysis.statistics import mean_interval
from springblock.io.rows import Row, markdown_table
from springblock.mechanism.peaks_page import written

_MODELS = ("independent", "quasi_static", "overshooting", "simulation")
_THIN, _THICK = "l_z = 5 µm", "l_z = 40 µm"
_TEXT = """## Other gaps, layers and scatter, and flat surfaces

Where the stress is most uneven, and where friction is lowest, as n_p of the sizes computed; on
surfaces of 30 blocks a side or more, over {seeds} seeds. In brackets: sizes that cannot be told
from it, as the 95 % t interval of their mean overlaps that of the lowest. The stress has no
interval, since chance plays no part in it.

{table}

{sentences}
- **Flat surfaces** have even stress and no edges. Friction is {flat[0]} with stress alone,
  {flat[1]} with load transfer, {flat[2]} with overshoot, and {flat[3]} in the full model.

On the thinnest layer unevenness and friction part, since unevenness hardly matters there: its
largest value, {uneven:.2f}, is about the scatter of the thresholds, 0.1. Stress alone is lowest
beside the most uneven size, at n_p = {stress_alone}. Load transfer moves the minimum to
n_p = {transfer}, and the full model has it at {full}, but so shallow that sizes of {near[0]} to
{near[1]} blocks cannot be told apart there. On the thickest layer the models fail: slips of
single blocks raise friction there, and the full model lies {thick} % below the last of them,
on average over the sizes.
"""


def variants_section(rows: Sequence[Row]) -> str:
    """Write the section from the table `mechanism_variants`."""
    flat, cases = [row for row in rows if not row["n_p"]], _cases(rows)
    thin = cases[_THIN]
    full, near = _lowest(thin, "simulation")
    return _TEXT.format(
        uneven=max(found[0]["stress_variation"] for found in thin.values()),
        stress_alone=_lowest(thin, "independent")[0],
        transfer=_lowest(thin, "quasi_static")[0],
        full=full,
        thick=_excess(cases[_THICK]),
        near=(min(near), max(near)),
        seeds=min(len(found) for sizes in cases.values() for found in sizes.values()),
        table=_table(cases),
        sentences="\n".join(_sentence(name, sizes) for name, sizes in cases.items()),
        flat=[written(mean_interval([row[name] for row in flat]), 3) for name in _MODELS],
    )


def _cases(rows: Sequence[Row]) -> dict[str, dict[int, list[Row]]]:
    """Return rows by case, and by n_p within a case."""
    cases: dict[str, dict[int, list[Row]]] = {}
    for row in (row for row in rows if row["n_p"]):
        sizes = cases.setdefault(_case(row), {})
        sizes.setdefault(row["n_p"], []).append(row)
    return cases


def _case(row: Row) -> str:
    constant = row["varied"].partition("=")[0]
    if constant == "thickness":
        return f"l_z = {1e6 * row['thickness']:g} µm"
    if constant == "mu_static_std":
        return f"scatter {row['mu_static_std']:g}"
    return f"n_s = {row['n_s'] / row['n_p']:g} n_p"


def _lowest(sizes: Mapping[int, Sequence[Row]], model: str) -> tuple[int, list[int]]:
    """Return the n_p of lowest friction, and all that cannot be told from it."""
    found = {n_p: mean_interval([row[model] for row in rows]) for n_p, rows in sizes.items()}
    best = min(found, key=lambda n_p: float(found[n_p].mean))
    return best, [n_p for n_p, here in found.items() if here.low <= found[best].high]


def _excess(sizes: Mapping[int, Sequence[Row]]) -> str:
    """Return by how much overshoot overrates friction, % of itself, a mean over sizes."""
    below = [
        [100.0 * (1.0 - row["simulation"] / row["overshooting"]) for row in rows]
        for rows in sizes.values()
    ]
    return written(mean_interval(np.mean(below, axis=0)), 1)


def _table(cases: Mapping[str, Mapping[int, Sequence[Row]]]) -> str:
    lines = []
    for name, sizes in cases.items():
        uneven = {n_p: found[0]["stress_variation"] for n_p, found in sizes.items()}
        most = max(uneven, key=uneven.__getitem__)
        cells = [f"{most} ({uneven[most]:.2f})"]
        for model in _MODELS:
            best, near = _lowest(sizes, model)
            cells.append(f"{best} [{min(near)}, {max(near)}]")
        lines.append([name, ", ".join(map(str, sizes)), *cells])
    header = ["case", "sizes n_p", "most uneven (SD/mean)"]
    names = ["stress alone", "load transfer", "overshoot", "full model"]
    return markdown_table([*header, *names], lines)


def _sentence(name: str, sizes: Mapping[int, Sequence[Row]]) -> str:
    """Say from which model on the lowest size of the full one is among theirs, in brackets.

    A model that cannot tell any size from its lowest agrees with nothing.
    """
    full, _ = _lowest(sizes, "simulation")
    near = [_lowest(sizes, model)[1] for model in _MODELS[:-1]]
    agree = [full in here and len(here) < len(sizes) for here in near] + [True]
    first = next(i for i in range(len(agree)) if all(agree[i:]))
    words = (
        "the models agree from uneven stress on",
        "the models agree from load transfer on",
        "the models agree from overshoot on",
        "none of the simpler models agrees",
    )
    bound = ", the largest computed" if full == max(sizes) else ""
    changes = [
        written(mean_interval([100.0 * (row[b] / row[a] - 1.0) for row in sizes[full]]), 1)
        for a, b in pairwise(_MODELS)
    ]
    return fill(
        f"- **{name}**: friction is lowest at n_p = {full}{bound}; {words[first]}. At this "
        f"size load transfer changes friction by {changes[0]} %, overshoot by {changes[1]} %, and "
        f"the step from there to the full model by {changes[2]} %.",
        width=100,
        subsequent_indent="  ",
    )
