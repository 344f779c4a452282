"""The report of a study, clicked through in a browser, wide and narrow."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from PIL import Image
from playwright.sync_api import expect

from springblock.cli import main
from springblock.io.parquet import write
from springblock.report.page import page as written
from studies import ROOT

#: Pictures and films without words for those who do not see them.
MUTE = "img:not([alt]), img[alt=''], video:not([aria-label]), video[aria-label='']"
OVERFLOW = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
BROKEN = "[...document.images].filter((i) => i.complete && !i.naturalWidth).length"


@pytest.fixture(scope="session")
def every_page(study, tmp_path_factory):
    """A report of the tiny study with those pages, too, that only a whole study has."""
    results, output = study / "results", tmp_path_factory.mktemp("report") / "report.html"
    pages = [results / "claims.md", ROOT / "docs/accuracy.md", ROOT / "docs/beyond.md"]
    figures, tables = (sorted(results.glob(kind)) for kind in ("figures/*.png", "tables/*.parquet"))
    files = map(str, [*figures, *tables, *pages])
    main(["report", *files, "--output", str(output)], standalone_mode=False)
    return output


def shown(page):
    """Names of the parts that are to be seen."""
    return page.locator("section.part").evaluate_all(
        "parts => parts.filter((part) => part.checkVisibility()).map((part) => part.id)"
    )


def click_through(page):
    """Visit every part, and open all that is folded."""
    names = page.locator("nav a").evaluate_all("links => links.map((a) => a.hash.slice(1))")
    for name in names:
        page.locator(f"nav a[href='#{name}']").click()
        expect(page.locator(".part:visible")).to_have_attribute("id", name)
        expect(page.locator("nav a[aria-current]")).to_be_in_viewport(ratio=0.99)
        for fold in page.locator(f"#{name} details:not([open]) > summary").element_handles():
            fold.click()
        assert page.evaluate(OVERFLOW) <= 0, name
        assert page.locator(MUTE).count() == page.evaluate(BROKEN) == 0, name
    return names


def test_every_part_of_the_report_is_shown(study, opened):
    names = click_through(opened(study / "results/report.html"))
    assert names == ["findings", "claims", "figures", "films", "tables"]


def test_every_page_of_a_whole_study_is_shown(every_page, opened):
    names = click_through(opened(every_page))
    assert {"claims", "accuracy", "beyond"} <= set(names)


def test_a_link_to_a_statement_opens_it(study, opened):
    page = opened(study / "results/report.html")
    page.locator("nav a[href='#claims']").click()
    page.locator(".verdicts > summary").first.click()
    statement = page.locator(".verdicts .statement").first
    statement.locator("summary").click()
    link = statement.get_by_text("All that was found")
    target = page.locator(f"[id='{link.get_attribute('href')[1:]}']")
    link.click()
    assert shown(page) == ["claims"]
    assert target.locator("xpath=ancestor::details").get_attribute("open") is not None


def test_tables_are_searched_and_sorted(study, opened):
    page = opened(study / "results/report.html")
    page.locator("nav a[href='#tables']").click()
    table = page.locator("#table-claims")
    table.locator("summary").first.click()
    rows = table.locator("tbody tr:visible")
    everything = rows.count()
    table.locator("input[type=search]").fill("pillars FLAT")
    assert 0 < rows.count() < everything
    found = [text.lower() for text in rows.all_inner_texts()]
    assert all("flat" in text and "pillars" in text for text in found)
    table.locator("input[type=search]").fill("nothing holds this")
    assert rows.count() == 0
    table.locator("input[type=search]").fill("")
    table.locator("input[type=search]").fill("form=universal pillars")
    assert 0 < rows.count() < everything
    assert all("universal" in text for text in rows.all_inner_texts())
    table.locator("input[type=search]").fill("")
    head = table.locator("th", has_text="section")
    firsts = []
    for _ in "up", "down":
        head.locator("button").click()
        column = head.evaluate("head => head.cellIndex")
        firsts.append(float(table.locator("tbody tr").first.locator("td").nth(column).inner_text()))
    assert firsts[0] < firsts[1]


def test_a_search_of_a_table_compares_numbers(opened, tmp_path):
    """On columns, and on what is the same in all rows and stands above them."""
    held, report = tmp_path / "held.parquet", tmp_path / "report.html"
    sizes = [6, 20, 60] * 10
    write(pa.table({"n_p": sizes, "t_max": [1e-6 * n for n in sizes], "N": [120] * 30}), held, {})
    report.write_text(written([held], {}), encoding="utf-8")
    page = opened(report)
    page.locator("nav a[href='#tables']").click()
    table = page.locator("#table-held")
    table.locator("summary").first.click()
    rows, numbers = table.locator("tbody tr:visible"), []
    for condition in ("n_p=6", "n_p > 6", "t_max<=2e-5", "N=120 n_p=60.0", "N=12", "n_s=6"):
        table.locator("input[type=search]").fill(condition)
        numbers.append(rows.count())
    assert numbers == [10, 20, 20, 10, 0, 0]


def test_a_search_of_the_report_leads_to_what_it_finds(study, opened):
    page = opened(study / "results/report.html")
    page.locator("#search").fill("n_p2 pawls")
    results = page.locator("#results button")
    assert results.count() > 0
    results.last.click()
    found = page.locator(".found")
    expect(found).to_be_in_viewport()
    assert "pawls" in found.inner_text()
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
    with Image.open(saved(page.locator("#figure_4 .save"))) as picture:
        assert picture.format == "PNG"
        assert picture.width == page.locator("#figure_4 img").evaluate("i => i.naturalWidth")
    page.locator("nav a[href='#tables']").click()
    table = page.locator("#table-realisations")
    table.locator("summary").first.click()
    kept = study / "results/tables/realisations.parquet"
    assert saved(table.locator("a.save")).read_bytes() == kept.read_bytes()
    whole, read = pd.read_parquet(kept), pd.read_csv(saved(table.locator("button.save")))
    assert len(read) == len(whole)
    assert np.allclose(read["static_friction"], whole["static_friction"], rtol=1e-5)
    assert set(read["integrator"]) == {"leapfrog"}  # said above the table


def test_figures_can_be_enlarged_in_their_own_box(study, opened):
    page = opened(study / "results/report.html")
    frame = page.locator("#figure_6 .frame")
    widths = []
    for _ in range(2):
        widths.append(frame.locator("img").bounding_box()["width"])
        frame.press("Enter")
        assert page.evaluate(OVERFLOW) <= 0
    assert widths[0] < widths[1]
    assert frame.bounding_box()["width"] < widths[1]


def test_films_wait_until_they_are_started(study, opened):
    page = opened(study / "results/report.html")
    page.locator("nav a[href='#films']").click()
    assert page.locator("video").count() == 3
    for film in page.locator("video").all():
        assert film.evaluate("film => film.paused && film.controls && !film.autoplay")
        film.evaluate("film => film.play()")
        page.wait_for_function("film => film.currentTime > 0", arg=film.element_handle())


def test_without_scripts_all_parts_can_be_read(study, browser):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((study / "results/report.html").as_uri())
    for name in ("findings", "figures", "films", "claims", "tables"):
        assert page.locator(f"#{name} h1").is_visible()
    context.close()


def test_what_looks_like_html_does_nothing(nasty, opened):
    page = opened(nasty)
    assert page.locator("img[src=x]").count() == 0
    assert page.evaluate("[...document.querySelectorAll('[onerror]')].length") == 0
