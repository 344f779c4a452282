"""Decay length and lowest friction against the scatter of thresholds."""

from collections.abc import Iterator, Mapping, Sequence

from springblock.analysis.correlation import LAST
from springblock.analysis.lowest import Lowest, are_apart, lowest
from springblock.analysis.statistics import Interval, independent_difference, number
from springblock.beyond.friction import lowest_in_words, samples
from springblock.beyond.question import (
    FEWEST,
    UNCHANGED,
    Ensembles,
    direction,
    grouped,
    is_even,
    on_one_side,
    side_length,
)
from springblock.io.records import Record
from springblock.io.rows import listed, markdown_table

NEEDS = "groups pillars and scatter"

Sizes = Mapping[int, Sequence[Record]]  #: realisations by n_p


def by_scatter(ensembles: Ensembles) -> dict[float, Sizes]:
    """Pillars of the sizes common to all, by the standard deviation of static coefficients."""
    found = on_one_side(
        (scene.n_blocks, runs[0].material.mu_static_std, scene.n_p, runs)
        for scene, runs in ensembles.items()
        if is_even(scene, ["mu_static_std"]) and len(runs) >= FEWEST
    )
    return {
        std: {n_p: sizes[n_p] for n_p in sizes if all(n_p in other for other in found.values())}
        for std, sizes in found.items()
    }


def decay_lengths(scatters: Mapping[float, Sizes]) -> dict[int, dict[float, Interval]]:
    """Decay lengths, blocks, by scatter, on pillars of each size on which they can be fitted."""
    return grouped(
        (n_p, std, length)
        for std, sizes in scatters.items()
        for n_p, runs in sizes.items()
        if (length := side_length(runs, LAST))
    )


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    scatters = by_scatter(ensembles)
    if len(scatters) < 3 or not (lengths := decay_lengths(scatters)):
        return
    friction = {std: samples(sizes) for std, sizes in scatters.items()}
    sizes = [str(n_p) for n_p in next(iter(friction.values()))]
    minima = [lowest(by_size) for by_size in friction.values()]
    yield f"{_conclusion(lengths, minima, sizes)}."
    header = ["scatter", *(f"decay length, n_p = {n_p} (blocks)" for n_p in lengths)]
    header += [f"friction-minimising n_p of {', '.join(sizes)}", "lowest friction"]
    lines = []
    for std, by_size in friction.items():
        fitted = [number(by_scatter[std]) for by_scatter in lengths.values()]
        lines.append([f"{std:g}", *fitted, *lowest_in_words(by_size)])
    yield markdown_table(header, lines)


def _conclusion(
    lengths: Mapping[int, Mapping[float, Interval]], minima: Sequence[Lowest], sizes: Sequence[str]
) -> str:
    """Write the changes from the smallest to the largest scatter."""
    changed: dict[str, dict[str, str]] = {}
    for n_p, by_std in lengths.items():
        (least, first), *_, (most, last) = by_std.items()
        change = number(independent_difference(last, first))
        changed.setdefault(direction(first, last), {})[str(n_p)] = change
    said = [
        f"{verb} on pillars of {listed([*by_size])} blocks (change: {listed([*by_size.values()])} "
        "blocks)"
        for verb, by_size in changed.items()
    ]
    stays = f"{UNCHANGED}: {minima[0]}"
    then = f"changes from {minima[0]} to {minima[-1]}" if are_apart(minima) else stays
    return (
        f"**When the scatter of the thresholds increases from {least:g} to {most:g}**, the decay "
        f"length {listed(said)}; the friction-minimising n_p, among {listed(sizes)}, {then}"
    )
