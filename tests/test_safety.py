"""What strangers and slips put into configurations and files: none of it runs, all is refused."""

import io
import json
import os
import re
import shlex
import shutil
import struct
import subprocess
import sys
import zipfile
import zlib
from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import Image
from snakemake_interface_executor_plugins.utils import format_cli_arg

from springblock import Pattern, compute_prelude
from springblock.files import BLANK, read_arrays, write_sealed
from springblock.model.blockmap import BlockMap, Cut
from springblock.model.pattern import MAX_BLOCKS
from springblock.model.scene import Scene
from springblock.simulation.checkpoint import Checkpoint
from springblock.simulation.prelude import Prelude
from springblock.study.configuration import PARTS, check, completed
from springblock.study.texts import check_texts
from test_workflow import PAPER, TINY, copied

ROOT = Path(__file__).parents[1]
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())

#: Each would do something, or be something else, if anybody but this package read it.
HOSTILE = [
    *(
        "a;touch PWNED",
        "a; touch PWNED #",
        "a && touch PWNED",
        "a & touch PWNED",
        "a || touch PWNED",
    ),
    *(
        "a | touch PWNED",
        "a > PWNED",
        "a >> PWNED",
        "a < PWNED",
        "2>PWNED",
        "a\ntouch PWNED",
        "a\n",
    ),
    *("a\rtouch PWNED", "a\ttouch PWNED", "\ntouch PWNED\n", "$(touch PWNED)", "a$(touch PWNED)b"),
    *("`touch PWNED`", "${IFS}touch", "$HOME", "$((1))", "<(touch PWNED)", "'a'; touch PWNED; 'b'"),
    *("'", '"', "a'b", 'a"b', "a'$(touch PWNED)'b", 'a"$(touch PWNED)"b', "'$(touch PWNED)'"),
    *("\\", "a\\", "a\\\ntouch PWNED", "\\'; touch PWNED", "a\\x00", "a\0b", "\x1b[2J", "\x7f"),
    *(
        "{x}",
        "{input}",
        "{{x}}",
        "{0}",
        "{wildcards.scene}",
        "{workflow.globals}",
        "{x,.*}",
        "{",
        "}",
    ),
    *("{a,b}", "*", "a*", "?", "[a-z]", "!", "!!", "a!b", "~", "~/a", "~root", "#a", "%s", "%(x)s"),
    *("-", "--", "-rf", "--output", "-c touch PWNED", " a", "a ", " ", "a:b", "a=b", "a^b", "a%b"),
    *(
        "\u202egnp.a",
        "a\u2028b",
        "\ud800",
        "a\u200bb",
        "\ufeffa",
        "💥",
        "a" * 300,
        "a/" * 600 + "a",
    ),
    *("ü" * 150, "s3://a/b", "file:///etc/passwd", "; rm -rf /", "<b>a</b>", "a\x00.png", "a#b"),
]
#: Plain names, as users have them.
PLAIN = [
    *("results", "my results", "a b  c", "../elsewhere", "/scratch/a/b", "./a", "a//b/", "..", "."),
    *(
        "Größe (1)",
        "схема",
        "摩擦",
        "run+1,2@3",
        "(a)",
        "_a",
        ".a",
        "a-b_c.d",
        "0",
        "a/" * 100 + "b",
    ),
]


def resolved(schema):
    """A part of the schema with what it refers to."""
    reference = schema.get("$ref")
    return schema | resolved(SCHEMA["$defs"][reference.split("/")[-1]]) if reference else schema


def places(schema, path=()):
    """Paths to all that a schema takes, with what it says there; names of one's own are `own`."""
    schema = resolved(schema)
    yield path, schema
    for name, inner in schema.get("properties", {}).items():
        yield from places(inner, (*path, name))
    if isinstance(schema.get("additionalProperties"), dict):
        yield from places(schema["additionalProperties"], (*path, "own"))
    if "items" in schema:
        yield from places(schema["items"], (*path, 0))
    for part in [
        *schema.get("anyOf", []),
        *(schema[key] for key in ("then", "else") if key in schema),
    ]:
        yield from places(part, path)


