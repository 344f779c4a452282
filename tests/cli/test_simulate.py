"""springblock compile, prelude and simulate."""

import json

import numpy as np
import pyarrow.parquet as pq
import pytest
import xarray

from springblock import Prelude, read
from springblock.simulation.fields import Fields
from springblock.simulation.prelude import HOLDING

FLAT = ("--n-blocks", 6)
ONE = ("--first-seed", 3, "--last-seed", 3)


def test_an_integrator_is_compiled_with_a_law(springblock):
    said = springblock("compile", "--law", "slip_weakening")
    assert said == "compiled: leapfrog with the friction law slip_weakening and free edges\n"


@pytest.fixture
def own(tmp_path):
    """Options of a surface of one's own, whose coefficients are known."""
    files = {"--mask": np.eye(6) > 0.0, "--mu-static-field": np.full((6, 6), 0.9)}
    files |= {"--mu-dynamic-field": np.full((6, 6), 0.5)}
    for option, values in files.items():
        np.save(tmp_path / f"{option}.npy", values)
    return [word for option in files for word in (option, tmp_path / f"{option}.npy")]


@pytest.mark.parametrize("known", [False, True], ids=["drawn", "from files"])
def test_a_prelude_changes_nothing(springblock, tmp_path, own, known):
    """With known coefficients it has one state; means that nothing is drawn with do not matter."""
    scene = (*own, "--mu-static", "0.1") if known else FLAT
    prelude, with_it, without = (tmp_path / name for name in ("p.npz", "with", "without"))
    springblock("prelude", *scene, "--output", prelude)
    springblock("simulate", *scene, *ONE, "--prelude", prelude, "--output", with_it)
    springblock("simulate", *scene, *ONE, "--output", without)
    tables = [pq.read_table(file) for file in (with_it, without)]
    assert tables[0].schema.equals(tables[1].schema, check_metadata=True)
    skipping, plain = (repr(table.to_pylist()) for table in tables)
    assert skipping == plain  # to the last digit, NaN outside the contact included
    assert len(Prelude.read(prelude).samples) == (1 if known else len(HOLDING))


def test_a_batch_holds_every_seed_and_says_how_it_was_computed(springblock, tmp_path):
    how = ("--gamma", "4e3", "--step", 1e-8, "--integrator", "rk4", "--duration", 4e-6)
    seeds = ("--first-seed", 3, "--last-seed", 5)
    said = springblock(
        "simulate", *FLAT, *seeds, *how, "--direction", 30, "--output", tmp_path / "a"
    )
    assert "at the end the force still increases in 3 of 3" in said
    table = pq.read_table(tmp_path / "a")
    assert table["seed"].to_pylist() == [3, 4, 5]
    assert set(table["direction"].to_pylist()) == {"30"}
    assert set(table["steps"].to_pylist()) == {400}
    configuration = json.loads(table.schema.metadata[b"configuration"])
    assert (configuration["gamma"], configuration["step"]) == (4e3, 1e-8)
    assert (configuration["integrator"], configuration["duration"]) == ("rk4", 4e-6)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--last-seed", -1], "'--last-seed': -1 is not in the range 0<=x<=10"),
        (["--first-seed", 3, "--last-seed", 2], "--last-seed 2 is below --first-seed 3"),
        (["--last-seed", 10**7], "10000001 seeds in a batch; choose up to 1000000"),
        (["--mu-static-field", __file__], "'--mu-static-field': "),
        (["--fields", "a.nc"], "--fields a.nc needs times: give them with --snapshot-times"),
        (["--fields", "a.nc", "--snapshot-times", 2e-7, "--last-seed", 1], "takes one seed, not 2"),
        (["--constant", "d_0=1", "--constant", "d_0=2"], "d_0 is given twice, as 1 and 2"),
        (["--constant", "gama=3"], "unknown constant 'gama'"),
        (["--gamma", "much"], "'--gamma': 'much' is not a valid float"),
        (["--direction", "up"], "'--direction': direction must be"),
    ],
)
def test_what_makes_no_sense_is_refused_and_leaves_nothing(springblock, tmp_path, words, sentence):
    output = ("--output", tmp_path / "a")
    assert sentence in springblock("simulate", *FLAT, *output, *words, refused=True)
    assert list(tmp_path.iterdir()) == []


def test_fields_are_written_beside_the_run(springblock, tmp_path):
    run, file = tmp_path / "run", tmp_path / "fields.nc"
    asked = ("simulate", *FLAT, "--duration", 4e-6, "--snapshot-times", 2e-6, "--output")
    springblock(*asked, run, "--fields", file)
    with xarray.open_dataset(file) as data:
        fields, about = Fields.from_xarray(data), data.attrs
    assert (about["seed"], about["scene"]) == (
        "0",
        "n_blocks = 6, duration = 4e-06, snapshot_times = (2e-06,)",
    )
    assert (about["gamma"], about["law"]) == (5e3, "coulomb")
    np.testing.assert_array_equal(read(run)[0].snapshots, fields.displacement)


def test_a_run_that_fails_is_named(springblock, tmp_path):
    soft = ("--youngs-modulus", "1e4", "--step", 1e-6, "--sample-interval", 1e-5)
    refusal = springblock("simulate", *FLAT, *ONE, *soft, "--output", tmp_path / "a", refused=True)
    assert ", seed 3: at t = " in refusal
