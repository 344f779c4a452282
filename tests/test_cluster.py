"""The workflow on a cluster and in its container, as far as it can be seen without either.

`make test-slurm` has a cluster; programs that the tests write stand for Slurm's and Apptainer's.
"""

import os
import re
import shutil
import subprocess

import pytest
import yaml

from studies import ROOT, Study

RULES = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
CONTAINER = (ROOT / "container/springblock.def").read_text()
COMPILED = ("--cores", "1", "--", "results/compiled")
#: Says how it was called, and which packages a file pins.
PYTHON = """\
#!/bin/sh
echo "$@"
for word in "$@"; do case $word in *.lock) grep -c == $word; esac; done
"""
#: Says how it was called, and runs the command outside of any container.
APPTAINER = """\
#!/bin/sh
case "$*" in *--version*) echo "apptainer version 1.3.6"; exit; esac
echo "$@" >> called
while [ "$1" != container/springblock.sif ]; do shift; done
shift
exec "$@"
"""


@pytest.fixture
def study(tmp_path):
    return Study.begun(tmp_path)


def test_profiles_differ_in_cores_and_know_the_groups_of_the_rules():
    default, slurm = (
        yaml.safe_load((ROOT / f"profiles/{name}/config.yaml").read_text())
        for name in ("default", "slurm")
    )
    assert {key for key in default if slurm.get(key) != default[key]} == {"cores", "quiet"}
    sizes = {entry.partition("=")[0] for entry in slurm["group-components"]}
    assert sizes == set(re.findall(r'group:\s+"(\w+)"', RULES))


def test_a_run_does_not_start_beside_jobs_of_a_killed_one(study):
    """Jobs of the same name elsewhere, or here of another name, do not matter."""
    harmless = f"springblock_1a2b|/tmp\nanother|{study.folder}"
    study.program("squeue", f"#!/bin/sh\nprintf '{harmless}\nspringblock_3c|{study.folder}\n'\n")
    said = study.run(*COMPILED, refused=True)
    assert "cancel them: scancel --name=springblock_3c\n" in said


def section(name):
    """Lines of a section of the container's definition, without comments."""
    (body,) = re.findall(rf"^%{name}\n(.*?)(?=^%|\Z)", CONTAINER, re.MULTILINE | re.DOTALL)
    lines = [line.strip() for line in body.splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def test_a_container_has_what_the_lock_pins_and_nothing_else(study):
    """Its steps run here, with a Python that only says what it would do."""
    for source, target in map(str.split, section("files")):
        assert (ROOT / source).exists()
        assert target == f"/opt/springblock/{source}"
    (version,) = re.findall(r"^From: python:([\d.]+)-", CONTAINER, re.MULTILINE)
    assert f'"{version}"' in (ROOT / ".github/workflows/test.yml").read_text()
    study.program("python", PYTHON)
    shutil.copy(ROOT / "pyproject.toml", study)
    steps = "set -e\n" + "\n".join(section("post")).replace("/opt/springblock", str(study.folder))
    path = os.pathsep.join([str(study / "bin"), os.environ["PATH"]])
    done = subprocess.run(
        steps, shell=True, env={"PATH": path}, capture_output=True, text=True, check=True
    )
    first, ones, second, many, last = done.stdout.splitlines()
    assert first.endswith("--require-hashes -r setuptools.lock")
    assert second.endswith("--require-hashes -r environment.lock")
    assert (int(ones), int(many) > 50) == (1, True)
    assert last.endswith("--no-deps .")
    assert all("--no-build-isolation" in line for line in (first, second, last))


def test_jobs_run_in_the_container_where_snakemake_is_told_to(study):
    study.program("apptainer", APPTAINER)
    (study / "container").mkdir()
    (study / "container/springblock.sif").touch()
    study.run("--software-deployment-method", "apptainer", *COMPILED)
    (called,) = (study / "called").read_text().splitlines()
    assert called.startswith("exec ")
    assert "container/springblock.sif bash -c" in called
    assert "compile --integrator leapfrog" in called
    assert "apptainer build container/springblock.sif container/springblock.def" in CONTAINER