PLACES = dict.fromkeys(path for path, _ in places(SCHEMA) if path)
MAPPINGS = dict.fromkeys(
    path
    for path, schema in places(SCHEMA)
    if {"properties", "additionalProperties", "propertyNames"} & schema.keys()
)


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


def test_enough_is_tried():
    assert len(HOSTILE) == len(set(HOSTILE)) >= 60
    texts = {path for path in PLACES if path[-1] in ("results", "mask", "topography", "mu_static")}
    assert {("results",), ("scenes", "own", "mask"), ("beyond", "own", 0, "topography")} <= texts
    assert ("figures", "sweeps", "own", "over") in PLACES
    assert ("scenes", "own", 0, "mask", 0) in PLACES
    assert {("scenes",), ("figures", "sweeps"), ("beyond", "own", "material")} <= MAPPINGS.keys()


def test_a_hostile_text_is_refused_whatever_key_has_it():
    """Keys are those of the schema: a new one is tried, too."""
    for path in PLACES:
        key = ".".join(map(str, path))
        for text in HOSTILE:
            assert refusal(holding(path, text)).startswith(f"{key} is "), text


def test_a_hostile_key_is_refused_wherever_it_is():
    for path in MAPPINGS:
        key = ".".join(map(str, path)) or "the configuration"
        for text in [*HOSTILE, 1, None, 1.5, ("a;touch PWNED",)]:
            assert refusal(holding(path, {text: {}})).startswith(f"{key} has the key "), text


@pytest.mark.parametrize("name", ["a/b", "../a", "a b", "", "a" * 65, "(a)", "a.b"])
def test_names_of_groups_and_sweeps_are_words(name):
    for part in PARTS:
        assert "name of up to 64" in refusal(PAPER | {part: PAPER[part] | {name: None}})
    sweeps = {name: {"groups": ["flat"], "over": "n_p"}}
    figures = PAPER["figures"] | {"sweeps": sweeps}
    assert "name of up to 64" in refusal(PAPER | {"figures": figures})


@pytest.mark.parametrize("key", ["n_blocks", "step", "first_seed", "realisations_per_job"])
@pytest.mark.parametrize("number", [10**400, "1" + "0" * 400, -(2**63)])
def test_whole_numbers_fit_into_columns(key, number):
    assert refusal(PAPER | {key: number}).startswith(f"{key} is ")


def test_plain_names_are_taken():
    for text in PLAIN:
        check_texts({"results": text, "scenes": {"own": [{"mask": [text]}]}})
    check(PAPER | {"results": PLAIN[1]}, SCHEMA)


def argv(line):
    """What a shell makes of the words of a line."""
    shown = subprocess.run(
        ["sh", "-c", f"printf '%s\\0' {line}"], capture_output=True, text=True, check=True
    )
    return shown.stdout.split("\0")[:-1]


def test_what_is_taken_arrives_at_the_jobs_of_a_cluster_as_it_was():
    """Snakemake puts `--config` into a line of its own, and quotes it with Python's quotes."""
    given = {"results": PLAIN[2], "scenes": {"own": {"mask": PLAIN}}}
    line = format_cli_arg("--config", given)
    results, scenes = argv(line)[1:]
    assert results == f"results={given['results']}"
    assert yaml.safe_load(scenes.removeprefix("scenes=")) == given["scenes"]


def test_what_is_refused_would_have_run_there(tmp_path, monkeypatch):
    """The line above is why quotes in the rules alone would not do."""
    monkeypatch.chdir(tmp_path)
    given = {"scenes": {"own": {"mask": "$(touch PWNED)"}}}
    argv(format_cli_arg("--config", given))
    assert Path("PWNED").exists()
    with pytest.raises(ValueError, match=r"^scenes.own.mask is '\$\(touch PWNED\)'; a text may"):
        check_texts(given)


