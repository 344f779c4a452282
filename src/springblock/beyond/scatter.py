"""What the scatter of thresholds does to the decay of correlation and to the lowest friction."""

from collections.abc import Iterator, Mapping, Sequence

from springblock.analysis.correlation import LAST, side_times
from springblock.analysis.statistics import Interval
from springblock.beyond.friction import lowest_in_words, static_friction
from springblock.beyond.question import (
    UNCHANGED,
    Ensembles,
    change,
    grouped,
    is_even,
    listed,
    number,
)
from springblock.beyond.resampling import FEWEST, Lowest, SideLength, lowest
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
    """Sizes on which a decay length can be fitted."""
    return [n_p for n_p in next(iter(scatters.values())) if n_p >= _SHORTEST]


def fits(scatters: Mapping[float, Sizes], n_p: int) -> dict[float, SideLength]:
    """Decay length on pillars of one size by scatter."""
    ensembles = {std: sizes[n_p] for std, sizes in scatters.items()}
    times = {std: side_times(runs, runs[0].scene.pattern, "x") for std, runs in ensembles.items()}
    return {std: SideLength(times[std], min(LAST, n_p // 3)) for std in scatters}


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    scatters = by_scatter(ensembles)
    if len(scatters) < 3:
        return
    scatters = shared(scatters)
    if not (sizes := long_enough(scatters)):
        return
    lengths = {
        n_p: {std: fit.interval for std, fit in fits(scatters, n_p).items()} for n_p in sizes
    }
    friction = {
        std: {n_p: static_friction(runs) for n_p, runs in here.items()}
        for std, here in scatters.items()
    }
    yield _conclusion(lengths, [lowest(samples) for samples in friction.values()])
    header = ["scatter", *(f"decay length, n_p = {n_p} (blocks)" for n_p in sizes)]
    listed_sizes = ", ".join(map(str, next(iter(friction.values()))))
    header += [f"friction-minimising n_p of {listed_sizes}", "lowest friction"]
    yield markdown_table(
        header,
        [
            [f"{std:g}", *(number(lengths[n_p][std]) for n_p in sizes), *lowest_in_words(samples)]
            for std, samples in friction.items()
        ],
    )


def _conclusion(lengths: Mapping[int, Mapping[float, Interval]], minima: Sequence[Lowest]) -> str:
    """Say what changes from the least scatter to the most."""
    said = []
    for n_p, by_std in lengths.items():
        (least, first), *_, (most, last) = by_std.items()
        how = f"{change(first, last)} from {number(first)} to {number(last)} blocks"
        said.append(f"{how} on pillars of n_p = {n_p}")
    moves = not set.intersection(*(set(each.alike) for each in minima))
    then = f"changes from {minima[0]} to {minima[-1]}" if moves else f"{UNCHANGED}: {minima[0]}"
    return (
        f"**From a scatter of {least:g} to {most:g} the decay length {listed(said)}; "
        f"the friction-minimising n_p {then}.**"
    )
