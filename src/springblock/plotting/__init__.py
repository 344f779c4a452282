"""Figures of the study, and pictures and films of single runs."""

from collections.abc import Callable
from pkgutil import resolve_name
from typing import Any

from springblock.plotting.figures import FIGURES


def drawing(name: str) -> Callable[..., Any]:
    """Return the function that draws a figure in the journal's style, as matplotlib's `Figure`."""
    from springblock.plotting.style import journal  # slow to load: it brings matplotlib along

    return journal(resolve_name(f"{__name__}.{FIGURES[name].module}:{name}"))
