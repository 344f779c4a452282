"""The workflow on a cluster and in its container, as far as it can be seen without either.

`make test-slurm` has a cluster; programs that the tests write stand for Slurm's and Apptainer's.
"""

import re

import pytest
import yaml

from studies import ROOT, Study

RULES = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
CONTAINER = (ROOT / "container/springblock.def").read_text()
COMPILED = ("--cores", "1", "--", "compiled")
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


def test_profiles_differ_in_cores_and_group_jobs_of_rules_that_exist():
    default, slurm = (
        yaml.safe_load((ROOT / f"profiles/{name}/config.yaml").read_text())
        for name in ("default", "slurm")
    )
    assert {key for key in default if slurm.get(key) != default[key]} == {"cores", "quiet"}
    groups = dict(entry.split("=") for entry in slurm["groups"])
    assert set(groups.values()) == {entry.partition("=")[0] for entry in slurm["group-components"]}
    assert set(groups) <= set(re.findall(r"^ *rule (\w+):", RULES, re.MULTILINE))
    assert not re.search(r'\bgroup:\s+"', RULES)  # or dry runs would take a quarter longer


def test_the_container_is_built_from_files_that_exist_with_a_tested_python():
    (files,) = re.findall(r"^%files\n(.*?)(?=^%)", CONTAINER, re.MULTILINE | re.DOTALL)
    assert CONTAINER.count("--require-hashes -r") == 2  # setuptools, and all else
    for source, target in map(str.split, files.strip().splitlines()):
        assert (ROOT / source).exists()
        assert target == f"/opt/springblock/{source}"
    (version,) = re.findall(r"^From: python:([\d.]+)-", CONTAINER, re.MULTILINE)
    assert f'"{version}"' in (ROOT / ".github/workflows/test.yml").read_text()


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
