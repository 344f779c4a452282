"""The configuration: what it expands to, and that its documentation keeps up with it."""

import copy
from pathlib import Path

import pytest
import yaml

from springblock.scene import Scene
from springblock.sources import configuration_digest
from springblock.study import Ensemble, check, ensembles

ROOT = Path(__file__).parents[1]
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())


def changed(*path, to):
    """The paper's configuration with one key changed."""
    configuration = copy.deepcopy(PAPER)
    node = configuration
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = to
    return configuration


def keys(schema):
    """All keys that a schema names, at any depth."""
    found = set(schema.get("properties", {}))
    for part in [*schema.get("properties", {}).values(), *schema.get("$defs", {}).values()]:
        found |= keys(part)
    return found


def test_the_papers_configuration_is_accepted():
    check(PAPER, SCHEMA)


def test_every_key_is_documented():
    text = (ROOT / "config/README.md").read_text()
    assert {key for key in keys(SCHEMA) if f"`{key}`" not in text} == set()


def test_a_group_is_a_grid_over_its_lists():
    groups = ensembles(PAPER)
    assert [e.scene.n_p for e in groups["pillars"]] == PAPER["scenes"]["pillars"]["n_p"]
    assert all(e.scene.n_s == e.scene.n_p for e in groups["pillars"])
    assert [e.scene.direction for e in groups["grooves"]][:2] == ["x", "y"]
    assert groups["flat"][0] == Ensemble(Scene(120), range(40), 3e-4)


def test_a_group_may_be_a_list_of_grids():
    grids = [{"n_p": [n_p], "n_s": [10 - n_p], "direction": ["x"], "seeds": 1} for n_p in (4, 6)]
    members = ensembles(changed("beyond", "ten", to=grids))["ten"]
    assert [(e.scene.n_p, e.scene.n_s) for e in members] == [(4, 6), (6, 4)]


def test_a_constant_may_be_an_axis_of_a_grid():
    """The study's own value makes the scene that other groups have."""
    axes = {"slider_velocity": [5e-4, 1e-3], "gamma": [0, 5000]}
    grid = {"n_blocks": [9], "material": axes, "step": [1e-8, 2e-8], "direction": ["x"], "seeds": 1}
    scenes = [e.scene for e in ensembles(changed("scenes", "fast", to=grid))["fast"]]
    assert len(set(scenes)) == 8
    assert Scene(9) in scenes
    assert Scene(9, varied={"slider_velocity": 1e-3, "gamma": 0, "step": 1e-8}) in scenes


def test_a_law_may_be_an_axis_with_its_constant():
    axes = {"law": ["slip_weakening"], "slip_distance": [1e-8, 1e-7]}
    grid = {"n_blocks": [9], "material": axes, "direction": ["x"], "seeds": 1}
    weak = changed("scenes", "weak", to=grid)
    check(weak, SCHEMA)
    scenes = [e.scene for e in ensembles(weak)["weak"]]
    assert scenes[1] == Scene(9, varied={"law": "slip_weakening", "slip_distance": 1e-7})


@pytest.mark.parametrize(
    ("axes", "sentence"),
    [
        ({"law": ["slip_weakening"]}, "slip_distance must be positive with slip_weakening"),
        ({"slip_distance": [1e-7]}, "slip_distance must be zero with coulomb, not 1e-07"),
        ({"speed_scale": [-1.0]}, "speed_scale must be finite and zero or positive, not -1.0"),
    ],
)
def test_a_group_whose_law_lacks_its_constant_is_refused_by_name(axes, sentence):
    grid = {"n_blocks": [9], "material": axes, "direction": ["x"], "seeds": 1}
    with pytest.raises(ValueError, match=rf"^scenes\.weak: Material\.{sentence}"):
        check(changed("scenes", "weak", to=grid), SCHEMA)


def test_there_is_no_other_law():
    with pytest.raises(ValueError, match=r"^material\.law is not valid: 'stribeck' is not one of"):
        check(changed("material", "law", to="stribeck"), SCHEMA)


