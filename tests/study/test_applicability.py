"""The page on where the model applies has the values of the tables, or is not written."""

import re

import numpy as np
import pytest

from springblock.io.identity import identity
from springblock.model.scene import Scene
from springblock.study.applicability.page import values
from springblock.study.pages import rendered
from studies import ROOT

#: Static friction by width of strips: across the grooves, and along them.
FRICTION = {60: (0.73, 0.72), 6: (0.68, 0.70), 1: (0.85, 0.86)}
NOISE = np.random.default_rng(3).normal(0.0, 1e-3, 4)


def rows(friction=FRICTION):
    scenes = {Scene(120): 0.8, Scene(120, n_p=6, n_s=6): 0.6, Scene(120, n_p2=6, n_s2=2): 0.5}
    for width, (across, along) in friction.items():
        scenes[Scene(120, n_p2=width, n_s2=width, direction="y")] = across
        scenes[Scene(120, n_p2=width, n_s2=width)] = along
    return [
        identity(scene) | {"seed": seed, "static_friction": mean + noise}
        for scene, mean in scenes.items()
        for seed, noise in enumerate(NOISE)
    ]


def test_strips_are_compared_between_runs_of_the_same_seed():
    found = values(rows())
    assert [(each.number, each.width) for each in found["strips"]] == [(1, 60), (10, 6), (60, 1)]
    for each in found["strips"]:
        across, along = FRICTION[each.width]
        assert tuple(each.difference) == pytest.approx([across - along] * 3)
        assert each.across.mean - across == pytest.approx(NOISE.mean())
    assert found["flat"].mean == pytest.approx(0.8 + NOISE.mean())


def test_the_page_has_a_row_for_each_width_and_is_what_the_template_writes():
    found = values(rows())
    page = rendered("applicability/page.md", **found)
    assert "more than\n25 %" in page
    across, along = (each.mean for each in found["strips"][1][2:4])
    assert f"\n| 10 | 6 | {across:.4f} | {along:.4f} | " in page
    written = (ROOT / "docs/applicability.md").read_text("utf-8")
    words = (
        re.sub(r"^\|.*|-?[\d.]+(?: \[.*?\])?", "#", text, flags=re.M) for text in (written, page)
    )
    assert len({re.sub(r"[#\s]+", " ", text) for text in words}) == 1


@pytest.mark.parametrize("others", [{6: (0.74, 0.70)}, {60: (0.71, 0.72), 1: (0.85, 0.86)}])
def test_a_page_that_the_table_contradicts_is_refused(others):
    with pytest.raises(ValueError, match="the tables contradict"):
        rendered("applicability/page.md", **values(rows(FRICTION | others)))
