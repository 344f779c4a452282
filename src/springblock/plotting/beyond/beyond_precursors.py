"""Beyond the paper: clusters of precursors, and correlation by sliding direction."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.correlation import Correlation
from springblock.analysis.statistics import Interval, cluster_sizes
from springblock.beyond.clusters import Mask, mixed, precursors, shuffled, surfaces
from springblock.beyond.question import Ensembles, by_scene
from springblock.beyond.sliding import by_angle, edges
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.curves import draw_band
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.looks import pillar_look, pillar_name, shades
from springblock.plotting.style import GREY, Look, journal

FIGURE = Declaration(
    title="Clusters of precursors, and correlation by direction",
    category="Beyond",
    caption="""a) Share of the blocks that detach before the force maximum in clusters of a size or
    more, 4 neighbours together: solid, observed; dashed, as many blocks anywhere in contact;
    dotted, blocks in the same places, each from another realisation. b) Correlation of detachment
    times along the edges of grooves within pillars, by the angle between sliding direction and
    grooves, with 95 % intervals over realisations.""",
    source=RealisationsSource(groups=("flat", "pillars", "grooves", "angles"), keys=("folder",)),
)

_SHOWN = (0, 6, 20)  #: n_p
_LAST = 15  #: blocks


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw a) clusters of precursors beside those of chance and b) c(r) by angle.

    `ensembles` holds realisations by folder.
    """
    found = by_scene(list(chain.from_iterable(ensembles.values())))
    picture, (clusters, angles) = style.panels(style.DOUBLE, 73.0, "ab")
    _draw_clusters(clusters, found)
    _draw_angles(angles, found)
    return picture


def _draw_clusters(ax: Axes, ensembles: Ensembles) -> None:
    shown = {s: runs for s, runs in surfaces(ensembles).items() if not s.n_p2 and s.n_p in _SHOWN}
    rng = np.random.default_rng(0)
    for scene, runs in shown.items():
        masks, color = [precursors(run) for run in runs], pillar_look(scene.n_p)["color"]
        anywhere = [shuffled(mask, scene.contact, rng) for mask in masks]
        _draw_shares(ax, masks, color, linestyle="-", label=pillar_name(scene.n_p))
        _draw_shares(ax, anywhere, color, linestyle="--", linewidth=0.7)
        _draw_shares(ax, mixed(masks, rng), color, linestyle=":", linewidth=0.9)
    ax.set_xscale("log")
    ax.set(xlabel="size of the cluster (blocks)", ylabel="share of precursors in clusters as large")
    ax.set_ylim(0.0, 1.03)
    for line, word in (("-", "observed"), ("--", "anywhere"), (":", "same places")):
        ax.plot([], [], color=GREY, linestyle=line, label=word)
    ax.legend(loc="upper right")
    ax.set_xlim(0.9, 3000.0)


def _draw_shares(ax: Axes, masks: Iterable[Mask], color: Any, **look: Any) -> None:
    """Share of blocks in clusters of a size or more."""
    sizes = np.sort(np.concatenate([cluster_sizes(mask) for mask in masks]))
    share = np.cumsum(sizes[::-1])[::-1] / sizes.sum()
    ax.step(sizes, share, where="pre", color=color, **look)


def _draw_angles(ax: Axes, ensembles: Ensembles) -> None:
    found = by_angle(ensembles)
    colors = shades(found)
    for angle, runs in found.items():
        curve = Correlation(edges(runs)["grooves"]).interval
        shown = Interval(*(part[: _LAST + 1] for part in curve))
        look: Look = {"marker": "o", "markersize": 2.0, "label": f"{angle:g}°"}
        draw_band(ax, range(len(shown.mean)), shown, colors[angle], 0.12, **look)
    ax.axhline(0.0, color=GREY, linewidth=0.5, zorder=0)
    ax.set(xlabel="distance along grooves $r$ (blocks)", ylabel="time correlation $c(r)$")
    ax.legend(loc="upper right", title="sliding at", ncols=2)
