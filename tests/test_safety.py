"""Quoting of paths in rules, unforeseen errors, and pickled objects."""

import re

import numpy as np
import pytest

from springblock.simulation.prelude import Prelude
from studies import ROOT, Study


def test_rules_quote_every_path():
    rules = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
    commands = re.findall(r"^( +)shell:\n((?:\1 +.*\n)+)", rules, re.MULTILINE)
    text = "".join(body for _, body in commands)
    placeholders = re.findall(r"\{((?:input|output|log).*?)\}", text)
    assert len(placeholders) > len(commands) > 10
    assert all(each.endswith(":q") for each in placeholders)


def test_a_repeated_key_and_an_unforeseen_error_are_one_sentence(tmp_path):
    study = Study.begun(tmp_path)
    configured = (study / "tiny.yaml").read_text()
    (study / "tiny.yaml").write_text(configured + "step: 1.0e-8\nstep: 2e-8\n")
    said = study.run("-n", refused=True)
    assert re.search(r"tiny.yaml, line \d+: key 'step' is repeated; rename or remove it", said)
    assert "Traceback" not in said
    (study / "tiny.yaml").write_text(configured)
    study.edit("study/configuration.py", "def check(", "def check(*_): {}['x']\n\n\ndef unused(")
    said = study.run("-n", refused=True)
    assert "The study cannot be run: " in said
    assert "KeyError('x'); SPRINGBLOCK_TRACEBACK=1 shows where this happened." in said
    assert "Traceback" not in said


def test_no_pickled_object_is_loaded_from_a_prelude(tmp_path):
    np.savez(tmp_path / "trap.npz", conditions=np.array([{}], dtype=object))
    with pytest.raises(ValueError, match=r"trap.npz is not a prelude"):
        Prelude.read(tmp_path / "trap.npz")
