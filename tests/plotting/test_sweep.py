"""Any observable over anything that tells ensembles apart."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from springblock.analysis.statistics import mean_interval
from springblock.io.identity import identity
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.plotting import sweep
from springblock.plotting.lines import SHARE, axes, lines

SPEEDS = (2.5e-4, 5e-4, 1e-3, 4e-3)


def rows(scene, friction, seeds=5):
    """Rows of the table of realisations, whose friction scatters about a mean."""
    rng = np.random.default_rng(7)
    numbers = {"dynamic_friction": 0.6, "t_max": 3e-4, "t_avg": 2.9e-4, "t_first": 1e-4}
    numbers |= {"prominence": 0.0, "t_quiet": np.nan, "t_width": 1e-4}
    return [
        {**identity(scene), **numbers, "static_friction": friction + 0.01 * noise, "seed": i}
        for i, noise in enumerate(rng.standard_normal(seeds))
    ]


def names(found):
    return found["line"].cat.categories.tolist()


def at(speed, **scene):
    return Scene(120, **scene, slider_velocity=speed)


@pytest.fixture
def two_lines():
    made = []
    for speed in SPEEDS:
        made += rows(at(speed), 0.8 + 10.0 * speed)
        made += rows(at(speed, n_p=20, n_s=20), 0.7 + 10.0 * speed)
    return made


def test_scenes_that_differ_in_nothing_else_share_a_line(two_lines):
    found = lines(two_lines, "slider_velocity")
    assert names(found) == ["flat", "$n_{p}$ = 20, $n_{s}$ = 20"]
    assert [{*line} for _, line in found.groupby("line", observed=True)["place"]] == [{*SPEEDS}] * 2
    alone = rows(at(SPEEDS[0], n_p=60, n_s=60), 0.7)  # it has one place, and is left out
    assert lines(two_lines + alone, "slider_velocity").equals(found)


def test_coulombs_law_is_where_weakening_takes_no_way():
    laws = [{"law": "slip_weakening", "slip_distance": distance} for distance in (1e-8, 1e-7)]
    table = [row for law in ({}, *laws) for row in rows(Scene(12, **law), 0.7)]
    found = lines(table, "slip_distance")
    assert len(names(found)) == 1
    assert found["place"].unique().tolist() == [0.0, 1e-8, 1e-7]


def test_points_are_means_and_bars_t_intervals(two_lines):
    found = lines(two_lines, "slider_velocity")
    ax = sweep.draw(found, "slider_velocity", ["static_friction"]).axes[0]
    flat, pillars = ax.containers
    runs = found[found["line"] == "flat"].groupby("place")["static_friction"]
    means = [mean_interval(sample) for _, sample in runs]
    left, right = (np.asarray(c.lines[0].get_xdata(), float) for c in (flat, pillars))
    np.testing.assert_allclose(np.sqrt(left * right), SPEEDS)  # on both sides of their places
    np.testing.assert_allclose(right / left, (SPEEDS[-1] / SPEEDS[0]) ** 0.03)
    heights = np.asarray(flat.lines[0].get_ydata(), float)
    np.testing.assert_allclose(heights, [each.mean for each in means])
    tops = [segment[1, 1] for segment in flat.lines[2][0].get_segments()]
    np.testing.assert_allclose(tops, [each.high for each in means])


def test_distances_grow_with_pillars():
    made = [row for n_p in (6, 10, 20) for row in rows(Scene(120, n_p, n_p), 0.7)]
    made += [row for n_p in (6, 10, 20) for row in rows(Scene(120, n_p, 3 * n_p // 2), 0.7)]
    assert names(lines(made, "n_p")) == ["$n_{s}$/$n_{p}$ = 1", "$n_{s}$/$n_{p}$ = 1.5"]


def test_a_panel_for_each_observable(two_lines):
    found = lines(two_lines, "slider_velocity")
    picture = sweep.draw(found, "slider_velocity", ["t_max", "t_max-t_avg"])
    assert [ax.get_ylabel() for ax in picture.axes] == [
        r"$t_\mathrm{max}$ (µs)",
        r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)",
    ]
    means = picture.axes[1].containers[0].lines[0]
    assert means.get_ydata() == pytest.approx([10.0] * 4)


def test_directions_are_lines_and_over_the_direction_itself_angles():
    made = [r for s in SPEEDS for way in ("x", "y", "30") for r in rows(at(s, direction=way), 0.8)]
    found = lines(made, "slider_velocity")
    assert names(found) == ["direction = x", "direction = 30°", "direction = y"]
    assert sorted(lines(made, "direction")["place"].unique()) == [0.0, 30.0, 90.0]


def test_a_line_is_named_by_its_mask():
    """Without the digest, unless two files have one name."""
    masks = {n: BlockMap(f"islands-{n:08x}", np.eye(12) > 0) for n in (1, 2)}
    one, two = (
        [r for s in SPEEDS for r in rows(replace(at(s), n_blocks=12, n_rows=12, mask=mask), 0.8)]
        for mask in masks.values()
    )
    assert names(lines(one, "slider_velocity")) == ["islands"]
    both = lines(one + two, "slider_velocity")
    assert names(both) == ["islands-00000001", "islands-00000002"]
    assert sweep.draw(lines(one, "slider_velocity"), "slider_velocity", ["t_avg"]).legends


def test_laws_and_masks_stand_on_an_axis_by_name_and_no_two_in_one_place():
    """Coulomb's law first, then by their constants."""
    slips = {"law": "slip_weakening", "healing": "none"}
    laws = [Scene(24), *(Scene(24, **slips, slip_distance=d) for d in (1e-7, 5e-8))]
    found = lines([row for law in laws for row in rows(law, 0.7)], "law")
    named = dict(zip(found["place"], found["tick"], strict=True))
    assert named == dict(
        enumerate(["coulomb", "slip weakening, 5e-08 m, none", "slip weakening, 1e-07 m, none"])
    )
    assert names(found) == ["as the study"]
    islands = {name: BlockMap(f"{name}-0123abcd", np.eye(n)) for name, n in (("b", 4), ("a", 6))}
    found = lines([row for mask in islands.values() for row in rows(Scene(mask=mask), 0.7)], "mask")
    assert [*found.groupby("place")["tick"].first()] == ["a", "b"]
    ticks = sweep.draw(found, "mask", ["static_friction"]).axes[0].get_xticklabels()
    assert [tick.get_text() for tick in ticks] == ["a", "b"]
    assert "Lines join" not in sweep.caption(found)


