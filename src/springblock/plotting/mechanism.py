"""Figure of the mechanism: stress before slip, and friction by model."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.mechanism.elasticity import Layer
from springblock.mechanism.page import NAMES
from springblock.mechanism.surfaces import TABLES
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.plotting import style
from springblock.plotting.curves import FRICTION, draw_means, name_places
from springblock.plotting.maps import draw_map
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, VERMILION, Look, color_bar

_SHOWN = (3, 6, 10, 20)  #: n_p of the pillars whose stress is mapped
_COLORS = "cividis"
_LOOKS: dict[str, Look] = {
    "independent": {"color": BLUE, "marker": "s", "linestyle": ":"},
    "quasi_static": {"color": GREEN, "marker": "^", "linestyle": "-."},
    "overshooting": {"color": VERMILION, "marker": "D", "linestyle": "--"},
    "simulation": {"color": BLACK, "marker": "o"},
}


def mechanism_friction(table: pd.DataFrame) -> Figure:
    """Draw a-d) stress on pillars, e) its relative deviation and f) friction by model over n_p."""
    picture, panels = style.panels(style.DOUBLE, 118.0, "abcd|eeff", height_ratios=(45, 73))
    _draw_stress(panels[:4])
    uneven, friction = panels[4:]
    variation = table.groupby("n_p")["stress_variation"].first()
    uneven.plot(variation.index, variation, color=GREY, marker="o")
    uneven.set(ylabel="stress: standard deviation over mean", ylim=(0.0, None))
    for name, look in _LOOKS.items():
        samples = {n_p: part[name] for n_p, part in table.groupby("n_p")}
        draw_means(friction, samples, **look, label=NAMES[name])
    friction.set_ylabel(FRICTION)
    friction.legend(loc="upper right", ncols=2)
    for ax in (uneven, friction):
        name_places(ax, table["n_p"])
        ax.set_xlabel("size of pillars $n_p$ (blocks)")
    return picture


def _draw_stress(panels: Sequence[Axes]) -> None:
    """Map the stress on one pillar of each size over its mean, in common colours."""
    stresses = {n_p: _pillar_stress(n_p) for n_p in _SHOWN}
    limits = min(map(np.min, stresses.values())), max(map(np.max, stresses.values()))
    for ax, (n_p, stress) in zip(panels, stresses.items(), strict=True):
        image = draw_map(ax, stress, "_p/l", cmap=_COLORS, vmin=limits[0], vmax=limits[1])
        ax.set_title(f"$n_p$ = {n_p}", loc="right")
    color_bar(panels[-1], image, "stress over its mean")


def _pillar_stress(n_p: int) -> Array:
    """Return |F_mot| on the blocks of the first pillar before any slip, over the mean of all."""
    pattern = TABLES["mechanism"][str(n_p)][0].pattern
    pulled = Layer(pattern.contact, Material()).stress
    stress = np.zeros(pattern.shape)
    stress[pattern.contact] = pulled / pulled.mean()
    y, x = pattern.origins[0]
    return stress[y : y + n_p, x : x + n_p]
