"""springblock compile, prelude and simulate."""

import json

import pyarrow.parquet as pq
import pytest

from springblock.solver import INTEGRATORS

FLAT = ("--n-blocks", 6)
ONE = ("--first-seed", 3, "--last-seed", 3)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_an_integrator_is_compiled(springblock, integrator):
    assert springblock("compile", "--integrator", integrator) == f"{integrator} is compiled\n"


def test_a_prelude_changes_nothing(springblock, tmp_path):
    prelude, with_it, without = (tmp_path / name for name in ("p.npz", "with", "without"))
    springblock("prelude", *FLAT, "--output", prelude)
    springblock("simulate", *FLAT, *ONE, "--prelude", prelude, "--output", with_it)
    springblock("simulate", *FLAT, *ONE, "--output", without)
    assert pq.read_table(with_it).equals(pq.read_table(without), check_metadata=True)


def test_a_batch_holds_every_seed_and_says_how_it_was_computed(springblock, tmp_path):
    how = ("--material", "gamma=4e3", "--step", 1e-8, "--integrator", "rk4", "--duration", 4e-6)
    seeds = ("--first-seed", 3, "--last-seed", 5)
    springblock("simulate", *FLAT, *seeds, *how, "--direction", 30, "--output", tmp_path / "a")
    table = pq.read_table(tmp_path / "a")
    assert table["seed"].to_pylist() == [3, 4, 5]
    assert set(table["direction"].to_pylist()) == {"30"}
    assert set(table["steps"].to_pylist()) == {400}
    configuration = json.loads(table.schema.metadata[b"configuration"])
    assert (configuration["material"]["gamma"], configuration["step"]) == (4e3, 1e-8)
    assert (configuration["integrator"], configuration["duration"]) == ("rk4", 4e-6)


def test_pillars_under_a_law_of_their_own_say_so(springblock, tmp_path):
    """From the prelude to the table, and weaker friction is another one."""
    scene = ("--n-blocks", 8, "--n-p", 2, "--n-s", 2)
    law = ("--vary", "law=slip_weakening", "--vary", "slip_distance=1e-7")
    files = prelude, weak, plain, whole = [tmp_path / name for name in ("p", "w", "c", "t")]
    springblock("prelude", *scene, *law, "--output", prelude)
    springblock("simulate", *scene, *law, *ONE, "--prelude", prelude, "--output", weak)
    springblock("simulate", *scene, *ONE, "--output", plain)
    springblock("aggregate", weak, plain, "--configuration", "none", "--output", whole)
    assert all(file.exists() for file in files)
    table = pq.read_table(whole)
    rows = {row["law"]: row for row in table.to_pylist()}
    assert rows["slip_weakening"]["varied"] == "law=slip_weakening, slip_distance=1e-07"
    assert rows["slip_weakening"]["slip_distance"] == 1e-7
    assert (rows["coulomb"]["slip_distance"], rows["coulomb"]["speed_scale"]) == (0.0, 0.0)
    assert rows["slip_weakening"]["static_friction"] > rows["coulomb"]["static_friction"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--n-blocks", 0], "N must be at least 1 block, not 0"),
        (["--n-p", 2], "n_p = 2 needs n_s"),
        (["--n-p", 4, "--n-s", 1], "4 + 1 = 5 must divide N = 6"),
        (["--first-seed", -1], "a seed must be zero or positive, not -1"),
        (["--last-seed", 2], "2 comes before --first-seed 3"),
        (["--step", 1e-6], "step = 1e-06 s is unstable: leapfrog needs less than 9.561e-08 s"),
        (["--sample-interval", 2.5e-8], "sample_interval must be a multiple of step = 2e-08 s"),
        (["--duration", "nan"], "duration must be finite and positive, not nan"),
        (["--integrator", "euler"], "'--integrator': 'euler' is not one of 'leapfrog', 'rk4'"),
        (["--material", "gama=3"], "'--material': 'gama' is no constant; there are youngs_modulus"),
        (["--material", "gamma=much"], "'--material': gamma must be a number, not 'much'"),
        (["--material", "density=-1"], "Material.density must be finite and positive, not -1.0"),
        (["--vary", "law=slip_weakening"], "Material.slip_distance must be positive with slip_"),
        (["--material", "law=stribeck"], "'--material': Material.law must be one of coulomb, "),
        (["--prelude", "absent.npz"], "'--prelude': File 'absent.npz' does not exist"),
    ],
)
def test_what_makes_no_sense_is_refused_and_leaves_nothing(springblock, tmp_path, words, sentence):
    output = ("--output", tmp_path / "a")
    assert sentence in springblock("simulate", *FLAT, *ONE, *output, *words, refused=True)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["compile", "--integrator", "euler"], "'euler' is not one of 'leapfrog', 'rk4'"),
        (["prelude", *FLAT, "--step", 1e-6, "--output", "absent"], "step = 1e-06 s is unstable"),
    ],
)
def test_so_it_is_before_a_simulation(springblock, words, sentence):
    assert sentence in springblock(*words, refused=True)


def test_the_prelude_of_another_scene_is_refused(springblock, tmp_path):
    prelude = tmp_path / "p.npz"
    springblock("prelude", *FLAT, "--output", prelude)
    other = ("--direction", "y", "--prelude", prelude, "--output", tmp_path / "a")
    refusal = springblock("simulate", *FLAT, *ONE, *other, refused=True)
    assert "this prelude belongs to another scene" in refusal


def test_a_run_that_fails_is_named(springblock, tmp_path):
    soft = ("--material", "youngs_modulus=1e4", "--step", 1e-6, "--sample-interval", 1e-5)
    refusal = springblock("simulate", *FLAT, *ONE, *soft, "--output", tmp_path / "a", refused=True)
    assert "n_blocks=6/level=0/direction=x, seed 3: at t = " in refusal
