"""springblock info, dictionary, and verify of two files."""

import os

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from springblock.analysis.comparison import differences
from springblock.io.parquet import write
from springblock.plotting.figures import FIGURES

CONFIGURATION = ("--configuration", "0123")
OUTPUT = ("--output", "{here}/a")


def test_info_says_what_a_batch_holds_and_what_made_it(springblock, batch):
    said = springblock("info", batch(0, 2))
    assert "3 rows" in said
    assert "code_version: " in said
    assert any(line.split()[:3] == ["t_max", "double", "s"] for line in said.splitlines())


@pytest.mark.parametrize(
    "words",
    [
        ("info", "{file}"),
        ("claims", "{batch}", "--correlation", "{file}", *CONFIGURATION, *OUTPUT),
    ],
    ids=lambda words: words[0],
)
def test_what_is_no_table_is_refused(springblock, batch, tmp_path, words):
    (text := tmp_path / "text").write_text("text")
    words = [word.format(file=text, here=tmp_path, batch=batch(0, 2)) for word in words]
    assert "Parquet" in springblock(*words, refused=True)
    assert list(tmp_path.iterdir()) == [text]


TABLES = [(name, each.tables) for name, each in FIGURES.items() if each.draws == "tables"]
CLAIMED = ("correlation", "correlation-length", "work-precision")


@pytest.mark.parametrize(
    "words",
    [
        *(("figure", name, "{file}", "--output", "{here}/a.png") for name, _ in TABLES),
        *(
            ("claims", "{batch}", f"--{name}", "{file}", *CONFIGURATION, *OUTPUT)
            for name in CLAIMED
        ),
        ("make", "accuracy", *["{file}"] * 4, "--output", "{here}/a.md"),
        ("make", "mechanism", *["{file}"] * 3, "--output", "{here}/a.md"),
        ("plot", "{file}", "--output", "{here}/a.png"),
        ("animate", "{file}", "--output", "{here}/a.gif"),
        ("table", "{file}"),
        ("compare", "{batch}", "{file}"),
        ("aggregate", "{file}", *CONFIGURATION, "--output", "{here}/a"),
    ],
    ids=" ".join,
)
def test_a_table_of_another_kind_is_refused_by_name(springblock, batch, tmp_path, words):
    write(pa.table({"a": [1.0]}), tmp_path / "table", {"code_version": "1.0.0+0123"})
    words = [w.format(file=tmp_path / "table", here=tmp_path, batch=batch(0, 2)) for w in words]
    said = springblock(*words, refused=True)
    assert said.startswith(f"Error: {tmp_path / 'table'} lacks the column ")
    assert not list(tmp_path.glob("a*"))


@pytest.mark.parametrize(("name", "tables"), TABLES)
def test_a_figure_takes_its_tables_alone(springblock, batch, tmp_path, name, tables):
    files = [batch(0, 2)] * (len(tables) + 1)
    said = springblock("figure", name, *files, "--output", tmp_path / "a.png", refused=True)
    assert said == f"Error: {len(files)} files given; give {', '.join(tables)}"


def changed(file, to, **columns):
    """Write a table with some cells changed, its rows in the other order."""
    table = pq.read_table(file, partitioning=None)
    for name, values in columns.items():
        at = table.column_names.index(name)
        table = table.set_column(
            at, table.schema.field(at), pa.array(values, table.schema.types[at])
        )
    write(table.take(list(range(table.num_rows))[::-1]), to, {})
    return to


def test_a_difference_is_named_with_its_size(springblock, batch, tmp_path):
    t_max = pq.read_table(batch(0, 2), partitioning=None)["t_max"].to_pylist()
    other = changed(batch(0, 2), tmp_path / "b", t_max=[t_max[0], 1.5 * t_max[1], t_max[2]])
    said = springblock("verify", batch(0, 2), other, refused=True)
    assert f"t_max: 1 row differs, by {0.5 * t_max[1]:.3g} at most, or 0.5 of the first" in said


def test_curves_of_other_lengths_and_missing_rows_are_differences(batch, tmp_path):
    table = pq.read_table(batch(0, 2), partitioning=None)
    short = [force[:5] for force in table["force"].to_pylist()]
    other = pq.read_table(changed(batch(0, 2), tmp_path / "b", force=short))
    rows, force = differences(table, other.slice(0, 2))
    assert rows == "2 rows in both, 1 only in the first"
    assert force.startswith("  force: 2 rows differ")


def test_tables_of_other_columns_or_rows_are_not_the_same(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 2), partitioning=None)
    write(table.drop_columns(["t_avg"]), tmp_path / "b", {})
    assert "t_avg" in springblock("verify", batch(0, 2), tmp_path / "b", refused=True)
    said = springblock("verify", batch(0, 2), batch(3, 3), refused=True)
    assert said.endswith(": no rows in both, 3 only in the first, 1 only in the second")


def test_equal_tables_are_the_same_in_any_order_of_their_rows(springblock, batch, tmp_path):
    other = changed(batch(0, 2), tmp_path / "b.parquet")
    assert "the same 3 rows, to the bit" in springblock("verify", batch(0, 2), other)
    assert "give a second file" in springblock("verify", other, refused=True)


@pytest.mark.parametrize("kind", ["fifo", "link", "link to nothing", "device"])
def test_nothing_but_a_regular_file_is_replaced(springblock, tmp_path, kind):
    """As root, renaming a file to a device would take it from all programs."""
    (tmp_path / "table").write_text("theirs")
    output = tmp_path / "output"
    if kind == "fifo":
        os.mkfifo(output)
    elif kind == "device":
        output = "/dev/null"
    else:
        output.symlink_to(tmp_path / ("table" if kind == "link" else "absent"))
    before = os.lstat(output)
    refusal = springblock("dictionary", "--output", output, refused=True)
    assert "exists and is not a regular file" in refusal
    assert os.lstat(output) == before
    assert (tmp_path / "table").read_text() == "theirs"


#: For each command that writes, words that it would take, and names of other types of files.
OF_OTHER_TYPES = {
    ("mask", __file__): "area.png",
    ("simulate", "--n-blocks", 4): "run.csv",
    ("prelude", "--n-blocks", 4): "run.parquet",
    ("aggregate", __file__, *CONFIGURATION): "all.npy",
    ("make", "stability"): "page.md",
    ("make", "collect", __file__): "table.csv",
    ("make", "mechanism", *[__file__] * 3): "page.parquet",
    ("make", "sensitivities", __file__): "page.md",
    ("report", __file__): "report.pdf",
    ("dictionary",): "tables.parquet",
    ("figure", "figure_1"): "figure.jpg",
    ("show", "--n-blocks", 4): "surface",
    ("plot", __file__): "run.parquet",
    ("animate", __file__): "run.png",
    ("archive", "."): "study.tar",
    ("table", __file__): "means.md",
}


@pytest.mark.parametrize(("words", "name"), OF_OTHER_TYPES.items())
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
    same = ("--output", "a.png", "--output", "a.png")
    for words in (("plot", batch(0, 0)), ("figure", "figure_1")):
        assert "given twice" in springblock(*words, *same, refused=True)
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_no_folder_to_write_to(springblock, tmp_path):
    (tmp_path / "file").touch()
    refusal = springblock("dictionary", "--output", tmp_path / "file/deep/table", refused=True)
    assert f"cannot be written, because {tmp_path / 'file'} is not a folder" in refusal
