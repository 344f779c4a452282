"""Where static friction is lowest, with the uncertainty of the position."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from springblock.analysis.statistics import difference_interval
from springblock.model.numbers import Array

#: Bound of the numerical bias of static friction on pillars, default step (`docs/accuracy.md`).
BIAS = 1e-3


class Lowest(NamedTuple):
    """Position of the lowest mean static friction, and all positions where it may be the lowest."""

    place: Any
    alike: list[Any]

    def __str__(self) -> str:
        """Return the position, with the others in brackets."""
        others = ", ".join(f"{place:g}" for place in self.alike if place != self.place)
        return f"{self.place:g} (or {others})" if others else f"{self.place:g}"


def lowest(samples: Mapping[Any, Array]) -> Lowest:
    """Return the position of the lowest mean static friction, from samples by position.

    There is no interpolation. Friction may also be the lowest wherever it exceeds the lowest mean
    by no more than the numerical bias: where the 95 % interval of the difference, without
    correction for multiple comparisons, does not lie above `BIAS`.
    """
    best = min(samples, key=lambda place: float(samples[place].mean()))
    apart = {place: difference_interval(each, samples[best]) for place, each in samples.items()}
    alike = [place for place, found in apart.items() if place == best or not found.low > BIAS]
    return Lowest(best, alike)
