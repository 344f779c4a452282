"""A tiny study from end to end, and when the workflow runs what again."""

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from springblock import Material, continuum
from springblock.accuracy import conventions
from springblock.io.identity import read_record
from springblock.mechanism.surfaces import TABLES
from springblock.plotting import figures
from springblock.solver.integrators import INTEGRATORS
from springblock.study.archive import archive
from springblock.study.audit import all_faults
from studies import PAPER, ROOT, SCHEMA, TINY, Study

WHOLE = {"configuration": ("config/config.yaml",)}
FULL = {"configuration": ("config/full.yaml",)}
SENSITIVE = {"n_p2": [4], "n_s2": [2], "direction": ["x"], "seeds": 2}

#: Those of the study without its optional groups of scenes and without its tables of errors.
FIGURES = {
    name
    for name, figure in figures.FIGURES.items()
    if figure.is_part_of(TINY["scenes"])
    and figure.category not in ("Mechanism", "Accuracy", "Continuum")
}


def test_every_figure_is_drawn_in_both_formats(study):
    names = {file.name for file in (study / "results/figures").iterdir()}
    assert names == {f"{name}.{suffix}" for name in FIGURES for suffix in ("pdf", "png")}
    assert {f"figure_{number}" for number in range(1, 10)} <= FIGURES


def test_files_say_what_their_columns_mean_and_which_code_made_them(study):
    files = sorted((study / "results").rglob("*.parquet"))
    assert len(files) == 13  # 7 batches, 4 tables, and the correlations of one scene
    for file in files:
        schema = pq.read_schema(file)
        assert {b"code_version", b"configuration_digest"} <= set(schema.metadata)
        assert all({b"unit", b"meaning"} == set(field.metadata) for field in schema)


def test_the_configuration_offers_what_the_package_has():
    """Every integrator, and every constant with the paper's value, which is the default."""
    keys = SCHEMA["properties"]
    assert keys["integrator"]["enum"] == list(INTEGRATORS)
    assert list(keys["material"]["properties"]) == list(PAPER["material"])
    assert PAPER["material"] == dict(Material().items())


#: Scenes of one's own, in another study than the paper's.
OWN = {"flat": {"direction": ["x"], "seeds": 2, "snapshot_times": [1e-5]}}


def rules(study, *options, **how):
    """Names and descriptions of the rules that Snakemake lists."""
    listed = study.run("--list", "--quiet", "host", *options, **how)
    return dict(re.findall(r"^(\w+)(?: \((.+)\))?$", listed, re.MULTILINE))


@pytest.mark.parametrize("kind", ["tiny", "own"])
def test_every_rule_can_be_planned_by_its_name(study, tmp_path, kind):
    """Rules with wildcards, too, such as `prelude`: all files of theirs."""
    study = study.copied(tmp_path / "study")
    if kind == "own":
        study.write("tiny.yaml", {"study": "own", "results": "own", "n_blocks": 12, "scenes": OWN})
    listed = rules(study)
    assert all(listed.values())
    jobs = study.planned("--forceall", "--", *listed)
    assert jobs.keys() >= listed.keys()
    assert jobs["prelude"] == {"tiny": 5, "own": 1}[kind]
    assert jobs["compare_scene"] == 6
    assert study.planned("--forceall", "--", "prelude").keys() == {"compile", "prelude"}


def test_every_step_of_the_full_study_can_be_planned(study):
    """With config/full.yaml all that the package can do; surfaces are a user's own.

    docs/workflow.md lists the steps that are neither figures nor films.
    """
    elsewhere = ("--config", "results=elsewhere")
    steps = rules(study, *elsewhere, **FULL).keys()
    full = study.planned(*elsewhere, "--", *steps, **FULL).keys()
    further = {"mechanism", "production_table", "sweep_pressure", "sweep_scatter"}
    assert {*steps, *further, *figures.FIGURES} - {"surfaces"} <= full
    named = set(re.findall(r"`(\w+)`", (ROOT / "docs/workflow.md").read_text()))
    drawn = ("figure_", "supplement", "sweep_", "film_")
    assert {step for step in steps if not step.startswith(drawn)} <= named


def test_a_figure_of_surfaces_that_are_missing_stops_itself_alone(study):
    options = ("--config", "results=elsewhere", "figures={figure_5: {n_p: 7}}", "--")
    study.run("--dry-run", *options, "figure_6", **WHOLE)
    refused = study.run("--dry-run", *options, "figure_5", refused=True, **WHOLE)
    assert "figures.figure_5: no scene of pillars has n_p = 7." in refused


def test_the_linter_finds_nothing(study):
    said = study.run("--lint", "--config", "results=elsewhere", **WHOLE)
    assert not re.findall(r"^ +\* (.+):$", said, re.MULTILINE)


