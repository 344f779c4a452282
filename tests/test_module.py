"""The study as a module of another workflow, and run from another folder."""

import re

import numpy as np
import pytest

from studies import ROOT, TINY, Study

SNAKEFILE = """\
configfile: "tiny.yaml"

module springs:
    snakefile: "{root}/workflow/Snakefile"
    config: config

use rule * from springs as springs_*
"""
#: Keys without which `study: own` has nothing to simulate.
OWN = {
    "study": "own",
    "results": "results/mine",
    "material": {"slider_velocity": 5e-3},
    "scenes": {"a": {"mask": "islands.npy", "direction": ["x"], "seeds": 2}},
}


@pytest.fixture
def host(tmp_path):
    """A workflow with the study as its module, and nothing else of it."""
    (tmp_path / "Snakefile").write_text(SNAKEFILE.format(root=ROOT))
    np.save(tmp_path / "islands.npy", np.indices((12, 12)).sum(axis=0) % 5 > 1)
    return Study(tmp_path, ("--cores", "2"))


def test_a_module_runs_once_and_then_has_nothing_to_do(host):
    """A changed material makes all of it again; a dry run records nothing.

    Keys that are left out have the values that a study of one's own has.
    """
    host.write("tiny.yaml", OWN)
    before = host.planned()
    assert not (host / "results").exists()
    assert before["springs_simulate_batch"] == 1
    host.run()
    results = host / "results/mine"
    assert (results / "report.html").exists()
    assert host.planned() == {}
    host.write("tiny.yaml", OWN | {"material": {"slider_velocity": 5e-3, "gamma": 4e3}})
    assert host.planned().keys() == before.keys() - {"springs_compile"}
    assert "springs_simulate_batch" in host.planned("--rerun-triggers", "mtime")


@pytest.mark.parametrize("option", ["-s", "-d"])
def test_a_study_in_another_folder_has_the_same_defaults_and_glossary(tmp_path, option):
    """Snakemake itself looks for default configurations only in the folder in which it runs."""
    here = Study(tmp_path)
    here.write("tiny.yaml", {"scenes": TINY["scenes"], "figures": TINY["figures"]})
    shown = ("--dry-run", "--quiet", "host", "-p", "--cores", "1")
    if option == "-s":
        said = here.run("-s", str(ROOT / "Snakefile"), *shown)
    else:
        configuration = (str(here / "tiny.yaml"),)
        said = Study(ROOT).run("-d", str(tmp_path), *shown, configuration=configuration)
    assert "--n-blocks 120" in said
    (report,) = re.findall(r"^Shell command: (springblock report .+)$", said, re.MULTILINE)
    (glossary,) = re.findall(r"\S+glossary\.md", report)
    assert (tmp_path / glossary).resolve() == ROOT / "docs/glossary.md"
