"""Runs that are killed, disturbed or outdated: the next `snakemake` ends in the same tables."""

import ctypes
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

import psutil
import pyarrow.parquet as pq
import pytest

from faults.damages import BATCH, FLAT, OTHER, PRELUDE, TABLE, flipped, truncated
from faults.studies import ROOT, copy
from springblock.study.audit import faults


def begin(study, *options):
    """Have the realisations of the flat surface computed again, with what comes after."""
    without(study, BATCH, TABLE)
    return study.start(*options)


def without(study, *places):
    """Remove files."""
    for place in places:
        (study.results / place).unlink()


def until(condition, seconds=300.0):
    """Wait for something to happen."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it never happened"
        time.sleep(0.02)


def processes(study):
    """Processes that work in the folder of a study, by their command lines."""
    return {
        process.pid: " ".join(process.info["cmdline"] or ())
        for process in psutil.process_iter(["cwd", "cmdline"])
        if process.info["cwd"] == str(study.folder.resolve())
    }


def jobs(study):
    """Those that simulate."""
    return [
        number
        for number, words in processes(study).items()
        if "simulate" in words and "springblock" in words and "snakemake" not in words
    ]


def forget(study):
    """Lose what Snakemake remembers of a study."""
    shutil.rmtree(study.folder / ".snakemake")


def date_back(study, seconds=3600):
    """Set the clock back: what is there comes from the future."""
    for file in study.results.rglob("*"):
        later = file.stat().st_mtime_ns + seconds * 10**9
        os.utime(file, ns=(later, later), follow_symlinks=False)


def test_a_killed_job_is_done_again(study, undisturbed):
    run = begin(study)
    until(lambda: jobs(study))
    for number in jobs(study):
        os.kill(number, signal.SIGKILL)
    said, _ = run.communicate()
    assert run.returncode != 0
    assert "simulate_batch" in said
    assert not (study.results / BATCH).exists()
    study.run()
    assert study.tables == undisturbed.tables


def unlock(study):
    subprocess.run(study.command("--unlock"), cwd=study.folder, env=study.environment, check=True)


def test_a_killed_run_goes_on_once_it_is_unlocked(study, undisturbed):
    run = begin(study)
    until(lambda: jobs(study))
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    assert "--unlock" in study.run(refused=True)
    unlock(study)
    study.run()
    assert study.tables == undisturbed.tables


def test_a_job_that_outlives_its_run_does_no_harm(study, undisturbed):
    """Both write the same file, whole."""
    run = begin(study)
    until(lambda: jobs(study))
    os.kill(run.pid, signal.SIGKILL)
    unlock(study)
    study.run()
    run.communicate()
    until(lambda: not processes(study))
    assert study.tables == undisturbed.tables
    study.run()


def test_two_runs_in_one_folder_are_refused(study, undisturbed):
    run = begin(study)
    until(lambda: jobs(study))
    os.killpg(run.pid, signal.SIGSTOP)  # it takes its time
    said = study.run(refused=True)
    assert "locked" in said.lower()
    os.killpg(run.pid, signal.SIGCONT)
    run.communicate()
    assert run.returncode == 0
    assert study.tables == undisturbed.tables


def test_a_full_disk_stops_the_study_and_leaves_no_half_file(study, undisturbed):
    """Simulated: no file may grow beyond 2 kB, which no batch fits into."""

    def limited():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (2048, resource.RLIM_INFINITY))

    words = ("simulate", "--n-blocks", "12", "--material", "slider_velocity=5e-3")
    output = ("--prelude", study.results / PRELUDE, "--output", study.results / "a.parquet")
    done = subprocess.run(
        [sys.executable, "-m", "springblock", *words, *output],
        env=study.environment,
        preexec_fn=limited,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert re.search(r"^Error: .*File too large", done.stderr, re.MULTILINE)
    assert "Traceback" not in done.stderr
    assert not list(study.results.glob("*a.parquet*"))


def test_results_that_cannot_be_written_stop_the_study(study, undisturbed):
    """Without the right of root to write everywhere, if it is root who runs this."""

    def without_rights():
        if os.geteuid() == 0:
            for capability in (1, 2):  # DAC_OVERRIDE, DAC_READ_SEARCH
                ctypes.CDLL(None).prctl(24, capability, 0, 0, 0)

    if os.geteuid() == 0 and sys.platform != "linux":
        pytest.skip("root may write anywhere")
    folder = (study.results / BATCH).parent
    without(study, BATCH, TABLE)
    folder.chmod(0o555)
    said = study.run(refused=True, preexec_fn=without_rights)
    assert "ermission denied" in said
    assert "Traceback" not in said
    if folder.exists():  # Snakemake may have removed it, empty as it is
        folder.chmod(0o755)
    study.run()
    assert study.tables == undisturbed.tables


def test_a_missing_file_is_made_again(study, undisturbed):
    """With the tables that are made of it."""
    without(study, BATCH, PRELUDE, TABLE)
    study.run()
    assert study.tables == undisturbed.tables


@pytest.mark.parametrize("damages", ["damaged", "foreign"])
def test_what_was_set_aside_is_made_again(study, undisturbed, damages):
    if damages == "damaged":
        truncated(study.results / BATCH, study)
        flipped(study.results / PRELUDE, study)
    else:
        shutil.copy(study.results / OTHER, study.results / BATCH)
    said = study.run("--quiet", "host", targets=("repair",))
    assert "set aside in results/set-aside" in said
    study.run()
    assert study.tables == undisturbed.tables
    assert not list(faults(study.results))


def test_a_damaged_file_stops_the_study_with_one_sentence(study):
    flipped(study.results / BATCH, study)
    without(study, TABLE)
    said = study.run(refused=True)
    assert re.search(rf"{FLAT}/batch-0.parquet is damaged.*`snakemake repair`", said)
    assert "Traceback" not in said


def planned(study):
    """Rules that a dry run announces."""
    return set(study.planned())


def state(study):
    """Every file of a study's folder with its time and size, but for Snakemake's own."""
    return {
        file: (file.stat().st_mtime_ns, file.stat().st_size)
        for file in study.folder.rglob("*")
        if ".snakemake" not in file.parts and "__pycache__" not in file.parts
    }


@pytest.mark.parametrize("results", ["results", "elsewhere"])
def test_a_dry_run_writes_nothing(study, results):
    study.configure(results=results, step=1e-8)
    before = state(study)
    study.run("--dry-run")
    assert state(study) == before


def test_lost_memory_alone_changes_nothing(study):
    forget(study)
    assert planned(study) == set()
    study.run()
    assert planned(study) == set()


@pytest.mark.parametrize("times", ["as they were", "new", "from the future"])
def test_results_of_another_configuration_are_refused_without_memory(study, times):
    """Also after a run under the old one, which leaves Snakemake with a memory of nothing."""
    forget(study)
    if times == "new":
        for file in study.results.rglob("*"):
            file.touch()
    elif times == "from the future":
        date_back(study)
    study.configure(step=1e-8)
    for options in (["--dry-run"], [], ["--touch"]):
        said = study.run(*options, refused=True)
        assert "another configuration (step)" in said
        assert "Traceback" not in said
    study.configure()
    if times == "as they were":
        assert planned(study) == set()


def test_results_of_other_code_are_refused_without_memory(study):
    forget(study)
    study.edit("solver/friction.py", "0.0", "0.5")
    assert "another code (compile, simulate, accuracy)" in study.run("--dry-run", refused=True)


def test_touch_does_not_bless_results_of_another_configuration(study):
    study.configure(step=1e-8)
    assert "--touch does not compare them" in study.run("--touch", refused=True)
    assert {"prelude", "simulate_batch", "aggregate"} <= planned(study)


def test_results_without_their_record_are_refused(study):
    (study.results / "study.json").unlink()
    assert "without study.json" in study.run("--dry-run", refused=True)


def test_batches_of_another_size_are_refused(study):
    study.configure(realisations_per_job=3)
    said = study.run("--dry-run", refused=True)
    assert "realisations_per_job: results was made with 2" in said


def test_a_growing_study_has_each_seed_once(study):
    scenes = study.configuration["scenes"]
    for seeds in (3, 4, 5):
        study.configure(scenes=scenes | {"flat": {"seeds": seeds, "duration": 2e-5}})
        study.run()
    found = pq.read_table(study.results / f"realisations/{FLAT}")
    assert found["seed"].to_pylist() == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(
    "module", ["solver/springs.py", "simulation/run.py", "cli/simulate.py", "io/schemas.py"]
)
def test_a_comment_runs_nothing_again(study, module):
    study.edit(module)
    assert planned(study) == set()


@pytest.mark.parametrize(
    ("module", "old", "new", "again"),
    [
        ("solver/springs.py", "0.5 * (nex", "0.4 * (nex", {"compile", "prelude", "simulate_batch"}),
        (
            "analysis/correlation.py",
            "1000.0, 922",
            "1000.0, 900",
            {"correlation", "correlations_table"},
        ),
        ("plotting/style.py", "=", "=  ", set()),
    ],
)
def test_a_changed_formula_runs_again_what_depends_on_it(study, module, old, new, again):
    study.edit(module, old, new)
    assert again <= planned(study)
    if "simulate_batch" not in again:
        assert "simulate_batch" not in planned(study)


def test_a_clock_set_back_stops_the_study_until_time_stamps_are_mended(study, undisturbed):
    """By the command that the page has."""
    date_back(study)
    without(study, BATCH, TABLE)
    assert "has older modification time" in study.run(refused=True)
    text = (ROOT / "docs/reliability.md").read_text(encoding="utf-8")
    (command,) = re.findall(r"^ +(find .*)$", text, re.MULTILINE)
    subprocess.run(command, shell=True, cwd=study.folder, check=True)
    study.run()
    assert study.tables == undisturbed.tables


def test_an_interrupted_setup_is_done_again(tmp_path):
    """Its stamps are written last."""
    for name in ("Makefile", "environment.lock", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    (tmp_path / ".venv/bin").mkdir(parents=True)

    def steps():
        words = ["make", "--dry-run", "setup"]
        return subprocess.run(
            words, cwd=tmp_path, capture_output=True, text=True, check=True
        ).stdout

    assert "rm -rf .venv" in steps()
    (tmp_path / ".venv/locked").touch()
    assert "rm -rf .venv" not in steps()
    assert "--editable ." in steps()
    (tmp_path / ".venv/installed").touch()
    assert "Nothing to be done" in steps()


def test_a_copied_study_is_the_same_study(study, undisturbed, tmp_path):
    other = copy(study, tmp_path / "copy")
    assert planned(other) == set()
    assert other.tables == undisturbed.tables
