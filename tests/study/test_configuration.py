"""The configuration: its expansion, its errors and its documentation."""

import copy
import shutil
from functools import reduce
from operator import getitem
from pathlib import Path

import numpy as np
import pytest
import yaml

import studies
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.study.configuration import (
    _Validator,
    check,
    completed,
    ensembles,
    for_figures,
    refuse_repeated_keys,
)
from studies import ROOT, SCHEMA

SWEEPS = {"angle": {"groups": ["grooves", "angles"], "over": "direction"}}
FULL = yaml.safe_load((ROOT / "config/full.yaml").read_text())["scenes"]
#: The paper's study with some groups of the full one, and a sweep.
PAPER = studies.PAPER | {
    "scenes": studies.PAPER["scenes"]
    | {name: FULL[name] for name in ("angles", "gaps", "size_flat", "third_level")},
    "figures": studies.PAPER["figures"] | {"sweeps": SWEEPS},
}


def changed(key, to):
    """The paper's configuration with the value of one key, as `scenes.flat.seeds`, changed."""
    configuration = copy.deepcopy(PAPER)
    *path, last = (int(part) if part.isdigit() else part for part in key.split("."))
    reduce(getitem, path, configuration)[last] = to
    return configuration


def expanded(grid, **study):
    """Ensembles of a group with this grid, alone in a study that passes all checks."""
    whole = PAPER | {"scenes": {"own": grid}, "figures": {}} | study
    check(whole, SCHEMA)
    return ensembles(whole)["own"]


def keys(schema):
    """Names of the keys that a schema knows."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
    if isinstance(schema, dict | list):
        for part in schema.values() if isinstance(schema, dict) else schema:
            yield from keys(part)


def test_every_key_is_documented():
    text = "".join((ROOT / page).read_text() for page in ("config/README.md", "docs/model.md"))
    assert {key for key in keys(SCHEMA) if f"`{key}`" not in text} == set()


def test_a_constant_may_be_an_axis_of_a_grid():
    """The study's own value makes the scene that other groups have."""
    axes = {"slider_velocity": [5e-4, 1e-3], "gamma": [0, 5000]}
    grid = {"n_blocks": [9], "material": axes, "step": [1e-8, 2e-8], "direction": ["x"], "seeds": 1}
    scenes = expanded(grid)
    assert len(scenes) == 8
    assert Scene(9) in scenes
    assert Scene(9, slider_velocity=1e-3, gamma=0, step=1e-8) in scenes


def test_single_values_are_lists_of_one():
    constants = {"gamma": 0, "law": "slip_weakening", "slip_distance": 1e-8}
    single = {"n_p": 4, "n_s": "n_p", "direction": "x", "step": 1e-8, "material": constants}
    lists = {key: [value] for key, value in single.items()}
    lists["material"] = {key: [value] for key, value in constants.items()}
    one, other = (expanded(grid | {"seeds": 2}) for grid in (single, lists))
    assert one == other
    assert len(one) == 1


def test_a_law_ignores_the_constants_of_others(tmp_path):
    (tmp_path / "law.py").write_text(
        "CONSTANTS = {'d_0': (1e-8, 'm')}\ndef friction(mu_dynamic, d_0):\n    return mu_dynamic\n"
    )
    laws = ["coulomb", "slip_weakening", str(tmp_path / "law.py")]
    constants = {"law": laws, "slip_distance": [1e-8, 2e-8], "d_0": [1e-8, 3e-8]}
    grid = {"n_blocks": 9, "direction": "x", "seeds": 1}
    scenes = list(expanded(grid | {"material": constants}))
    assert len(scenes) == 1 + 2 + 2
    assert scenes[0] == Scene(9)
    # A group replaces constants of the study.
    slower = PAPER["material"] | {"law": "slip_weakening", "slip_distance": 1e-8}
    coulomb = grid | {"material": {"law": ["coulomb"]}}
    assert list(expanded(coulomb, material=slower)) == [Scene(9)]


def test_keys_for_anchors_are_no_part_of_the_study():
    assert completed(PAPER | {"x-common": {"n_p": [4]}}) == PAPER
    assert not list(_Validator(SCHEMA).iter_errors(PAPER | {"x-common": {"n_p": [4]}}))


@pytest.mark.parametrize(
    "text", ["a: 1\nb: 2\na: 3\n", "s:\n  a: {}\n  a: {}\n", "- {a: 1, a: 2}\n"]
)
def test_a_repeated_key_is_refused_with_its_line(tmp_path, text):
    file = tmp_path / "mine.yaml"
    file.write_text("\ufeff" + text, encoding="utf-8")
    with pytest.raises(ValueError, match=r"mine.yaml, line [13]: key 'a' is repeated; rename"):
        refuse_repeated_keys(file)
    file.write_text("x: &a {k: 1, all: {<<: &b {k: 2}}}\ny: {<<: *a, k: 3}\nz: [*a, *b]\nw: *a\n")
    refuse_repeated_keys(file)


