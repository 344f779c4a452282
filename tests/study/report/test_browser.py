"""The report of a study, clicked through in a browser, wide and narrow."""

import numpy as np
import pandas as pd
import pytest
from playwright.sync_api import expect

from studies import ROOT

#: Pictures without words for those who do not see them.
MUTE = "img:not([alt]), img[alt='']"
OVERFLOW = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
BROKEN = "[...document.images].filter((i) => i.complete && !i.naturalWidth).length"


@pytest.fixture(scope="module")
def whole(study, springblock, tmp_path_factory):
    """A report of the tiny study with those pages, too, that only a whole study has."""
    results, output = study / "results", tmp_path_factory.mktemp("report") / "report.html"
    pages = [results / "claims.md", ROOT / "docs/accuracy.md", ROOT / "docs/mechanism.md"]
    figures, tables = (sorted(results.glob(kind)) for kind in ("figures/*.png", "tables/*.parquet"))
    run, film = next(results.glob("realisations/**/*.parquet")), results / "films/flat.gif"
    springblock("report", *figures, *tables, *pages, "--film", film, run, "--output", output)
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


def test_friction_stands_beside_its_surface_on_a_narrow_page(whole, opened):
    page = opened(whole, 390)
    page.locator("nav a[href='#means']").click()
    expect(page.locator("#means th").nth(1)).to_have_text("static friction")
    expect(page.locator("#means td").nth(1)).to_be_in_viewport(ratio=1)


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
