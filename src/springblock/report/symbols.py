"""The paper's symbols as it prints them: n_p with its index below the line."""

import re

from markupsafe import Markup, escape

_SYMBOL = re.compile(r"\b(?:(n)_([ps][23]?)|(l)_([cpz])|(t)_(max|avg|det)|(μ)_([sd]))\b")


def typeset(text: str) -> Markup:
    """Return text as HTML, escaped but for what sets its symbols."""

    def symbol(found: re.Match[str]) -> str:
        letter, index = filter(None, found.groups())
        return f"<var>{letter}<sub>{index}</sub></var>"

    return Markup(_SYMBOL.sub(symbol, str(escape(text))))
