"""The container's definition installs what the lock pins; it takes Apptainer to see it built."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "container/springblock.def").read_text()
#: Stands for Python in the container: says how it was called, and which packages a file pins.
PYTHON = """\
#!/bin/sh
echo "$@"
for word in "$@"; do case $word in *.lock) grep -c == $word; esac; done
"""
#: Stands for Apptainer: says how it was called, and runs the command outside of any container.
APPTAINER = """\
#!/bin/sh
case "$*" in *--version*) echo "apptainer version 1.3.6"; exit; esac
echo "$@" >> {folder}/called
while [ "$1" != container/springblock.sif ]; do shift; done
shift
exec "$@"
"""


def section(name: str) -> list[str]:
    """Lines of a section, without comments."""
    (body,) = re.findall(rf"^%{name}\n(.*?)(?=^%|\Z)", TEXT, re.MULTILINE | re.DOTALL)
    lines = [line.strip() for line in body.splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def test_it_is_built_from_files_that_are_there():
    taken = dict(line.split() for line in section("files"))
    assert all((ROOT / source).exists() for source in taken)
    assert all(target == f"/opt/springblock/{source}" for source, target in taken.items())


def test_its_python_is_one_that_the_package_is_tested_with():
    (version,) = re.findall(r"^From: python:([\d.]+)-", TEXT, re.MULTILINE)
    assert f'"{version}"' in (ROOT / ".github/workflows/test.yml").read_text()


def test_it_installs_the_lock_with_its_hashes_and_nothing_else(tmp_path):
    """Its steps run here, with a Python that only says what it would do."""
    (tmp_path / "bin").mkdir()
    python = tmp_path / "bin/python"
    python.write_text(PYTHON)
    python.chmod(0o755)
    for source in ("environment.lock", "pyproject.toml"):
        (tmp_path / source).write_bytes((ROOT / source).read_bytes())
    steps = "set -e\n" + "\n".join(section("post")).replace("/opt/springblock", str(tmp_path))
    path = os.pathsep.join([str(tmp_path / "bin"), os.environ["PATH"]])
    done = subprocess.run(
        steps, shell=True, env={"PATH": path}, capture_output=True, text=True, check=True
    )
    first, ones, second, many, last = done.stdout.splitlines()
    assert first.endswith("--require-hashes -r setuptools.lock")
    assert second.endswith("--require-hashes -r environment.lock")
    assert (int(ones), int(many) > 50) == (1, True)
    assert last.endswith("--no-deps .")
    assert all("--no-build-isolation" in line for line in (first, second, last))


def test_jobs_run_in_it_where_snakemake_is_told_to(tmp_path):
    command = tmp_path / "apptainer"
    command.write_text(APPTAINER.format(folder=tmp_path))
    command.chmod(0o755)
    for part in ("Snakefile", "workflow", "config", "profiles"):
        (tmp_path / part).symlink_to(ROOT / part)
    (tmp_path / "container").mkdir()
    (tmp_path / "container/springblock.sif").touch()
    options = ["--software-deployment-method", "apptainer", "--cores", "1", "--"]
    path = os.pathsep.join([str(tmp_path), os.environ["PATH"]])
    subprocess.run(
        [sys.executable, "-m", "snakemake", *options, "results/compiled/leapfrog"],
        cwd=tmp_path,
        env={**os.environ, "PATH": path},
        check=True,
    )
    (called,) = (tmp_path / "called").read_text().splitlines()
    assert called.startswith("exec ")
    assert "container/springblock.sif bash -c" in called
    assert "springblock compile --integrator leapfrog" in called
    assert "apptainer build container/springblock.sif container/springblock.def" in TEXT
