"""Surfaces of one's own in the study: planned as in the example, and from end to end."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from springblock import Setup, Surface, simulate
from springblock.io.records import read_records
from springblock.model.blockmap import BlockMap
from studies import FEWER, Study

EXAMPLE = "config/examples/islands.yaml"
#: Names that a shell would take apart or run, and results that lie deeper.
MASK, WEAK, RESULTS = "my masks/$(a) 'b' (1), ü.png", "weak mu.npy", "my 'results'/ü $(a)"
ISLANDS = np.indices((12, 12)).sum(axis=0) % 5 > 1
WEIBULL = {"distribution": ["weibull"], "correlation_length": [3e-5]}
CORRELATED = {"correlation_length": [2e-5]}
GROUP = [
    {"mask": MASK, "material": WEIBULL, "direction": ["x"], "seeds": 2},
    {"mask": MASK, "mu_static_field": "mu.npy", "mu_dynamic_field": WEAK, "direction": ["y"]},
    {"n_rows": [6], "edges": "periodic", "direction": ["x"], "seeds": 2, "material": CORRELATED},
]


def files(study):
    """All that a study has beside Snakemake's own notes."""
    own = {path.relative_to(study) for path in study.folder.rglob("*") if path.is_file()}
    return {path for path in own if path.parts[0] != ".snakemake"}


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> tuple[Study, set[Path], str]:
    """A tiny study with a group of one's own surfaces, which files running it made, and the log."""
    study = Study.begun(
        tmp_path_factory.mktemp("a study (1), ü"),
        **FEWER | {"scenes": FEWER["scenes"] | {"surfaces": GROUP}},
        results=RESULTS,
    )
    (study / MASK).parent.mkdir()
    Image.fromarray(ISLANDS[::-1]).save(study / MASK)
    np.save(study / "mu.npy", np.linspace(0.8, 1.2, 144).reshape(12, 12))
    np.save(study / WEAK, np.full((12, 12), 0.5))
    before = files(study)
    said = study.run("--printshellcmds", "--quiet", "host", "--", "surfaces")
    return study, files(study) - before, said


@pytest.fixture
def study(ran) -> Study:
    return ran[0]


def records(study, **wanted):
    """Realisations of the scenes that have these values."""
    every = read_records(sorted((study / RESULTS / "realisations").glob("*/*.parquet")))
    return [run for run in every if wanted.items() <= run.scene.values.items()]


def assert_same(run, surface, direction="x"):
    """Detachment times of a stored run are those of Python's, to the bit."""
    alone = simulate(surface, Setup(run.material), direction)
    assert alone.t_det.tobytes() == run.t_det.tobytes()


def test_a_study_writes_into_its_folder_alone(ran):
    """Its commands, as the shell splits them, have each path in one piece."""
    _, made, said = ran
    assert {path.parts[:2] for path in made} == {Path(RESULTS).parts}
    assert Path(RESULTS, "figures/surfaces.png") in made
    commands = map(shlex.split, re.findall(r"^Shell command: (springblock .+)$", said, re.M))
    masked = [words for words in commands if "simulate" in words and "--mask" in words]
    assert {words[words.index("--mask") + 1] for words in masked} == {MASK}
    assert {Path(words[words.index("--output") + 1]) for words in masked} <= made


def test_the_example_can_be_planned(study):
    jobs = study.planned(
        "--config", "results=elsewhere", "--", "surfaces", configuration=(EXAMPLE,)
    )
    assert (jobs["prelude"], jobs["simulate_batch"], jobs["surfaces"]) == (3, 3, 1)


def test_a_study_simulates_what_python_does(study):
    mask = str(BlockMap.mask(study / MASK))
    runs = records(study, mask=mask, distribution="weibull", correlation_length=3e-5)
    assert [run.seed for run in runs] == [0, 1]
    for run in runs:
        assert_same(run, Surface.draw(ISLANDS, run.seed, run.material))


def test_coefficients_from_files_are_not_drawn(study):
    mu, weak = (BlockMap.coefficients(study / file) for file in ("mu.npy", WEAK))
    (run,) = records(study, mu_static_field=str(mu), mu_dynamic_field=str(weak), direction="y")
    assert_same(run, Surface(ISLANDS, mu.values, weak.values), direction="y")


def test_rectangles_and_periodic_edges_are_simulated_as_in_python(study):
    """Correlated coefficients, too, go around the edges."""
    runs = records(study, n_rows=6, edges="periodic")
    assert [run.seed for run in runs] == [0, 1]
    for run in runs:
        whole = Surface.draw(np.ones((6, 12), bool), run.seed, run.material, periodic=True)
        assert_same(run, whole)
