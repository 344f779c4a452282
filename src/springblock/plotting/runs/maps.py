"""Maps of a run, block by block."""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import CenteredNorm, to_rgb
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from springblock.plotting.figure_3 import half_range
from springblock.plotting.style import BEFORE_AFTER, BLACK, CONTACT, NO_CONTACT
from springblock.simulation.run import Array, Run

NANO = 1e9  #: nm per m
#: Of displacements; the same for all colour vision (Nuñez, Anderton & Renslow 2018,
#: doi:10.1371/journal.pone.0199239).
DISPLACED = "cividis"
_LEAST = 1e-3  #: half width of the scale around t_max, over t_max


def scale(run: Run) -> CenteredNorm:
    """Scale of t_det/t_max around 1, as in figure 3, of a run in which blocks have detached."""
    return CenteredNorm(1.0, max(half_range(run.t_det / run.t_max), _LEAST))


def painted(run: Run, until: float = math.inf, since: float = math.inf) -> Array:
    """Colours of all blocks at a time in s, (N, N, 3).

    Those that have detached have the colour of their time, or are black where they have done so
    after `since`; those that have not are distinct from those that are not in contact.
    """
    image = np.where(run.contact[..., None], to_rgb(CONTACT), to_rgb(NO_CONTACT))
    detached = run.t_det <= until
    if detached.any():
        colours = BEFORE_AFTER(scale(run)(run.t_det[detached] / run.t_max))
        image[detached] = colours[:, :3]
    image[detached & (run.t_det > since)] = to_rgb(BLACK)
    return image


def draw_map(ax: Axes, image: Array) -> AxesImage:
    """Show one value or colour per block; block (x, y) covers x ± 1/2, y ± 1/2."""
    shown = ax.imshow(image, origin="lower", interpolation="nearest")
    ax.set(xlabel="$x/l$", ylabel="$y/l$")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True, steps=[1, 2, 4, 5, 10]))
    return shown


def draw_times_bar(picture: Figure, ax: Axes, run: Run) -> None:
    """Say in `ax`, below a map, which colour stands for which time."""
    mappable = ScalarMappable(scale(run), BEFORE_AFTER)
    bar = picture.colorbar(mappable, ax, orientation="horizontal", extend="both")
    bar.set_label(r"first detachment $t_\mathrm{det}/t_\mathrm{max}$")
    for place, side, name in ((0.0, "left", "precursors"), (1.0, "right", "after the force peak")):
        ax.text(place, 1.15, name, ha=side, va="bottom", transform=ax.transAxes)


def draw_key(ax: Axes, *names: str) -> None:
    """Name colours above a map: those in `names`, and the one without contact where it occurs."""
    colours = {"not detached": CONTACT, "detaching now": BLACK, "not in contact": NO_CONTACT}
    handles = [Patch(color=colours[name], label=name) for name in names]
    ax.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=3,
        columnspacing=1.0,
        handlelength=1.0,
    )


def size_of_displacement(snapshot: Array) -> Array:
    """|u| in nm of a snapshot, (2, N, N) m."""
    return NANO * np.hypot(snapshot[0], snapshot[1])
