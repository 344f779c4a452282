"""The findings of the full study: sentences that its tables contradict are refused."""

from dataclasses import asdict

import pytest

from springblock.analysis.lowest import lowest
from springblock.io.identity import identity
from springblock.model.scene import Scene
from springblock.study.claims.rule import Case
from springblock.study.findings.page import by_size, values
from springblock.study.pages import rendered
from study.accuracy.test_page import production_rows
from study.continuum.test_page import rows as unit_cells


def finding(name, value, verdict="reproduced", outcome="holds", **case):
    """A row of the table of statements."""
    limits = {"together_low": value - 0.01, "together_high": value + 0.01}
    limits |= {"claimed_low": 0.01, "claimed_high": 0.5, "unit": "1", "holds": 1, "cases": 2}
    return {"id": name, "verdict": verdict, "outcome": outcome, "value": value, **limits} | asdict(
        Case(**case)
    )


SCALED = "A exp(-r/l_c)"
CLAIMS = [
    finding("intermediate_size", 0.17),
    finding("intermediate_size", 0.08),
    finding("detachment_order", 0.1, n_p=6),
    finding("always_in_order", 0.33, "not reproduced", "fails", n_p=6, part="single pillars"),
    finding("always_in_order", 0.86, "not reproduced", "fails", n_p=20, part="single pillars"),
    finding("three_blocks", 3.7, fit=SCALED, n_p=60),
    finding("size_like_length", 0.2, "not reproduced", "fails", fit=SCALED),
    finding("size_like_length", 6.0, "not reproduced", "fails", fit=SCALED),
    finding("two_peaks", 0.028, "reproduced in part", n_p=58, n_p2=8),
    finding("hierarchy_needed", 0.002, n_p=20),
    finding("hierarchy_needed", 0.027, "not reproduced", "fails", n_p2=8, n_s2=2),
]


def realisations(n_blocks, frictions):
    """Three runs on pillars of each size, with so much static friction."""
    return [
        identity(Scene(n_blocks, n_p=n_p, n_s=n_p)) | {"static_friction": friction + bias}
        for n_p, friction in frictions.items()
        for bias in (-1e-4, 0.0, 1e-4)
    ]


PAPER = realisations(120, {0: 0.79, 2: 0.8, 6: 0.62, 20: 0.68}) + realisations(126, {7: 0.6202})
EDGES = [{"edge": "along", "what": "paper", "quantity": "l_c", "predicted": 2.7, "simulated": 2.6}]


def rendered_from(claims):
    """The page from these rows of the table of statements."""
    found = values(claims, PAPER, unit_cells(), production_rows(), EDGES)
    return rendered("findings/page.md", **found)


def test_the_size_of_lowest_friction_is_that_of_the_papers_pillars():
    """Other lattices, gaps, constants and directions do not count."""
    other = [Scene(60, n_p=30, n_s=30), Scene(120, n_p=3, n_s=1)]
    other += [Scene(120, n_p=3, n_s=3, direction="y")]
    other += [Scene(120, n_p=3, n_s=3, thickness=4e-5)]
    found = by_size([*PAPER, *(identity(each) | {"static_friction": 0.1} for each in other)])
    del found[0]
    assert lowest(found) == (6, [6, 7])


def test_findings_have_the_values_of_the_tables():
    text = rendered_from(CLAIMS)
    for value in (
        "0.620 on pillars of six, 0.790 on a flat",
        "86 % of single",
        "gives 2.70 blocks",
    ):
        assert value in text


@pytest.mark.parametrize("place", [0, 2, 3, 4, 6, 8, 10])
def test_findings_are_refused_where_their_statement_turns_out_otherwise(place):
    """The others are not named."""
    turned = {"verdict": "not settled", "outcome": "open", "value": 0.5}
    claims = [row | turned if i == place else row for i, row in enumerate(CLAIMS)]
    with pytest.raises(ValueError, match="contradict"):
        rendered_from(claims)