def test_files_of_a_scene_are_quoted_whatever_their_names():
    for text in filter(str.isprintable, [*HOSTILE, *PLAIN]):
        scene = Scene(mask=BlockMap("own-12345678", np.ones((3, 3), bool), Path(text)))
        words = shlex.split(scene.arguments)
        assert words[words.index("--mask") + 1] == str(Path(text))


def test_rules_quote_every_path():
    """What they do not quote are words of the package's own making."""
    unquoted = set()
    for file in [ROOT / "Snakefile", *(ROOT / "workflow/rules").glob("*.smk")]:
        for shell in re.findall(r"^( +)shell:\n((?:\1 +.*\n)+)", file.read_text(), re.MULTILINE):
            unquoted |= set(re.findall(r"\{([^{}]+)(?<!:q)\}", shell[1]))
    wildcards = {"comparison", "scene", "integrator", "first", "last"}
    options = {
        "scene",
        "how",
        "duration",
        "cut",
        "films",
        "options",
        "of",
        "preludes",
        "tables",
        "production",
    }
    words = {"figure", "over", "configuration"}
    assert unquoted <= {f"wildcards.{name}" for name in wildcards} | {
        f"params.{name}" for name in options | words
    }


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A study of surfaces of one's own, whose folders and files have names that need quotes."""
    folder = copied(tmp_path_factory.mktemp("a study (1), ü"))
    shutil.rmtree(folder / "src")
    (folder / "my masks").mkdir()
    Image.new("L", (6, 6), 255).save(folder / "my masks/islands (1), ü.png")
    np.save(folder / "weak mu.npy", np.full((6, 6), 0.5))
    grid = {"mask": "my masks/islands (1), ü.png", "mu_dynamic": "weak mu.npy"}
    grid |= {"direction": ["x"], "seeds": 1}
    tiny = TINY | {"scenes": TINY["scenes"] | {"surfaces": grid}, "results": "my results/ü (2)"}
    (folder / "tiny.yaml").write_text(yaml.safe_dump(tiny))
    return folder


def run(study, *options):
    """Run Snakemake on a copy of the study with this package, which is compiled already."""
    return subprocess.run(
        [sys.executable, "-m", "snakemake", *options],
        cwd=study,
        env={**os.environ, "PYTHONPATH": f"{ROOT / 'src'}:{os.environ.get('PYTHONPATH', '')}"},
        capture_output=True,
        text=True,
        check=False,
    )


def files(folder):
    """All that a study has beside Snakemake's own notes."""
    own = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
    return {path for path in own if path.parts[0] != ".snakemake"}


def test_a_study_writes_into_its_folder_alone(study):
    """Its commands, as the shell splits them, have each path in one piece."""
    before = files(study)
    outcome = run(study, "--configfile", "tiny.yaml", "--printshellcmds", "--", "surfaces")
    assert outcome.returncode == 0, outcome.stderr
    made = files(study) - before
    assert made
    assert {path.parts[:2] for path in made} == {("my results", "ü (2)")}
    lines = re.findall(
        r"^Shell command: (springblock .+)$", outcome.stdout + outcome.stderr, re.MULTILINE
    )
    commands = {words[1]: words for words in map(shlex.split, lines)}
    for name in ("prelude", "simulate"):
        words = commands[name]
        assert words[words.index("--mask") + 1] == "my masks/islands (1), ü.png"
        assert words[words.index("--mu-dynamic") + 1] == "weak mu.npy"
        assert Path(words[words.index("--output") + 1]) in made


@pytest.mark.parametrize(
    "change",
    [
        {"results": "a'$(touch PWNED)"},
        {"scenes": {"surfaces": {"mask": "`touch PWNED`.png", "direction": ["x"], "seeds": 1}}},
        {"figures": {"sweeps": {"a\ntouch PWNED": {"groups": ["flat"], "over": "n_p"}}}},
    ],
)
def test_a_refused_study_runs_and_writes_nothing(study, change):
    (study / "wrong.yaml").write_text(yaml.safe_dump(change))
    before = files(study)
    outcome = run(study, "--configfile", "tiny.yaml", "wrong.yaml")
    assert outcome.returncode == 1
    assert "a text may hold letters, digits" in outcome.stdout + outcome.stderr
    assert files(study) == before


