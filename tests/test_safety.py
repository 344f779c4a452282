"""Quoting of paths in commands, unforeseen errors, and packed arrays that are none."""

import io
import re
import shlex
import zipfile
from pathlib import Path

import numpy as np
import pytest

from springblock.files import BLANK, read_arrays, write_sealed
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.simulation.prelude import Prelude
from studies import ROOT, Study


@pytest.mark.parametrize("text", ["$(touch a).png", "a 'b'.png", "{input}.png", "नमस्ते.png"])
def test_commands_quote_every_path(text):
    scene = Scene(mask=BlockMap("own-12345678", np.ones((3, 3), bool), Path(text)))
    words = shlex.split(scene.arguments)
    assert words[words.index("--mask") + 1] == text


def test_rules_quote_every_path():
    rules = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
    commands = re.findall(r"^( +)shell:\n((?:\1 +.*\n)+)", rules, re.MULTILINE)
    text = "".join(body for _, body in commands)
    placeholders = re.findall(r"\{((?:input|output|log).*?)\}", text)
    assert len(placeholders) > len(commands) > 10
    assert all(each.endswith(":q") for each in placeholders)


def test_any_name_can_be_planned(tmp_path):
    study = Study.begun(tmp_path, results="मेरे 'results' $(a)")
    flat = study.planned(targets=("aggregate",))
    assert flat["simulate_batch"] > 0


def test_an_unforeseen_error_in_a_configuration_is_one_sentence(tmp_path):
    study = Study.begun(tmp_path)
    study.edit("study/configuration.py", "def check(", "def check(*_): {}['x']\n\n\ndef unused(")
    said = study.run("-n", refused=True)
    assert "The study cannot be run: " in said
    assert "KeyError('x'); SPRINGBLOCK_TRACEBACK=1 shows where this happened." in said
    assert "Traceback" not in said


def test_a_repeated_group_is_refused_in_one_sentence(tmp_path):
    study = Study.begun(tmp_path)
    with (study / "tiny.yaml").open("a") as file:
        file.write("step: 1.0e-8\nstep: 2e-8\n")
    said = study.run("--dry-run", refused=True)
    assert re.search(r"tiny.yaml, line \d+: key 'step' is repeated; rename or remove it", said)
    assert "Traceback" not in said


def npy(shape, kind="<f8"):
    """The first bytes of an array that is this large."""
    head = io.BytesIO()
    described = {"descr": kind, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(head, described)
    return head.getvalue() + bytes(64)


PICKLE = npy((3,), "|O")


def packed(file, **members):
    """A file of several arrays, packed as well as it can be."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in members.items():
            archive.writestr(f"{name}.npy", content)
    return file


@pytest.mark.parametrize("content", [npy((10**12,)), PICKLE, b"cos\nsystem\n(S'a'\ntR."])
def test_packed_arrays_are_plain_and_no_larger_than_they_are(tmp_path, content):
    """Neither what a header claims is made room for, nor is anything but numbers loaded."""
    with pytest.raises(ValueError, match=r"."):
        read_arrays(packed(tmp_path / "a.npz", peak=content))


def test_a_packed_bomb_is_not_unpacked(tmp_path, monkeypatch):
    file = packed(tmp_path / "a.npz", peak=npy((10**6,)) + bytes(8 * 10**6))
    monkeypatch.setattr("springblock.files._MOST", 10**6)
    with pytest.raises(ValueError, match=r"^it has 8\d+ bytes unpacked; the limit is 1000000"):
        read_arrays(file)


def test_preludes_are_read_that_way(tmp_path):
    trap = packed(tmp_path / "trap.npz", conditions=PICKLE)
    with zipfile.ZipFile(trap, "a") as archive:
        archive.comment = BLANK
    write_sealed(trap, trap.read_bytes())
    with pytest.raises(ValueError, match=r"trap.npz is not a prelude"):
        Prelude.read(trap)
