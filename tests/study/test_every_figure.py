"""What holds for all figures: each stays on its page, names its axes and is always the same.

Tests of figures hold their drawings in `DRAWINGS`; more words may follow the name of the figure.
"""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from plotting import test_still as still
from springblock.plotting import style
from springblock.study.results import FIGURES

TESTS = sorted(Path(__file__).parent.glob("*/test_*.py"))
DRAWINGS: dict[str, Callable[[], Figure]] = dict(still.DRAWINGS)
for test in TESTS:
    DRAWINGS |= getattr(import_module(f"study.{test.parent.name}.{test.stem}"), "DRAWINGS", {})


@cache
def drawn(name: str) -> Figure:
    """A figure whose panels have their places."""
    picture = (DRAWINGS | still.PICTURES)[name]()
    style.settle(picture)
    return picture


def test_every_figure_is_drawn_here():
    assert {name.split()[0] for name in DRAWINGS} == set(FIGURES)


@pytest.mark.parametrize("name", DRAWINGS | still.PICTURES)
def test_nothing_leaves_the_page_and_panels_do_not_overlap(name):
    box = style.journal(drawn(name).get_tightbbox)()  # inches
    width, height = drawn(name).get_size_inches()
    assert 0.0 <= box.x0 < box.x1 <= width
    assert 0.0 <= box.y0 < box.y1 <= height
    assert width in (w * style.MM for w in (style.COLUMN, style.ONE_AND_A_HALF, style.DOUBLE))
    for ax in filter(lambda ax: ax.axison, drawn(name).axes):
        for axis in (ax.xaxis, ax.yaxis):
            told = any(text.get_text() and text.get_visible() for text in axis.get_ticklabels())
            assert not told or axis.get_label_text()
    assert not any("nan" in text.get_text() for text in drawn(name).findobj(Text))
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