def test_gaps_may_follow_the_pillars():
    halved = changed("scenes", "pillars", "n_s", to=["n_p/2"])
    assert [e.scene.n_s for e in ensembles(halved)["pillars"]] == [1, 1, 3, 5, 10, 15, 30]
    doubled = changed("scenes", "pillars", "n_s", to=["2n_p"])
    assert [e.scene.n_s for e in ensembles(doubled)["pillars"]] == [4, 6, 12, 20, 40, 60, 120]


@pytest.mark.parametrize(("given", "gaps"), [("n_p/3", [1, 3, 10]), ("3n_p", [9, 30, 90])])
def test_gaps_may_be_multiples_and_parts_of_a_pillar(given, gaps):
    grid = {"n_p": [3, 10, 30], "n_s": [given], "direction": ["x"], "seeds": 1}
    assert [e.scene.n_s for e in ensembles(changed("scenes", "far", to=grid))["far"]] == gaps


def test_each_size_of_pillars_may_have_its_own_number_of_seeds():
    groups = ensembles(PAPER)
    assert [len(e.seeds) for e in groups["pillars"]] == PAPER["scenes"]["pillars"]["seeds"]
    assert {len(e.seeds) for e in groups["angles"]} == {PAPER["scenes"]["angles"]["seeds"]}


def test_a_scene_of_two_groups_is_one_ensemble_with_the_larger_number_of_seeds():
    both = {"n_p": [6, 20], "n_s": [20, "n_p"], "direction": ["x"], "seeds": [500, 7]}
    groups = ensembles(changed("scenes", "more", to=both))
    assert len(groups["more"]) == 3  # n_s = n_p = 20 occurs twice
    shared = set(groups["more"]) & set(groups["pillars"])
    assert {(e.scene.n_p, len(e.seeds)) for e in shared} == {(6, 500), (20, 60)}
    whole, decimal = ({"direction": [angle], "seeds": 1} for angle in (15, 15.0))
    assert ensembles(PAPER | {"scenes": {"a": whole, "b": decimal}})["b"][0].scene.direction == "15"


def test_a_scene_of_the_study_is_not_changed_by_what_goes_beyond_it():
    small = {"n_p": [10], "n_s": [10], "direction": ["x"], "seeds": 3}
    large = small | {"n_p": [20, 10], "seeds": 500}
    groups = ensembles(PAPER | {"scenes": {"few": small}, "beyond": {"many": large}})
    assert [len(e.seeds) for e in groups["many"]] == [500, 3]
    assert groups["many"][1] == groups["few"][0]


def test_a_group_may_be_left_out():
    left_out = changed("scenes", "spacing", to=None)
    check(left_out, SCHEMA)
    assert ensembles(left_out)["spacing"] == []


@pytest.mark.parametrize("count", [1, 4, 5, 7, 20])
def test_batches_hold_each_seed_once(count):
    batches = list(Ensemble(Scene(4), range(3, 3 + count), None).batches(5))
    assert [seed for batch in batches for seed in batch] == list(range(3, 3 + count))
    assert all(len(batch) in (1, 5) for batch in batches)


def test_a_larger_ensemble_keeps_the_whole_batches_of_a_smaller_one():
    small, large = (list(Ensemble(Scene(4), range(n), None).batches(5)) for n in (10, 25))
    assert large[: len(small)] == small


def test_scenes_differ_in_folder_and_are_rebuilt_from_their_options():
    scenes = {e.scene for group in ensembles(PAPER).values() for e in group}
    assert {scene.level for scene in scenes} == {0, 1, 2, 3}
    assert len({scene.folder for scene in scenes}) == len(scenes)
    for scene in scenes:
        pairs = list(zip(*[iter(scene.arguments.split())] * 2, strict=True))
        named = {key[2:].replace("-", "_"): value for key, value in pairs if key != "--vary"}
        varied = dict(value.split("=") for key, value in pairs if key == "--vary")
        texts = {key: named.pop(key) for key in ("direction", "along_3") if key in named}
        assert Scene(**texts, **{k: int(v) for k, v in named.items()}, varied=varied) == scene


