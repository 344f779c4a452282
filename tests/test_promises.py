"""The promises of docs/scaling.md, each provoked in a small study."""

import re
import shutil
import signal
import time
from dataclasses import replace
from io import BytesIO

import psutil
import pyarrow.parquet as pq
import pytest

from springblock.provenance import PLAN, SIMULATE, planned
from studies import FEWER, Study

TARGETS = ("simulate", "aggregate", "correlations", "figure_6")


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> Study:
    """A finished study on one core, which no test changes."""
    begun = Study.begun(tmp_path_factory.mktemp("undisturbed"), **FEWER)
    begun.run("--cores", "1", targets=TARGETS)
    return replace(begun, options=("--cores", "1"), targets=TARGETS)


@pytest.fixture
def study(undisturbed, tmp_path) -> Study:
    """A finished study, to be disturbed."""
    return undisturbed.copied(tmp_path / "study")


@pytest.fixture(scope="module")
def both(undisturbed, tmp_path_factory) -> Study:
    """The same, run with another damping afterwards; it has the realisations of both."""
    study = undisturbed.copied(tmp_path_factory.mktemp("both") / "study")
    study.configure(material={"slider_velocity": 5e-3, "gamma": 4e3})
    study.run()
    return study


def batch(study, scene="flat-x"):
    """The first batch of a scene."""
    return min(study.results.glob(f"realisations/{scene}-*/*.parquet"))


def pictures(study):
    return {file.name: file.read_bytes() for file in study.results.glob("figures/*.png")}


@pytest.mark.parametrize("blinded", [False, True])
def test_constants_that_change_and_change_back_give_the_first_tables(
    undisturbed, both, tmp_path, blinded
):
    """No simulation runs the second time; tables are those of its constants, and so are pictures
    unless Snakemake is kept from seeing the change in all ways at once.
    """
    study = both.copied(tmp_path / "study")
    assert study.numbers() != undisturbed.numbers()
    study.configure(material=undisturbed.configuration["material"])
    if blinded:
        study.run("--touch")
        shutil.rmtree(study / ".snakemake")
    said = study.run(*(("--rerun-triggers", "mtime") if blinded else ()))
    assert not re.findall(r"rule (prelude|simulate_batch)", said)
    assert study.numbers() == undisturbed.numbers()
    if not blinded:
        assert pictures(study) == pictures(undisturbed)
        assert study.planned() == {}


def test_a_batch_is_read_only_under_its_own_name(study, springblock, tmp_path):
    """Neither one of other constants, nor one of other seeds."""
    first, last = sorted(batch(study).parent.glob("*.parquet"))
    for other, seeds in ((last, "2 to 2"), (batch(study, "pillars-6-6-x"), "0 to 1")):
        shutil.copy(other, first)
        said = springblock("aggregate", first, "--output", tmp_path / "a", refused=True)
        assert re.search(rf"0-1.parquet holds seeds {seeds} of \w+, not those of its name", said)


def jobs(study):
    """Processes that simulate in the folder of a study."""
    here = str(study.folder.resolve())
    found = psutil.process_iter(["cwd", "cmdline"])
    words = {p: " ".join(p.info["cmdline"] or ()) for p in found if p.info["cwd"] == here}
    return [p for p, line in words.items() if re.search(r"springblock simulate ", line)]


def until(condition, seconds=300.0):
    """Wait for something to happen."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it never happened"
        time.sleep(0.02)


def test_the_same_command_resumes_after_a_job_and_after_the_whole_run_is_killed(study, undisturbed):
    batch(study).unlink()
    run = study.start()
    until(lambda: jobs(study))
    for job in jobs(study):
        job.kill()
    said, _ = run.communicate()
    assert run.returncode != 0
    assert "simulate_batch" in said
    run = study.start()
    until(lambda: jobs(study))
    psutil.Process(run.pid).send_signal(signal.SIGKILL)
    assert "--unlock" in study.run(refused=True)
    study.run("--unlock")
    study.run()  # beside the job that has outlived its run, which writes the same file
    run.communicate()
    until(lambda: not jobs(study))
    assert study.numbers() == undisturbed.numbers()


def test_missing_files_are_made_again(study):
    files = "realisations/flat-*/2-2", "tables/correlation_length", "figures/figure_6"
    for name in files:
        next(study.results.glob(f"{name}.p*")).unlink()
    assert study.planned().keys() >= {"simulate_batch", "correlations", "figure_6"}


def truncated(content):
    return content[: len(content) // 2]


def flipped(content):
    """Change a bit of an array, or of the largest column of a table."""
    place = len(content) // 2
    if content.startswith(b"PAR1"):
        group = pq.read_metadata(BytesIO(content)).row_group(0)
        columns = [group.column(i) for i in range(group.num_columns)]
        largest = max(columns, key=lambda each: each.total_compressed_size)
        place = largest.data_page_offset + largest.total_compressed_size // 2
    return content[:place] + bytes([content[place] ^ 4]) + content[place + 1 :]


@pytest.mark.parametrize("damage", [truncated, flipped, lambda content: b""])
@pytest.mark.parametrize("pattern", ["realisations/flat-*/0-1.parquet", "preludes/flat-*.npz"])
def test_a_damaged_file_is_refused_by_name(study, springblock, tmp_path, pattern, damage):
    (file,) = study.results.glob(pattern)
    file.write_bytes(damage(file.read_bytes()))
    simulate = ("simulate", "--n-blocks", 12, "--slider-velocity", "5e-3", "--prelude")
    output = ("--output", tmp_path / "a.parquet")
    words = (*simulate, file, *output) if file.suffix == ".npz" else ("info", file)
    said = springblock(*words, refused=True)
    assert said.startswith(f"Error: {file} is ")
    assert said.endswith("delete it, and `snakemake` makes it again")
    assert not list(tmp_path.glob("a.*"))


def test_an_edit_of_the_solver_stops_a_running_study(study):
    """What was planned with the former code is not written; then all is simulated with the new."""
    study.edit("simulation/run.py")  # a comment, in a package of the study's own
    assert study.planned() == {}
    before = {*study.results.glob("realisations/*/*")}
    study.configure(material={"slider_velocity": 5e-3, "gamma": 3e3})
    run = study.start()
    until(lambda: jobs(study))
    study.edit("solver/springs.py", "0.5 * (nex", "0.4 * (nex")
    said, _ = run.communicate()
    assert run.returncode != 0
    assert "the code changed while the study ran" in said
    study.run()
    made = {*study.results.glob("realisations/*/*")} - before
    assert len(made) == 5
    assert len({pq.read_schema(file).metadata[b"code_version"] for file in made}) == 1


def test_a_growing_study_has_each_seed_once(study):
    """It had three, in batches of two: the last batch alone is another file."""
    study.configure(scenes=FEWER["scenes"] | {"flat": {"seeds": 5, "duration": 2e-5}})
    said = study.run(targets=("aggregate",))
    assert len(re.findall("rule simulate_batch", said)) == 2
    found = pq.read_table(study.results / "tables/realisations.parquet").to_pylist()
    assert [row["seed"] for row in found if not row["level"]] == [0, 1, 2, 3, 4]


def test_tables_of_another_configuration_are_refused_by_name(
    study, springblock, tmp_path, monkeypatch
):
    table = study.results / "tables/realisations.parquet"
    monkeypatch.setenv(PLAN, planned("0123", [SIMULATE]))
    words = "make", "applicability", *[table] * 3, "--output", tmp_path / "a.md"
    assert f"{table} is of another configuration" in springblock(*words, refused=True)
