"""Runs of different studies are refused in whatever way a command reads several."""

import pyarrow.parquet as pq
import pytest

FASTER = ("--material", "slider_velocity=1e-3")
OUTPUT = ("--output", "{here}/a.png")
TABLE = ("--output", "{here}/a")
#: A command for each way to read files, here of two studies, 0 and 1.
COMMANDS = {
    "aggregate": ("aggregate", "{batch0}", "{batch1}", *TABLE),
    "collect": ("make", "collect", "{c0}", "{c1}", "--output", "{here}/a"),
    "figure_6": ("figure", "figure_6", "{batch0}", "{batch1}", *OUTPUT),
    "figure_7": ("figure", "figure_7", "{c0}", "{l1}", "--n-p", "6", *OUTPUT),
    "claims, table": ("claims", "{batch0}", "--correlation", "{c1}", *TABLE),
    "claims, tables": (
        *("claims", "{batch0}", "--correlation", "{c0}", "--correlation-length", "{l1}"),
        *TABLE,
    ),
}
PILLARS = ("--n-blocks", 12, "--n-p", 6, "--n-s", 6)


@pytest.fixture(scope="module")
def studies(springblock, tmp_path_factory):
    """Files of two studies that differ in one constant: batches and tables."""
    folder, files = tmp_path_factory.mktemp("studies"), {}
    for i, other in enumerate(((), FASTER)):
        files |= {name + str(i): folder / f"{name}{i}" for name in ("batch", "c", "l")}
        batch, seeds = files[f"batch{i}"], ("--first-seed", 3 * i, "--last-seed", 3 * i + 2)
        springblock("simulate", *PILLARS, *other, *seeds, "--output", batch)
        outputs = ("--output-correlation", files[f"c{i}"], "--output-length", files[f"l{i}"])
        springblock("correlation", batch, *outputs)
    return files


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_a_mixture_is_refused(springblock, studies, command, tmp_path):
    words = [str(word).format(here=tmp_path, **studies) for word in command]
    refusal = springblock(*words, refused=True)
    assert "slider_velocity is 0.0005 in" in refusal
    assert "and 0.001 in" in refusal
    assert list(tmp_path.iterdir()) == []


def test_scenes_with_constants_of_their_own_belong_together(springblock, studies, tmp_path):
    """They say themselves in what they differ."""
    own, table = tmp_path / "own", tmp_path / "table"
    varied = ("--vary", "slider_velocity=1e-3", "--last-seed", 2)
    springblock("simulate", *PILLARS, *varied, "--output", own)
    springblock("aggregate", studies["batch0"], own, "--output", table)
    assert pq.read_table(table).num_rows == 6
