"""Files for a report, a browser to read it in, and what the browser complains about."""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
import pytest
from PIL import Image, PngImagePlugin

from springblock.io.parquet import write
from springblock.study.claims import STATEMENTS
from springblock.study.claims.rule import Evidence
from springblock.study.claims.table import rows
from springblock.study.report.page import report_page as page

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
ON_MACOS = "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome"

NASTY = "<img src=x onerror=alert(1)>"


@pytest.fixture
def picture(tmp_path):
    """Write a picture with a caption, as figures are saved."""

    def write(name: str, caption: str) -> Path:
        info = PngImagePlugin.PngInfo()
        info.add_text("Description", caption)
        Image.new("RGB", (40, 20)).save(tmp_path / name, pnginfo=info)
        return tmp_path / name

    return write


@pytest.fixture
def nasty(tmp_path, picture) -> Path:
    """A report of files whose names and contents look like HTML."""
    names = (f"{NASTY}.md", f"{NASTY}.parquet", "claims.parquet")
    text, table, claims = (tmp_path / name for name in names)
    text.write_text(f"# {NASTY}\n\n{NASTY} [x](javascript:alert(1))\n\n## {NASTY}\n")
    write(pa.table({NASTY: [NASTY, "a"], "b": [NASTY, NASTY]}), table, {})
    said = [row | {"claim": NASTY, "section": NASTY} for row in rows(STATEMENTS[:1], Evidence())]
    write(pa.Table.from_pylist(said), claims, {})
    report = tmp_path / "report.html"
    files = [picture(f"sweep_{NASTY}.png", f'" onerror="alert(1) {NASTY}'), text, table, claims]
    report.write_text(page(files, {}), encoding="utf-8")
    return report


@pytest.fixture(scope="session")
def browser():
    """Headless Chromium; tests without it are skipped, but not where CI must run them."""
    installed = filter(None, map(shutil.which, [*NAMES, ON_MACOS]))
    if (place := next(installed, None)) is None:
        told = f"no browser is called {', '.join(NAMES)}; `make browser` installs one"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(told)
    from playwright.sync_api import sync_playwright

    # the sandbox, which keeps foreign pages from the system, is not to be had as root
    options = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as play:
        started = play.chromium.launch(executable_path=place, args=options)
        yield started
        started.close()


@pytest.fixture
def opened(browser) -> Iterator:
    """Open a file at a width; what goes wrong or leaves the file fails the test at its end."""
    complaints: list[str] = []
    context = browser.new_context()

    def open_file(file: Path, width: int = 1280):
        page = context.new_page()
        page.set_viewport_size({"width": width, "height": 800})
        page.on("pageerror", lambda error: complaints.append(f"error: {error}"))
        page.on(
            "console", lambda said: complaints.append(said.text) if said.type == "error" else None
        )
        own = ("data:", "blob:", file.as_uri())
        page.on(
            "request",
            lambda asked: None if asked.url.startswith(own) else complaints.append(asked.url),
        )
        page.on("dialog", lambda dialog: complaints.append(f"dialog: {dialog.message}"))
        page.goto(file.as_uri())
        return page

    yield open_file
    context.close()
    assert not complaints
