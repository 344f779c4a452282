"""A tiny study from end to end, and when the workflow runs what again."""

import re

import pyarrow.parquet as pq
import pytest

from springblock import Material
from springblock.solver.integrators import INTEGRATORS
from springblock.study.results import FIGURES, PAGES, TABLES
from studies import PAPER, ROOT, SCHEMA, TINY, Study

WHOLE = {"configuration": ("config/config.yaml",)}

#: Those of the study without its optional groups of scenes and without tables of chapters.
DRAWN = {
    name
    for name, figure in FIGURES.items()
    if all(map(TINY["scenes"].get, figure.groups)) and figure.draws != "tables"
}


def test_every_figure_is_drawn_in_both_formats(study):
    names = {file.name for file in (study / "results/figures").iterdir()}
    assert names == {f"{name}.{suffix}" for name in DRAWN for suffix in ("pdf", "png")}
    assert {f"figure_{number}" for number in range(1, 10)} <= DRAWN


def test_a_finished_study_has_nothing_to_do(study):
    assert study.planned() == {}


def test_files_say_what_their_columns_mean_and_which_code_made_them(study):
    files = sorted((study / "results").rglob("*.parquet"))
    assert len(files) == 11  # 7 batches and 4 tables
    for file in files:
        schema = pq.read_schema(file)
        digest = b"study" if file.parent.name == "tables" else b"digest"
        assert {b"code_version", digest} <= set(schema.metadata)
        assert all({b"unit", b"meaning"} == set(field.metadata) for field in schema)


def test_the_configuration_offers_what_the_package_has():
    """Every integrator, and every constant with the paper's value, which is the default."""
    assert SCHEMA["properties"]["integrator"]["enum"] == list(INTEGRATORS)
    assert PAPER["material"] == dict(Material().items())


#: Scenes of one's own, in another study than the paper's.
OWN = {"flat": {"direction": ["x"], "seeds": 2, "snapshot_times": [1e-5]}}


@pytest.mark.parametrize("file", ["own.yaml", "config/full.yaml"])
def test_every_stage_can_be_planned_by_its_name(tmp_path, file):
    """Without tricks: a rule whose files are many has another beside it that asks for all."""
    study, how = Study.begun(tmp_path), {"configuration": (file,)}
    study.write("own.yaml", {"study": "own", "n_blocks": 12, "scenes": OWN})
    listed = study.run("--list-target-rules", "--quiet", "host", **how)
    named = set(re.findall(r"^(\w+) \(", listed, re.MULTILINE))
    beside = {"prelude": "preludes", "simulate_batch": "simulate", "part": "parts", "film": "films"}
    beside |= {"fields_of_scene": "fields", "compile": "compiled", "mask": "masks"}
    assert {*beside.values()} <= named
    assert study.planned("--forceall", "--", *named, **how).keys() >= named
    text = (ROOT / "config/README.md").read_text()
    assert file == "own.yaml" or {*re.findall(r"snakemake -n (\w+)", text)} <= named
    known = {*re.findall(r"`(\w+)`", text), *FIGURES, *PAGES, *(f"{name}_table" for name in TABLES)}
    assert {name for name in named if not name.startswith("sweep_")} <= known | {"all"}


def test_lengths_of_a_figure_that_no_scene_has_are_refused(study):
    options = ("--config", "results=elsewhere", "figures={figure_5: {n_p: 7}}", "--")
    refused = study.run("--dry-run", *options, "figure_5", refused=True, **WHOLE)
    assert "figures.figure_5: no scene of pillars has n_p = 7." in refused


def test_the_linter_finds_nothing(study):
    said = study.run("--lint", "--config", "results=elsewhere", **WHOLE)
    assert not re.findall(r"^ +\* (.+):$", said, re.MULTILINE)


def test_the_study_is_planned_from_the_file_that_the_catalogue_of_workflows_reads(study):
    elsewhere = ("--cores", "1", "--config", "results=elsewhere")
    usual, jobs = study.planned(*elsewhere), study.planned("-s", "workflow/Snakefile", *elsewhere)
    assert jobs.keys() ^ usual.keys() <= {"all", "study"}
    assert all(jobs[name] == usual[name] for name in jobs.keys() & usual.keys())


def test_a_repeated_key_and_an_unforeseen_error_are_one_sentence(tmp_path):
    study = Study.begun(tmp_path)
    configured = (study / "tiny.yaml").read_text()
    (study / "tiny.yaml").write_text(configured + "step: 1.0e-8\nstep: 2e-8\n")
    said = study.run("-n", refused=True)
    assert re.search(r"tiny.yaml, line \d+: key 'step' is repeated; rename or remove it", said)
    assert "Traceback" not in said
    (study / "tiny.yaml").write_text(configured)
    study.edit("study/configuration.py", "def check(", "def check(*_): {}['x']\n\n\ndef unused(")
    said = study.run("-n", refused=True)
    assert "The study cannot be run: " in said
    assert "KeyError('x'); SPRINGBLOCK_TRACEBACK=1 shows where this happened." in said
    assert "Traceback" not in said
