"""What the scatter of thresholds does to the correlation length and to the lowest friction."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from springblock.analysis.correlation import side_times
from springblock.analysis.statistics import Interval, mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, Question, is_even, number
from springblock.beyond.resampling import (
    FEWEST,
    SideLength,
    length_exponents,
    lowest_place,
)
from springblock.io.records import Record
from springblock.io.rows import markdown_table

_SHORTEST = 9  #: n_p from which on three distances can be fitted
LAST = 6  #: blocks, the end of all fits here, or a third of shorter sides

Sizes = Mapping[int, Sequence[Record]]  #: realisations by n_p


def by_scatter(ensembles: Ensembles) -> dict[float, Sizes]:
    """Pillars by the standard deviation of their static coefficients, and by n_p."""
    found: dict[int, dict[float, dict[int, Sequence[Record]]]] = {}
    for scene, runs in ensembles.items():
        if is_even(scene, ["mu_static_std"]) and len(runs) >= FEWEST:
            at = found.setdefault(scene.n_blocks, {})
            at.setdefault(runs[0].material.mu_static_std, {})[scene.n_p] = runs
    scatters = max(found.values(), key=len, default={})
    return {std: dict(sorted(scatters[std].items())) for std in sorted(scatters)}


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
    found = {}
    for std, sizes in scatters.items():
        runs = sizes[n_p]
        times = side_times(runs, runs[0].scene.pattern, "x")
        found[std] = SideLength(times, min(LAST, n_p // 3))
    return found


def exponent(fitted: Mapping[float, SideLength]) -> Interval:
    """Exponent of l_c over the standard deviation."""
    (found,) = length_exponents(fitted.values(), np.log(list(fitted))[:, None], [1.0] * len(fitted))
    return found


def _answers(ensembles: Ensembles) -> Iterator[str]:
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
        lowest = min(samples.values(), key=lambda values: float(values.mean()))
        place = number(lowest_place(samples))
        found = [number(lengths[n_p][std].interval) for n_p in sizes]
        lines.append([f"{std:g}", *found, place, number(mean_interval(lowest))])
    yield markdown_table(header, lines)


QUESTION = Question(
    "What does the scatter of thresholds do?",
    f"""The standard deviation of the static coefficients varies, 0.1 in the paper. l_c is that of
A exp(-r/l_c), fitted from r = 1 to {LAST} blocks, or a third of shorter sides; the
friction-minimising n_p is found as in the questions above.""",
    "groups pillars and scatter",
    _answers,
)
