"""Warnings: input that is valid but hardly meant, and results that depend on the lattice."""

import warnings
from collections.abc import Iterable, Iterator
from functools import cache

from springblock.model.surface import Surface
from springblock.provenance import study
from springblock.simulation import resolution
from springblock.simulation.run import Run
from springblock.simulation.setup import PAPER, Setup

#: Least number of steps while blocks are loaded.
_LOADING = 10
#: Largest static friction over the largest coefficient; inertia of the paper's blocks adds little.
_LARGEST = 1.5

_warn_once = cache(warnings.warn)  # Python forgets what it has shown when others change its filters


def warn(doubts: Iterable[str]) -> None:
    """Warn, once of each, unless the run is a job of a study, whose report says so."""
    for doubt in doubts:
        if not study():
            _warn_once(doubt)


def of_input(surface: Surface, setup: Setup) -> Iterator[str]:
    """Yield doubts about a surface and a setup."""
    material, contact = setup.material, surface.contact
    if _is_quick(surface, setup):
        yield (
            f"with pressure = {material.pressure:g} Pa and slider_velocity = "
            f"{material.slider_velocity:g} m/s blocks detach within {_LOADING} steps; did you mean "
            f"others, such as the paper's {PAPER.pressure:g} Pa and {PAPER.slider_velocity:g} m/s?"
        )
    if material.spacing > material.thickness * (1.0 + 1e-9):
        yield (
            f"spacing = {material.spacing:g} m exceeds thickness = {material.thickness:g} m, so "
            "that blocks hardly interact; lengths are in m"
        )
    side = max(contact.shape) * material.spacing
    if material.thickness > side * (1.0 + 1e-9) and not surface.periodic:
        yield (
            f"thickness = {material.thickness:g} m exceeds the side of the surface, {side:g} m; "
            "lengths are in m"
        )
    if material.slip_distance > material.thickness:
        yield (
            f"slip_distance = {material.slip_distance:g} m exceeds thickness = "
            f"{material.thickness:g} m, so that friction hardly falls; lengths are in m"
        )
    if not contact.all():
        yield from filter(None, [resolution.lattice(material)])


def of_run(surface: Surface, setup: Setup, direction: str | float, run: Run) -> Iterator[str]:
    """Yield doubts about the results of a run."""
    found, strongest = run.static_friction, surface.strongest
    if 0.0 < _LARGEST * strongest < found and not _is_quick(surface, setup):
        yield (
            f"static friction = {found:.3g} exceeds the largest coefficient, {strongest:.3g}, by "
            "more than half: it is that of inertia and damping; check pressure, slider_velocity "
            "and gamma"
        )
    yield from resolution.doubts(surface, setup.material, direction, run)


def _is_quick(surface: Surface, setup: Setup) -> bool:
    """Return whether blocks are loaded to their coefficients within a few steps."""
    loading = setup.loading_time(surface.contact, surface.strongest)
    return 0.0 < loading < _LOADING * setup.step
