"""Style of all figures: sizes, colours, names and panels, and reproducible files.

Figures are drawn without pyplot, independently of global state: the decorator `journal` applies the
style whatever the user's own settings are.
"""

from collections.abc import Iterable
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps, style
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from springblock.files import whole_file

Look = dict[str, Any]  #: of a line, of markers or of text

MM = 1.0 / 25.4  #: one millimetre in inches, matplotlib's unit
MICRO, NANO = 1e6, 1e9  #: µs and ns per s; nm per m
KILO = 1e-3  #: kPa per Pa
PERCENT = 100.0
FORCE = r"friction force $F_\mathrm{fr}/F_n$"
COLUMN, ONE_AND_A_HALF, DOUBLE = 90.0, 140.0, 190.0  #: widths of the journal's columns, mm

# Colour-blind safe (Okabe & Ito 2008, https://jfly.uni-koeln.de/color/). In figures of surfaces
# black is flat; blue is along x, vermilion along y and green oblique, for sides as for sliding
# directions. Pillars have the colours of `pillar_looks`, and lines of sweeps all colours in turn.
BLACK = "#000000"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILION = "#D55E00"
PURPLE = "#CC79A7"

GREY = "#6E6E6E"  #: guides and secondary text
CONTACT = "#93A8BA"  #: blocks that touch the substrate
NO_CONTACT = "#E4E4E4"  #: blocks above a groove or a gap

#: Blue before t_max, red after it, with a step between them, since a block is a precursor or not.
#: Precursors are darker in shades of grey, too.
BEFORE_AFTER = LinearSegmentedColormap.from_list(
    "before_after",
    [(0.0, "#08306B"), (0.5, "#7FB2DB"), (0.5, "#FCEAE2"), (0.8, "#F2AD95"), (1.0, "#DC6B55")],
).with_extremes(bad=NO_CONTACT)

#: Integrators by name. Symbols of Runge-Kutta are open, as some cover those of the leapfrog.
METHODS: dict[str, Look] = {
    "leapfrog": {"label": "leapfrog", "color": BLUE, "marker": "o"},
    "rk4": {"label": "Runge–Kutta", "color": VERMILION, "marker": "s"}
    | {"markersize": 3.8, "markerfacecolor": "none"},
}
#: By n_p.
_MARKERS = {2: "v", 3: "s", 4: ">", 5: "p", 6: "^", 7: "d", 8: "8", 9: "h"}
_MARKERS |= {10: "*", 20: "D", 30: "P", 60: "X"}
_LARGEST = 60  #: n_p at the light end of the colours, and two at the dark one
#: Ordered for all colour vision, from blue to an orange; the yellow beyond it fades on white.
_SHADES = LinearSegmentedColormap.from_list(
    "shades", colormaps["plasma"](np.linspace(0.0, 0.66, 33))
)

SMALL = 7.0  #: pt, ticks, legends and labels inside a panel
NORMAL = 8.0  #: pt, axis labels

#: Changes to matplotlib's own style, whose font comes with it and is the same on every computer.
JOURNAL: Look = {
    "font.size": SMALL,
    "axes.labelsize": NORMAL,
    "axes.titlesize": NORMAL,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "legend.borderaxespad": 0.4,
    "axes.linewidth": 0.6,
    "axes.labelpad": 3.0,
    "lines.linewidth": 1.0,
    "lines.markersize": 3.0,
    "patch.linewidth": 0.6,
    "hatch.linewidth": 0.4,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "xtick.minor.size": 1.5,
    "ytick.minor.size": 1.5,
    "savefig.dpi": 600,
    "pdf.fonttype": 42,  # TrueType: text stays text
    "svg.hashsalt": "springblock",  # the same identifiers every time
}

#: Decorator of functions that make artists and of those that save them; both depend on the style.
journal = style.context(JOURNAL, after_reset=True)

#: Without date and program version the same figure gives the same bytes.
_METADATA: dict[str, dict[str, str | None]] = {
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
}


