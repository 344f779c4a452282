"""The record of a results folder, which replaces lost metadata of Snakemake."""

import shutil
from pathlib import Path

import pytest

from springblock.study import audit, record

RESULTS = Path("results")
BEFORE = {"step": 2e-8, "realisations_per_job": 2}
OTHER = BEFORE | {"step": 1e-8}


@pytest.fixture(autouse=True)
def recorded(tmp_path, monkeypatch):
    """Begin a folder of results under one configuration."""
    monkeypatch.chdir(tmp_path)
    record.begin(RESULTS, BEFORE, touched=False)
    (RESULTS / "realisations").mkdir()


def test_results_of_another_configuration_or_code_are_refused_without_memory(monkeypatch):
    record.refuse_unknown(RESULTS, OTHER)  # Snakemake compares them itself
    shutil.rmtree(".snakemake")
    record.refuse_unknown(RESULTS, BEFORE)
    with pytest.raises(ValueError, match=r"results of another configuration \(step\), and Snakem"):
        record.refuse_unknown(RESULTS, OTHER)
    for more, fewer in ((BEFORE, BEFORE | {"new": None}), (BEFORE | {"new": None}, BEFORE)):
        record.begin(Path("others"), more, touched=False)
        with pytest.raises(ValueError, match=r"results of another configuration \(new\), and --t"):
            record.begin(Path("others"), fewer, touched=True)
        shutil.rmtree("others")
    monkeypatch.setattr(record, "digest", lambda step: f"of another {step}")
    with pytest.raises(ValueError, match=r"results of another code \(compile, mask, simulate, "):
        record.refuse_unknown(RESULTS, BEFORE)


def test_all_configurations_of_a_folder_count():
    record.begin(RESULTS, OTHER, touched=False)
    shutil.rmtree(".snakemake")
    with pytest.raises(ValueError, match="another configuration"):
        record.refuse_unknown(RESULTS, OTHER)


def test_the_last_configuration_is_the_present_one():
    for configuration in (OTHER, BEFORE):
        record.begin(RESULTS, configuration, touched=False)
        made = record.read(RESULTS)["made"]
        assert made[-1]["configuration"] == configuration
    assert len(made) == 2


def test_files_are_checked_with_the_constants_of_the_last_configuration():
    constants = {"integrator": "leapfrog", "sample_interval": 2e-7, "material": {}}
    for configuration in (BEFORE, OTHER):
        record.begin(RESULTS, configuration | constants, touched=False)
        assert audit._constants(RESULTS)["step"] == configuration["step"]


def test_batches_of_another_size_are_refused():
    with pytest.raises(ValueError, match=r"^realisations_per_job must remain 2, "):
        record.refuse_unknown(RESULTS, BEFORE | {"realisations_per_job": 3})


def test_results_without_their_record_or_with_half_of_it_are_refused():
    file = RESULTS / record.RECORD
    file.write_text(file.read_text()[:20])
    with pytest.raises(ValueError, match=r"study\.json is damaged; remove results"):
        record.refuse_unknown(RESULTS, BEFORE)
    file.unlink()
    with pytest.raises(ValueError, match=r"results holds results without study\.json"):
        record.refuse_unknown(RESULTS, BEFORE)