def test_any_change_changes_the_digest():
    digests = {configuration_digest(PAPER), configuration_digest(changed("step", to=1e-8))}
    assert len(digests) == 2


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (("realisations_per_job",), 0, "realisations_per_job is not valid: 0 .* minimum of 1"),
        (("integrator",), "euler", "integrator is not valid: 'euler'.*leapfrog"),
        (("step",), "1e-8", r"step is not valid: '1e-8'.*with its point"),
        (("step",), 9.6e-8, "leapfrog needs less than 9.56.*e-08 s"),
        (("material", "mu_statik"), 1.0, "material has the unknown key 'mu_statik'.*mu_static"),
        (("scenes", "flat", "direction"), ["z"], "scenes.flat.direction.0 is not valid"),
        (("scenes", "flat", "direction"), [float("nan")], "flat: direction must be .* finite"),
        (("scenes", "flat", "duration"), 1e-8, "scenes.flat: duration.*less than one"),
        (("scenes", "pillars", "n_p"), [7] * 7, "scenes.pillars.n_p is not valid"),
        (("scenes", "pillars", "seeds"), [20, 60], "pillars: seeds lists 2 numbers for 7 values"),
        (("scenes", "pillars", "seeds"), 2, "pillars of 6 blocks need 3 seeds or more"),
        (
            ("scenes", "pillars", "n_p"),
            list(range(7, 14)),
            r"scenes.pillars: the period n_p \+ n_s = 7 \+ 7",
        ),
        (("scenes", "grooves", 0, "n_s2"), [58], "scenes.grooves: a groove of 58 .* of 58"),
        (("scenes", "spacing", 0, "n_p2"), [2], "scenes.spacing: n_p2 = 2 needs n_s2"),
        (("scenes", "third_level", 0, "n_p3"), [9], "third_level: pawls of 9 .* do not fill"),
        (("scenes", "third_level", 0, "np"), [9], "third_level.0 has the unknown key 'np'"),
        (("scenes", "third_level", 1, "along_3"), "z", "third_level.1.along_3 is not valid: 'z'"),
        (("scenes", "loading"), [], "scenes.loading is not valid"),
        (("scenes", "loading", 0, "material", "speed"), [1.0], "material has the unknown key"),
        (("scenes", "loading", 0, "step"), [1e-6], "loading: step = 1e-06 s is unstable"),
        (("scenes", "loading", 0, "material", "gamma"), [-1.0], "loading: Material.gamma must be"),
        (("beyond", "flat"), {"direction": ["x"], "seeds": 1}, "beyond.flat: scenes has a group"),
        (
            ("beyond", "more"),
            {"n_p": [7], "n_s": [7], "direction": ["x"], "seeds": 3},
            "beyond.more: the period",
        ),
        (("scenes", "flat", "n_s"), [5], "scenes.flat: n_s = 5 needs n_p"),
        (("scenes", "angles", "duration"), 1e-8, "scenes.angles: duration.*less than one"),
        (("scenes", "size_flat", "n_blocks"), [120], "n_blocks=120.* is given two durations"),
        (("scenes", "grooves"), PAPER["scenes"]["spacing"], "grooves: .* of level 2, not 1"),
        (("scenes", "extra"), {"np": [4]}, "scenes.extra has the unknown key 'np'"),
        (("scenes", "pillars"), None, "scenes.pillars is not valid: None"),
        (("figures", "figure_5", "n_p"), 40, "figure_5.n_p is 40, which scenes.pillars.n_p"),
        (("figures", "figure_7", "n_p"), 40, "figure_7.n_p is 40, which scenes.pillars.n_p"),
        (("figures", "figure_7", "n_p"), 3, "figure_7.n_p is not valid: 3.*at least 6"),
        (("scenes", "flat"), {"seeds": 3}, "scenes.flat: 'direction' is a required property"),
    ],
)
def test_one_sentence_says_what_is_wrong(path, value, sentence):
    with pytest.raises(ValueError, match=sentence) as refusal:
        check(changed(*path, to=value), SCHEMA)
    assert "\n" not in str(refusal.value)