def panels(
    width: float, height: float, letters: str = "a", **placing: Any
) -> tuple[Figure, list[Axes]]:
    """Make a figure of `width` x `height` mm with panels where `letters` has them.

    In "ab;cd|ef" semicolons end rows, and below a bar are columns of their own. Panels come in the
    order of their letters, with "a)" above each if there are several. `placing` are further
    arguments of `Figure.subplot_mosaic`.
    """
    picture = page(width, height)
    blocks = [[list(row) for row in block.split(";")] for block in letters.split("|")]
    mosaic: Any = [[block] for block in blocks] if len(blocks) > 1 else blocks[0]
    placed = picture.subplot_mosaic(mosaic, **placing)
    for letter, ax in placed.items():
        if len(placed) > 1:
            ax.set_title(f"{letter})", loc="left", fontweight="bold")
    return picture, [placed[letter] for letter in sorted(placed)]


def page(width: float, height: float) -> Figure:
    """Make an empty figure of `width` x `height` mm, whose panels keep their labels apart."""
    layout = ConstrainedLayoutEngine(w_pad=2.0 * MM)
    return Figure(figsize=(width * MM, height * MM), layout=layout)


def legend_above(picture: Figure, *panels: Axes, **look: Any) -> None:
    """Draw one legend for several panels above them, each name once."""
    named: dict[str, Artist] = {}
    for ax in panels:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            named.setdefault(label, handle)
    picture.legend(named.values(), named.keys(), **{"loc": "outside upper center"} | look)


def color_bar(ax: Axes, mappable: ScalarMappable, label: str, **look: Any) -> Colorbar:
    """Draw a bar of colours as long as a panel, at its right or, if horizontal, below."""
    below = look.get("orientation") == "horizontal"
    place = ax.inset_axes((0.0, -0.24, 1.0, 0.04) if below else (1.05, 0.0, 0.05, 1.0))
    picture: Any = ax.figure
    bar: Colorbar = picture.colorbar(mappable, place, label=label, **look)
    bar.outline.set_linewidth(JOURNAL["axes.linewidth"])
    return bar


def shades(values: Iterable[float]) -> dict[float, Any]:
    """Return a colour for each value, from dark for the smallest to light."""
    ordered = sorted(set(values))
    return dict(zip(ordered, map(tuple, _SHADES(np.linspace(0.0, 1.0, len(ordered)))), strict=True))


def pillar_looks(sizes: Iterable[int]) -> dict[int, Look]:
    """Return the colours and markers of pillars by their size; 0 is a flat surface.

    Sizes in `_MARKERS` have colours and markers of their own; if there are others, all sizes have
    those of their rank.
    """
    every = sorted({*sizes} - {0})
    colors, markers = shades(every), dict(zip(every, cycle(_MARKERS.values()), strict=False))
    if {*every} <= {*_MARKERS}:
        colors = {n_p: _SHADES(np.log(n_p / 2.0) / np.log(_LARGEST / 2.0)) for n_p in every}
        markers = _MARKERS
    own: dict[int, Look] = {n_p: {"color": colors[n_p], "marker": markers[n_p]} for n_p in every}
    return {0: {"color": BLACK, "marker": "o"}} | own


def span(values: Iterable[int]) -> str:
    """Return the range of some numbers: 20, or 20 to 300."""
    lowest, *_, highest = sorted([*values] * 2)
    return f"{lowest}" if lowest == highest else f"{lowest} to {highest}"


@journal
def settle(picture: Figure) -> None:
    """Give panels their final places, with the text and arrows beside them on the page.

    Two passes, as these change with the panel; rounded, as the layout sums in any order.
    """
    for _ in range(2):
        if engine := picture.get_layout_engine():
            engine.execute(picture)
    picture.set_layout_engine("none")
    for ax in picture.axes:
        ax.set_position(np.round(ax.get_position(original=True).bounds, 6))


@journal
def save(picture: Figure, path: Path, caption: str = "") -> None:
    """Write a figure as PDF, PNG (600 dpi) or SVG, by the suffix of `path`, whole or not at all.

    Its bytes depend on the picture and the caption alone, which is kept in the metadata.
    """
    key = "Subject" if path.suffix == ".pdf" else "Description"
    metadata = _METADATA[path.suffix] | ({key: caption} if caption else {})
    settle(picture)
    with whole_file(path) as partial:
        picture.savefig(partial, format=path.suffix[1:], metadata=metadata)
