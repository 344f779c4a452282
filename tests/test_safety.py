"""What strangers and slips put into configurations and files: none of it runs, all is refused."""

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
from springblock.study.configuration import check, completed
from springblock.study.texts import check_texts
from studies import PAPER, ROOT, SCHEMA, Study, places

#: Plain names, as users have them.
PLAIN = ["my results", "a b  c", "../elsewhere", "/scratch/a/b", "a//b/", ".", "Größe (1)", "схема"]
PLAIN += ["摩擦", "run+1,2@3", "_a", ".a", "a-b_c.d", "0", "a/" * 100 + "b"]
#: What a shell, Snakemake or a file system could take for something else: any other character of
#: ASCII, ends that look like options or get lost, invisible characters, and what is too long.
HOSTILE = [f"a{chr(i)}b" for i in range(128) if not re.match(r"[\w ./+,@()-]", chr(i))]
HOSTILE += ["$(touch PWNED)", "a;touch PWNED", "{input}", "'a'", "-", "--output", " a", "a ", "a\n"]
HOSTILE += ["\u202egnp.a", "a\u2028b", "\ud800", "a\u200bb", "\ufeffa", "💥"]
HOSTILE += ["a" * 300, "a/" * 600 + "a", "ü" * 150]


def holding(path, value):
    """A configuration that has nothing but a value at a place."""
    for key in reversed(path):
        value = [value] if key == 0 else {key: value}
    return value


def refusal(configuration):
    """The sentence that a configuration is refused with."""
    with pytest.raises(ValueError, match=r".") as refused:
        check(completed(configuration), SCHEMA)
    sentence = str(refused.value)
    assert sentence.isprintable()
    assert len(sentence) < 400
    return sentence


def test_a_hostile_value_is_refused_whatever_key_has_it():
    """Keys are those of the schema, so that a new one is tried as well; plain names are taken."""
    check_texts({"scenes": {"own": {"mask": PLAIN}}})
    paths = {path for path, _ in places(SCHEMA) if path}
    assert {("results",), ("scenes", "own", 0, "mask", 0), ("figures", "sweeps", "own")} <= paths
    for path in paths:
        key = ".".join(map(str, path))
        assert refusal(holding(path, "$(touch PWNED)")).startswith(f"{key} is ")
    for value in [*HOSTILE, 10**400, -(2**63)]:
        assert refusal({"results": value}).startswith("results is "), value


def test_a_hostile_key_is_refused_wherever_it_is():
    takes_keys = {"properties", "additionalProperties", "propertyNames"}
    mappings = {path for path, schema in places(SCHEMA) if takes_keys & schema.keys()}
    assert {(), ("scenes",), ("figures", "sweeps"), ("scenes", "own", "material")} <= mappings
    for path in mappings:
        key = ".".join(map(str, path)) or "the configuration"
        assert refusal(holding(path, {"$(touch PWNED)": {}})).startswith(f"{key} has the key ")
    for name in [*HOSTILE, 1, None, 1.5]:
        assert refusal({"scenes": {name: {}}}).startswith("scenes has the key "), name


@pytest.mark.parametrize("name", ["../a", "a b", "a" * 65])
def test_names_of_groups_and_sweeps_are_words(name):
    """They are parts of paths and of names of rules."""
    assert "name of up to 64" in refusal(PAPER | {"scenes": PAPER["scenes"] | {name: None}})
    figures = PAPER["figures"] | {"sweeps": {name: {"groups": ["flat"], "over": "n_p"}}}
    assert "name of up to 64" in refusal(PAPER | {"figures": figures})


def test_commands_quote_every_path():
    for text in filter(str.isprintable, [*HOSTILE, *PLAIN]):
        scene = Scene(mask=BlockMap("own-12345678", np.ones((3, 3), bool), Path(text)))
        words = shlex.split(scene.arguments)
        assert words[words.index("--mask") + 1] == str(Path(text))
    rules = "".join(file.read_text() for file in (ROOT / "workflow/rules").glob("*.smk"))
    commands = re.findall(r"^( +)shell:\n((?:\1 +.*\n)+)", rules, re.MULTILINE)
    text = "".join(body for _, body in commands)
    placeholders = re.findall(r"\{((?:input|output|log).*?)\}", text)
    assert len(placeholders) > len(commands) > 10
    assert all(each.endswith(":q") for each in placeholders)


def test_a_refused_study_runs_and_writes_nothing(tmp_path):
    study = Study.begun(tmp_path, results="a'$(touch PWNED)")
    before = {*tmp_path.iterdir()}
    said = study.run(refused=True)
    assert "The study cannot be run: results is" in said
    assert "Traceback" not in said
    assert {*tmp_path.iterdir()} - before <= {tmp_path / ".snakemake"}


def test_an_unforeseen_error_in_a_configuration_is_one_sentence(tmp_path):
    study = Study.begun(tmp_path)
    study.edit(
        "study/texts.py", "def check_texts(", "def check_texts(*_): {}['x']\n\n\ndef unused("
    )
    said = study.run("-n", refused=True)
    assert "The study cannot be run: " in said
    assert "KeyError('x'); SPRINGBLOCK_TRACEBACK=1 shows where this happened." in said
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
