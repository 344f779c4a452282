"""Runs that are killed, disturbed or outdated: the next `snakemake` ends in the same tables."""

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

from faults.damages import BATCH, FLAT, PRELUDE, flipped
from springblock.study.audit import faults
from studies import FEWER


def without_realisations(study):
    """Remove a batch of the flat surface."""
    (study.results / BATCH).unlink()


def until(condition, seconds=300.0):
    """Wait for something to happen."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it never happened"
        time.sleep(0.02)


def processes(study):
    """Processes that work in the folder of a study, with their command lines."""
    return {
        process: " ".join(process.info["cmdline"] or ())
        for process in psutil.process_iter(["cwd", "cmdline"])
        if process.info["cwd"] == str(study.folder.resolve())
    }


def jobs(study):
    """Those that simulate: `springblock --code ... simulate ...`."""
    job = re.compile(r"springblock --code \w+ simulate ")
    return [process for process, words in processes(study).items() if job.search(words)]


def written(folder):
    """Return when each file was written, except Snakemake's own and bytecode."""
    own = {".snakemake", "__pycache__"}
    files = (file for file in folder.rglob("*") if not own & {*file.parts})
    return {file: file.stat().st_mtime_ns for file in files if file.is_file()}


def test_after_a_killed_job_and_a_killed_run_the_same_command_continues(study, undisturbed):
    """The job of the killed run outlives it; both write the same complete file."""
    without_realisations(study)
    run = study.start()
    until(lambda: jobs(study))
    for job in jobs(study):
        job.kill()
    said, _ = run.communicate()
    assert run.returncode != 0
    assert "simulate_batch" in said
    assert not (study.results / BATCH).exists()
    run = study.start()
    until(lambda: jobs(study))
    run.kill()
    assert "--unlock" in study.run(refused=True)
    subprocess.run(study.command("--unlock"), cwd=study, env=study.environment, check=True)
    study.run()
    run.communicate()
    until(lambda: not processes(study))
    assert study.numbers() == undisturbed.numbers()


def test_a_job_that_outlives_its_run_is_noticed_after_the_configuration_has_changed(study):
    """It overwrites a batch of another duration that the next run has made."""
    without_realisations(study)
    run = study.start()
    until(lambda: jobs(study))
    outliving = jobs(study)
    for job in outliving:
        job.suspend()
    run.kill()
    subprocess.run(study.command("--unlock"), cwd=study, env=study.environment, check=True)
    flat = FEWER["scenes"]["flat"] | {"duration": 1e-5}
    study.configure(scenes=FEWER["scenes"] | {"flat": flat})
    study.run()
    numbers = study.numbers()
    for job in outliving:
        job.resume()
    run.communicate()
    until(lambda: not processes(study))
    (found,) = faults(study.results)
    sentence = f"duration is 2e-05 in {found.file}, but 1e-05 in the study"
    assert found.file == study.results / BATCH
    assert sentence in found.reason
    assert f"duration is 2e-05 in results/{BATCH}, but 1e-05 in the study" in study.run(
        refused=True
    )
    assert "1 file is set aside" in study.run("--quiet", "host", targets=("repair",))
    study.run()
    assert study.numbers() == numbers
    assert not list(faults(study.results))


def test_a_full_disk_stops_the_study_and_leaves_no_half_file(study):
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


def test_a_bad_file_stops_the_study_until_it_is_set_aside(study, undisturbed):
    """In one sentence; then it is made again."""
    flipped(study.results / BATCH, study.results)
    said = study.run(refused=True)
    assert re.search(rf"{BATCH} is damaged.*`snakemake repair`", said)
    assert "Traceback" not in said
    said = study.run("--quiet", "host", targets=("repair",))
    assert "set aside in results/set-aside" in said
    study.run()
    assert study.numbers() == undisturbed.numbers()
    assert not list(faults(study.results))


@pytest.mark.parametrize(
    "options", [("--touch",), ("--rerun-triggers", "mtime"), ("--rerun-triggers", "code", "input")]
)
def test_changes_that_snakemake_is_told_not_to_see_are_refused(study, options):
    """A dry run without these options lists what has to run again, and writes nothing."""
    assert study.planned(*options) == {}
    study.configure(material={"gamma": 4e3})
    assert "another configuration (material), and --" in study.run(*options, refused=True)
    before = written(study.folder)
    assert {"prelude", "simulate_batch", "aggregate"} <= study.planned().keys()
    assert written(study.folder) == before


def test_a_run_without_metadata_is_not_changed_unseen(study):
    without_realisations(study)
    study.run("--drop-metadata")
    assert study.planned() == {}
    study.configure(material={"gamma": 4e3})
    assert "metadata on them are missing" in study.run(refused=True)


def test_without_memory_the_same_results_are_kept_and_those_of_other_code_refused(study):
    """Before anything is planned."""
    shutil.rmtree(study / ".snakemake")
    assert study.planned() == {}
    study.edit("solver/friction.py", "0.0", "0.5")
    said = study.run("--dry-run", refused=True)
    assert "another code (compile, simulate, accuracy, mechanism, continuum)" in said
    assert "Traceback" not in said


def test_a_growing_study_has_each_seed_once(study):
    """It had three, in batches of two."""
    study.configure(scenes=FEWER["scenes"] | {"flat": {"seeds": 5, "duration": 2e-5}})
    study.run()
    found = pq.read_table(study.results / f"realisations/{FLAT}")
    assert found["seed"].to_pylist() == [0, 1, 2, 3, 4]


def test_a_changed_formula_runs_again_what_depends_on_it_and_a_comment_nothing(study):
    for module in ("solver/springs.py", "simulation/run.py", "cli/simulate.py", "io/schemas.py"):
        study.edit(module)
    assert study.planned() == {}
    study.edit("analysis/correlation.py", "1000.0, 922", "1000.0, 900")
    rules = study.planned().keys()
    assert "correlation" in rules
    assert "simulate_batch" not in rules
    study.edit("solver/springs.py", "0.5 * (nex", "0.4 * (nex")
    assert {"compile", "prelude", "simulate_batch"} <= study.planned().keys()
