"""What the report says, and that it takes nothing for its own that was only given to it."""

import re
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest

from springblock.claims import CLAIMS
from springblock.claims.rule import Evidence
from springblock.claims.table import rows
from springblock.cli import main
from springblock.io.records import read_records
from springblock.model.scene import Scene
from springblock.plotting.figures import FIGURES
from springblock.report import findings, markup, media
from springblock.report.markup import typeset
from springblock.report.page import counted, page, statements


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


def told(*samples):
    runs = findings.main_runs([row for sample in samples for row in sample])
    return {headline.subject: headline.text for headline in findings.headlines(runs)}


def test_findings_follow_the_numbers_and_not_the_paper():
    flat, pillars = realisations(0.80), realisations(0.64, n_p=6, n_s=6)
    large = realisations(0.72, lag=3e-6, n_p=60, n_s=60)
    found = told(flat, pillars, large)
    size = found["Friction and the size of pillars"]
    assert "on pillars of n_p = 6, the lowest mean of those simulated: lower by 0.1" in size
    assert re.search("On the largest, n_p = 60, it is .*: higher by 0.0", size)
    order = found["Force and detachments"]
    assert "before the mean first detachment on the flat surface and pillars of n_p = 6" in order
    assert order.endswith("; after it on pillars of n_p = 60.")
    turned = told(realisations(0.64), realisations(0.80, n_p=6, n_s=6))
    assert "the only ones simulated: higher by" in turned["Friction and the size of pillars"]


def test_what_the_intervals_do_not_tell_apart_is_not_said_to_differ():
    """Means that differ by less than their scatter, and single runs, which have none."""
    close = told(realisations(0.7, scatter=0.1), realisations(0.701, scatter=0.1, n_p=6, n_s=6))
    assert "not told apart" in close["Friction and the size of pillars"]
    single = told(realisations(0.8, seeds=1), realisations(0.6, seeds=1, n_p=6, n_s=6))
    assert "not told apart" in single["Friction and the size of pillars"]
    assert "[no interval]" in single["Friction and the size of pillars"]
    assert (
        "not told from the mean first detachment on the flat surface"
        in single["Force and detachments"]
    )


def test_grooves_are_compared_along_and_across():
    lengths = {"n_p": 58, "n_s": 62, "n_p2": 8, "n_s2": 2}
    along, across = (realisations(f, **lengths, direction=d) for f, d in ((0.7, "x"), (0.6, "y")))
    assert told(along, across)["Grooves"].endswith("is higher on 1 of 1 grooved surfaces.")
    (row,) = findings.grooves(findings.main_runs([*along, *across]))
    assert row[0] == "n_p/n_s = 58/62, n_p2/n_s2 = 8/2"
    assert "Grooves" not in told(along)


def test_constants_of_their_own_are_left_out_of_the_findings():
    varied = realisations(0.5, varied=(("pressure", 1e5),))
    assert findings.main_runs(varied) == {}
    assert told() == {}


def test_each_statement_belongs_to_a_figure():
    assert {f"figure_{claim.figure}" for claim in CLAIMS} <= FIGURES.keys()


def test_statements_link_to_where_their_page_says_more():
    from springblock.claims.page import page as claims_page

    table = rows(CLAIMS, Evidence())
    _, body = markup.rendered("claims", claims_page(table))
    made = statements(table)
    assert counted(made) == {"not tested": len(CLAIMS)}
    assert all(f'id="{statement["anchor"]}"' in body for statement in made)


def test_links_headings_and_symbols_of_a_page_are_set():
    """Links within it and headings become its own; symbols are set in words, not in code."""
    text = "# T\n\n[to](#the-end) [out](https://x.org) n_p, `n_p`\n\n## The end\n\n| l_c |\n|---|\n"
    title, body = markup.rendered("a", text)
    assert title == "T"
    assert '<a href="#a-the-end">to</a>' in body
    assert '<h2 id="a-the-end">' in body
    assert 'href="https://x.org"' in body
    assert "<var>n<sub>p</sub></var>, <code>n_p</code>" in body
    assert "<th><var>l<sub>c</sub></var></th>" in body


def test_folded_parts_are_the_only_html_of_a_page():
    text = "<details><summary>n_p <= 3</summary>\n\nb\n\n</details>\n\n<details><b>\n"
    _, body = markup.rendered("a", text.replace("<=", "and"))
    assert "<details><summary><var>n<sub>p</sub></var> and 3</summary>" in body
    assert body.count("<details>") == body.count("</details>") == 1
    _, body = markup.rendered("a", text)  # not a plain title
    assert "<summary>" not in body


def test_symbols_are_set_and_nothing_but_symbols():
    assert typeset("t_max < l_c") == "<var>t<sub>max</sub></var> &lt; <var>l<sub>c</sub></var>"
    assert typeset("n_p2/n_s2") == "<var>n<sub>p2</sub></var>/<var>n<sub>s2</sub></var>"
    for name in ("supplement_n_p", "n_p_x", "t_maximum", "static_friction", "n_blocks"):
        assert typeset(name) == name


def test_a_table_leaves_out_what_is_the_same_in_all_rows():
    table = pa.table({"a": [1.0, 2.0], "b": [5.0, 5.0], "c": [np.nan, 0.123456789], "d": ["", ""]})
    shown = markup.shown("t", table)
    assert shown["same"] == ["b = 5"]
    assert [column["name"] for column in shown["columns"]] == ["a", "c"]
    assert shown["rows"] == [("1", ""), ("2", "0.123457")]


def test_a_film_is_told_in_words(tmp_path):
    file = tmp_path / "run.parquet"
    options = ["--n-blocks", "12", "--n-p", "3", "--n-s", "3", "--first-seed", "4"]
    main(["simulate", *options, "--output", str(file)], standalone_mode=False)
    (run,) = read_records([file])
    said = media.in_words(run)
    assert said.startswith("N = 12, sliding direction x. Pillars n_p/n_s = 3/3 (seed 4). 36 blocks")
    assert f"The force is largest at {1e6 * run.t_max:.1f} µs" in said
    still = replace(run, t_det=np.full_like(run.t_det, np.nan))  # ends before a block lets go
    assert media.in_words(still).endswith("None of them lets go.")


def test_captions_are_those_that_pictures_keep(picture):
    written = page([picture("figure_6.png", "N = 120, seeds 0 to 19.")], {})
    assert "<figcaption>N = 120, seeds 0 to 19.</figcaption>" in written
    assert FIGURES["figure_6"].title in written


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