def chunk(kind, content):
    """A part of a PNG."""
    checked = kind + content
    return struct.pack(">I", len(content)) + checked + struct.pack(">I", zlib.crc32(checked))


def png(width, height):
    """An image of a few bytes that says it is this large."""
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


def npy(shape, kind="<f8"):
    """The first bytes of an array that is this large."""
    described = {"descr": kind, "fortran_order": False, "shape": shape}
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, described)
    return head.getvalue() + bytes(64)


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("bomb.png", png(100_000, 100_000), "bomb.png is larger than the 4096 x 4096 blocks"),
        ("bomb.png", png(MAX_BLOCKS + 1, 1), "bomb.png is larger than the 4096 x 4096 blocks"),
        ("bomb.npy", npy((10**6, 10**6)), "bomb.npy must be an array of numbers"),
        ("bomb.npy", npy((10**9, 10**9, 10**9)), "bomb.npy must be an array of numbers"),
        ("bomb.npy", npy((1, 1), "|O"), "bomb.npy must be an array of numbers"),
    ],
)
def test_a_file_that_says_it_is_huge_is_refused_by_its_header(tmp_path, name, content, sentence):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=sentence):
        BlockMap.mask(tmp_path / name)


def test_a_file_that_is_huge_is_not_read(tmp_path):
    """Eight terabytes that take no room on the disk."""
    with (tmp_path / "bomb.npy").open("wb") as file:
        file.write(npy((10**6, 10**6)))
        try:
            file.truncate(8 * 10**12 + 128)
        except OSError:
            pytest.skip("no file may be as large here")
    with pytest.raises(ValueError, match=r"bomb.npy (is larger than the 4096|must be an array)"):
        BlockMap.coefficients(tmp_path / "bomb.npy")


def test_an_image_is_never_a_program(tmp_path, monkeypatch):
    """Pillow has Ghostscript draw PostScript, whatever the file is called."""
    (tmp_path / "gs").write_text("#!/bin/sh\ntouch PWNED\n")
    (tmp_path / "gs").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    monkeypatch.chdir(tmp_path)
    head = "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 6 6\n%%EndComments\nshowpage\n"
    Path("islands.png").write_text(head)
    with pytest.raises(ValueError, match=r"islands.png is neither an image nor an array"):
        BlockMap.mask(Path("islands.png"))
    assert not Path("PWNED").exists()


@pytest.mark.parametrize("text", ["1 " * 10**4, "9" * 10**6, "# " * 10**5, "\n" * 10**4])
def test_absurd_lines_are_no_topography(tmp_path, text):
    pytest.importorskip("SurfaceTopography")
    (tmp_path / "rough.txt").write_text(text)
    with pytest.raises(ValueError, match=r"^\S+rough.txt") as refusal:
        Cut(tmp_path / "rough.txt", 1e-5, bearing_area=0.5).mask()
    assert "\n" not in str(refusal.value)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # of the reader
def test_a_topography_too_large_is_not_opened(tmp_path):
    pytest.importorskip("SurfaceTopography")
    with (tmp_path / "rough.txt").open("wb") as file:
        file.truncate(2**28 + 1)
    with pytest.raises(ValueError, match=r"rough.txt has more than 268435456 bytes"):
        Cut(tmp_path / "rough.txt", 1e-5, bearing_area=0.5).mask()
    (tmp_path / "rough.npy").write_bytes(npy((10**6, 10**6)))
    with pytest.raises(ValueError, match=r"rough.npy: it has 1000000000000 points; 67108864"):
        Cut(tmp_path / "rough.npy", 1e-5, bearing_area=0.5).mask()


