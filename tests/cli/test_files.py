"""Files that commands take and write, and springblock compare of two files."""

import os
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from springblock.io.parquet import write
from springblock.study.results import FIGURES

TABLES = [(name, each.tables) for name, each in FIGURES.items() if each.draws == "tables"]


@pytest.mark.parametrize(
    "words",
    [
        *(("figure", name, *["table"] * len(of), "--output", "a.png") for name, of in TABLES),
        ("make", "claims", "table", "--output", "a.md"),
        ("plot", "table", "--output", "a.png"),
        ("animate", "table", "--output", "a.gif"),
        ("table", "table"),
        ("aggregate", "table", "--output", "a"),
    ],
    ids=" ".join,
)
def test_a_table_of_another_kind_is_refused_by_name(springblock, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    write(pa.table({"a": [1.0]}), Path("table"), {"code_version": "1.0.0+0123"})
    said = springblock(*words, refused=True)
    assert said.startswith("Error: table lacks the column ")
    assert not list(tmp_path.glob("a*"))


def test_a_figure_takes_its_tables_alone(springblock, batch, tmp_path):
    name, tables = TABLES[0]
    files = [batch(0, 2)] * (len(tables) + 1)
    said = springblock("figure", name, *files, "--output", tmp_path / "a.png", refused=True)
    assert said == f"Error: {len(files)} files given; give {', '.join(tables)}"


def test_two_files_are_the_same_in_any_order_of_their_rows(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 2), partitioning=None)
    write(table.take([2, 1, 0]), tmp_path / "b.parquet", {})
    assert "the same 3 rows" in springblock("compare", batch(0, 2), tmp_path / "b.parquet")
    said = springblock("compare", batch(0, 2), batch(3, 3))
    assert said.startswith("no rows in both, 3 only in the first, 1 only in the second")
    assert "Second minus first:" in said


def test_nothing_but_a_regular_file_is_replaced(springblock, tmp_path):
    """As root, renaming a file to a device would take it from all programs."""
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "link").symlink_to(tmp_path / "absent")
    for output in (tmp_path / "fifo", tmp_path / "link", Path("/dev/null")):
        before = output.lstat()
        refusal = springblock("prelude", "--n-blocks", 4, "--output", output, refused=True)
        assert "exists and is not a regular file" in refusal
        assert output.lstat() == before


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (("mask", __file__), "area.png"),
        (("simulate", "--n-blocks", 4), "run.csv"),
        (("make", "stability"), "page.md"),
        (("make", "applicability", *[__file__] * 3), "page.parquet"),
        (("report", __file__), "report.pdf"),
        (("figure", "figure_1"), "figure.jpg"),
        (("animate", __file__), "run.png"),
        (("table", __file__), "means.md"),
    ],
)
def test_a_name_of_another_type_of_file_is_refused_before_anything_is_read(
    springblock, tmp_path, words, name
):
    said = springblock(*words, "--output", tmp_path / name, refused=True)
    assert f"{name}: choose a name that ends in ." in said
    assert list(tmp_path.iterdir()) == []


def test_two_outputs_are_two_files(springblock, batch, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = ("--output-correlation", "a.parquet", "--output-length", tmp_path / "a.parquet")
    said = springblock("correlation", batch(0, 2), *names, refused=True)
    assert said.endswith("a.parquet; choose two files")
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_no_folder_to_write_to(springblock, tmp_path):
    (tmp_path / "file").touch()
    words = ("prelude", "--n-blocks", 4, "--output", tmp_path / "file/deep/prelude")
    refusal = springblock(*words, refused=True)
    assert f"cannot be written, because {tmp_path / 'file'} is not a folder" in refusal


def test_no_pickled_object_is_loaded_from_a_prelude(springblock, tmp_path):
    class Trap:
        def __reduce__(self):
            return os.mkdir, (str(tmp_path / "sprung"),)

    texts = {"conditions": "", "code_version": ""}
    np.savez(tmp_path / "trap.npz", fields=np.array([Trap()]), **texts)
    words = ("--n-blocks", 4, "--prelude", tmp_path / "trap.npz", "--output", tmp_path / "a")
    assert "trap.npz is not a prelude" in springblock("simulate", *words, refused=True)
    assert not (tmp_path / "sprung").exists()
