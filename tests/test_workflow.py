"""A tiny study from end to end, and when the workflow runs what again."""

import re

import pyarrow.parquet as pq
import pytest

from springblock import Material
from springblock.plotting import figures
from springblock.solver.integrators import INTEGRATORS
from studies import PAPER, ROOT, SCHEMA, TINY

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
    assert len(files) == 11  # 7 batches and 4 tables
    for file in files:
        schema = pq.read_schema(file)
        assert {b"code_version", b"digest" if file.parent.name[-9] == "-" else b"study"} <= set(
            schema.metadata
        )
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


def test_a_finished_study_has_nothing_to_do(study):
    assert study.planned() == {}


@pytest.mark.parametrize("place", ["Snakefile", "workflow/Snakefile"])
def test_the_study_is_planned_from_either_file(study, place):
    """The catalogue of workflows, and a module of another workflow, read that in `workflow`."""
    usual = study.planned("--config", "results=elsewhere")
    jobs = study.planned("-s", place, "--config", "results=elsewhere")
    assert {name: jobs[name] for name in usual} == usual
    assert jobs.keys() - usual.keys() <= {"study"}
    host = study.folder / f"{place.replace('/', '_')}_host"
    host.write_text(HOST.format(place=study.folder / place))
    jobs = study.planned("-s", host.name, "--config", "results=elsewhere")
    assert {name: jobs[f"own_{name}"] for name in usual} == usual


HOST = """\
module own:
    snakefile: "{place}"
    config: config

use rule * from own as own_*
"""
