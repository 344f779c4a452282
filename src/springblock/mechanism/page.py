"""The page on the mechanism; every number in it comes from the table."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from springblock.analysis.statistics import mean_interval
from springblock.io.rows import Row, markdown_table
from springblock.mechanism.peaks_page import peaks_section, written
from springblock.mechanism.variants_page import variants_section

#: What models are called, in the order of what they contain.
NAMES = {
    "independent": "stress alone",
    "quasi_static": "load transfer",
    "overshooting": "overshoot",
    "simulation": "full model",
}
_PAGE = """# Why static friction depends on the size of pillars, and when it has two peaks

Static friction is lowest on pillars of {lowest} blocks; the elastic layer loads the blocks most
unevenly on pillars of {most_uneven}. Their edges let go early and hand their load to the rest.
On the smallest pillars stress alone comes close to the friction of the full simulation, because
load transfer, which raises it there, and overshoot cancel. On larger ones the redistribution of
load lowers friction, and the inertia of single blocks, which overshoot as they slip, lowers it
further. A quasi-static model of stress, load transfer and overshoot agrees with the full simulation
to {small_error:.1%} up to n_p = {small} and to {worst_error:.1%} on all sizes of the first table.

Grooves along the sliding direction can have two load peaks: their edges let go together, and the
core of the pawls holds on. Across it the edges of the paper's pawls let go one by one, and the load
hardly falls. In the quasi-static model it hardly falls along the grooves either: how deep it falls
is dynamic.

## Four models

All start from the linear elasticity of the lattice, reduced to the blocks in contact
(`mechanism/elasticity.py`), and use the same friction coefficients, seed by seed.

1. **Stress before any slip.** Blocks inside a pillar are pulled by the slider alone; those at its
   edges bear the free layer beside it as well. The standard deviation of the stress over its mean
   is largest, {largest_variation:.2f}, at n_p = {most_uneven}: on pillars of two blocks all blocks
   are corners, and on wide pillars most blocks lie inside.
2. **Stress alone** (independent blocks). Each block lets go where its stress reaches $\\mu_s F_n$
   and bears $\\mu_d F_n$ from then on; no other block notices.
3. **Load transfer** (quasi-static). The layer stays in equilibrium: what a block no longer bears,
   its neighbours do. This is the limit of the simulation for strong damping and a slow slider.
4. **Overshoot.** A block that lets go accelerates and comes to rest at $(2\\mu_d - \\mu_s) F_n$, as
   one without damping between neighbours at rest. There it sticks again: its force has fallen by
   $2(\\mu_s - \\mu_d) F_n$, twice the drop of friction, most of which its neighbours bear. Slips
   follow one another while the slider stands still.

Static friction, means over {seeds} seeds with 95 % t intervals, on the smallest surfaces of
{blocks} blocks a side or more with gaps as wide as the pillars:

{table}

## What each step adds

Differences of means over the same seeds, in percent of the full model, with 95 % t intervals:

{steps}

Over the sizes, the unevenness of the stress and the friction of the full model are correlated by
{correlation:.2f}. Friction is lowest at {minima}.

{variants}
{peaks}

## Limits

- The models know no waves and no time. On the larger pillars the full model has less friction
  than the last of them. Slips of several blocks at once may overshoot further than those of one;
  that was not tested.
- Surfaces are smaller than those of the study, which changes friction: compare the models with the
  full model of the same row, not with the numbers of the other pages.
- Edges are free. In the models the slider moves along x, and all constants are the paper's where
  the tables do not say otherwise.
"""


def page(
    rows: Sequence[Row], variants: Sequence[Row], peaks: Sequence[Row], budget: Sequence[Row]
) -> str:
    """Write the page from the tables named in `mechanism.TABLES`, in their order."""
    sizes = {n_p: [row for row in rows if row["n_p"] == n_p] for n_p in _sizes(rows)}
    means = {name: _means(sizes, name) for name in NAMES}
    variation = {n_p: found[0]["stress_variation"] for n_p, found in sizes.items()}
    error = {n_p: abs(means["overshooting"][n_p] / means["simulation"][n_p] - 1.0) for n_p in sizes}
    most_uneven, lowest = max(variation, key=variation.__getitem__), _lowest(means["simulation"])
    small = max(n_p for n_p in sizes if all(error[m] < 0.01 for m in sizes if m <= n_p))
    friction = list(means["simulation"].values())
    return _PAGE.format(
        lowest=lowest,
        small=small,
        small_error=max(error[n_p] for n_p in sizes if n_p <= small),
        worst_error=max(error.values()),
        most_uneven=most_uneven,
        largest_variation=variation[most_uneven],
        seeds=min(map(len, sizes.values())),
        blocks=min(row["n_blocks"] for row in rows),
        table=_table(sizes, variation),
        steps=_steps(sizes),
        correlation=np.corrcoef(list(variation.values()), friction)[0, 1],
        variants=variants_section(variants),
        peaks=peaks_section(peaks, budget),
        minima=", ".join(f"n_p = {_lowest(means[name])} ({NAMES[name]})" for name in NAMES),
    )


def _sizes(rows: Sequence[Row]) -> list[int]:
    return sorted({row["n_p"] for row in rows})


def _means(sizes: Mapping[int, Sequence[Row]], name: str) -> dict[int, float]:
    return {n_p: float(np.mean([row[name] for row in rows])) for n_p, rows in sizes.items()}


def _lowest(friction: Mapping[int, float]) -> int:
    return min(friction, key=friction.__getitem__)


def _table(sizes: Mapping[int, Sequence[Row]], variation: Mapping[int, float]) -> str:
    lines = []
    for n_p, rows in sizes.items():
        found = [mean_interval([row[name] for row in rows]) for name in NAMES]
        lines.append([f"{n_p}", f"{variation[n_p]:.3f}", *(written(each, 4) for each in found)])
    return markdown_table(["n_p", "SD/mean of stress", *NAMES.values()], lines)


def _steps(sizes: Mapping[int, Sequence[Row]]) -> str:
    names, lines = list(NAMES), []
    for n_p, rows in sizes.items():
        whole = np.mean([row["simulation"] for row in rows])
        changes = [
            mean_interval([100.0 * (row[later] - row[former]) / whole for row in rows])
            for former, later in pairwise(names)
        ]
        lines.append([f"{n_p}", *(written(each, 1) for each in changes)])
    header = [f"{NAMES[former]} → {NAMES[later]}" for former, later in pairwise(names)]
    return markdown_table(["n_p", *header], lines)
