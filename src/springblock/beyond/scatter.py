"""What the scatter of thresholds does to the correlation length and to the lowest friction."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from springblock.analysis.correlation import LAST, side_times
from springblock.analysis.statistics import Interval
from springblock.beyond.friction import lowest_in_words, static_friction
from springblock.beyond.question import Ensembles, grouped, is_even, number
from springblock.beyond.resampling import FEWEST, SideLength, length_exponents
from springblock.io.records import Record
from springblock.io.rows import markdown_table

_SHORTEST = 9  #: n_p from which on three distances can be fitted
NEEDS = "groups pillars and scatter"

Sizes = Mapping[int, Sequence[Record]]  #: realisations by n_p


def by_scatter(ensembles: Ensembles) -> dict[float, Sizes]:
    """Pillars by the standard deviation of their static coefficients, and by n_p."""
    sizes = grouped(
        ((scene.n_blocks, runs[0].material.mu_static_std), scene.n_p, runs)
        for scene, runs in ensembles.items()
        if is_even(scene, ["mu_static_std"]) and len(runs) >= FEWEST
    )
    found: dict[int, dict[float, Sizes]] = grouped((n, std, sizes[n, std]) for n, std in sizes)
    return max(found.values(), key=len, default={})


def shared(scatters: Mapping[float, Sizes]) -> dict[float, Sizes]:
    """The sizes that all have."""
    common = set.intersection(*(set(sizes) for sizes in scatters.values()))
    return {
        std: {n_p: runs for n_p, runs in sizes.items() if n_p in common}
        for std, sizes in scatters.items()
    }


def long_enough(scatters: Mapping[float, Sizes]) -> list[int]:
    """Sizes on which l_c can be fitted."""
    return [n_p for n_p in next(iter(scatters.values())) if n_p >= _SHORTEST]


def fits(scatters: Mapping[float, Sizes], n_p: int) -> dict[float, SideLength]:
    """l_c on pillars of one size by scatter."""
    ensembles = {std: sizes[n_p] for std, sizes in scatters.items()}
    times = {std: side_times(runs, runs[0].scene.pattern, "x") for std, runs in ensembles.items()}
    return {std: SideLength(times[std], min(LAST, n_p // 3)) for std in scatters}


def exponent(fitted: Mapping[float, SideLength]) -> Interval:
    """Exponent of l_c over the standard deviation."""
    (found,) = length_exponents(fitted.values(), np.log(list(fitted))[:, None], [1.0] * len(fitted))
    return found


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    scatters = by_scatter(ensembles)
    if len(scatters) < 3:
        return
    scatters = shared(scatters)
    sizes = long_enough(scatters)
    lengths = {n_p: fits(scatters, n_p) for n_p in sizes}
    for n_p, fitted in lengths.items():
        yield (
            f"**l_c on pillars with n_p = {n_p}** goes with the power "
            f"{number(exponent(fitted))} of the scatter."
        )
    header = ["scatter", *(f"l_c, n_p = {n_p} (blocks)" for n_p in sizes)]
    header += ["friction-minimising n_p", "lowest friction"]
    lines = []
    for std, sizes_here in scatters.items():
        samples = {n_p: static_friction(runs) for n_p, runs in sizes_here.items()}
        found = [number(lengths[n_p][std].interval) for n_p in sizes]
        lines.append([f"{std:g}", *found, *lowest_in_words(samples)])
    yield markdown_table(header, lines)
