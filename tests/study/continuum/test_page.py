"""The page on the continuum limit has the numbers of its table, and no sentence against them."""

import pytest

from springblock.study.continuum.page import values
from springblock.study.pages import rendered
from study.continuum.chapter import rows


@pytest.mark.parametrize(
    "number",
    [
        "are 0.0010 and 0.0010",  # the largest differences
        "| d_c = 100 nm | 0.94 | 70 | 70 | 7.0 | 0.8000 | 0.8010 |",
        "| slip weakening | 100 |  | 0.8175 | 0.8147 | 0.8140 |",  # 0.015 (l/l_z)²
        "100 nm,\nagainst 70 µm",
        "is up to 0.10 higher",  # with healing and the paper's damping
    ],
)
def test_the_page_has_the_numbers_of_its_table(number):
    assert number in rendered("continuum/page.md", **values(rows()))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"shape": "across", "simulated": lambda row: 0.1 - row["width"]},
            "Theory and solver agree",
        ),
        (
            {"what": "Coulomb", "simulated": lambda row: 0.9 - 1e4 * row["spacing"]},
            "Under Coulomb friction",
        ),
        ({"what": "pawls", "prominence": lambda row: 0.02}, r"\*\*There is no second"),
        (
            {"what": "healing", "simulated": lambda row: row["simulated"] + 0.002},
            r"- \*\*Healing with light damping",
        ),
    ],
)
def test_a_sentence_against_the_table_is_refused(change, sentence):
    (key, value), (name, other) = change.items()
    cells = [row | {name: other(row)} if row[key] == value else row for row in rows()]
    with pytest.raises(ValueError, match=f"contradict “{sentence}"):
        rendered("continuum/page.md", **values(cells))