def test_a_finished_study_has_nothing_to_do_and_no_fault(study, springblock):
    assert study.planned() == {}
    assert "all files are there" in springblock("verify", study.results)


#: Files of a finished study, with the jobs that follow if one is deleted. Preludes, masks and
#: compiled code are made for jobs that are yet to run: without them, nothing is missing.
DELETED = {
    "realisations/n_blocks-12/level-0/direction-x/batch-1.parquet": {"simulate_batch", "report"},
    "correlations/**/correlation.parquet": {"correlation", "correlations_table", "report"},
    "tables/correlation_length.parquet": {"correlations_table", "report"},
    "tables/claims.parquet": {"claims_table", "claims", "report"},
    "figures/figure_1.pdf": {"figure_1", "report"},
    "films/flat.mp4": {"film_flat", "report"},
    "claims.md": {"claims", "report"},
    "report.html": {"report"},
    "preludes/n_blocks-12/level-0/direction-x.npz": set(),
    "compiled": set(),
}


@pytest.mark.parametrize("pattern", DELETED)
def test_a_deleted_file_is_made_again_if_the_study_needs_it(study, springblock, tmp_path, pattern):
    study = study.copied(tmp_path / "study")
    file = next(iter(study.results.glob(pattern)))
    file.unlink()
    jobs, wanted = study.planned(), DELETED[pattern]
    assert jobs.keys() >= wanted
    assert bool(jobs) == bool(wanted)
    if not wanted:
        springblock("verify", study.results)
        return
    found = {fault.file: fault.reason for fault in all_faults(study.results)}
    assert found == {file: f"{file} is missing; `snakemake` makes it"}


def test_the_record_names_all_parts_of_the_pages(study, tmp_path):
    """Also where nothing is to be done: no job of `fields` runs here."""
    study = study.copied(tmp_path / "study")
    sensitive = TINY["scenes"] | {"sensitivities": SENSITIVE}
    study.configure(accuracy=True, verification=True, mechanism="all", scenes=sensitive)
    study.run("--", "fields")
    files = read_record(study.results)["files"]
    parts = {Path(file).parent.name for file in files}
    assert {"accuracy", "mechanism", "tables", "figures", "films"} <= parts
    assert {f"accuracy/production-{scene}.parquet" for scene in conventions.SCENES} <= {*files}
    assert {f"mechanism/{part}.parquet" for each in TABLES.values() for part in each} <= {*files}
    assert {f"continuum/{part}.parquet" for part in continuum.PARTS} <= {*files}
    made = {"accuracy.md", "mechanism.md", "continuum.md", "tables/stability.parquet"}
    assert made | {"tables/sensitivities.parquet"} <= {*files}


def test_repair_compares_with_the_recorded_configuration(study, tmp_path):
    """Another one, which was given by mistake, is not recorded."""
    study = study.copied(tmp_path / "study")
    before = (study.results / "study.json").read_bytes()
    study.configure(material={"gamma": 4e3})
    assert "no faults found" in study.run("--quiet", "host", "--", "repair")
    assert (study.results / "study.json").read_bytes() == before


def test_figures_and_pages_are_drawn_again_without_a_simulation(study, tmp_path):
    """As docs/workflow.md says, in a folder into which an archive was unpacked; to the byte."""
    folder = shutil.copytree(study, tmp_path / "study", ignore=shutil.ignore_patterns(".snakemake"))
    for name in ("CITATION.cff", "environment.lock"):
        shutil.copy(ROOT / name, folder)
    subprocess.run(["git", "init", "-q"], cwd=folder, check=True)
    subprocess.run(["git", "add", "--", ".", ":!results"], cwd=folder, check=True)
    archive(folder, folder / "results", folder / "tiny.yaml", tmp_path / "study.zip")
    with zipfile.ZipFile(tmp_path / "study.zip") as file:
        file.extractall(tmp_path / "unpacked")
    results = tmp_path / "unpacked/results"
    pages = [*results.glob("figures/*"), results / "claims.md"]
    before = {file: file.read_bytes() for file in pages}
    assert len(before) == 2 * 9 + 1  # figures of the paper as PDF and PNG, and the page
    unpacked = Study(tmp_path / "unpacked")
    unpacked.run("--touch")
    for file in before:
        file.unlink()
    names = sorted({file.stem for file in before if file.suffix == ".png"})
    assert set(unpacked.planned("--", *names, "claims")) == {*names, "claims"}
    some = ("figure_1", "figure_7")  # of patterns and correlations
    unpacked.run("--", *some, "claims")
    again = {file: file.read_bytes() for file in before if file.exists()}
    assert {file.stem for file in again} == {*some, "claims"}
    assert again.items() <= before.items()
