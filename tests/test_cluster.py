"""The workflow on a cluster, as far as it can be seen without one; `make test-slurm` has one."""

import logging
import os
import re
import subprocess
import sys
from datetime import datetime, timedelta
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml
from snakemake_interface_logger_plugins.common import LogEvent

from benchmarks.load import bare, configuration, measured

ROOT = Path(__file__).parents[1]
PROFILES = {name: ROOT / f"profiles/{name}/config.yaml" for name in ("default", "slurm")}
#: Stands for Slurm's squeue: one job, of a run in some folder.
SQUEUE = """\
#!/bin/sh
echo "{job}|{folder}"
"""


@pytest.fixture
def study(tmp_path):
    """A folder with the study and a small configuration."""
    for part in ("Snakefile", "workflow", "config", "profiles"):
        (tmp_path / part).symlink_to(ROOT / part)
    (tmp_path / "small.yaml").write_text(yaml.safe_dump(configuration(1001)))
    return tmp_path


def snakemake(study: Path, *options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "snakemake", "--configfile", "small.yaml", "--cores", "1", *options],
        cwd=study,
        env={**os.environ, "PATH": os.pathsep.join([str(study), os.environ["PATH"]])},
        capture_output=True,
        text=True,
        check=False,
    )


def test_every_entry_of_the_profile_says_why():
    lines = PROFILES["slurm"].read_text().splitlines()
    entries = [i for i, line in enumerate(lines) if line[0] not in " #-"]
    assert len(entries) == len(yaml.safe_load("\n".join(lines)))
    shared = lines.index("# As in profiles/default.")
    pair = lines.index("max-status-checks-per-second: 0.1")  # one comment for two entries
    assert all(lines[i - 1].startswith("#") for i in entries if i < shared and i != pair)


def test_what_the_profile_says_as_the_other_is_the_same():
    default, slurm = (yaml.safe_load(PROFILES[name].read_text()) for name in ("default", "slurm"))
    assert {key for key in default if slurm.get(key) != default[key]} == {"cores"}


def test_groups_of_the_profile_are_those_of_the_rules():
    rules = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
    slurm = yaml.safe_load(PROFILES["slurm"].read_text())
    sizes = [entry.partition("=")[0] for entry in slurm["group-components"]]
    assert sorted(sizes) == sorted(set(re.findall(r'group:\s+"(\w+)"', rules)))


@pytest.mark.parametrize(
    ("job", "folder", "refused"),
    [
        ("springblock_1a2b", "here", True),
        ("springblock_1a2b", "elsewhere", False),
        ("another", "here", False),
    ],
)
def test_a_run_does_not_start_beside_jobs_of_a_killed_one(study, job, folder, refused):
    squeue = study / "squeue"
    squeue.write_text(SQUEUE.format(job=job, folder=study if folder == "here" else "/tmp"))
    squeue.chmod(0o755)
    outcome = snakemake(study, "--", "results/compiled/leapfrog")
    assert (outcome.returncode != 0) == refused, outcome.stderr
    assert (f"cancel them: scancel --name={job}" in outcome.stderr + outcome.stdout) == refused


def test_a_folder_holds_a_thousand_batches(study):
    planned = snakemake(study, "--dry-run", "--", "aggregate").stdout
    folder = "results/realisations/n_blocks-12/level-0/direction-x"
    assert f"{folder}/seeds-999-999.parquet" in planned
    assert f"{folder}/more-1/seeds-1000-1000.parquet" in planned


def test_the_scheduler_looks_for_work_only_when_a_job_has_ended(study):
    """Its limit on jobs per second, 100 unless it is off, would start one more timer each time."""
    outcome = snakemake(study, "--verbose", "--", "results/compiled/leapfrog")
    after = re.findall(r"Resources after job selection: .*'_job_count': (\d+)", outcome.stderr)
    assert after == [str(sys.maxsize)]


def test_a_run_says_when_it_will_be_done():
    """After two minutes ten of forty steps are done: six more minutes."""
    code = (ROOT / "workflow/rules/running.smk").read_text()
    (pace,) = re.findall(r"^class Pace.*?(?=^\S(?<!c))", code, re.MULTILINE | re.DOTALL)
    clock, said = [0.0, 30.0, 120.0, 150.0], []
    names = {
        "logging": logging,
        "LogEvent": LogEvent,
        "logger": SimpleNamespace(info=said.append),
        "time": SimpleNamespace(monotonic=lambda: clock.pop(0)),
        "datetime": datetime,
        "timedelta": timedelta,
    }
    exec(pace, names)
    handler = names["Pace"]()
    for done in (2, 10, 13):  # too early; then once a minute at most
        handler.emit(SimpleNamespace(event=LogEvent.PROGRESS, done=done, total=40))
    assert [text.partition(", ")[0] for text in said] == ["At this pace the rest takes 0:06:00"]


def test_bare_jobs_leave_four_files_each(tmp_path):
    (tmp_path / "study").mkdir()
    load = measured(tmp_path / "study", 5, python=bare(tmp_path / "python"))
    assert load.files > 4 * load.jobs
    assert load.largest >= load.jobs
    assert load.own > 0.0