def test_names_keep_their_places_where_others_are_left_out():
    """A law whose line has no second law leaves no gap; textures of other sizes are other lines."""
    slow = {"law": "velocity_weakening", "speed_scale": 1e-2}
    laws = [Scene(24), Scene(24, gamma=1e4, law="slip_weakening", slip_distance=1e-7)]
    found = lines([row for law in (*laws, Scene(24, **slow)) for row in rows(law, 0.7)], "law")
    ticks = sweep.draw(found, "law", ["static_friction"]).axes[0].get_xticklabels()
    assert [tick.get_text() for tick in ticks] == ["coulomb", "velocity weakening, 0.01 m/s"]
    assert {*found["place"]} == {0, 1}
    textures = [
        Scene(texture=kind, feature=size, pitch=1e-4, width=1e-4)
        for kind in ("discs", "squares")
        for size in (4e-5, 6e-5)
    ]
    found = lines([row for each in textures for row in rows(each, 0.7)], "texture")
    assert names(found) == ["feature = 4e-05 m", "feature = 6e-05 m"]


def test_surfaces_of_one_contact_fraction_are_not_averaged():
    textures = [Scene(texture="squares", feature=a, pitch=2 * a, width=4 * a) for a in (4e-5, 8e-5)]
    with pytest.raises(ValueError, match=r"contact_fraction = 0\.25 in different surfaces"):
        lines([r | {"contact_fraction": 0.25} for s in textures for r in rows(s, 0.7)], SHARE)


def test_axes_are_numbers_in_which_two_scenes_differ_that_are_otherwise_alike():
    """n_s follows n_p, and a mask is no number."""
    pillars = [Scene(120, n, n, direction=way) for n in (6, 10) for way in ("x", "y")]
    assert axes(pillars) == ["n_p", "direction"]
    assert axes([at(s) for s in SPEEDS]) == ["slider_velocity"]
    assert axes([Scene(120), Scene(120, 6, 6)]) == []


def test_without_seaborn_a_sentence_asks_for_it(two_lines, monkeypatch):
    monkeypatch.setitem(sys.modules, "seaborn", None)
    with pytest.raises(ModuleNotFoundError, match="pip install seaborn"):
        lines(two_lines, "slider_velocity")


@pytest.mark.parametrize(
    ("over", "sentence"),
    [("speed", "unknown axis 'speed'; choose for"), ("pressure", "has the same value")],
)
def test_what_cannot_be_drawn_is_refused(two_lines, over, sentence):
    with pytest.raises(ValueError, match=sentence):
        lines(two_lines, over)
