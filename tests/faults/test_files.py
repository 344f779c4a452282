"""Files that are damaged, foreign or outdated: noticed before a number of them is used."""

import json
from functools import partial

import pytest
from click.testing import CliRunner

from faults.damages import (
    BATCH,
    CORRELATION,
    FLAT,
    OTHER,
    PRELUDE,
    TABLE,
    added,
    flipped,
    of_another,
    of_another_configuration,
    of_older_code,
    replaced,
    truncated,
)
from specimens import uniform
from springblock import simulate
from springblock.cli import main
from springblock.files import read_sealed
from springblock.provenance import code_version
from springblock.study import record
from springblock.study.audit import faults

NEXT = BATCH.replace("batch-0", "batch-1")
#: What is done to which file, and words of the sentence about it.
FAULTS = {
    "truncated batch": (BATCH, truncated, "has no checksum"),
    "flipped bit in a batch": (BATCH, flipped, "its checksum does not match"),
    "batch of older code": (BATCH, of_older_code, "was made by different code"),
    "batch of another material": (BATCH, partial(of_another, gamma=4e3), "gamma is 4000.0 in"),
    "batch of another duration": (BATCH, partial(of_another, duration=1e-5), "duration is 1e-05"),
    "batch with snapshots": (BATCH, partial(of_another, snapshot_times=[1e-5]), "snapshot_times"),
    "batch of other seeds": (BATCH, partial(replaced, by=NEXT), "must hold the seeds 0 to 1"),
    "batch of another scene": (BATCH, partial(replaced, by=OTHER), "level is 1 in"),
    "truncated prelude": (PRELUDE, truncated, "is not a prelude, or damaged"),
    "flipped bit in a prelude": (PRELUDE, flipped, "is not a prelude, or damaged"),
    "table in place of a prelude": (PRELUDE, partial(replaced, by=TABLE), "is not a prelude"),
    "prelude of older code": (PRELUDE, of_older_code, "was made by different code"),
    "flipped bit in a table": (TABLE, flipped, "its checksum does not match"),
}
#: Files that are whole, each in a place where the configuration of the study needs none or another.
FOREIGN = {
    "table of another configuration": (TABLE, of_another_configuration),
    "prelude of another material": (PRELUDE, of_another_configuration),
    "correlations of other runs": (CORRELATION, of_another_configuration),
    "batch of more seeds": (f"realisations/{FLAT}/batch-2.parquet", added),
    "batch of an earlier scene": ("realisations/n_blocks-24/direction-x/batch-0.parquet", added),
    "figure of an earlier sweep": ("figures/sweep_old.pdf", added),
    "remainder of a killed job": (f"realisations/{FLAT}/.batch-0.parquet.{32 * 'a'}", added),
    "remainder of a killed page": (f".report.html.{32 * '0'}", added),
}
#: Commands that read such a file, together with others of its study.
READERS = {
    BATCH: ("aggregate", "{results}/{other}", "{file}", "--configuration", "0"),
    PRELUDE: (
        *("simulate", "--n-blocks", "12", "--material", "slider_velocity=5e-3"),
        *("--prelude", "{file}"),
    ),
    TABLE: ("figure", "stability", "{file}"),
}


def refused(*words):
    """Lines of a command that fails."""
    outcome = CliRunner().invoke(main, [str(word) for word in words])
    assert outcome.exit_code == 1
    return outcome.output.splitlines()


@pytest.mark.parametrize("fault", FAULTS)
def test_a_bad_file_is_refused_by_name_and_set_aside(study, springblock, tmp_path, fault):
    place, damage, sentence = FAULTS[fault]
    file = study.results / place
    damage(file, study.results)
    (found,) = faults(study.results)
    assert found.file == file
    assert str(file) in found.reason
    assert sentence in found.reason
    assert "`snakemake repair`" in found.reason
    words = [w.format(file=file, results=study.results, other=OTHER) for w in READERS[place]]
    name = "a.png" if place == TABLE else "a.parquet"
    said = springblock(*words, "--output", tmp_path / name, refused=True)
    assert said.startswith("Error: ")
    assert str(file) in said
    assert not list(tmp_path.glob("a*"))
    content = file.read_bytes()
    said = springblock("repair", study.results)
    assert said.splitlines()[0] == found.reason
    assert not file.exists()
    assert (study.results / "set-aside" / place).read_bytes() == content
    assert not list(faults(study.results))


