"""What holds for all figures: each stays on its page, names its panels and is always the same.

Tests of figures hold their drawings in `DRAWINGS`; more words may follow the name of the figure.
"""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path
from string import ascii_lowercase

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from plotting import test_surfaces as surfaces
from plotting.test_still import PICTURES
from springblock.plotting import style
from springblock.study.results import FIGURES

TESTS = sorted(Path(__file__).parent.glob("*/test_*.py"))
DRAWINGS: dict[str, Callable[[], Figure]] = dict(surfaces.DRAWINGS)
for test in TESTS:
    DRAWINGS |= getattr(import_module(f"study.{test.parent.name}.{test.stem}"), "DRAWINGS", {})


@cache
def drawn(name: str) -> Figure:
    """A figure whose panels have their places."""
    picture = (DRAWINGS | PICTURES)[name]()
    style.settle(picture)
    return picture


def test_every_figure_is_drawn_here():
    assert {name.split()[0] for name in DRAWINGS} == set(FIGURES)


@pytest.mark.parametrize("name", DRAWINGS)
def test_panels_carry_letters_and_numbers_have_names(name):
    panels = drawn(name).axes
    letters = sorted(filter(None, (ax.get_title("left")[:2] for ax in panels)))
    if name.split()[0] != "surfaces":  # whose rows have names
        assert letters == [f"{letter})" for letter in ascii_lowercase[: len(letters)]]
        assert len(letters) > 1 or len(panels) == 1
    for ax in panels:
        for axis in (ax.xaxis, ax.yaxis):
            numbers = [text for text in axis.get_ticklabels() if text.get_text()]
            if ax.axison and any(text.get_visible() for text in numbers):
                assert axis.get_label_text()
    assert not any("nan" in text.get_text() for text in drawn(name).findobj(Text))


@pytest.mark.parametrize("name", DRAWINGS | PICTURES)
def test_nothing_leaves_the_page_and_panels_do_not_overlap(name):
    box = style.journal(drawn(name).get_tightbbox)()  # inches
    width, height = drawn(name).get_size_inches()
    assert 0.0 <= box.x0 < box.x1 <= width
    assert 0.0 <= box.y0 < box.y1 <= height
    assert width in (w * style.MM for w in (style.COLUMN, style.ONE_AND_A_HALF, style.DOUBLE))
    panels = [ax.get_window_extent() for ax in drawn(name).axes if ax.get_label() != "<colorbar>"]
    for i, panel in enumerate(panels):
        assert min(panel.width, panel.height) > 30.0  # pixels of 0.25 mm
        assert not any(panel.overlaps(other) for other in panels[:i])


@pytest.mark.parametrize(
    ("name", "suffix"),
    [  # panels of two grids, and the formats of print and of the web
        ("stability", ".png"),
        ("figure_3", ".pdf"),
        ("figure_8", ".svg"),
    ],
)
def test_the_same_figure_is_the_same_file(name, suffix, tmp_path, monkeypatch):
    monkeypatch.setitem(style.JOURNAL, "savefig.dpi", 72)  # quicker
    contents = []
    for attempt, picture in (("first", drawn(name)), ("second", DRAWINGS[name]())):
        path = tmp_path / attempt / f"figure{suffix}"
        style.save(picture, path)
        assert [file.name for file in path.parent.iterdir()] == [path.name]  # nothing left over
        contents.append(path.read_bytes())
    assert contents[0] == contents[1]
    assert b"atplotlib version" not in contents[0]


def test_figures_do_not_follow_the_settings_of_the_reader(tmp_path):
    draw = FIGURES["figure_1"].function()
    style.save(draw(), tmp_path / "mine.pdf")
    with matplotlib.rc_context({"font.size": 20.0, "lines.linewidth": 5.0, "pdf.fonttype": 3}):
        style.save(draw(), tmp_path / "yours.pdf")
    assert (tmp_path / "mine.pdf").read_bytes() == (tmp_path / "yours.pdf").read_bytes()


def test_sizes_of_pillars_have_colours_that_can_be_told_apart():
    """Those of the paper keep theirs; others are spread over all shades."""
    assert style.pillar_looks((6, 20)).items() <= style.pillar_looks((0, 2, 6, 20, 60)).items()
    looks = style.pillar_looks((12, 14, 15))
    del looks[0]
    colors = np.array([look["color"][:3] for look in looks.values()])
    assert np.linalg.norm(np.diff(colors, axis=0), axis=1).min() > 0.2
    assert len({look["marker"] for look in looks.values()}) == 3
