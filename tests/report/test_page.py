"""What the report says, and that it takes nothing for its own that was only given to it."""

from dataclasses import asdict, replace

import numpy as np
import pyarrow as pa
import pytest

from springblock.claims import STATEMENTS
from springblock.claims.ranges import PLAIN, SCALED
from springblock.claims.rule import Case, Evidence
from springblock.claims.summary import counted, judged, values
from springblock.claims.table import rows
from springblock.cli import main
from springblock.io.records import read_records
from springblock.model.scene import Scene
from springblock.pages import rendered
from springblock.plotting.figures import FIGURES
from springblock.report import findings, markup, media
from springblock.report.markup import typeset
from springblock.report.page import page, statements


def realisations(friction, lag=-2e-6, seeds=5, scatter=1e-3, **lengths):
    """Rows of a table of realisations, with so much static friction and t_max - t_avg."""
    scene = Scene(120, **lengths)
    return [
        {
            **scene.row,
            "seed": seed,
            "static_friction": friction + scatter * np.sin(seed),
            "t_max": 1e-4 + lag + 1e-8 * np.cos(seed),
            "t_avg": 1e-4,
            "energy_error": -1e-5,
        }
        for seed in range(seeds)
    ]


def found(*samples, claims=()):
    rows = [row for sample in samples for row in sample]
    return findings.findings({"realisations": rows, "claims": claims})


def test_the_size_of_least_friction_follows_the_numbers_and_not_the_paper():
    flat, small = realisations(0.80), realisations(0.72, n_p=6, n_s=6)
    large = realisations(0.64, lag=3e-6, n_p=60, n_s=60)
    friction = found(flat, small, large)["friction"]
    assert friction["size"] == 60
    assert friction["sizes"] == [6, 60]
    assert "lower by 0.16" in friction["change"]
    assert [row[0] for row in friction["rows"]] == ["flat", "n_p = 6", "n_p = 60"]
    assert found(flat, small, large)["order"]["peaks"]["after"] == [60]
    turned = found(realisations(0.64), realisations(0.80, n_p=6, n_s=6))["friction"]
    assert "higher by 0.16" in turned["change"]


def test_no_minimum_is_claimed_where_the_statement_was_not_tested():
    flat, pillars = realisations(0.80), realisations(0.72, n_p=6, n_s=6)
    claims = rows(STATEMENTS, Evidence())
    assert found(flat, pillars, claims=claims)["friction"]["below"] == []
    assert found(claims=claims) == {}


def found_row(claim, value, verdict="reproduced", outcome="holds", **case):
    """A row of the table of statements, on one that the study does test."""
    assert claim in {each.title for each in STATEMENTS}
    limits = {"together_low": value - 0.01, "together_high": value + 0.01, "claimed_low": 0.01}
    named = {"claim": claim, "verdict": verdict, "outcome": outcome, "value": value}
    return limits | named | asdict(Case(**case))


def test_findings_take_their_numbers_from_the_statements():
    length, peaks, alone = (
        "Correlation length of about three blocks or more",
        "Two load peaks along grooves",
        "Without hierarchy one load peak",
    )
    claims = [
        found_row("Lowest static friction at an intermediate n_p", 0.17),
        found_row("Order of detachment on a pillar", 0.1, n_p=6),
        found_row("The order of detachment never changes", 0.33, "not reproduced", "fails", n_p=6),
        found_row(length, 2.7, fit=PLAIN, n_p=20),
        found_row(length, 3.6, fit=SCALED, n_p=20),
        found_row("Correlation length grows with n_p", -0.005, "not settled", "open", fit=SCALED),
        found_row(peaks, 0.004, outcome="fails", n_p=58, n_p2=4),
        found_row(peaks, 0.028, n_p=58, n_p2=8),
        found_row(alone, 0.012, outcome="fails", n_p=6),
        found_row(alone, 0.027, outcome="fails", n_p2=8, n_s2=2),
    ]
    told = found(realisations(0.80), realisations(0.63, n_p=6, n_s=6), claims=claims)
    assert told["friction"]["below"] == ["0.17 [0.16, 0.18]"]
    assert told["order"]["inward"]
    assert told["order"]["shares"] == [(6, "0.33 [0.32, 0.34]")]
    assert [name for (_, name), _ in told["correlation"]["fits"]] == ["l_d", "l_c"]
    assert told["correlation"]["growth"] == [("l_d", "", "-0.005 [-0.015, 0.005]")]
    assert [size for size, _ in told["peaks"]["along"]] == [8, 4]
    assert told["peaks"]["others"] == [
        ("pawls of 8 between grooves of 2 (no pillars)", "0.027 [0.017, 0.037]")
    ]


