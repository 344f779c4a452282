"""Archives of studies: contents, metadata, and their validity."""

import hashlib
import os
import subprocess
import zipfile

import pytest
from click.testing import CliRunner
from rocrate.rocrate import ROCrate

from springblock.cli import main
from springblock.study.archive import CRATE, archive
from studies import ROOT

CODE = {
    "Snakefile": "rule all:\n",
    "environment.lock": "numpy==2.0\n",
    "config/config.yaml": "n_blocks: 12\n",
}
RESULTS = ("tables/a.parquet", "figures/figure_1.png", "claims.md", "realisations/b.parquet")
ASIDE = ("logs/a.log", "benchmarks/a.tsv", "set-aside/tables/b.parquet", "tables/.a.parquet.123")


@pytest.fixture
def clone(tmp_path):
    """A clone with results; contents do not matter."""
    folder = tmp_path / "study"
    made = {f"results/{name}": name for name in (*RESULTS, *ASIDE)}
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    for name, text in {**CODE, **made, "CITATION.cff": citation, "notes.txt": "mine"}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    subprocess.run(["git", "init", "-q"], cwd=folder, check=True)
    subprocess.run(["git", "add", *CODE, "CITATION.cff"], cwd=folder, check=True)
    return folder


def packed(study, configuration="config/config.yaml"):
    """Archive of a study, and how many files it is said to hold."""
    output = study.parent / "study.zip"
    number = archive(study, study / "results", study / configuration, output)
    return output, number


def test_it_holds_code_and_results_and_nothing_else(clone):
    output, number = packed(clone)
    with zipfile.ZipFile(output) as file:
        names = file.namelist()
        assert file.testzip() is None
    assert len(names) == number
    assert set(names) == {*CODE, "CITATION.cff", CRATE, *(f"results/{name}" for name in RESULTS)}


def test_it_holds_an_untracked_configuration(clone):
    (clone / "mine.yaml").write_text("n_blocks: 24\n", encoding="utf-8")
    output, _ = packed(clone, "mine.yaml")
    with zipfile.ZipFile(output) as file:
        assert file.read("mine.yaml") == b"n_blocks: 24\n"


def test_the_crate_describes_every_file_and_the_run(clone, tmp_path):
    for name in RESULTS:  # unlike the code, of 2001
        os.utime(clone / "results" / name, (1e9, 1e9))
    output, _ = packed(clone)
    with zipfile.ZipFile(output) as file:
        file.extractall(tmp_path / "unpacked")
    crate = ROCrate(tmp_path / "unpacked")  # its library reads it back
    files = {entity.id: entity for entity in crate.data_entities}
    for path in (tmp_path / "unpacked").rglob("*.*"):
        name = path.relative_to(tmp_path / "unpacked").as_posix()
        if name != CRATE:
            assert files[name]["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
            assert int(files[name]["contentSize"]) == path.stat().st_size
    assert crate.mainEntity.id == "Snakefile"
    assert {"SoftwareSourceCode", "ComputationalWorkflow"} <= set(crate.mainEntity.type)
    [run] = crate.root_dataset["mentions"]
    assert run.type == "CreateAction"
    assert run["instrument"].id == "Snakefile"
    assert {each.id for each in run["object"]} == {"config/config.yaml", "environment.lock"}
    assert {each.id for each in run["result"]} == {f"results/{name}" for name in RESULTS}
    assert run["startTime"] == run["endTime"] == "2001-09-09T01:46:40+00:00"
    # what the profile Workflow Run Crate 0.5 and RO-Crate 1.1 require of the root
    root = crate.root_dataset
    assert all(root[name] for name in ("name", "description", "license", "datePublished"))
    profiles = {each.id.rsplit("/", 2)[1] for each in root["conformsTo"]}
    assert profiles == {"process", "workflow", "workflow-ro-crate"}


@pytest.mark.parametrize(
    ("missing", "sentence"),
    [(".git", "is not a clone of the study"), ("results/tables", "run the study first")],
)
def test_an_unfinished_study_is_refused(clone, monkeypatch, missing, sentence):
    (clone / missing).rename(clone.parent / "elsewhere")
    monkeypatch.chdir(clone)
    outcome = CliRunner().invoke(main, ["archive", "results", "--output", "study.zip"])
    assert outcome.exit_code == 1
    assert sentence in outcome.output
    assert not (clone / "study.zip").exists()
