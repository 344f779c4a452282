"""Supplement: sliding at an angle to the grooves; the paper has 0 and 90 degrees (section 3.3).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.statistics import lesser_prominence, mean_interval
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations, one_pattern
from springblock.plotting.ensembles import (
    FRICTION,
    LAG,
    Runs,
    direction_color,
    draw_no_lag,
    draw_point,
    highest_and_lag,
    stacked_panels,
)
from springblock.plotting.style import GREY, journal
from springblock.simulation.run import Array, friction

FIGURE = Declaration(
    title="Sliding at an angle to grooves",
    category="Supplement",
    caption=f"""a) Static friction, b) t_max - t_avg and c) prominence of the lesser load peak over
    the angle between the sliding direction and the grooves, 0 and 90 degrees in the paper. The
    prominence is how far the second most prominent load peak of a run stands out of the force
    around it, over the largest force, small waves included; 0 where there is one peak alone. Small
    dots: single runs; large ones: means with {INTERVALS}.""",
    source=Realisations(groups=("grooves", "angles"), keys=("direction",), pick=one_pattern),
)

_AXES = {"x": 0.0, "y": 90.0}  #: degrees from the grooves, which run along x


_SPREAD = 2.0  #: degrees over which single runs are spread


@journal
def draw(ensembles: Mapping[str, Runs]) -> Figure:
    """Draw what changes with the angle between sliding and grooves.

    That is a) static friction, b) t_max - t_avg and c) the prominence of the lesser load peak.
    `ensembles` holds runs by sliding direction: "x", "y" or degrees from x.
    """
    labels = (FRICTION, LAG, "lesser peak (% of force)")
    picture, panels = stacked_panels("angle between sliding and grooves (°)", labels)
    angles = {name: float(_AXES.get(name, name)) for name in ensembles}
    names = sorted(angles, key=lambda name: angles[name])
    samples = zip(*(_quantities(ensembles[name]) for name in names), strict=True)
    for ax, values in zip(panels, samples, strict=True):
        places = [angles[name] for name in names]
        ax.plot(places, [sample.mean() for sample in values], color=GREY, linewidth=0.6)
        for name, sample in zip(names, values, strict=True):
            _draw_sample(ax, angles[name], sample, direction_color(name))
        ax.set_xticks(places)
        ax.margins(x=0.06)
    draw_no_lag(panels[1])
    panels[2].set_ylim(0.0, None)
    return picture


def _quantities(runs: Runs) -> tuple[Array, Array, Array]:
    """Static friction, t_max - t_avg in µs, and prominence of the lesser peak in %, (k,) each."""
    lesser = np.array([100.0 * lesser_prominence(friction(run)) for run in runs])
    return *highest_and_lag(runs), lesser


def _draw_sample(ax: Axes, angle: float, sample: Array, color: str) -> None:
    """Single runs side by side, and their mean."""
    places = angle + _SPREAD * np.linspace(-1.0, 1.0, len(sample))
    ax.plot(places, sample, ".", color=color, markersize=2.8, alpha=0.5, markeredgewidth=0.0)
    draw_point(ax, angle, mean_interval(sample), color, marker="o", zorder=3)
