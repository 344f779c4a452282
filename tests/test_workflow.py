"""A tiny study from end to end, and when the workflow runs what again."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest
import yaml

from springblock import Material
from springblock.io.schemas import BATCH, CORRELATION, CORRELATION_LENGTH, SUMMARY
from springblock.plotting import declarations
from springblock.solver import INTEGRATORS

ROOT = Path(__file__).parents[1]

PAPER = yaml.safe_load((ROOT / "config/config.yaml").read_text())
WHOLE = {"configuration": ("config/config.yaml",)}

GROOVES = {"n_p": [5], "n_s": [7], "n_p2": [1], "n_s2": [1]}
TINY = {
    "n_blocks": 12,
    "realisations_per_job": 2,
    "accuracy": False,
    "scenes": dict.fromkeys(PAPER["scenes"])  # null leaves the other groups out
    | {
        "flat": {"seeds": 3},
        "pillars": {"n_p": [3, 6], "seeds": [2, 3]},
        "again": {"n_p": [6], "n_s": [6], "direction": ["x"], "seeds": 1},
        "grooves": GROOVES | {"direction": ["x", "y"], "seeds": 1},
    },
    "beyond": dict.fromkeys(PAPER["beyond"]),
    "more": dict.fromkeys(PAPER["more"]),
    "figures": {
        "figure_4": {"n_p": 3, "n_s": 3},
        "figure_5": {"n_p": 3},
        "figure_7": {"n_p": 6},
        "figure_8": {"n_p": 5, "n_s": 7, "n_p2": 1, "n_s2": 1},
    },
}

#: Those of the study without its optional groups of scenes and without its tables of errors.
FIGURES = {
    name
    for name, figure in declarations().items()
    if figure.is_part_of(TINY["scenes"]) and figure.category != "Accuracy"
}


FILMS = {"film_flat", "film_pillars", "film_grooves"}


def with_sources(study: Path) -> dict[str, str]:
    """Environment in which the copy's own package comes first."""
    paths = [str(study / "src"), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}


def snakemake(
    study: Path, *options: str, configuration: tuple[str, ...] = ("tiny.yaml",)
) -> subprocess.CompletedProcess[str]:
    """Run Snakemake on a copy of the study with the copy's own package."""
    return subprocess.run(
        [sys.executable, "-m", "snakemake", "--configfile", *configuration, *options],
        cwd=study,
        env=with_sources(study),
        capture_output=True,
        text=True,
        check=False,
    )


def planned(study: Path, *options: str, **configuration: tuple[str, ...]) -> dict[str, int]:
    """Jobs that a dry run announces, by rule; without the one that writes down their origins."""
    outcome = snakemake(study, "--dry-run", *options, **configuration)
    assert outcome.returncode == 0, outcome.stderr
    table = re.search(r"job +count\n-+  -+\n(.*?)\n\n", outcome.stdout + outcome.stderr, re.DOTALL)
    rows = table.group(1).splitlines() if table else []
    return {
        name: int(count) for name, count in map(str.split, rows) if name not in ("total", "origins")
    }


def copied(folder: Path) -> Path:
    """Copy all that the study consists of into a folder."""
    for part in ("src", "workflow", "config", "profiles"):
        shutil.copytree(ROOT / part, folder / part)
    shutil.copy(ROOT / "Snakefile", folder)
    return folder


@pytest.fixture
def edited(study: Path, request: pytest.FixtureRequest):
    """Append a line to a file of the study for the time of one test."""
    file = study / request.param
    content = file.read_bytes()
    file.write_bytes(content + b"\n# another line\n")
    yield request.param
    file.write_bytes(content)


def test_every_figure_is_drawn_in_both_formats(study):
    names = {file.name for file in (study / "results/figures").iterdir()}
    assert names == {f"{name}.{suffix}" for name in FIGURES for suffix in ("pdf", "png")}
    assert {f"figure_{number}" for number in range(1, 10)} <= FIGURES
    assert {"supplement_repetitions", "supplement_restick"} <= FIGURES


