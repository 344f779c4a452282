"""Beyond the paper: load peaks over the widths of grooves and the sliding direction."""

from collections.abc import Mapping, Sequence
from itertools import chain, product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from springblock.beyond.peaks import Grooves, by_grooves
from springblock.beyond.question import by_scene
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.style import journal
from springblock.simulation.run import Array

FIGURE = Declaration(
    title="Load peaks over groove widths and direction",
    category="Beyond",
    caption="""Prominence of the second most prominent load peak in percent of the largest force,
    mean over realisations, over the angle between sliding direction and grooves and the width of
    pawls n_p2: on pillars (left) and over the whole surface (right), with narrow (above) and wide
    grooves (below). A prominence cannot be negative; what scatter alone leaves is that of light
    cells.""",
    source=RealisationsSource(groups=("peaks",), keys=("folder",)),
)

ByGrooves = Mapping[Grooves, Mapping[float, Array]]  #: prominences by angle
_LETTERS = ("ab", "cd")
_COLORS = "viridis_r"


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw a map for each width of grooves, with pillars and without.

    `ensembles` holds realisations by folder.
    """
    found = by_grooves(by_scene(list(chain.from_iterable(ensembles.values()))))
    largest = max(float(v.mean()) for angles in found.values() for v in angles.values())
    widths = sorted({key.n_s2 for key in found})
    letters = ";".join(_LETTERS[: len(widths)])
    picture, panels = style.panels(style.ONE_AND_A_HALF, 6.0 + 55.0 * len(widths), letters)
    for ax, (n_s2, pillars) in zip(panels, product(widths, (True, False)), strict=True):
        part = {k: v for k, v in found.items() if k.n_s2 == n_s2 and bool(k.n_p) is pillars}
        if part:
            _draw_map(ax, part, largest)
        where = "on pillars" if pillars else "whole surface"
        ax.set_title(f"{where}, $n_{{s2}}$ = {n_s2}")
        ax.set(xlabel="angle to grooves (°)", ylabel="width of pawls $n_{p2}$ (blocks)")
    colors = ScalarMappable(Normalize(0.0, largest), _COLORS)
    picture.colorbar(colors, ax=panels, label="prominence of the lesser load peak (%)", aspect=40)
    return picture


def _draw_map(ax: Axes, part: ByGrooves, largest: float) -> None:
    """Cells by angle and pawl, coloured and numbered."""
    angles = sorted({angle for each in part.values() for angle in each})
    pawls = sorted(key.n_p2 for key in part)
    cells = np.full((len(pawls), len(angles)), np.nan)
    for key, each in part.items():
        for angle, values in each.items():
            cells[pawls.index(key.n_p2), angles.index(angle)] = values.mean()
    ax.imshow(cells, cmap=_COLORS, vmin=0.0, vmax=largest, origin="lower", aspect="auto")
    for (row, column), value in np.ndenumerate(cells):
        if np.isfinite(value):
            color = "white" if value > 0.55 * largest else "black"
            ax.text(column, row, f"{value:.1f}", ha="center", va="center", color=color)
    ax.set_xticks(range(len(angles)), [f"{angle:g}" for angle in angles])
    ax.set_yticks(range(len(pawls)), [str(pawl) for pawl in pawls])
    ax.tick_params(length=0.0)
