"""Supplement: sliding at an angle to the grooves; the paper has 0 and 90 degrees (section 3.3)."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from springblock.analysis.statistics import lesser_prominence, mean_interval
from springblock.plotting.declaration import (
    INTERVALS,
    Declaration,
    RealisationsSource,
    one_pattern,
)
from springblock.plotting.looks import direction_color
from springblock.plotting.points import draw_point, friction_and_lag, highest_and_lag
from springblock.plotting.style import GREY, PERCENT, Look, journal
from springblock.simulation.run import Array, Run, friction

FIGURE = Declaration(
    title="Sliding at an angle to grooves",
    category="Supplement",
    caption=f"""a) Static friction, b) t_max - t_avg and c) prominence of the lesser load peak over
    the angle between the sliding direction and the grooves, 0 and 90 degrees in the paper. The
    prominence is how far the second most prominent load peak of a run stands out of the force
    around it, over the largest force, small waves included; 0 where there is one peak alone. Small
    dots: single runs; large ones: means with {INTERVALS}.""",
    source=RealisationsSource(groups=("grooves", "angles"), keys=("direction",), pick=one_pattern),
)

_AXES = {"x": 0.0, "y": 90.0}  #: degrees from the grooves, which run along x
_SPREAD = 2.0  #: degrees over which single runs are spread
_DOT: Look = {"marker": ".", "markersize": 2.8, "alpha": 0.5, "markeredgewidth": 0.0}


@journal
def draw(ensembles: Mapping[str, Sequence[Run]]) -> Figure:
    """Draw what changes with the angle between sliding and grooves.

    That is a) static friction, b) t_max - t_avg and c) the prominence of the lesser load peak.
    `ensembles` holds runs by sliding direction: "x", "y" or degrees from x.
    """
    label = "angle between sliding and grooves (°)"
    picture, panels = friction_and_lag(label, "lesser peak (% of force)")
    angles = {name: float(_AXES.get(name, name)) for name in ensembles}
    names = sorted(angles, key=lambda name: angles[name])
    places = [angles[name] for name in names]
    samples = zip(*(_quantities(ensembles[name]) for name in names), strict=True)
    for ax, values in zip(panels, samples, strict=True):
        ax.plot(places, [sample.mean() for sample in values], color=GREY, linewidth=0.6)
        for name, angle, sample in zip(names, places, values, strict=True):
            color = direction_color(name)
            aside = _SPREAD * np.linspace(-1.0, 1.0, len(sample))
            ax.plot(angle + aside, sample, color=color, linestyle="none", **_DOT)
            draw_point(ax, angle, mean_interval(sample), color, marker="o", zorder=3)
        ax.set_xticks(places)
    panels[2].set_ylim(0.0, None)
    return picture


def _quantities(runs: Sequence[Run]) -> tuple[Array, Array, Array]:
    """Static friction, t_max - t_avg in µs, and prominence of the lesser peak in %, (k,) each."""
    lesser = np.array([PERCENT * lesser_prominence(friction(run)) for run in runs])
    return *highest_and_lag(runs), lesser
