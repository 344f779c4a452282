"""Figures of the study, and pictures and films of single runs."""

from collections.abc import Callable
from pkgutil import resolve_name
from typing import Any

from springblock.plotting.declaration import Declaration
from springblock.plotting.figures import FIGURES


def declarations() -> dict[str, Declaration]:
    """Return the declaration of each figure, by name in alphabetical order."""
    return dict(sorted(FIGURES.items()))


def drawing(name: str) -> Callable[..., Any]:
    """Return the function that draws a figure as a `matplotlib.figure.Figure`."""
    return resolve_name(f"{__name__}.{FIGURES[name].module}:{name}")
