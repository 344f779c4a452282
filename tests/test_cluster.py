"""Rules, the profile of a cluster and the container; `make test-slurm` runs a study by Slurm."""

import re

import yaml

from studies import ROOT

RULES = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
CONTAINER = (ROOT / "container/springblock.def").read_text()


def test_rules_quote_every_path():
    commands = re.findall(r"^( +)shell:\n((?:\1 +.*\n)+)", RULES, re.MULTILINE)
    text = "".join(body for _, body in commands)
    placeholders = re.findall(r"\{((?:input|output|log).*?)\}", text)
    assert len(placeholders) > len(commands) > 10
    assert all(each.endswith(":q") for each in placeholders)


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


def test_rules_run_in_a_container_of_files_that_exist_with_a_tested_python():
    assert 'container: "container/springblock.sif"' in (ROOT / "Snakefile").read_text()
    assert "apptainer build container/springblock.sif container/springblock.def" in CONTAINER
    (files,) = re.findall(r"^%files\n(.*?)(?=^%)", CONTAINER, re.MULTILINE | re.DOTALL)
    assert CONTAINER.count("--require-hashes -r") == 2  # setuptools, and all else
    for source, target in map(str.split, files.strip().splitlines()):
        assert (ROOT / source).exists()
        assert target == f"/opt/springblock/{source}"
    (version,) = re.findall(r"^From: python:([\d.]+)-", CONTAINER, re.MULTILINE)
    assert f'"{version}"' in (ROOT / ".github/workflows/test.yml").read_text()
