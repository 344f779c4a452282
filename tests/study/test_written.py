"""Configuration files as they are written, before YAML drops or converts parts of them."""

import pytest
import yaml

from springblock.study.written import check_file
from studies import ROOT, Study

SCENE = "{mask: plain.png, direction: [x], seeds: 2}"
#: Lists of lists of lists, nine times as many in each.
LAUGHS = "a0: &a0 [1]\n" + "".join(
    f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]\n" for i in range(1, 30)
)


def written(folder, text, encoding="utf-8"):
    (folder / "a.yaml").write_text(text, encoding=encoding)
    return folder / "a.yaml"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (f"scenes:\n  a: {SCENE}\n  'a': {SCENE}\n", "scenes: 'a' is given twice; remove one"),
        ("step: 1.0\nstep: 2.0\n", "the configuration: 'step' is given twice"),
        ('{"scenes": {"a": [{"seeds": 1, "seeds": 2}]}}', "scenes.a: 'seeds' is given twice"),
        ("seed: 010", "seed is 010, which YAML takes for 8; write a decimal number"),
        ("a: [1, 1:30]", "a is 1:30, which YAML takes for 90"),
        ("a: 1_2", "a is 1_2, which YAML takes for 12"),
        ("a: -0x1F", "a is -0x1F, which YAML takes for -31"),
        ("a: 0b11", "a is 0b11, which YAML takes for 3"),
        ("a: .inf", "a is .inf, which YAML takes for inf"),
        ("a: 1:30.5", "a is 1:30.5, which YAML takes for 90.5"),
        (
            "results: 2024-05-01",
            "results is 2024-05-01, which YAML takes for a timestamp; .* quotes",
        ),
        ("a: !!set {b}", "a is a collection, which YAML takes for a set"),
        ("a: !own b", "a is b, which YAML takes for a !own"),
        ("a: &a [*a]", "a has more than 100000 values; no alias may"),
        ("a: &a {b: [*a]}", "a has more than 100000 values; no alias may"),
        (LAUGHS, "a29 has more than 100000 values"),
        ("a: [", "while parsing a flow"),
    ],
)
def test_what_yaml_would_drop_or_convert_is_refused(tmp_path, text, sentence):
    with pytest.raises(ValueError, match=rf"a.yaml:? {sentence}") as refusal:
        check_file(written(tmp_path, text))
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_what_is_meant_as_it_is_read_is_taken(tmp_path, encoding):
    """Keys that replace merged ones as well, and aliases, which repeat values."""
    text = f"a: &a {SCENE}\nb: {{<<: *a, seeds: 3}}\nc: [*a, *a]\nd: [0, -1, +2, 1.5, 1e-8, .5]\n"
    text += "e: ['010', '2024-05-01', 1e3, y, true, yes, null, ~]\nf: {}\n"
    check_file(written(tmp_path, text, encoding))
    for file in (ROOT / "config").rglob("*.yaml"):
        check_file(file)


def test_a_study_refuses_what_a_file_does_not_say_clearly(tmp_path):
    study = Study.begun(tmp_path)
    with (study / "tiny.yaml").open("a") as file:
        file.write("results: 2024-05-01\n")
    said = study.run("-n", refused=True)
    assert "tiny.yaml: results is 2024-05-01, which YAML takes for a timestamp" in said
    assert "Traceback" not in said
    said = study.run(
        "-n", "--config", "results=[a]", configuration=("config/quick.yaml",), refused=True
    )
    assert "results is not valid: ['a'] is not of type 'string'" in said
    again = written(tmp_path, yaml.safe_dump({"n_blocks": 24}) + "n_blocks: 36\n", "utf-8-sig")
    said = study.run("-n", configuration=("config/quick.yaml", again.name), refused=True)
    assert "a.yaml: the configuration: 'n_blocks' is given twice" in said
