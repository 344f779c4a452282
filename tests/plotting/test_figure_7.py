"""Figure 7 shows the tables of correlations that it is given."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from springblock.plotting.paper_results import figure_7

SIZES = [6, 20, 60]
LENGTH = {"x": 3.0, "y": 0.5}


def correlation(n_p: int = 60) -> pd.DataFrame:
    """Exponential curves whose intervals are 0.1 wide."""
    r = np.arange(n_p // 2 - n_p // 10 + 1)
    sides = []
    for side, length in LENGTH.items():
        c = np.exp(-r / length)
        columns = {"r": r, "correlation": c, "ci_low": c - 0.05, "ci_high": c + 0.05}
        sides.append(pd.DataFrame(columns).assign(n_p=n_p, side=side))
    return pd.concat(sides)


def lengths() -> pd.DataFrame:
    """Lengths that grow with n_p; the smallest pillars have no fit with a free amplitude."""
    rows = []
    for n_p in SIZES:
        for side, length in LENGTH.items():
            l_c = length * (1.0 + n_p / 600.0)
            tail = np.nan if n_p == 6 else l_c + 1.0
            row = {
                "l_c": l_c,
                "ci_low": l_c - 0.2,
                "ci_high": l_c + 0.3,
                "r_last": min(n_p // 3, 5),
            }
            row |= {"tail": tail, "tail_low": tail - 0.5, "tail_high": tail + 0.5}
            rows.append({"n_p": n_p, "side": side, **row})
    return pd.DataFrame(rows)


DRAWINGS: dict[str, Callable[[], Figure]] = {
    "figure_7": lambda: figure_7(correlation(), lengths()),
    "figure_7 of the smallest pillars": lambda: figure_7(correlation(6), lengths()[:2]),
}


@cache
def drawn(name: str) -> Figure:
    """A figure for tests that only look at it."""
    return DRAWINGS[name]()


def points(ax: Axes) -> list[np.ndarray]:
    """Data of what is drawn with markers alone, (n, 2) each."""
    return [
        line.get_xydata()
        for line in ax.get_lines()
        if line.get_linestyle() == "None" and len(line.get_xydata()) and line.get_marker() in "Ds"
    ]


def test_curves_and_bands_are_those_of_the_table():
    (curves,) = drawn("figure_7").axes
    bands = [part for part in curves.collections if isinstance(part, PolyCollection)]
    for (_, side), shown, band in zip(
        correlation().groupby("side"), points(curves), bands, strict=True
    ):
        np.testing.assert_allclose(shown, side[["r", "correlation"]])
        limits = band.get_datalim(curves.transData)
        assert (limits.y0, limits.y1) == pytest.approx((side["ci_low"].min(), 1.05))


def test_the_fit_is_solid_where_it_was_fitted_and_dotted_beyond():
    (curves,) = drawn("figure_7").axes
    for pattern, span in (("-", (0.0, 5.0)), (":", (5.0, 24.0))):
        drawn_so = [line for line in curves.get_lines() if line.get_linestyle() == pattern]
        lines = [line.get_xydata() for line in drawn_so if len(line.get_xydata()) > 25]
        assert len(lines) == 2
        for line, length in zip(lines, LENGTH.values(), strict=True):
            assert (line[0, 0], line[-1, 0]) == span
            np.testing.assert_allclose(line[:, 1], np.exp(-line[:, 0] / (1.1 * length)))


def test_the_fit_with_a_free_amplitude_is_dashed_over_its_range():
    """Its A lies on the points: here they are exp(-r/3), which any other length tilts."""
    (curves,) = drawn("figure_7").axes
    dashed = [line.get_xydata() for line in curves.get_lines() if line.get_linestyle() == "--"]
    shown = [line for line in dashed if len(line) > 25]
    assert [(line[0, 0], line[-1, 0]) for line in shown] == [(1.0, 5.0)] * 2
    tail, r = 1.1 * LENGTH["x"] + 1.0, np.arange(1, 6)
    c, decay = np.exp(-r / LENGTH["x"]), np.exp(-r / tail)
    best = (c @ decay) / (decay @ decay)
    np.testing.assert_allclose(shown[0][:, 1], best * np.exp(-shown[0][:, 0] / tail))
    (smallest,) = drawn("figure_7 of the smallest pillars").axes
    lines = [line.get_xydata() for line in smallest.get_lines() if line.get_linestyle() == "--"]
    assert not any(len(line) > 25 for line in lines)  # two distances fit any two numbers
    names = [text.get_text() for text in curves.get_legend().get_texts()]
    assert names[-2:] == [r"$\exp(-r/l_c)$", r"$A\,$$\exp(-r/l_c)$"]


def test_the_inset_shows_the_lengths_along_x_with_their_intervals():
    (inset,) = drawn("figure_7").axes[0].child_axes
    fitted, tail = inset.containers
    expected = lengths().query("side == 'x'")
    np.testing.assert_allclose(fitted.lines[0].get_ydata(orig=False), expected["l_c"])
    np.testing.assert_allclose(tail.lines[0].get_ydata(orig=False), expected["tail"])
    (bars,) = fitted.lines[2]
    np.testing.assert_allclose(
        [segment[:, 1] for segment in bars.get_segments()], expected[["ci_low", "ci_high"]]
    )
    assert inset.get_xscale() == "log"


def test_scenes_that_the_inset_cannot_tell_apart_are_refused():
    with pytest.raises(ValueError, match="same n_p"):
        figure_7(correlation(), pd.concat([lengths(), lengths()[-1:]]))
    with pytest.raises(ValueError, match="no correlation length for n_p = 60"):
        figure_7(correlation(), lengths()[:4])
