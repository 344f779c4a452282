"""Archives of studies: contents, metadata, and their validity."""

import hashlib
import os
import subprocess
import zipfile

import pytest
from click.testing import CliRunner
from rocrate.rocrate import ROCrate

from springblock.cli import main
from springblock.study import record
from springblock.study.archive import CRATE, archive
from studies import ROOT

CODE = {
    "Snakefile": "rule all:\n",
    "environment.lock": "numpy==2.0\n",
    "config/config.yaml": "n_blocks: 12\n",
}
RESULTS = ("tables/a.parquet", "figures/figure_1.png", "claims.md", "realisations/b.parquet")
PRELUDES = ("preludes/a.npz", "surfaces/a.npy")
ASIDE = ("logs/a.log", "benchmarks/a.tsv", "set-aside/tables/b.parquet", "tables/.a.parquet.123")
#: Notes, former archives, and what a rule has made once, when it was named.
ASIDE += ("notes.txt", "springblock-study.zip", "tables/former.zip", "tables/means.csv")


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A clone with results; contents do not matter."""
    folder = tmp_path / "study"
    made = {f"results/{name}": name for name in (*RESULTS, *PRELUDES, *ASIDE)}
    made["former.zip"] = "tracked by git"
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    for name, text in {**CODE, **made, "CITATION.cff": citation, "notes.txt": "mine"}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    subprocess.run(["git", "init", "-q"], cwd=folder, check=True)
    subprocess.run(["git", "add", *CODE, "CITATION.cff", "former.zip"], cwd=folder, check=True)
    monkeypatch.chdir(folder)
    spare = [*PRELUDES, "preludes/b.npz", "tables/means.csv"]
    contents = {"ensembles": {}, "files": list(RESULTS), "spare": spare}
    record.begin(folder / "results", {"realisations_per_job": 1}, contents)
    return folder


def packed(study, configuration="config/config.yaml"):
    """Archive of a study, and how many files it is said to hold."""
    output = study.parent / "study.zip"
    number = archive(study, study / "results", study / configuration, output)
    return output, number


def test_what_git_says_is_told(clone):
    (clone / ".git/HEAD").unlink()
    with pytest.raises(ValueError, match=r"study: git fails: fatal: not a git repository"):
        packed(clone)


def test_it_holds_an_untracked_configuration(clone):
    (clone / "mine.yaml").write_text("n_blocks: 24\n", encoding="utf-8")
    output, _ = packed(clone, "mine.yaml")
    with zipfile.ZipFile(output) as file:
        assert file.read("mine.yaml") == b"n_blocks: 24\n"


def test_the_crate_holds_code_and_results_alone_and_describes_each_file_and_the_run(
    clone, tmp_path
):
    names = (*RESULTS, *PRELUDES, "study.json")
    for name in names:  # unlike the code, of 2001
        os.utime(clone / "results" / name, (1e9, 1e9))
    output, number = packed(clone)
    with zipfile.ZipFile(output) as file:
        results = {f"results/{name}" for name in names}
        assert set(file.namelist()) == {*CODE, "CITATION.cff", CRATE, *results}
        assert len(file.namelist()) == number
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
    assert {each.id for each in run["result"]} == results
    assert run["startTime"] == run["endTime"] == "2001-09-09T01:46:40+00:00"
    # what the profile Workflow Run Crate 0.5 and RO-Crate 1.1 require of the root
    root = crate.root_dataset
    assert all(root[name] for name in ("name", "description", "license", "datePublished"))
    profiles = {each.id.rsplit("/", 2)[1] for each in root["conformsTo"]}
    assert profiles == {"process", "workflow", "workflow-ro-crate"}


@pytest.mark.parametrize("name", ["results/tables/a.parquet", "results/tables", "Snakefile"])
def test_a_link_out_of_the_study_is_refused(clone, name):
    """Of a file or a folder; the folder of results itself may be a link."""
    moved = (clone / name).rename(clone.parent / "elsewhere")
    (clone / name).symlink_to(moved)
    sentence = rf"^{name}.* is a link to {moved}.*, outside of the study"
    with pytest.raises(ValueError, match=sentence):
        packed(clone)
    (clone / name).unlink()
    moved.rename(clone / name)
    moved = (clone / "results").rename(clone.parent / "scratch")
    (clone / "results").symlink_to(moved)
    assert packed(clone)[1] > len(RESULTS)


@pytest.mark.parametrize(
    ("missing", "sentence"),
    [
        (".git", "is not a clone of the study"),
        ("results/study.json", "results is not a folder of results of a study"),
        ("results/claims.md", "results/claims.md is missing; `snakemake` makes it"),
    ],
)
def test_an_unfinished_study_is_refused(clone, missing, sentence):
    for name in ("tables/a.parquet", "realisations/b.parquet"):  # which are no tables
        (clone / "results" / name).unlink()
    needed = ["claims.md", "figures/figure_1.png"]
    contents = {"ensembles": {}, "files": needed, "spare": list(PRELUDES)}
    record.begin(clone / "results", {"realisations_per_job": 1}, contents)
    for name in (*PRELUDES, "tables/former.zip", "tables/means.csv"):
        (clone / "results" / name).unlink()
    (clone / missing).rename(clone.parent / "elsewhere")
    outcome = CliRunner().invoke(main, ["archive", "results", "--output", "study.zip"])
    assert outcome.exit_code == 1
    assert sentence in outcome.output
    assert not (clone / "study.zip").exists()