@pytest.mark.parametrize(
    ("verdict", "is_open"), [("reproduced", False), ("not settled", True), ("not tested", True)]
)
def test_a_study_says_whether_it_settles_that_two_peaks_need_hierarchy(verdict, is_open):
    along = found_row("Two load peaks along grooves", 0.028, n_p2=8)
    alone = found_row("Without hierarchy one load peak", 0.009, verdict, "open", n_p=6)
    assert found(claims=[along, alone])["peaks"]["is_open"] == is_open


def test_differences_within_the_scatter_are_not_significant():
    """Means that differ by less than their scatter, and single runs, which have none."""
    close = found(realisations(0.7, scatter=0.1), realisations(0.701, scatter=0.1, n_p=6, n_s=6))
    assert "not differ significantly" in close["friction"]["change"]
    single = found(realisations(0.8, seeds=1), realisations(0.6, seeds=1, n_p=6, n_s=6))
    assert "[no interval]" in single["friction"]["change"]
    assert single["order"]["peaks"]["unsettled"] == [0, 6]


def test_findings_are_those_on_the_side_with_the_most_realisations():
    few = [*realisations(0.8, seeds=2), *realisations(0.7, seeds=2, n_p=6, n_s=6)]
    many = [row | Scene(60).row for row in realisations(0.8, seeds=9)]
    assert set(findings.main_runs([*few, *many])) == {Scene(60)}


def test_constants_of_their_own_are_left_out_of_the_findings():
    varied = realisations(0.5, varied=(("pressure", 1e5),))
    assert findings.main_runs(varied) == {}
    assert found(varied) == {}


def test_each_statement_belongs_to_a_figure():
    assert {f"figure_{each.figure}" for each in STATEMENTS} <= FIGURES.keys()


def test_statements_link_to_where_their_page_says_more():
    table = rows(STATEMENTS, Evidence())
    body = markup.rendered("claims", rendered("claims.md", **values(table))).body
    made = statements(judged(table))
    assert counted(judged(table)) == {"not tested": len(STATEMENTS)}
    assert all(f'id="{statement["anchor"]}"' in body for statement in made)


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("[to](#the-end)", '<a href="#a-the-end">to</a>'),
        ("[out](https://x.org)", '<a href="https://x.org">out</a>'),
        ("n_p, `n_p`", "<var>n<sub>p</sub></var>, <code>n_p</code>"),
        ("## The end", '<h2 id="a-the-end">'),
        ("| l_c |\n|---|", "<th><var>l<sub>c</sub></var></th>"),
        ('<a id="l-c"></a>l_c', '<span id="a-l-c"></span>'),
        (r"If $\mu_s F_n > w$.", "<var>μ<sub>s</sub></var> <var>F<sub>n</sub></var> &gt; w."),
    ],
)
def test_links_headings_formulas_and_symbols_of_a_page_are_set(text, html):
    """Links within it, headings and anchors bear its name; symbols are set, but not in code."""
    page = markup.rendered("a", f"# T\n\n{text}\n")
    assert page.title == "T"
    assert html in page.body


def test_folded_parts_are_the_only_html_of_a_page():
    text = "<details><summary>n_p <= 3</summary>\n\nb\n\n</details>\n\n<details><b>\n"
    body = markup.rendered("a", text.replace("<=", "and")).body
    assert "<details><summary><var>n<sub>p</sub></var> and 3</summary>" in body
    assert body.count("<details>") == body.count("</details>") == 1
    body = markup.rendered("a", text).body  # not a plain title
    assert "<summary>" not in body