def test_the_report_says_of_each_figure_what_it_declares(study, tmp_path):
    outcome = snakemake(study, "--report", str(tmp_path / "report.html"))
    assert outcome.returncode == 0, outcome.stderr
    report = (tmp_path / "report.html").read_text()
    for name in FIGURES:
        assert f'"caption": "<p>{declarations()[name].caption[:60]}' in report
    assert "N = 12, sliding direction x. Flat (seeds 0 to 2)." in report  # and what it draws from


def test_the_table_holds_every_realisation_once(study):
    table = pq.read_table(study / "results/tables/realisations.parquet")
    assert table.schema.names == SUMMARY.names
    scenes = [(row["level"], row["direction"], row["seed"]) for row in table.to_pylist()]
    flat = [(0, "x", seed) for seed in (0, 1, 2)]
    pillars = [(1, "x", seed) for seed in (0, 1, 0, 1, 2)]
    assert scenes == [*flat, *pillars, (2, "x", 0), (2, "y", 0)]


def test_correlations_are_those_of_pillars_with_sides(study):
    for table, schema in (("correlation", CORRELATION), ("correlation_length", CORRELATION_LENGTH)):
        found = pq.read_table(study / f"results/tables/{table}.parquet")
        assert found.schema.names == schema.names
        assert {(row["n_p"], row["side"]) for row in found.to_pylist()} == {(6, "x"), (6, "y")}
        assert set(found["realisations"].to_pylist()) == {3}


def test_files_say_what_their_columns_mean_and_which_code_made_them(study):
    files = sorted((study / "results").rglob("*.parquet"))
    assert len(files) == 13  # 7 batches, 4 tables, and the correlations of one scene
    for file in files:
        schema = pq.read_schema(file)
        assert {b"code_version", b"configuration_digest"} <= set(schema.metadata)
        assert all({b"unit", b"meaning"} == set(field.metadata) for field in schema)


def test_batches_hold_the_curves_that_the_figures_draw(study):
    (file, *_) = sorted((study / "results/realisations").rglob("seeds-0-1.parquet"))
    assert pq.read_schema(file).names == BATCH.names


def test_each_job_leaves_a_log_and_a_benchmark(study):
    jobs = {
        "compile-leapfrog",
        "origins",
        "aggregate",
        "correlation",
        "correlation_length",
        "claims",
        *FILMS,
        "report",
        *FIGURES,
    }
    for kind, suffix in (("logs", "log"), ("benchmarks", "tsv")):
        files = {file.stem for file in (study / "results" / kind).glob(f"*.{suffix}")}
        assert files == jobs


def test_the_configuration_offers_what_the_package_has():
    """Every integrator, and every constant with the paper's value, which holds if unsaid."""
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    assert schema["properties"]["integrator"]["enum"] == list(INTEGRATORS)
    assert list(schema["properties"]["material"]["properties"]) == list(PAPER["material"])
    assert PAPER["material"] == dict(Material().items())


def test_the_whole_study_can_be_planned(study):
    """With all its groups of scenes and its comparisons, from nothing."""
    jobs = planned(study, "--config", "results=elsewhere", **WHOLE)
    tables = {"compare_scene", "stability_table", "precision_table", "accuracy", "claims"}
    figures = {
        name: figure
        for name, figure in declarations().items()
        if figure.is_part_of(PAPER["scenes"] | PAPER["beyond"] | PAPER["more"])
    }
    assert declarations().keys() - figures.keys() == {"surfaces"}  # whose files a user brings
    upon_request = {name for name, figure in figures.items() if figure.upon_request}
    further = {name for name, figure in figures.items() if figure.category == "Beyond"}
    assert {*tables, *figures} - upon_request - further <= set(jobs)
    assert not {*upon_request, *further, "production_scene"} & set(jobs)
    beyond = planned(study, "--config", "results=elsewhere", "--", "beyond", **WHOLE)
    assert {"beyond_page", *further} <= set(beyond)
    more = planned(study, "--config", "results=elsewhere", "--", "more", **WHOLE)
    assert {"aggregate_part": 1, "correlations_table": 2, "more": 1}.items() <= more.items()
    assert not {"claims", "beyond_page", *figures} & set(more)
    assert {f"supplement_{name}" for name in ("spacing", "size", "angle", "levels")} <= set(jobs)
    sizes = planned(study, "--config", "results=elsewhere", "--", "figure_7", **WHOLE)
    assert set(sizes) == {
        "compile_integrator",
        "prelude_scene",
        "simulate_batch",
        "correlation_scene",
        "figure_7",
    }
    assert sizes["simulate_batch"] < jobs["simulate_batch"]


