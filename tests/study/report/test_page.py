"""What the report says, and that it takes nothing for its own that was only given to it."""

import re
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest

from springblock.io.parquet import rows_to_table, write
from springblock.io.records import read_records
from springblock.study.claims import STATEMENTS
from springblock.study.claims.rule import Evidence
from springblock.study.claims.table import SCHEMA, rows
from springblock.study.report import markup, media
from springblock.study.report.markup import typeset
from springblock.study.report.page import report_page as page
from springblock.study.results import FIGURES


def test_figures_have_all_that_is_said_of_their_statements_and_the_verdicts(picture, tmp_path):
    """Here of a study without data."""
    table = tmp_path / "claims.parquet"
    write(rows_to_table(rows(STATEMENTS, Evidence()), SCHEMA), table, {})
    figures = [picture(f"figure_{i}.png", "a") for i in range(1, 10)]
    text = page([table, *figures], {})
    for each in STATEMENTS:
        part = text.partition(f'id="statement-{each.id}"')[2].partition("</details>")[0]
        texts = (each.title, each.words, each.criterion, each.remark, each.changed)
        for said in (*map(typeset, texts), "0 of 0 cases hold"):
            assert str(said) in part
    assert "verdicts of this study" not in page(figures, {})


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("[to](#the-end)", '<a href="#a-the-end">to</a>'),
        ("[out](https://x.org)", '<a href="https://x.org">out</a>'),
        ("n_p, `n_p`", "<var>n<sub>p</sub></var>, <code>n_p</code>"),
        ("## The end", '<h2 id="a-the-end">'),
        ("| l_c |\n|---|", "<th><var>l<sub>c</sub></var></th>"),
        ('<a id="l-c"></a>l_c', '<span id="a-l-c"></span>'),
        (
            "[b](claims.md#the-rule) `docs/claims.md` [a](docs/model.md) `docs/model.md`",
            '<p><a href="#claims-the-rule">b</a> <a href="#claims">claims</a> '
            "<a>a</a> <code>docs/model.md</code></p>",
        ),
        ("![a < b](figure_6.png) ![c](figure_7.png)", '<p><a href="#figure_6">a &lt; b</a> c</p>'),
        (r"If $\mu_s F_n > w$.", "<var>μ<sub>s</sub></var> <var>F<sub>n</sub></var> &gt; w."),
    ],
)
def test_links_headings_formulas_and_symbols_of_a_page_are_set(text, html):
    """Links within it, headings and anchors bear its name; symbols are set, but not in code.

    Pages and pictures are links to pages and figures of the report; what it lacks leads nowhere.
    """
    page = markup.rendered("a", f"# T\n\n{text}\n", pages={"claims", "figure_6"})
    assert page.title == "T"
    assert html in page.body


def test_symbols_are_set_and_nothing_but_symbols():
    said = "2<var>μ<sub>d</sub></var>/<var>l<sub>z</sub></var>² &lt; <code>rk4</code>"
    assert typeset("2μ_d/l_z² < `rk4`") == said
    for name in ("level-1/n_p-2", "supplement_n_p", "n_p_x", "t_maximum", "static_friction"):
        assert typeset(name) == name


def test_a_table_leaves_out_what_is_the_same_in_all_rows():
    table = pa.table({"a": [1.0, 2.0], "b": [5.0, 5.0], "c": [np.nan, 0.123456789], "d": ["", ""]})
    shown = markup.shown("t", table)
    assert [(column["name"], value) for column, value in shown["same"]] == [("b", "5")]
    assert [column["name"] for column in shown["columns"]] == ["a", "c"]
    assert shown["rows"] == [("1", ""), ("2", "0.123457")]


def test_a_film_says_when_blocks_detach(springblock, tmp_path):
    file, scene = tmp_path / "run.parquet", ("--n-blocks", 12, "--n-p", 3, "--n-s", 3)
    springblock("simulate", *scene, "--first-seed", 4, "--output", file)
    (run,) = read_records([file])
    said = media.told(run)
    assert said["scene"] == str(run.scene)
    assert (said["seed"], said["blocks"]) == (4, 36)
    assert said["detached"]["t_max"] == 1e6 * run.t_max
    assert said["detached"]["before"] == 100.0 * np.sum(run.t_det < run.t_max) / 36
    still = replace(run, t_det=np.full_like(run.t_det, np.nan))  # ends before a block detaches
    assert not media.told(still)["detached"]


def test_means_are_those_of_ensembles_with_the_constants_of_the_study(springblock, tmp_path):
    own, other, table = (tmp_path / f"{name}.parquet" for name in ("own", "other", "realisations"))
    how = "simulate", "--n-blocks", 8, "--duration", 2e-6, "--output"
    springblock(*how, own)
    springblock(*how, other, "--gamma", "4321")
    springblock("aggregate", own, other, "--output", table)
    said = re.sub(r"<script.*", "", page([table], {}), flags=re.DOTALL)
    means = said.partition('id="means"')[2].partition("</section>")[0]
    assert means.count("<tr>") == 2  # a heading and one ensemble
    assert "4321" not in means
    assert "2 realisations" in said


def test_a_report_on_own_patterns_says_that_friction_depends_on_the_lattice(springblock, tmp_path):
    table = tmp_path / "realisations.parquet"
    for pattern, is_said in ((), False), (("--n-p", 4, "--n-s", 4), True):
        scene = "--n-blocks", 8, *pattern
        springblock("simulate", *scene, "--duration", 2e-6, "--output", tmp_path / "own")
        springblock("aggregate", tmp_path / "own", "--output", table)
        assert ("depends on the spacing" in page([table], {}, own=True)) == is_said


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


def test_a_file_that_is_neither_picture_page_nor_table_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"of type \.png, \.md, \.parquet, not .*notes\.txt"):
        page([tmp_path / "notes.txt"], {})
