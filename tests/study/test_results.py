"""What figures declare, what follows for a study, and the command that draws by it."""

from dataclasses import replace
from inspect import signature
from pathlib import Path

import pyarrow as pa
import pytest
import yaml
from snakemake.utils import update_config

from springblock.io.identity import identity
from springblock.io.parquet import rows_to_table, write
from springblock.io.records import Record
from springblock.io.schemas import BATCH
from springblock.model.scene import Scene
from springblock.study.commands.figure import ensembles
from springblock.study.continuum import cases
from springblock.study.mechanism import surfaces
from springblock.study.plan import Plan
from springblock.study.results import FIGURES, HERE, PAGES, PARTS, TABLES, found
from studies import ROOT
from study.paper.test_results import NORMAL_FORCE, SIZE, record


def planned(*files: str) -> Plan:
    """The plan of a configuration."""
    merged: dict = {}
    for file in files:
        update_config(merged, yaml.safe_load((ROOT / "config" / file).read_text()))
    return Plan(merged)


PAPER = planned("config.yaml")
FULL = planned("config.yaml", "full.yaml")
QUICK = planned("config.yaml", "quick.yaml")


def test_figures_whose_groups_are_left_out_are_no_part_of_a_study():
    assert {*QUICK.figures} == {f"figure_{number}" for number in range(1, 10)}
    assert FIGURES.keys() - {*FULL.figures} == {"surfaces"}  # whose files a user brings


FLAT, UPWARDS = Scene(120), Scene(120, direction="y")
SMALL, LARGE, WIDE = Scene(120, 2, 2), Scene(120, 20, 20), Scene(120, 20, 40)
ALONG, OTHER = Scene(120, 58, 62, 8, 2), Scene(120, 58, 62, 10, 2)
ACROSS, ASKEW = replace(ALONG, direction="y"), replace(OTHER, direction="45")
CUT = replace(ALONG, n_p3=18, n_s3=2)
CUT_ASKEW, CUT_ALONG = replace(CUT, direction="45"), replace(CUT, along_3="x")
GROUPS = {
    "flat": [FLAT, UPWARDS],
    "pillars": [SMALL, LARGE, WIDE],
    "grooves": [ALONG, ACROSS, OTHER],
    "third_level": [CUT, CUT_ASKEW, CUT_ALONG],
}


@pytest.mark.parametrize(
    ("name", "scenes"),
    [
        ("figure_2", [FLAT]),
        ("figure_5", [LARGE]),
        ("figure_6", [FLAT, SMALL, LARGE]),
        ("figure_9", [ALONG, ACROSS, OTHER]),
        ("supplement_levels", [CUT, CUT_ASKEW, CUT_ALONG]),
    ],
)
def test_a_figure_is_drawn_from_scenes_that_it_can_tell_apart(name, scenes):
    lengths = {"n_p": 20} if name == "figure_5" else {}
    assert FIGURES[name].scenes(GROUPS, lengths) == scenes
    few = [Scene(126, 7, 7), Scene(120, 4, 4)] if name == "figure_6" else []  # need another N
    assert FIGURES[name].scenes(GROUPS | {"small_pillars": few}, lengths) == [*scenes, *few]


@pytest.mark.parametrize("plan", [PAPER, FULL, QUICK])
def test_a_study_has_the_data_of_its_figures(plan):
    for name, declared in plan.figures.items():
        given = plan.needed(name) or plan.command(name) != f"figure {name} "
        assert given or not signature(declared.function()).parameters


def test_every_declared_place_exists():
    """Functions, columns and templates, with the parts that functions know."""
    for table in TABLES.values():
        assert isinstance(found(table.columns), pa.Schema)
        assert not table.made or callable(found(table.made))
    for page in PAGES.values():
        assert (HERE / page.template).exists()
        assert callable(found(page.values))
    assert {*surfaces.PARTS} == {part for part in PARTS if part.startswith("mechanism")}
    assert {*cases.SERIES} == {p.partition("-")[2] for p in PARTS if p.startswith("continuum")}


def test_a_part_that_no_table_has_is_refused():
    plan = Plan(PAPER.configuration | {"parts": ["stability", "mechanism-77"]})
    with pytest.raises(ValueError, match="parts: no part is 'mechanism-77'; choose from reference"):
        _ = plan.measured


def test_a_picture_keeps_its_caption_with_the_size_of_its_sample(springblock, tmp_path):
    runs = replace(record(0), seed=0), replace(record(1), seed=1)
    batches = [batch(tmp_path / str(run.seed), run) for run in runs]
    output, words = tmp_path / "figure.png", FIGURES["figure_5"].caption
    springblock("figure", "figure_5", *batches, "--output", output)
    said = f"{words} n_p = {SIZE}, N = 24, sliding direction x, 2 realisations. a) Blue: "
    assert said.encode() in output.read_bytes()


def batch(path: Path, run: Record) -> Path:
    """A file that holds one run; what figures do not read is zero in it."""
    scene = replace(run.scene, sample_interval=run.time[1])
    row = {name: getattr(run, name, 0) for name in BATCH.names} | identity(scene)
    row |= {"contact": scene.contact.ravel(), "t_det": run.t_det.ravel()}
    write(rows_to_table([row], BATCH), path, {})
    return path


def test_scenes_that_a_figure_cannot_tell_apart_are_refused(springblock, tmp_path):
    other = replace(record(1), scene=Scene(24, SIZE, 2))
    batches = batch(tmp_path / "one", record(0)), batch(tmp_path / "other", other)
    found = ensembles(batches, "n_p", "n_s")
    assert set(found) == {(SIZE, SIZE), (SIZE, 2)}
    assert found[SIZE, 2][0].normal_force == NORMAL_FORCE
    with pytest.raises(ValueError, match=r"n_p, direction = .* is not unique"):
        ensembles(batches, "n_p", "direction")
    output = ("--output", tmp_path / "figure.png")
    said = springblock("figure", "figure_5", *batches, *output, refused=True)
    scenes = "n_blocks = 24, n_p = 6, n_s = 6; n_blocks = 24, n_p = 6, n_s = 2;"
    assert said.startswith(f"Error: several scenes: {scenes}")


def test_a_pattern_is_drawn_from_options(springblock, tmp_path):
    output = ("--output", tmp_path / "figure.png")
    springblock("figure", "figure_4", "--n-blocks", 40, "--n-p", 2, "--n-s", 2, *output)
    said = springblock("figure", "figure_4", "--n-blocks", 8, *output, refused=True)
    assert "a flat surface has no pillar" in said