def test_a_scene_of_two_groups_is_one_ensemble_with_the_larger_number_of_seeds():
    both = {"n_p": [6, 20], "n_s": [20, "n_p"], "direction": ["x"], "seeds": [500, 7]}
    groups = ensembles(changed("scenes.both", to=both))
    assert len(groups["both"]) == 3  # n_s = n_p = 20 occurs twice
    shared = groups["both"].items() & groups["pillars"].items()
    pillars = PAPER["scenes"]["pillars"]
    seeds = dict(zip(pillars["n_p"], pillars["seeds"], strict=True))
    assert {(scene.n_p, count) for scene, count in shared} == {(6, 500), (20, seeds[20])}
    whole, decimal = ({"direction": [angle], "seeds": 1} for angle in (15, 15.0))
    (scene,) = ensembles(PAPER | {"scenes": {"a": whole, "b": decimal}})["b"]
    assert scene.direction == "15"


def test_numbers_given_as_text_are_converted():
    """YAML takes 1e-8 for text, and Snakemake all within an option."""
    text = {"step": "1e-8", "results": "2024", "scenes": {"flat": {"seeds": "3", "add": "null"}}}
    read = {"step": 1e-8, "results": "2024", "scenes": {"flat": {"seeds": 3, "add": None}}}
    assert completed(text) == read
    ways = {"direction": ["x", "15"], "n_s": ["2n_p", "n_p"], "accuracy": "true"}
    assert completed(ways) == {"direction": ["x", 15], "n_s": ["2n_p", "n_p"], "accuracy": True}
    assert completed(PAPER) == PAPER


def test_lists_can_be_extended():
    further = {"pillars": {"n_p": [15], "seeds": [7]}, "grooves": [PAPER["scenes"]["angles"]]}
    further["new"] = {"n_p": [4], "n_s": [4], "direction": ["x"], "seeds": 1}
    whole = completed(PAPER | {"add": {"scenes": further, "step": 1e-8}})
    check(whole, SCHEMA)
    sizes = {scene.n_p: n for scene, n in ensembles(whole)["pillars"].items()}
    assert sizes == {s.n_p: n for s, n in ensembles(PAPER)["pillars"].items()} | {15: 7}
    assert len(ensembles(whole)["grooves"]) == len(ensembles(PAPER)["grooves"]) + 5
    assert len(ensembles(whole)["new"]) == 1
    assert (whole["step"], whole["scenes"]["flat"]) == (1e-8, PAPER["scenes"]["flat"])
    with pytest.raises(ValueError, match=r"^add must hold keys of the configuration, not "):
        completed(PAPER | {"add": ["scenes"]})


@pytest.fixture
def surfaces(tmp_path, monkeypatch):
    """The paper's configuration with a group of one's own surfaces, given its grid."""
    monkeypatch.chdir(tmp_path)
    np.save("corner.npy", np.array([[1, 1, 0], [0, 0, 0], [0, 0, 0]], bool))
    Path("again").mkdir()
    shutil.copy("corner.npy", "again")
    shutil.copy("corner.npy", "copy.npy")
    shutil.copy("corner.npy", "{corner}.npy")
    np.save("mu.npy", np.full((3, 3), 1.5))
    Path("broken.png").write_bytes(b"no image")

    def configured(**grid):
        whole = {"direction": ["x"], "seeds": 4} | grid
        return changed("scenes.own", to={k: v for k, v in whole.items() if v is not None})

    return configured


def test_a_mask_may_have_several_paths(surfaces):
    """One ensemble for each name."""
    masks = {"mask": ["corner.npy", "again/corner.npy", "copy.npy"], "direction": "x", "seeds": 4}
    names = [str(scene.mask)[:-9] for scene in expanded(masks)]
    assert names == ["corner", "copy"]


def test_topographies_are_cut_at_the_spacing_of_the_lattice(surfaces, monkeypatch):
    """That of the study, unless a group has its own."""
    corner, cuts = BlockMap.mask(Path("corner.npy")), []
    monkeypatch.setattr(BlockMap, "of_topography", lambda cut, _: cuts.append(cut) or corner)
    for constants in ({}, {"spacing": [5e-6]}):
        own = surfaces(topography="measured.opd", bearing_area=0.5, material=constants)
        ensembles(own | {"material": own["material"] | {"spacing": 2e-5}})
    assert [*dict.fromkeys(cut.spacing for cut in cuts)] == [2e-5, 5e-6]


