"""Supplement: how often blocks come to rest and let go again, which the re-stick rule decides.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525, do not say when a sliding block
sticks again. Up to the force maximum the rule can matter only for blocks that do.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from springblock.analysis.statistics import mean_interval
from springblock.plotting import style
from springblock.plotting.curves import draw_band
from springblock.plotting.declaration import (
    INTERVALS,
    Declaration,
    RealisationsSource,
    main_surfaces,
)
from springblock.plotting.looks import Key, in_order, surface_look
from springblock.plotting.style import journal
from springblock.simulation.run import Array, Run, percent

FIGURE = Declaration(
    title="Blocks that let go again",
    category="Supplement",
    caption=f"""Blocks that have come to rest and let go again, over time, as a share of all blocks
    in contact; the re-stick rule can matter for no more. Means with {INTERVALS}. The paper does not
    say when a sliding block sticks; of the two integrators, `rk4` lets every block that turns back
    stick, `leapfrog` only those that static friction can hold.""",
    source=RealisationsSource(
        groups=("flat", "pillars", "grooves"),
        keys=("n_p", "n_p2", "direction"),
        pick=main_surfaces,
    ),
)

#: Times over t_max at which runs are compared.
_TIMES = np.linspace(0.0, 1.05, 106)
_FLOOR = 0.03  #: %, where the axis begins: four blocks of a flat surface


def let_go_again(run: Run) -> Array:
    """Switches from rest to sliding that are no first ones, up to `_TIMES`, % of all blocks."""
    again = np.cumsum(percent(run, run.switches) - percent(run, run.detachments))
    return np.interp(_TIMES, run.time / run.t_max, again)


@journal
def draw(ensembles: Mapping[Key, Sequence[Run]]) -> Figure:
    """Draw how many blocks have let go again over time, for each surface.

    `ensembles` holds runs by (n_p, n_p2, direction).
    """
    picture, (ax,) = style.panels(style.COLUMN, 80.0)
    ax.set(yscale="log", ylim=(_FLOOR, 50.0))
    ax.yaxis.set_major_formatter("{x:g}")
    for i, key in enumerate(in_order(ensembles)):
        name, look = surface_look(key)
        again = mean_interval([let_go_again(run) for run in ensembles[key]])
        draw_band(ax, _TIMES, again, **look, label=name, markevery=(62 + 3 * (i % 4), 12))
    ax.set(xlabel=r"time $t/t_\mathrm{max}$", ylabel="let go again (% of blocks)")
    ax.set(xlim=(0.6, _TIMES[-1]))
    ax.axvline(1.0, color=style.GREY, linewidth=0.5, zorder=0)
    picture.legend(loc="outside upper center", ncols=3)
    return picture
