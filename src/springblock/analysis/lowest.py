"""Where the mean of a sample is lowest, and where it may be."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from springblock.analysis.statistics import difference_interval
from springblock.simulation.run import Array


class Lowest(NamedTuple):
    """The place of the lowest mean, and all places whose means cannot be told from it."""

    place: float
    alike: list[float]

    def __str__(self) -> str:
        """Write the place, and the others in brackets."""
        others = ", ".join(f"{place:g}" for place in self.alike if place != self.place)
        return f"{self.place:g} (or {others})" if others else f"{self.place:g}"


def lowest(samples: Mapping[Any, Array]) -> Lowest:
    """Where the means of samples, by their places, are lowest.

    Nothing is interpolated between places. A mean is told from the lowest where the 95 % interval
    of their difference, each by itself, leaves out zero.
    """
    best = min(samples, key=lambda place: float(samples[place].mean()))
    apart = {place: difference_interval(each, samples[best]) for place, each in samples.items()}
    alike = [place for place, found in apart.items() if place == best or not found.low > 0.0]
    return Lowest(best, alike)


def are_apart(minima: Iterable[Lowest]) -> bool:
    """Whether no place is among those of all minima."""
    return not set.intersection(*(set(each.alike) for each in minima))
