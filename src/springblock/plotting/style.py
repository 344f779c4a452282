"""One look for all figures: sizes, colours, panel letters, and files that are always the same.

Figures are drawn without pyplot, so that nothing depends on global state: `draw` functions wear
the decorator `journal`, which puts the style in force whatever the reader's own settings are.
"""

from pathlib import Path
from typing import Any

from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.text import Text

from springblock.files import whole_file

MM = 1.0 / 25.4  #: one millimetre in inches, matplotlib's unit
MICRO = 1e6  #: µs per s
COLUMN, ONE_AND_A_HALF, DOUBLE = 90.0, 140.0, 190.0  #: widths of the journal's columns, mm

# Colour-blind safe (Okabe & Ito 2008, https://jfly.uni-koeln.de/color/). In figures of surfaces
# black is flat, blue goes along x, vermilion along y and green askew, whether it is a side or the
# slider; purple is a third level. Pillars have the colours of `ensembles.pillar_look`.
BLACK = "#000000"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILION = "#D55E00"
PURPLE = "#CC79A7"

GREY = "#6E6E6E"  #: guides and secondary text
CONTACT = "#93A8BA"  #: blocks that touch the substrate
NO_CONTACT = "#E4E4E4"  #: blocks above a groove or a gap

#: Blue before t_max, red after it. The blue end is darker than the red one, so that in shades of
#: grey, too, the precursors are the darkest spots.
BEFORE_AFTER = LinearSegmentedColormap.from_list(
    "before_after", ["#08306B", "#2A6FB5", "#8DBBE0", "#FFFFFF", "#F6B69B", "#E0654F", "#C8322F"]
).with_extremes(bad=NO_CONTACT)

SMALL = 7.0  #: pt, ticks, legends and labels inside a panel
NORMAL = 8.0  #: pt, axis labels

JOURNAL: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],  # comes with matplotlib: the same on every computer
    "mathtext.fontset": "dejavusans",
    "font.size": SMALL,
    "axes.labelsize": NORMAL,
    "axes.titlesize": NORMAL,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "legend.fontsize": SMALL,
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

#: Wear it where artists are made and where they are saved: matplotlib looks at both moments.
journal = style.context(JOURNAL, after_reset=True)

#: Without date and program version the same figure gives the same bytes.
_METADATA: dict[str, dict[str, None]] = {
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
}


def figure(width: float, height: float) -> Figure:
    """Make an empty figure of `width` x `height` mm."""
    return Figure(figsize=(width * MM, height * MM))


def axes(parent: Figure, left: float, bottom: float, width: float, height: float) -> Axes:
    """Add axes to `parent` at a place in mm from its lower left corner."""
    across, up = parent.get_size_inches() / MM
    return parent.add_axes((left / across, bottom / up, width / across, height / up))


def panel_letter(ax: Axes, letter: str, left: float = 0.0, above: float = 2.0) -> Text:
    """Write "a)" above the upper left corner of a panel, `left` and `above` mm from it."""
    points = 72.0 * MM
    return ax.annotate(
        f"{letter})",
        (0.0, 1.0),
        (-left * points, above * points),
        xycoords="axes fraction",
        textcoords="offset points",
        fontsize=NORMAL,
        fontweight="bold",
        annotation_clip=False,
    )


@journal
def save(picture: Figure, path: Path, caption: str | None = None) -> None:
    """Write a figure as PDF, PNG (600 dpi) or SVG, as the suffix of `path` says.

    The file appears complete or not at all, and its bytes depend on the picture and the caption
    alone, which its metadata keep.
    """
    if path.suffix not in _METADATA:
        raise ValueError(f"figures are saved as {', '.join(_METADATA)}, not as {path.suffix!r}")
    described = {"Subject" if path.suffix == ".pdf" else "Description": caption}
    metadata = _METADATA[path.suffix] | (described if caption else {})
    with whole_file(path) as partial:
        picture.savefig(partial, format=path.suffix[1:], metadata=metadata)
