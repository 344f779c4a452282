"""Files that are damaged, foreign or outdated: noticed before a number of them is used."""

import io
import re

import numpy as np
import pyarrow.parquet as pq
import pytest

from faults.damages import (
    BATCH,
    CORRELATION,
    OTHER,
    OTHER_PRELUDE,
    PILLARS,
    PRELUDE,
    TABLE,
    emptied,
    flipped,
    old,
    older_code,
    outdated,
    replaced,
    seed_missing,
    text,
    truncated,
    unsealed,
    with_constant,
)
from springblock.files import BLANK, read_sealed, write_sealed
from springblock.model.blockmap import BlockMap
from springblock.study.audit import faults

#: What is done to which file, and words of the sentence about it.
FAULTS = {
    "truncated batch": (BATCH, truncated, "has no checksum"),
    "truncated batch, old time stamp": (BATCH, old(truncated), "has no checksum"),
    "emptied batch": (BATCH, emptied, "is empty"),
    "flipped bit in a batch": (BATCH, flipped, "does not fit its checksum"),
    "flipped bit, old time stamp": (BATCH, old(flipped), "does not fit its checksum"),
    "batch that is no Parquet": (BATCH, text, "no whole table (Parquet)"),
    "batch without a checksum": (BATCH, unsealed, "has no checksum"),
    "batch of another scene": (BATCH, replaced(OTHER), f"belongs in {PILLARS}"),
    "batch without one of its seeds": (BATCH, seed_missing, "does not hold the seeds 0 to 1"),
    "batch of another material": (
        BATCH,
        with_constant("material", ('"gamma": 5000.0', '"gamma": 4000.0')),
        "gamma is 4000.0 in",
    ),
    "batch of another step": (
        BATCH,
        with_constant("step", ('"step": 2e-08', '"step": 1e-08')),
        "step is 1e-08 in",
    ),
    "batch of another duration": (
        BATCH,
        with_constant("duration", ('"duration": 2e-05', '"duration": 1e-05')),
        "duration is 1e-05 in",
    ),
    "batch of older code": (BATCH, older_code, "was made by other code"),
    "truncated prelude": (PRELUDE, truncated, "has no checksum"),
    "emptied prelude": (PRELUDE, emptied, "is empty"),
    "flipped bit in a prelude": (PRELUDE, flipped, "does not fit its checksum"),
    "prelude of another scene": (PRELUDE, replaced(OTHER_PRELUDE), "belongs in n_blocks-12"),
    "table in place of a prelude": (PRELUDE, replaced(TABLE), "is no prelude"),
    "prelude of older code": (PRELUDE, older_code, "was made by other code"),
    "truncated table": (TABLE, truncated, "has no checksum"),
    "flipped bit in a table": (TABLE, old(flipped), "does not fit its checksum"),
    "prelude in place of a table": (TABLE, replaced(PRELUDE), "is no table"),
    "table of older code": (TABLE, older_code, "was made by other code"),
    "outdated table, new time stamp": (TABLE, outdated, "was computed from another"),
    "outdated table, old time stamp": (TABLE, old(outdated), "was computed from another"),
    "flipped bit in a correlation": (CORRELATION, flipped, "does not fit its checksum"),
}
#: Commands that read such a file.
READERS = {
    BATCH: ("aggregate", "{file}", "--configuration", "0", "--output", "{here}/a"),
    PRELUDE: (
        *("simulate", "--n-blocks", "12", "--material", "slider_velocity=5e-3"),
        *("--prelude", "{file}", "--output", "{here}/a"),
    ),
    TABLE: ("figure", "stability", "{file}", "--output", "{here}/a.png"),
    CORRELATION: ("collect", "{file}", "--output", "{here}/a"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_bad_file_is_named_and_set_aside(study, springblock, tmp_path, fault):
    place, damage, sentence = FAULTS[fault]
    file = study.results / place
    damage(file, study)
    found, *derived = faults(study.results)
    assert all("was computed from" in each.reason for each in derived)
    assert found.file == file
    assert str(file) in found.reason
    assert sentence in found.reason
    assert "`snakemake repair`" in found.reason
    if "outdated" not in fault and "table of" not in fault:  # a table alone does not know that
        words = [word.format(file=file, here=tmp_path) for word in READERS[place]]
        status, said = springblock(*words)
        assert status == 1
        assert said.splitlines()[-1] == f"Error: {found.reason}"
        assert not list(tmp_path.glob("a*"))
    content = file.read_bytes()
    status, said = springblock("repair", study.results)
    assert said.splitlines()[:-1] == [each.reason for each in (found, *derived)]
    assert not any(each.file.exists() for each in (found, *derived))
    assert (study.results / "set-aside" / place).read_bytes() == content
    assert not list(faults(study.results))


def test_each_flipped_bit_of_a_batch_is_noticed(study, rng):
    """In every column, in the footer with what its columns say of themselves, and anywhere else."""
    file = study.results / BATCH
    content = file.read_bytes()
    metadata = pq.ParquetFile(file).metadata
    columns = [metadata.row_group(0).column(i) for i in range(metadata.num_columns)]
    starts = [each.dictionary_page_offset or each.data_page_offset for each in columns]
    sizes = [each.total_compressed_size for each in columns]
    places = [int(start + rng.integers(size)) for start, size in zip(starts, sizes, strict=True)]
    places += rng.integers(starts[-1] + sizes[-1], len(content), 500).tolist()
    places += [0, len(content) - 1, content.rindex(b"springblock-sha256"), *starts]
    places += rng.integers(len(content), size=500).tolist()
    for place in places:
        changed = bytearray(content)
        changed[place] ^= 1 << int(rng.integers(8))
        file.write_bytes(changed)
        with pytest.raises(ValueError, match=r"damaged|checksum"):
            read_sealed(file)


@pytest.mark.parametrize("place", [BATCH, PRELUDE, TABLE])
def test_each_truncation_is_noticed(study, rng, place):
    file = study.results / place
    content = file.read_bytes()
    for length in (*rng.integers(len(content), size=200), len(content) - 1):
        file.write_bytes(content[:length])
        with pytest.raises(ValueError, match=r"empty|damaged|checksum"):
            read_sealed(file)


def test_bytes_that_are_added_are_noticed(study):
    file = study.results / BATCH
    file.write_bytes(file.read_bytes() + b"\0")
    with pytest.raises(ValueError, match="damaged"):
        read_sealed(file)


@pytest.fixture
def mask(tmp_path):
    """A mask as a study cuts it from a topography: under the name of what it holds."""
    folder = tmp_path / "surfaces"
    contact = np.arange(64).reshape(8, 8) % 3 > 0
    np.save(tmp_path / "islands.npy", contact)
    name = BlockMap.mask(tmp_path / "islands.npy").name
    content = io.BytesIO()
    np.save(content, contact)
    write_sealed(folder / f"{name}.npy", content.getvalue() + BLANK)
    return folder / f"{name}.npy"


def test_a_damaged_mask_is_refused(mask, springblock, tmp_path):
    assert BlockMap.mask(mask).values.sum() == 42
    content = bytearray(mask.read_bytes())
    content[140] ^= 1
    mask.write_bytes(content)
    status, said = springblock("simulate", "--mask", mask, "--output", tmp_path / "a")
    assert status != 0
    assert "is damaged" in said
    (found,) = faults(tmp_path)
    assert found.file == mask


def test_a_mask_of_another_surface_is_refused(mask, springblock, tmp_path):
    other = mask.with_name("hills-0123abcd.npy")
    mask.rename(other)
    status, said = springblock("simulate", "--mask", other, "--output", tmp_path / "a")
    assert status != 0
    assert "holds another mask" in said
    (found,) = faults(tmp_path)
    assert found.file == other


def test_a_manifest_names_what_has_gone_or_changed_since(study, springblock):
    lock = ("--lock", study.folder / "environment.lock")
    assert springblock("verify", study.results, *lock) == (
        0,
        f"{study.results} is as its study has left it\n",
    )
    (study.results / CORRELATION).unlink()
    (study.folder / "environment.lock").write_text("numpy==0.1")
    status, said = springblock("verify", study.results, *lock)
    assert status == 1
    gone, other = said.splitlines()
    assert gone == f"{study.results / CORRELATION} is missing"
    assert re.fullmatch(r".*environment.lock was \w{16} and is \w{16}", other)


def test_a_damaged_manifest_is_named(study, springblock):
    (study.results / "manifest.json").write_text("{")
    status, said = springblock("verify", study.results)
    assert status == 1
    assert "manifest.json is damaged; remove it" in said
