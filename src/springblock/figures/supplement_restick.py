"""Supplement: how often blocks come to rest and let go again, which the re-stick rule decides.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525, do not say when a sliding block
sticks again. Up to the force maximum the rule can matter only for blocks that do.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.declaration import Declaration, Realisations
from springblock.figures.ensembles import Key, Runs, in_order, name_surface, size_colors
from springblock.figures.style import journal
from springblock.run import Array, Run, percent
from springblock.statistics import mean_interval

FIGURE = Declaration(
    title="Blocks that let go again",
    category="Supplement",
    caption="""Blocks that have come to rest and let go again, over time, as a share of all blocks
    in contact; the re-stick rule can matter for no more. Means over realisations with 95 %
    t intervals. The paper does not say when a sliding block sticks; of the two integrators,
    `rk4` lets every block that turns back stick, `leapfrog` only those that static friction can
    hold.""",
    source=Realisations(groups=("flat", "pillars", "grooves"), keys=("n_p", "n_p2", "direction")),
)

#: Times over t_max at which runs are compared.
_TIMES = np.linspace(0.0, 1.05, 106)


def let_go_again(run: Run) -> Array:
    """Switches from rest to sliding that are no first ones, up to `_TIMES`, % of all blocks."""
    again = np.cumsum(percent(run, run.switches) - percent(run, run.detachments))
    return np.interp(_TIMES, run.time / run.t_max, again)


@journal
def draw(ensembles: Mapping[Key, Runs]) -> Figure:
    """Draw how many blocks have let go again over time, for each surface.

    `ensembles` holds runs by (n_p, n_p2, direction).
    """
    picture = style.figure(style.COLUMN, 74.0)
    ax = style.axes(picture, 16.0, 11.0, 71.0, 41.0)
    colors = size_colors(n_p for n_p, n_p2, _ in ensembles if not n_p2)
    for key in in_order(ensembles):
        name, color = name_surface(key, colors)
        mean, low, high = mean_interval([let_go_again(run) for run in ensembles[key]])
        ax.plot(_TIMES, mean, color=color, label=name)
        ax.fill_between(_TIMES, low, high, color=color, alpha=0.25, linewidth=0.0)
    ax.set(xlabel=r"time $t/t_\mathrm{max}$", ylabel="let go again (% of blocks)")
    ax.set(xlim=(0.5, _TIMES[-1]), ylim=(0.0, None))
    ax.axvline(1.0, color=style.GREY, linewidth=0.5, zorder=0)
    picture.legend(loc="upper center", ncols=3)
    return picture
