"""The figure of total errors shows its table, and what follows from it."""

from functools import cache

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from precision import production_rows
from springblock.accuracy.budget import Bias, choices, excess, study_budget
from springblock.accuracy.conventions import DELAY, LENGTH, SCENES
from springblock.accuracy.production import STEPS
from springblock.model.defaults import STEP
from springblock.plotting.accuracy_errors import total_error

#: Panels of total errors, and what they are of.
CASES = [*(("static_friction", scene) for scene in SCENES), *((DELAY, scene) for scene in SCENES)]
ERRORS = dict(zip("defghij", [*CASES, (LENGTH, "pillared")], strict=True))


@cache
def table():
    """A bias of order two; in no order of rows."""
    return pd.DataFrame(production_rows()).sample(frac=1.0, random_state=1)


@cache
def drawn() -> Figure:
    return total_error(table())


DRAWINGS = {"total_error": lambda: total_error(table())}


def panel(letter):
    """The axes that carry this letter."""
    return next(ax for ax in drawn().axes if ax.get_title("left") == f"{letter})")


def rows(quantity, scene):
    found = table()[(table().quantity == quantity) & (table().scene == scene)]
    return found.to_dict("records")


@pytest.mark.parametrize(("letter", "scene"), list(zip("abc", SCENES, strict=True)))
def test_every_bias_but_that_of_the_finest_step_is_shown_with_its_interval(letter, scene):
    shown = table()[(table().scene == scene) & (table().step > min(STEPS))]
    shown = shown[shown.quantity.isin(["static_friction", DELAY, LENGTH])]
    bars = np.vstack([bar for c in panel(letter).collections for bar in c.get_segments()])
    ends = 100.0 * pd.concat([shown.ci_low, shown.ci_high]) / 50.0
    assert sorted(bars[:, 1]) == pytest.approx(sorted(ends))
    low, high = panel(letter).get_ylim()
    assert low < ends.min() < ends.max() < high


@pytest.mark.parametrize("letter", ERRORS)
def test_errors_are_those_of_as_many_seeds_as_the_time_allows(letter):
    steps = choices(rows(*ERRORS[letter]))
    dots = [line.get_xydata() for line in panel(letter).lines if line.get_marker() == "."]
    assert len(dots) == len(steps)
    for step, shown in zip(steps, dots, strict=True):
        wanted = [(step.bias**2 + step.deviation**2 / k) ** 0.5 for k in (1, 10, 100, 1000)]
        assert shown[:, 0] == pytest.approx([step.spent(k) for k in (1, 10, 100, 1000)])
        assert shown[:, 1] == pytest.approx([100.0 * error for error in wanted])


@pytest.mark.parametrize("letter", ERRORS)
def test_a_ring_marks_the_default_at_the_study_s_budget_and_no_line_passes_below_the_least(letter):
    lines = panel(letter).lines
    (ring,) = (line.get_xydata()[0] for line in lines if line.get_fillstyle() == "none")
    (default,) = (s for s in choices(rows(*ERRORS[letter])) if s.step == STEP)
    budget = study_budget(rows(*ERRORS[letter]))
    assert ring == pytest.approx([budget, 100.0 * default.error(budget)])
    (least,) = (line.get_ydata() for line in lines if line.get_linewidth() == 4.0)
    curves = [line.get_ydata() for line in lines if len(line.get_ydata()) == len(least)]
    assert np.nanmin(curves, axis=0) == pytest.approx(least)


def test_words_name_the_best_step_and_what_half_its_error_costs():
    """In 10 s, 20 % over the root of 40 seeds is what 40 ns leave; 80 ns have a bias of 4 %."""
    (words,) = (t.get_text() for t in panel("d").texts if "best" in t.get_text())
    assert words.startswith("best at 10 s: 40 ns, 40 seeds;\nhalf its error: 5.")


def test_every_step_is_compared_with_the_best_in_every_case():
    shown = [line.get_xydata() for line in panel("k").lines]
    assert len(shown) == len(ERRORS)
    for case in ERRORS.values():
        found = excess(choices(rows(*case)), study_budget(rows(*case)))
        wanted = [[1e9 * step, ratio] for step, ratio in found.items()]
        assert any(np.allclose(line, wanted, equal_nan=True) for line in shown)


def test_shades_hold_the_ends_of_the_bias_s_interval():
    band = panel("e").collections[-1].get_paths()[0].vertices
    at_end = band[np.isclose(band[:, 0], band[:, 0].max())][:, 1]
    ends = [choices(rows("static_friction", "pillared"), bias)[-1] for bias in Bias._fields[1:]]
    wanted = [100.0 * step.error(band[:, 0].max()) for step in ends]
    assert (at_end.min(), at_end.max()) == pytest.approx(tuple(wanted))
