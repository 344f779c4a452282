"""The report of a study, clicked through in a browser, wide and narrow."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from playwright.sync_api import expect

from springblock.__main__ import main
from springblock.io.parquet import write
from springblock.study.report.page import report_page as written
from studies import ROOT

#: Pictures without words for those who do not see them.
MUTE = "img:not([alt]), img[alt='']"
OVERFLOW = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
BROKEN = "[...document.images].filter((i) => i.complete && !i.naturalWidth).length"


@pytest.fixture(scope="module")
def whole(study, tmp_path_factory):
    """A report of the tiny study with those pages, too, that only a whole study has."""
    results, output = study / "results", tmp_path_factory.mktemp("report") / "report.html"
    pages = [results / "claims.md", ROOT / "docs/accuracy.md", ROOT / "docs/mechanism.md"]
    figures, tables = (sorted(results.glob(kind)) for kind in ("figures/*.png", "tables/*.parquet"))
    run, film = next(results.glob("realisations/**/*.parquet")), results / "films/flat.gif"
    files = map(str, [*figures, *tables, *pages, "--film", film, run, "--output", output])
    main(["report", *files], standalone_mode=False)
    return output


@pytest.mark.parametrize("width", [1280, 390])
def test_every_part_of_the_report_is_shown(whole, opened, width):
    page = opened(whole, width)
    names = page.locator("nav a").evaluate_all("links => links.map((a) => a.hash.slice(1))")
    assert " ".join(names) == "findings means figures claims mechanism accuracy films tables"
    for name in names:
        page.locator(f"nav a[href='#{name}']").click()
        expect(page.locator(f"#{name} h1")).to_be_in_viewport()
        page.locator(f"#{name} details").evaluate_all("every => every.map((d) => (d.open = true))")
        assert page.evaluate(OVERFLOW) <= 0, name
        assert page.locator(MUTE).count() == page.evaluate(BROKEN) == 0, name


def test_tables_are_searched_and_sorted(opened, tmp_path):
    held, report = tmp_path / "held.parquet", tmp_path / "report.html"
    sizes = [20, 6, 100] * 10
    made = {"n_p": sizes, "t_max": [1e-6 * n for n in sizes], "N": [120] * 30}
    write(pa.table(made | {"surface": ["flat", "pillars"] * 15}), held, {})
    report.write_text(written([held], {}), encoding="utf-8")
    page = opened(report)
    page.locator("nav a[href='#tables']").click()
    table = page.locator("#table-held")
    table.locator("summary").first.click()
    rows, searched = table.locator("tbody tr:visible"), table.locator("input[type=search]")
    for words, number in {"FLAT": 15, "pillars 100": 5, "nothing holds this": 0, "": 30}.items():
        searched.fill(words)
        assert rows.count() == number, words
    for first in "6", "100":  # up, then down
        table.locator("th button", has_text="t_max").click()
        assert rows.first.locator("td").first.inner_text() == first


def test_a_search_of_the_report_leads_to_what_it_finds(study, opened):
    page = opened(study / "results/report.html")
    page.locator("#search").fill("n_p2 pawls")
    results = page.locator("#results button")
    assert results.count() > 0
    results.last.click()
    expect(page.locator(":focus")).to_be_in_viewport()
    expect(page.locator(":focus")).to_contain_text("pawls")
    page.locator("#search").fill("nothing holds this")
    assert results.count() == 0


def test_figures_and_tables_are_saved_whole(study, opened, tmp_path):
    page = opened(study / "results/report.html")

    def saved(button):
        with page.expect_download() as download:
            button.click()
        file = tmp_path / download.value.suggested_filename
        download.value.save_as(file)
        return file

    page.locator("nav a[href='#figures']").click()
    assert saved(page.locator("#figure_4 .save")).read_bytes().startswith(b"\x89PNG")
    page.locator("nav a[href='#tables']").click()
    table = page.locator("#table-realisations")
    table.locator("summary").first.click()
    kept = study / "results/tables/realisations.parquet"
    assert saved(table.locator("a.save")).read_bytes() == kept.read_bytes()
    whole, read = pd.read_parquet(kept), pd.read_csv(saved(table.locator("button.save")))
    assert len(read) == len(whole)
    assert np.allclose(read["static_friction"], whole["static_friction"], rtol=1e-5)
    assert set(read["integrator"]) == {"leapfrog"}  # said above the table


def test_what_looks_like_html_does_nothing(nasty, opened):
    page = opened(nasty)
    assert page.locator("img[src=x]").count() == 0
    assert page.evaluate("[...document.querySelectorAll('[onerror]')].length") == 0