@pytest.mark.parametrize(
    ("grid", "sentence"),
    [
        ({"mask": "corner.npy", "height": 1e-6}, "mask cannot be combined with topography"),
        ({"bearing_area": 0.5}, "bearing_area needs topography"),
        ({"mask": "broken.png"}, "broken.png"),
        ({"mask": "{corner}.npy"}, r"{corner}.npy: rename it; Snakemake reads braces"),
        ({"mask": "corner.npy", "seeds": None}, "'seeds' is a required property"),
        (
            {"mask": "corner.npy", "mu_static_field": "mu.npy", "mu_dynamic_field": "mu.npy"},
            "seeds must be 1",
        ),
        ({"material": {"correlation_length": [1.0]}}, "correlation_length"),
        ({"edges": "periodic", "n_rows": [2]}, "periodic edges"),
    ],
)
def test_errors_in_surfaces_from_files_name_the_group(surfaces, grid, sentence):
    with pytest.raises(ValueError, match=rf"^scenes.own: .*{sentence}") as refusal:
        check(surfaces(**grid), SCHEMA)
    assert "\n" not in str(refusal.value)


def test_figures_of_the_paper_are_not_drawn_from_surfaces_of_ones_own(surfaces):
    own = surfaces(mask="corner.npy")["scenes"]["own"]
    groups = {"flat": PAPER["scenes"]["flat"], "sizes": own, "surfaces": own}
    study = PAPER | {"scenes": groups}
    drawn = for_figures(study, ensembles(study))
    assert {group: len(members) for group, members in drawn.items()} == {
        "flat": 1,
        "sizes": 0,
        "surfaces": 1,
    }


def test_a_study_of_own_scenes_shows_each_surface_once_in_each_direction(surfaces):
    """And a group may have the name of one of the paper's; constants are the paper's."""
    grid = surfaces(mask="corner.npy")["scenes"]["own"]
    scenes = {"pillars": grid | {"material": {"gamma": [0.0, 1e3]}, "direction": ["x", "y"]}}
    study = yaml.safe_load((ROOT / "config/own.yaml").read_text()) | {"scenes": scenes}
    check(study, SCHEMA)
    (shown,) = for_figures(study, ensembles(study)).values()
    assert [scene.direction for scene in shown] == ["x", "y"]


def test_one_realisation_suffices_without_scatter():
    """A correlation needs three, and the paper's figures need correlations."""
    scatter = {"mu_static_std": [0.0], "mu_dynamic_std": [0.0]}
    grid = {"n_p": [6], "n_s": [6], "material": scatter, "direction": ["x"], "seeds": 1}
    check(changed("scenes.own", to=grid), SCHEMA)
    too_few = "seeds must be at least 3, for correlations on pillars of 6"
    for group, changes, message in (
        ("own", {"material": scatter | {"mu_dynamic_std": [0.05]}}, too_few),
        ("own", {"seeds": 3}, "without scatter c"),
        ("pillars", {}, "without scatter c"),
    ):
        with pytest.raises(ValueError, match=message):
            check(changed(f"scenes.{group}", to=grid | changes), SCHEMA)


@pytest.mark.parametrize(
    ("key", "value", "sentence"),
    [
        ("realisations_per_job", 0, "realisations_per_job is not valid: 0 .* minimum of 1"),
        ("n_blocks", 24.0, "n_blocks is not valid: 24.0 is not of type 'integer' .N, blocks"),
        ("stepp", 1e-8, "the configuration: unknown key 'stepp'"),
        ("step", 9.6e-8, "leapfrog needs less than 9.56"),
        ("material.mu_statik", 1.0, "material: unknown constant 'mu_statik'; choose from"),
        ("scenes.flat.snapshot_times", [1.0], "flat: snapshot_times must lie within the duration"),
        ("scenes.pillars.seeds", [20, 60], "pillars: seeds must have one number per n_p, 7, not 2"),
        ("scenes.third_level.0.np", [9], "third_level.0: unknown key 'np'"),
        ("scenes.flat.material", {"speed": [1.0]}, "scenes.flat: unknown constant 'speed'"),
        ("scenes.flat.material", {"slider_velocity": [5e-2]}, "flat: sample_interval = 2e-07 s"),
        ("scenes.angles.material", {"direction": [30]}, "direction is not a constant of the mat"),
        ("scenes.grooves", PAPER["scenes"]["gaps"], "grooves: .* of level 2, not 1"),
        ("scenes.flat.edges", "periodic", "scenes.flat: surfaces in this group must be square"),
        ("scenes.flat.direction", [*range(20_001)], "scenes.flat: 20001 scenes are too many"),
        ("scenes", {}, "scenes: no scenes are given"),
        ("figures.sweeps.angle.groups", ["speeds"], "groups: unknown group 'speeds'; choose from"),
        ("figures.sweeps.angle.over", "speed", "over: unknown axis 'speed'; choose one .*n_p"),
    ],
)
def test_one_sentence_says_what_is_wrong(key, value, sentence):
    with pytest.raises(ValueError, match=sentence) as refusal:
        check(changed(key, to=value), SCHEMA)
    assert "\n" not in str(refusal.value)
