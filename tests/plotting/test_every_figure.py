"""What holds for all figures: each stays on its page, names its panels and is always the same.

Tests of figures hold their drawings in `DRAWINGS`; more words may follow the name of the figure.
"""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pathlib import Path
from string import ascii_lowercase

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from springblock.plotting import declarations, style

TESTS = [file.stem for file in Path(__file__).parent.glob("test_*.py") if file != Path(__file__)]
DRAWINGS: dict[str, Callable[[], Figure]] = {}
for test in sorted(TESTS):
    DRAWINGS |= getattr(import_module(f"plotting.{test}"), "DRAWINGS", {})

#: Letters of panels; those of other figures begin with a), too, if there are any.
LETTERS = dict.fromkeys([f"figure_{number}" for number in (1, 4, 5, 8)], "ab")
LETTERS |= dict.fromkeys([f"figure_{number}" for number in (2, 6, 9)], "abcd")
LETTERS |= {"stability": "abcdef", "work_precision": "abcdefghijkl", "total_error": "abcdefghijk"}


@cache
def drawn(name: str) -> Figure:
    """A figure for tests that only look at it."""
    return DRAWINGS[name]()


def test_every_figure_is_drawn_here():
    assert {name.split()[0] for name in DRAWINGS} == set(declarations())


@pytest.mark.parametrize("name", DRAWINGS)
def test_panels_carry_letters(name):
    texts = [text.get_text() for text in drawn(name).findobj(Text)]
    shown = sorted(text for text in texts if text[1:] == ")")
    letters = LETTERS.get(name.split()[0], ascii_lowercase[: len(shown)])
    assert shown == [f"{x})" for x in letters]


@pytest.mark.parametrize("name", DRAWINGS)
def test_nothing_leaves_the_page(name):
    box = style.journal(drawn(name).get_tightbbox)()  # inches
    width, height = drawn(name).get_size_inches()
    assert 0.0 <= box.x0 < box.x1 <= width
    assert 0.0 <= box.y0 < box.y1 <= height


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        *((name, ".png") for name in DRAWINGS if " " not in name),
        *(("figure_3", ".pdf"), ("figure_7", ".pdf"), ("figure_8", ".svg")),
    ],
)
def test_the_same_figure_is_the_same_file(name, suffix, tmp_path, monkeypatch):
    monkeypatch.setitem(style.JOURNAL, "savefig.dpi", 72)  # quicker
    contents = []
    for attempt in ("first", "second"):
        path = tmp_path / attempt / f"figure{suffix}"
        style.save(DRAWINGS[name](), path)
        assert [file.name for file in path.parent.iterdir()] == [path.name]  # nothing left over
        contents.append(path.read_bytes())
    assert contents[0] == contents[1]
    assert b"atplotlib version" not in contents[0]
