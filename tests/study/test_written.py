"""Configurations as they are written: what YAML would drop or convert without a word."""

import pytest

from springblock.study.written import check_file
from studies import Study

#: What is written, and words of the sentence about it.
WRITTEN = {
    "a group twice": (
        "scenes:\n  a: {seeds: 2}\n  a: {seeds: 3}\n",
        "scenes has the key 'a' twice",
    ),
    "a key twice": ("step: 1.0e-8\nstep: 2.0e-8\n", "has the key 'step' twice"),
    "an octal number": ("n_blocks: 010\n", "n_blocks is 010, which YAML takes for 8"),
    "sixties": ("n_blocks: 1:30\n", "n_blocks is 1:30, which YAML takes for 90"),
    "an underscore": ("n_blocks: 1_2\n", "n_blocks is 1_2, which YAML takes for 12"),
    "a hexadecimal number": ("n_blocks: 0x1F\n", "n_blocks is 0x1F, which YAML takes for 31"),
    "infinity": ("step: .inf\n", "step is .inf, which YAML takes for inf"),
    "a date": ("results: 2024-05-01\n", "results is 2024-05-01, which YAML takes for a timestamp"),
    "itself": ("scenes: &a {b: *a}\n", "contains itself"),
    "aliases of aliases": (
        "a: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n"
        + "".join(f"b{i}: &a{i} [{', '.join(10 * [f'*a{i - 1}'])}]\n" for i in range(1, 9)),
        "or has more than 1000000 values with its aliases",
    ),
    "no YAML": ("scenes: [\n", "while parsing"),
}


@pytest.mark.parametrize(("text", "sentence"), WRITTEN.values(), ids=WRITTEN)
def test_what_is_not_meant_is_refused_in_one_sentence(tmp_path, text, sentence):
    file = tmp_path / "mine.yaml"
    file.write_text(text)
    with pytest.raises(ValueError, match=r"mine\.yaml: ") as refused:
        check_file(file)
    assert sentence in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_byte_order_mark_is_none_of_the_configuration(tmp_path):
    (tmp_path / "mine.yaml").write_text("\ufeffstep: 1.0e-8\n", encoding="utf-8")
    check_file(tmp_path / "mine.yaml")


def test_snakemake_refuses_a_group_that_is_given_twice(tmp_path):
    study = Study.begun(tmp_path / "study")
    (study / "tiny.yaml").write_text(
        (study / "tiny.yaml").read_text() + "step: 1.0e-8\nstep: 2e-8\n"
    )
    said = study.run("--dry-run", refused=True)
    assert "tiny.yaml: it has the key 'step' twice; remove one, or rename it" in said
    assert "Traceback" not in said
