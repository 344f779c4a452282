"""The record of a results folder, which replaces lost metadata of Snakemake."""

import json
import shutil
from pathlib import Path

import pytest

from springblock.io.identity import read_record
from springblock.study import record

RESULTS = Path("results")
BEFORE = {"step": 2e-8, "realisations_per_job": 2}
OTHER = BEFORE | {"step": 1e-8}
CONTENTS = {"ensembles": {}, "files": ["tables/realisations.parquet"], "spare": ["compiled"]}


@pytest.fixture(autouse=True)
def recorded(tmp_path, monkeypatch):
    """Begin a folder of results under one configuration."""
    monkeypatch.chdir(tmp_path)
    record.begin(RESULTS, BEFORE, CONTENTS)
    (RESULTS / "realisations").mkdir()


def test_results_of_another_configuration_or_code_are_refused_without_memory(monkeypatch):
    record.refuse_unknown(RESULTS, OTHER)  # Snakemake compares them itself
    shutil.rmtree(".snakemake")
    record.refuse_unknown(RESULTS, BEFORE)
    with pytest.raises(ValueError, match=r"results of another configuration \(step\), and Snakem"):
        record.refuse_unknown(RESULTS, OTHER)
    for more, fewer in ((BEFORE, BEFORE | {"new": None}), (BEFORE | {"new": None}, BEFORE)):
        record.begin(Path("others"), more, CONTENTS)
        with pytest.raises(ValueError, match=r"results of another configuration \(new\), and --t"):
            record.refuse_unknown(Path("others"), fewer, "--touch does not compare them")
        record.refuse_unknown(Path("others"), fewer)
        shutil.rmtree("others")
    monkeypatch.setattr(record, "digest", lambda step: f"of another {step}")
    with pytest.raises(ValueError, match=r"results of another code \(compile, mask, simulate, "):
        record.refuse_unknown(RESULTS, BEFORE)


def test_all_configurations_of_a_folder_count():
    record.begin(RESULTS, OTHER, CONTENTS)
    shutil.rmtree(".snakemake")
    with pytest.raises(ValueError, match="another configuration"):
        record.refuse_unknown(RESULTS, OTHER)


def test_the_last_configuration_is_the_present_one():
    for configuration in (OTHER, BEFORE):
        record.begin(RESULTS, configuration, CONTENTS)
        made = read_record(RESULTS)["made"]
        assert made[-1]["configuration"] == configuration
    assert len(made) == 2


def test_without_metadata_on_its_files_a_changed_configuration_is_refused():
    """As after `snakemake --drop-metadata`."""
    record.begin(RESULTS, BEFORE, CONTENTS, remembers=False)
    record.refuse_unknown(RESULTS, BEFORE)
    with pytest.raises(ValueError, match="metadata on them are missing"):
        record.refuse_unknown(RESULTS, OTHER)


def test_a_record_of_an_earlier_version_is_completed():
    file = RESULTS / "study.json"
    older = {key: value for key, value in read_record(RESULTS).items() if key not in CONTENTS}
    file.write_text(json.dumps(older))
    assert read_record(RESULTS)["files"] == []
    record.begin(RESULTS, BEFORE, CONTENTS)
    assert json.loads(file.read_text()) == older | CONTENTS


def test_batches_of_another_size_are_refused():
    with pytest.raises(ValueError, match=r"^realisations_per_job must remain 2, "):
        record.refuse_unknown(RESULTS, BEFORE | {"realisations_per_job": 3})


def test_results_without_their_record_or_with_half_of_it_are_refused():
    file = RESULTS / "study.json"
    file.write_text(file.read_text()[:20])
    with pytest.raises(ValueError, match=r"study\.json is damaged; restore it"):
        record.refuse_unknown(RESULTS, BEFORE)
    file.unlink()
    with pytest.raises(ValueError, match=r"results holds results without study\.json"):
        record.refuse_unknown(RESULTS, BEFORE)
