"""Surfaces of one's own in the study: planned as in the example, and from end to end."""

from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
import yaml
from PIL import Image

from springblock import draw_friction, simulate
from springblock.io.records import read_records
from springblock.model.blockmap import BlockMap
from test_workflow import GROOVES, TINY, copied, planned, snakemake

ROOT = Path(__file__).parents[1]
EXAMPLE = "config/examples/islands.yaml"
ISLANDS = np.indices((12, 12)).sum(axis=0) % 5 > 1
GROUP = [
    {"mask": "islands.png", "direction": ["x"], "seeds": 3},
    {
        "mask": "islands.png",
        "material": {"distribution": ["weibull"], "correlation_length": [3e-5]},
        "direction": ["x"],
        "seeds": 2,
    },
    {"mask": "islands.png", "mu_static": "mu.npy", "mu_dynamic": "weak mu.npy", "direction": ["y"]},
]

#: Others must be there, too.
FEWER = {
    "flat": {"seeds": 1},
    "pillars": {"n_p": [6], "seeds": 3},
    "again": None,
    "grooves": {**GROOVES, "direction": ["x"], "seeds": 1},
}


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A tiny study with a group of one's own surfaces, its table and their figure made."""
    folder = copied(tmp_path_factory.mktemp("study"))
    Image.fromarray(ISLANDS[::-1]).save(folder / "islands.png")
    np.save(folder / "mu.npy", np.linspace(0.8, 1.2, 144).reshape(12, 12))
    np.save(folder / "weak mu.npy", np.full((12, 12), 0.5))
    scenes = {**TINY["scenes"], **FEWER, "surfaces": GROUP}
    figures = TINY["figures"] | {"figure_5": {"n_p": 6}}
    tiny = TINY | {"scenes": scenes, "figures": figures}
    (folder / "tiny.yaml").write_text(yaml.safe_dump(tiny))
    outcome = snakemake(folder, "--", "surfaces", "aggregate")
    assert outcome.returncode == 0, outcome.stderr
    return folder


@pytest.fixture
def changed(study):
    """Write a file of the study anew for the time of one test."""
    file = study / "islands.png"
    content = file.read_bytes()
    yield file
    file.write_bytes(content)


def records(study, *parts):
    """Realisations in the folder of this scene."""
    folder = study / "results/realisations/n_blocks-12" / name(study) / "/".join(parts)
    return read_records(sorted(folder.glob("seeds-*.parquet")))


def name(study):
    return f"mask-{BlockMap.mask(study / 'islands.png')}"


def test_the_example_can_be_planned(study):
    jobs = planned(study, "--", "surfaces", configuration=(EXAMPLE,))
    assert {key: jobs[key] for key in ("prelude_scene", "simulate_batch", "surfaces")} == {
        "prelude_scene": 3,
        "simulate_batch": 3,
        "surfaces": 1,
    }


def test_a_batch_brings_its_mask_along(study):
    runs = records(study, "direction-x")
    assert [run.seed for run in runs] == [0, 1, 2]
    for run in runs:
        np.testing.assert_array_equal(run.scene.contact, ISLANDS)
        assert np.isnan(run.t_det[~ISLANDS]).all()


def test_a_study_simulates_what_python_does(study):
    for run in records(study, "direction-x"):
        alone = simulate(ISLANDS, *draw_friction(12, run.seed))
        assert alone.t_det.tobytes() == run.t_det.tobytes()
    weibull = ("distribution-weibull", "correlation_length-3e-05", "direction-x")
    for run in records(study, *weibull):
        assert run.material.distribution == "weibull"
        alone = simulate(ISLANDS, *draw_friction(12, run.seed, run.material))
        assert alone.t_det.tobytes() == run.t_det.tobytes()


def test_coefficients_from_files_are_not_drawn(study):
    mu, weak = (BlockMap.coefficients(study / file) for file in ("mu.npy", "weak mu.npy"))
    parts = (f"mu_static_field-{mu}", f"mu_dynamic_field-{weak}", "direction-y")
    (run,) = records(study, *parts)
    alone = simulate(ISLANDS, mu.values, weak.values, direction="y")
    assert alone.t_det.tobytes() == run.t_det.tobytes()


def test_a_table_holds_them_beside_the_others(study):
    rows = pq.read_table(study / "results/tables/realisations.parquet").to_pylist()
    masks = [(row["level"], row["mask"]) for row in rows]
    assert masks[:6] == [(-1, str(BlockMap.mask(study / "islands.png")))] * 6
    assert masks[6:] == [(0, ""), (1, ""), (1, ""), (1, ""), (2, "")]
    jobs = planned(study, "--config", "results=elsewhere", "--", "correlation")
    assert jobs["correlation_scene"] == 1  # a mask has no sides


def test_each_is_drawn(study):
    assert (study / "results/figures/surfaces.png").stat().st_size > 10_000


def test_a_changed_image_is_another_surface(study, changed):
    old = name(study)
    Image.fromarray(~ISLANDS).save(changed)
    assert name(study) != old
    jobs = planned(study, "--", "surfaces")
    assert (jobs["prelude_scene"], jobs["simulate_batch"], jobs["surfaces"]) == (3, 4, 1)


def test_rectangles_and_periodic_edges_are_simulated_as_in_python(study):
    """From batches of the study; correlated coefficients, too, go around the edges."""
    grid = {"n_blocks": [12], "n_rows": [6], "edges": "periodic", "direction": ["x"], "seeds": 2}
    around = grid | {"material": {"correlation_length": [2e-5]}}
    (study / "around.yaml").write_text(yaml.safe_dump({"scenes": {"surfaces": [grid, around]}}))
    configuration = ("tiny.yaml", "around.yaml")
    outcome = snakemake(study, "--", "surfaces", configuration=configuration)
    assert outcome.returncode == 0, outcome.stderr
    batches = sorted((study / "results/realisations/n_blocks-12/n_rows-6").rglob("seeds-*.parquet"))
    runs = read_records(batches)
    assert {run.t_det.shape for run in runs} == {(6, 12)}
    assert {run.scene.edges for run in runs} == {"periodic"}
    assert len(runs) == 4
    for run in runs:
        coefficients = draw_friction((6, 12), run.seed, run.material, periodic=True)
        alone = simulate(np.ones((6, 12), bool), *coefficients, periodic=True)
        assert alone.t_det.tobytes() == run.t_det.tobytes()


@pytest.mark.parametrize(
    ("grid", "sentence"),
    [
        ({"mask": "absent.png"}, "scenes.surfaces: absent.png does not exist"),
        ({"mask": "tiny.yaml"}, "scenes.surfaces: tiny.yaml is neither an image nor an array"),
    ],
)
def test_a_file_that_is_no_mask_is_refused_before_any_job(study, grid, sentence):
    group = {"direction": ["x"], "seeds": 1, **grid}
    (study / "wrong.yaml").write_text(yaml.safe_dump({"scenes": {"surfaces": group}}))
    outcome = snakemake(study, "--dry-run", configuration=("tiny.yaml", "wrong.yaml"))
    message = outcome.stdout + outcome.stderr
    assert outcome.returncode == 1
    assert sentence in message
    assert "Traceback" not in message