def packed(file, **members):
    """A file of several arrays, packed as well as it can be."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in members.items():
            archive.writestr(f"{name}.npy", content)
    return file


def test_packed_arrays_are_read_back(tmp_path):
    np.savez_compressed(tmp_path / "a.npz", a=np.arange(3), b="text")
    read = read_arrays(tmp_path / "a.npz")
    np.testing.assert_array_equal(read["a"], range(3))
    assert str(read["b"]) == "text"
    assert read_arrays(io.BytesIO((tmp_path / "a.npz").read_bytes())).keys() == read.keys()


@pytest.mark.parametrize(
    "content", [npy((10**12,)), npy((3,), "|O"), b"", b"cos\nsystem\n(S'a'\ntR."]
)
def test_packed_arrays_are_plain_and_no_larger_than_they_are(tmp_path, content):
    """Neither what a header claims is made room for, nor is anything but numbers loaded."""
    with pytest.raises(ValueError, match=r"."):
        read_arrays(packed(tmp_path / "a.npz", peak=content))


def test_a_packed_bomb_is_not_unpacked(tmp_path, monkeypatch):
    file = packed(tmp_path / "a.npz", peak=npy((10**6,)) + bytes(8 * 10**6))
    assert file.stat().st_size < 10**5
    monkeypatch.setattr("springblock.files._MOST", 10**6)
    with pytest.raises(ValueError, match=r"^it would take 8\d+ bytes; 1000000 are the most"):
        read_arrays(file)


def test_preludes_and_checkpoints_are_read_that_way(tmp_path, monkeypatch):
    prelude = compute_prelude(Pattern.flat(3).contact)
    prelude.save(tmp_path / "prelude.npz")
    again = Prelude.read(tmp_path / "prelude.npz")
    assert again.conditions == prelude.conditions
    np.testing.assert_array_equal(again.peak, prelude.peak)
    trap = packed(tmp_path / "trap.npz", conditions=npy((3,), "|O"))
    with zipfile.ZipFile(trap, "a") as archive:
        archive.comment = BLANK
    write_sealed(trap, trap.read_bytes())
    with pytest.raises(ValueError, match=r"trap.npz is no prelude"):
        Prelude.read(trap)
    with pytest.raises(ValueError, match=r"trap.npz is no checkpoint: Object arrays cannot be"):
        Checkpoint(trap, 1.0, {}).restore(None)


def test_nothing_that_is_read_can_run():
    """Neither pickles nor texts become code, and no shell is between this package and others.

    Machine code of its own, in the user's cache, is what alone is meant to run.
    """
    kept = ROOT / "src/springblock/solver/compilation.py"
    for file in (ROOT / "src").rglob("*.py"):
        text = file.read_text()
        pickles = re.search(r"\b(pickle|marshal|shelve|dill|joblib|read_pickle)\b", text)
        assert not pickles or file == kept, file
        assert not re.search(r"(?<![.\w])(eval|exec)\(|os\.(system|popen)|shell=True", text), file
        for call in re.findall(r"np\.load\([^)]*\)", text):
            assert "allow_pickle=False" in call, file


def test_metadata_of_tables_are_parsed_alone(tmp_path):
    """As JSON; a table's own words about itself are never more than words."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    from springblock.io.parquet import read
    from springblock.io.schemas import SUMMARY

    trap = json.dumps({"__reduce__": "os.system('touch PWNED')"})
    metadata = {"configuration_digest": "$(touch PWNED)", "pandas": trap}
    pq.write_table(pa.table({"a": [1]}, metadata=metadata), tmp_path / "a.parquet")
    with pytest.raises(ValueError, match=r"a.parquet"):
        read([tmp_path / "a.parquet"], SUMMARY)
    assert [file.name for file in tmp_path.iterdir()] == ["a.parquet"]


def test_the_lock_pins_every_package_by_its_hash():
    for lock in ("environment.lock", "benchmarks/peers/peers.lock"):
        pinned = re.findall(r"^[a-z]\S+==.*(?:\n +.*)*", (ROOT / lock).read_text(), re.MULTILINE)
        assert pinned
        assert all("--hash=sha256:" in package for package in pinned)