def test_errors_at_full_size_are_measured_upon_request(study):
    jobs = planned(study, "--config", "results=elsewhere", "--", "production", **WHOLE)
    needed = {"compile_integrator": 2, "production_scene": 3, "production_table": 1}
    assert jobs == {**needed, "total_error": 1, "production": 1}


def test_errors_at_full_size_belong_to_the_study_once_they_are_there(study):
    table = study / "measured/tables/production.parquet"
    table.parent.mkdir(parents=True)
    table.touch()
    options = ("--config", "results=measured", "--printshellcmds")
    assert {"total_error", "accuracy"} <= set(planned(study, *options, **WHOLE))
    commands = snakemake(study, "--dry-run", *options, **WHOLE).stdout
    assert "realisations.parquet --production measured/tables/production.parquet" in commands


def test_a_part_without_sides_has_no_correlations(study):
    often = "more={repetitions: {n_p: [3], n_s: [3], direction: [x], seeds: 4}}"
    jobs = planned(study, "--config", "results=elsewhere", often, "--", "more")
    assert jobs["aggregate_part"] == 1
    assert not {"correlation_scene", "correlations_table"} & set(jobs)


@pytest.mark.parametrize("part", ["beyond/", "more/"])
def test_claims_rest_on_what_is_simulated_upon_request_once_it_is_there(study, part):
    results = f"with-{part[:-1]}"
    table = study / results / f"tables/{part}realisations.parquet"
    options = ("--config", f"results={results}", "--printshellcmds")
    alone = planned(study, *options, **WHOLE)
    table.parent.mkdir(parents=True)
    table.touch()
    assert planned(study, *options, **WHOLE)["simulate_batch"] > alone["simulate_batch"]
    commands = snakemake(study, "--dry-run", *options, **WHOLE).stdout
    for option in ("realisations", "correlation"):
        tables = [f"--{option} {results}/tables/{place}{option}.parquet" for place in ("", part)]
        assert " ".join(tables) in commands


def test_the_page_beyond_the_paper_rests_on_more_realisations_once_they_are_there(study):
    options = ("--config", "results=often", "--", "beyond_page")
    alone = planned(study, *options, **WHOLE)["simulate_batch"]
    table = study / "often/tables/more/realisations.parquet"
    table.parent.mkdir(parents=True)
    table.touch()
    assert planned(study, *options, **WHOLE)["simulate_batch"] > alone


def test_a_figure_of_surfaces_that_are_missing_stops_itself_alone(study):
    options = ("--config", "results=elsewhere", "figures={figure_5: {n_p: 7}}", "--")
    assert "figure_6" in planned(study, *options, "figure_6", **WHOLE)
    refused = snakemake(study, "--dry-run", *options, "figure_5", **WHOLE)
    assert refused.returncode != 0
    assert "figures.figure_5 shows n_p = 7, which no scene of pillars has." in refused.stdout


def test_every_step_can_be_planned_by_its_name(study):
    """Where many jobs share a step, they are named after it and one of them: simulate_batch."""
    rules, steps = (
        set(snakemake(study, option, **WHOLE).stdout.split())
        for option in ("--list-rules", "--list-target-rules")
    )
    assert {rule.rpartition("_")[0] for rule in rules - steps} <= steps
    jobs = planned(study, "--config", "results=elsewhere", "--", *steps, **WHOLE)
    assert steps - {"origins"} <= set(jobs)
    named = set(re.findall(r"`(\w+)`", (ROOT / "README.md").read_text()))
    assert {
        step for step in steps if not step.startswith(("figure", "supplement", "beyond_", "sweep_"))
    } <= named


def test_the_linter_finds_nothing(study):
    outcome = snakemake(study, "--lint", **WHOLE)
    assert outcome.returncode == 0
    assert not re.findall(r"^ +\* (.+):$", outcome.stderr, re.MULTILINE)


