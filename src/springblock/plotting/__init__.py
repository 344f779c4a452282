"""The figures of the study, one module each: those of the paper numbered as printed."""

from importlib import import_module
from pkgutil import iter_modules

from springblock.plotting.declaration import Declaration


def declarations() -> dict[str, Declaration]:
    """Return what each figure declares, by its name, which is that of its module."""
    modules = {name: import_module(f"{__name__}.{name}") for _, name, _ in iter_modules(__path__)}
    return {name: module.FIGURE for name, module in modules.items() if hasattr(module, "FIGURE")}
