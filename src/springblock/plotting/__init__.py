"""The figures of the study: a module each, of the same name, in the folder of their kind."""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from types import ModuleType

from matplotlib.figure import Figure

from springblock.plotting.declaration import Declaration


@cache
def _figures() -> dict[str, ModuleType]:
    """Modules with a constant `FIGURE` and a function `draw`, by name."""
    paths = [path for _, path, _ in walk_packages(__path__, f"{__name__}.")]
    modules = {path.rpartition(".")[2]: import_module(path) for path in paths}
    return {name: modules[name] for name in sorted(modules) if hasattr(modules[name], "FIGURE")}


def declarations() -> dict[str, Declaration]:
    """Return what each figure declares, by its name."""
    return {name: module.FIGURE for name, module in _figures().items()}


def drawing(name: str) -> Callable[..., Figure]:
    """Return the function that draws a figure."""
    draw: Callable[..., Figure] = _figures()[name].draw
    return draw