def test_a_printed_command_runs_by_hand(study):
    """As in an activated environment, and with the sources that the study selects."""
    drawn = study / "results/figures/figure_1.pdf"
    outcome = snakemake(study, "--dry-run", "--printshellcmds", "--force", "--", "figure_1")
    (command,) = re.findall(r"^Shell command: (.+)$", outcome.stdout, re.MULTILINE)
    drawn.unlink()
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    by_hand = {**with_sources(study), "PATH": path}
    subprocess.run(command, shell=True, cwd=study, env=by_hand, check=True)
    assert drawn.exists()


def test_a_finished_study_has_nothing_to_do(study):
    assert planned(study) == {}


@pytest.mark.parametrize("edited", ["src/springblock/solver/leapfrog.py"], indirect=True)
def test_an_edited_solver_runs_the_simulations_again(study, edited):
    assert planned(study)["simulate_batch"] == 7


@pytest.mark.parametrize("edited", ["src/springblock/plotting/paper/figure_3.py"], indirect=True)
def test_an_edited_figure_draws_that_figure_again(study, edited):
    assert set(planned(study)) == {"figure_3", "report", "all"}


@pytest.mark.parametrize("edited", ["config/README.md"], indirect=True)
def test_an_edited_text_runs_nothing_again(study, edited):
    assert planned(study) == {}


@pytest.mark.parametrize(
    ("figure", "preludes", "simulations"),
    [("figure_3", 1, 1), ("figure_5", 1, 1), ("figure_6", 3, 5), ("figure_9", 2, 2)],
)
def test_one_figure_needs_only_its_own_simulations(study, figure, preludes, simulations):
    jobs = planned(study, "--config", "results=elsewhere", "--", figure)
    needed = {"compile_integrator": 1, "prelude_scene": preludes, "simulate_batch": simulations}
    assert jobs == {**needed, figure: 1}


def test_figure_7_needs_only_pillars_with_sides(study):
    jobs = planned(study, "--config", "results=elsewhere", "--", "figure_7")
    needed = {"compile_integrator": 1, "prelude_scene": 1, "simulate_batch": 2}
    assert jobs == {**needed, "correlation_scene": 1, "figure_7": 1}


def test_the_quick_study_leaves_the_optional_groups_out(study):
    jobs = planned(study, configuration=("config/quick.yaml",))
    assert (jobs["prelude_scene"], jobs["correlation_scene"]) == (5, 4)


def test_a_changed_constant_runs_the_simulations_again(study):
    material = dict(Material().items()) | {"gamma": 4e3}
    (study / "damped.yaml").write_text(yaml.safe_dump({"material": material}))
    assert planned(study, configuration=("tiny.yaml", "damped.yaml"))["simulate_batch"] == 7


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"stepp": 1e-8}, "unknown key 'stepp'"),
        ({"scenes": {"pillars": {"seeds": [2]}}}, "pillars: seeds lists 1 numbers for 2 values"),
        ({"scenes": {"pillars": {"n_p": [5, 5]}}}, "scenes.pillars.n_p.*non-unique"),
        (
            {"scenes": {"pillars": {"n_p": [5, 6]}}},
            r"scenes.pillars.*5 \+ 5 = 10 must divide N = 12",
        ),
        ({"scenes": {"flat": {"seeds": "many"}}}, "scenes.flat.seeds.*'many'.*integer"),
        ({"step": 1e-6}, "step = 1e-06 s is unstable"),
        ({"sample_interval": 2.5e-8}, "sample_interval must be a multiple of step"),
        ({"material": {"density": -1.0}}, "material.density.*-1.0"),
        ({"scenes": {"grooves": {"n_s2": [6]}}}, "groove of 6 blocks.*pillar of 5"),
    ],
)
def test_a_wrong_configuration_is_refused_in_one_sentence(study, change, sentence):
    (study / "wrong.yaml").write_text(yaml.safe_dump(change))
    outcome = snakemake(study, "--dry-run", configuration=("tiny.yaml", "wrong.yaml"))
    message = outcome.stdout + outcome.stderr
    assert outcome.returncode == 1
    assert re.search(sentence, message), message
    assert "Traceback" not in message
