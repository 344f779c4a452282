"""Mathematics of the site as MathML, which browsers draw without a script or a network."""

import html
import re
from typing import Any

from latex2mathml.converter import convert

FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)


def on_page_content(content: str, **_: Any) -> str:
    """Replace the formulas of a page, called by MkDocs."""
    return FORMULA.sub(_mathml, content)


def _mathml(found: re.Match[str]) -> str:
    tex = re.sub(r"\\tag\{(.*?)\}", r"\\qquad (\1)", html.unescape(found[2]))
    tex = re.sub(r"\\mathbf\s+(\w)", r"\\mathbf{\1}", tex)  # or the letter is not bold
    return convert(tex, display="block" if found[1] == "div" else "inline")