def test_pages_of_the_report_link_to_each_other():
    text = "[a](docs/model.md) [b](claims.md#the-rule) `docs/claims.md` `docs/model.md`\n"
    body = markup.rendered("a", text, pages={"claims"}).body
    assert '<a href="#claims-the-rule">b</a> <a href="#claims">claims</a>' in body
    assert body.count("href") == 2  # pages that the report lacks lead nowhere


def test_a_page_tells_what_opens_it():
    page = markup.rendered("a", "# T\n\none\n\n1. two\n\n## Q?\n\n### R\n\nyes\n\nso\n")
    one, two = page.opening
    assert one == "<p>one</p>\n"
    assert two.startswith("<ol>")


def test_symbols_are_set_and_nothing_but_symbols():
    assert typeset("t_max < l_c") == "<var>t<sub>max</sub></var> &lt; <var>l<sub>c</sub></var>"
    assert typeset("n_p2/n_s2") == "<var>n<sub>p2</sub></var>/<var>n<sub>s2</sub></var>"
    assert typeset("c_x of `rk4`") == "<var>c<sub>x</sub></var> of <code>rk4</code>"
    assert typeset("2μ_d/l_z²") == "2<var>μ<sub>d</sub></var>/<var>l<sub>z</sub></var>²"
    for name in ("level-1/n_p-2", "supplement_n_p", "n_p_x", "t_maximum", "static_friction"):
        assert typeset(name) == name


def test_a_table_leaves_out_what_is_the_same_in_all_rows():
    table = pa.table({"a": [1.0, 2.0], "b": [5.0, 5.0], "c": [np.nan, 0.123456789], "d": ["", ""]})
    shown = markup.shown("t", table)
    assert [(column["name"], value) for column, value in shown["same"]] == [("b", "5")]
    assert [column["name"] for column in shown["columns"]] == ["a", "c"]
    assert shown["rows"] == [("1", ""), ("2", "0.123457")]


def test_a_film_is_told_in_words(tmp_path):
    file = tmp_path / "run.parquet"
    options = ["--n-blocks", "12", "--n-p", "3", "--n-s", "3", "--first-seed", "4"]
    main(["simulate", *options, "--output", str(file)], standalone_mode=False)
    (run,) = read_records([file])
    said = media.in_words(run)
    assert said.startswith("N = 12, sliding direction x. Pillars n_p/n_s = 3/3 (seed 4). 36 ")
    assert f" {1e6 * run.t_max:.1f} µs" in said
    early = np.where(np.arange(144).reshape(12, 12) % 7 == 0, 0.0, np.nan)  # a few, and no others
    few = np.where(run.contact, early, np.nan)
    share = 100.0 * np.isfinite(few).sum() / 36
    assert media.in_words(replace(run, t_det=few)).endswith(f"when {share:.1f} % have detached.")
    still = replace(run, t_det=np.full_like(run.t_det, np.nan))  # ends before a block detaches
    assert "nan" not in media.in_words(still)


def test_captions_are_those_that_pictures_keep(picture):
    declared = FIGURES["figure_6"]
    shown = media.picture(picture("figure_6.png", f"{declared.caption} N = 120, seeds 0 to 19."))
    assert (shown["caption"], shown["sample"]) == (declared.caption, "N = 120, seeds 0 to 19.")
    assert declared.title in shown["title"]
    assert media.picture(picture("sweep_x.png", "Another."))["caption"] == "Another."


def test_nothing_given_becomes_part_of_the_page(nasty):
    """Names of files, captions, tables and pages may hold what looks like HTML."""
    text = nasty.read_text(encoding="utf-8")
    assert "<img src=x" not in text
    assert 'href="javascript:' not in text
    assert text.count("&lt;img src=x") >= 8


def test_a_page_of_the_same_files_has_the_same_bytes(picture):
    files = [picture("figure_1.png", "a"), picture("stability.png", "b")]
    assert page(files, {}) == page(files, {})


def test_a_file_that_is_neither_picture_page_nor_table_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"of type \.png, \.md, \.parquet, not .*notes\.txt"):
        page([tmp_path / "notes.txt"], {})
