"""Whether static friction depends on the lattice: the same surface on finer ones."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from springblock.analysis.runs import Runs, ensemble
from springblock.analysis.statistics import Interval, difference_interval, number
from springblock.model.pattern import Pattern
from springblock.model.surface import as_mask
from springblock.model.texture import Texture
from springblock.simulation.setup import DEFAULT, Setup

#: Change of friction at the last halving of the spacing, over friction, that passes for none.
TOLERANCE = 0.01


@dataclass(frozen=True)
class Refined:
    """Runs of one surface on lattices of spacing l, l/2, l/4, ..."""

    spacings: list[float]  #: m
    runs: list[Runs]

    @property
    def friction(self) -> list[Interval]:
        """Return static friction on each lattice, with its 95 % interval (Student's t)."""
        return [runs.means()["static_friction"] for runs in self.runs]

    @property
    def changes(self) -> list[Interval]:
        """Return by how much each halving of the spacing changes it, with its 95 % interval."""
        samples = [[run.static_friction for run in runs] for runs in self.runs]
        pairs = zip(samples[1:], samples, strict=False)
        return [difference_interval(finer, coarser) for finer, coarser in pairs]

    @property
    def order(self) -> float:
        """Return the observed order of convergence in l; NaN if changes do not fall, or of two."""
        *_, before, last = [math.nan, *(float(change.mean) for change in self.changes)]
        return math.log2(before / last) if last and before / last > 1.0 else math.nan

    @property
    def verdict(self) -> str:
        """Return whether the last change is less than `TOLERANCE` of friction."""
        change, limit = self.changes[-1], TOLERANCE * float(self.friction[-1].mean)
        least = min(abs(change.low), abs(change.high)) if change.low * change.high > 0.0 else 0.0
        if max(abs(change.low), abs(change.high)) < limit:
            return f"converged within {100.0 * TOLERANCE:g} %"
        if least > limit or self.order < 0.5:
            return "not converged: friction still depends on the spacing of the lattice"
        return "not settled: give more seeds, or a finer lattice"

    def __repr__(self) -> str:
        each = zip(self.spacings, self.runs, self.friction, strict=True)
        told = [
            f"l = {spacing:g} m, {runs[0].contact.mean():.1%} in contact: "
            f"static friction {number(friction)}"
            for spacing, runs, friction in each
        ]
        order = f", observed order {self.order:.1f}" if math.isfinite(self.order) else ""
        told.append(f"last change {number(self.changes[-1])}{order}; {self.verdict}")
        return "\n".join(told)


def refine(
    contact: Pattern | Texture | ArrayLike,
    setup: Setup = DEFAULT,
    direction: str | float = "x",
    seeds: int = 10,
    levels: int = 3,
    **options: Any,
) -> Refined:
    """Simulate a surface on its lattice and on finer ones, all lengths in metres fixed.

    The disorder has one length on all of them, `correlation_length` or, without one, l of the
    coarsest: otherwise its scatter over a pillar would change with the lattice. A mask is refined
    by whole blocks, a texture from its lengths. Steps are as long in units of the stability limit.
    The cost of a run grows by eight with each level.

    Parameters
    ----------
    contact, setup, direction, seeds
        As in `ensemble`.
    levels : int
        Number of lattices, at least two.
    **options
        Further ones of `ensemble`.
    """
    if levels < 2:
        raise ValueError(f"levels must be at least 2, not {levels}")
    usual = setup.material
    disorder = usual.correlation_length or usual.spacing
    spacings, every = [], []
    for parts in 2 ** np.arange(levels):
        spacing = usual.spacing / int(parts)
        material = replace(usual, spacing=spacing, correlation_length=disorder)
        finer = Setup(material, setup.integrator, setup.step / int(parts))
        if isinstance(contact, Texture):
            mask = replace(contact, spacing=spacing).contact
        else:
            mask = as_mask(contact).repeat(parts, axis=0).repeat(parts, axis=1)
        spacings.append(spacing)
        every.append(ensemble(mask, finer, direction, seeds, **options))
    return Refined(spacings, every)
