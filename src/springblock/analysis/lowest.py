"""Position of the lowest mean among samples, with its uncertainty."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from springblock.analysis.statistics import difference_interval
from springblock.simulation.run import Array


class Lowest(NamedTuple):
    """Position of the lowest mean, and all positions whose means do not differ significantly."""

    place: float
    alike: list[float]

    def __str__(self) -> str:
        """Return the position, with the others in brackets."""
        others = ", ".join(f"{place:g}" for place in self.alike if place != self.place)
        return f"{self.place:g} (or {others})" if others else f"{self.place:g}"


def lowest(samples: Mapping[Any, Array]) -> Lowest:
    """Return the position of the lowest mean of samples, given by position.

    There is no interpolation. A mean differs from the lowest if the 95 % interval of their
    difference, without correction for multiple comparisons, excludes zero.
    """
    best = min(samples, key=lambda place: float(samples[place].mean()))
    apart = {place: difference_interval(each, samples[best]) for place, each in samples.items()}
    alike = [place for place, found in apart.items() if place == best or not found.low > 0.0]
    return Lowest(best, alike)


def are_apart(minima: Iterable[Lowest]) -> bool:
    """Return whether no position is common to all minima."""
    return not set.intersection(*(set(each.alike) for each in minima))
