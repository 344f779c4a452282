"""Figure 3: map of the first detachment times (section 3.1 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.colors import CenteredNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch

from springblock.plotting import style
from springblock.plotting.declaration import Declaration, Realisations
from springblock.plotting.style import BEFORE_AFTER, NO_CONTACT, journal
from springblock.simulation.run import Array, Run

FIGURE = Declaration(
    title="First detachment times, flat surface",
    category="Figures",
    caption="""First detachment times t_det over t_max of the realisation shown in figure 2: blue
    blocks detach before the force peak, red ones after it. One realisation; a map of single events
    has no error bar. Figure 3 of the paper.""",
    source=Realisations(groups=("flat",), batches=1),
)

_ROBUST = (1.0, 99.0)  #: percentiles of the times that the colours cover


@journal
def draw(runs: Sequence[Run]) -> Figure:
    """Map t_det/t_max of every block in runs[0]; light grey where a block is not in contact."""
    times = runs[0].t_det / runs[0].t_max
    has_grey = bool(np.isnan(times).any())
    picture = style.figure(style.COLUMN, 99.0 if has_grey else 95.0)
    ax = style.axes(picture, 13.5, 24.0, 69.0, 69.0)
    norm = CenteredNorm(1.0, half_range(times))
    image = ax.imshow(times, cmap=BEFORE_AFTER, norm=norm, origin="lower", interpolation="nearest")
    ax.set(xlabel="$x/l$", ylabel="$y/l$")
    if has_grey:
        grey = Patch(color=NO_CONTACT, label="not in contact")
        ax.legend(handles=[grey], loc="lower right", bbox_to_anchor=(1.0, 1.0))
    _draw_bar(picture, image)
    return picture


def _draw_bar(picture: Figure, image: AxesImage) -> None:
    ax = style.axes(picture, 13.5, 9.5, 69.0, 3.0)
    bar = picture.colorbar(image, ax, orientation="horizontal", extend="both")
    bar.set_label(r"first detachment $t_\mathrm{det}/t_\mathrm{max}$")
    for place, side, name in ((0.0, "left", "precursors"), (1.0, "right", "after the force peak")):
        ax.text(place, 1.15, name, ha=side, va="bottom", transform=ax.transAxes)


def half_range(times: Array) -> float:
    """Distance from 1 that takes in the times within the robust percentiles."""
    return float(np.abs(np.nanpercentile(times, _ROBUST) - 1.0).max())