@pytest.mark.parametrize("fault", FOREIGN)
def test_what_the_study_does_not_need_is_named_and_set_aside(study, springblock, fault):
    place, damage = FOREIGN[fault]
    file = study.results / place
    damage(file, study.results)
    (found,) = faults(study.results)
    assert found.file == file
    assert found.reason.startswith(f"{file} ")
    content = file.read_bytes()
    assert found.reason in springblock("repair", study.results).splitlines()
    assert (study.results / "set-aside" / place).read_bytes() == content
    assert not list(faults(study.results))


@pytest.mark.parametrize("place", [f"realisations/{FLAT}/._batch-0.parquet", "notes.txt"])
def test_notes_and_files_of_other_systems_are_left_alone(study, place):
    (study.results / place).write_text("mine")
    assert not list(faults(study.results))


def test_a_missing_file_is_named(study):
    """The study ran without its figures; each file has a sentence."""
    (study.results / BATCH).unlink()
    said = refused("verify", study.results)
    assert f"{study.results / BATCH} is missing; `snakemake` makes it" in said
    assert f"{study.results}/report.html is missing; `snakemake` makes it" in said


def test_tables_of_either_study_alone_are_named(study, tmp_path):
    other = study.copied(tmp_path / "other")
    (study.results / TABLE).unlink()
    (other.results / "tables/correlation.parquet").unlink()
    said = refused("verify", study.results, other.results)
    assert f"{TABLE}: missing in the first" in said
    assert "tables/correlation.parquet: missing in the second" in said
    assert "tables/correlation_length.parquet: the same 2 rows, to the bit" in said


def test_a_file_that_is_set_aside_again_replaces_no_other(study, springblock):
    aside = study.results / "set-aside" / TABLE
    for content in (b"once", b"twice", b"thrice"):
        (study.results / TABLE).write_bytes(content)
        springblock("repair", study.results)
    assert aside.read_bytes() == b"once"
    assert aside.with_name(f"{aside.name}.again").read_bytes() == b"twice"
    assert aside.with_name(f"{aside.name}.again.again").read_bytes() == b"thrice"


def test_every_file_of_numbers_is_checked(study):
    kinds = ("parquet", "npz", "nc", "npy")
    files = {file for kind in kinds for file in study.results.rglob(f"*.{kind}")}
    for file in files:
        file.write_bytes(b"")
    assert {fault.file for fault in faults(study.results)} == files
    assert len({file.parent for file in files}) > 3


def test_bad_fields_are_found(tmp_path, monkeypatch):
    """Fields of other runs or code, or cut short."""
    monkeypatch.chdir(tmp_path)
    fields = simulate(uniform(2, 1.0, 0.6), duration=1e-6, snapshot_times=[1e-6]).fields
    names = ("current", "older", "short", "foreign")
    files = {name: tmp_path / f"fields/{name}.nc" for name in names}
    for name, file in files.items():
        version = "1.0.0+0123" if name == "older" else code_version("simulate")
        identity = json.dumps({"duration": 2e-6 if name == "foreign" else 1e-6})
        file.parent.mkdir(exist_ok=True)
        about = {"source": f"springblock {version}", "identity": identity}
        fields.to_xarray().assign_attrs(about).to_netcdf(file, engine="scipy")
    truncated(files["short"], tmp_path)
    needed = [str(file.relative_to(tmp_path)) for file in files.values()]
    ensembles = {name: {"identity": {"duration": 1e-6}} for name in names}
    contents = {"ensembles": ensembles, "files": needed, "spare": []}
    record.begin(tmp_path, {"realisations_per_job": 1}, contents)
    found = {fault.file: fault.reason for fault in faults(tmp_path)}
    assert found.keys() == {files["older"], files["short"], files["foreign"]}
    assert "was made by different code, springblock 1.0.0+0123" in found[files["older"]]
    assert "was made with another configuration" in found[files["foreign"]]


def test_a_batch_with_a_seed_missing_is_not_aggregated(study, springblock, tmp_path):
    words = ("aggregate", study.results / BATCH, "--configuration", "0", "--realisations", "3")
    said = springblock(*words, "--output", tmp_path / "a", refused=True)
    assert said == "Error: 2 realisations in the batches; expected 3"


def test_each_flipped_bit_of_a_batch_is_noticed(study, rng):
    """Also in the footer, which Parquet's own checksums leave out."""
    file = study.results / BATCH
    content = file.read_bytes()
    seal = content.rindex(b"springblock-sha256")
    for place in (0, seal, len(content) - 1, *rng.integers(len(content), size=300)):
        changed = bytearray(content)
        changed[place] ^= 1 << int(rng.integers(8))
        file.write_bytes(changed)
        with pytest.raises(ValueError, match=r"damaged|checksum"):
            read_sealed(file)
