"""The site has every page, and a place for every public name."""

import re
from pathlib import Path
from pkgutil import resolve_name

import springblock

ROOT = Path(__file__).parents[1]


def test_every_public_name_is_in_the_reference():
    page = (ROOT / "docs/api.md").read_text(encoding="utf-8")
    shown = [path.rsplit(".", 1) for path in re.findall(r"^::: (.+)$", page, re.MULTILINE)]
    found = {name: resolve_name(f"{module}:{name}") for module, name in shown}
    assert found == {name: getattr(springblock, name) for name in springblock.__all__}


def test_every_page_of_the_documentation_is_in_the_navigation():
    """Files, not headings: `make site` checks all links."""
    configured = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    shown = re.findall(r": (\S+\.(?:md|ipynb))$", configured, re.MULTILINE)
    docs = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("docs/*.ipynb"), *ROOT.glob("config/**/*.md")]
    assert {file.relative_to(ROOT).as_posix() for file in docs} <= {*shown}
    assert all((ROOT / name).exists() for name in shown)
