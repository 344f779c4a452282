"""Static friction against the size of pillars and their distance, at constant total load."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from operator import attrgetter
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, difference_interval, mean_interval, number
from springblock.beyond.question import Ensembles, grouped, has_pillars_alone
from springblock.io.rows import markdown_table
from springblock.model.numbers import Array
from springblock.simulation.run import Run

NEEDS = "group friction"
Pillars = tuple[int, int]  #: n_p and n_s, blocks
Map = Mapping[Pillars, Array]  #: static friction of each realisation, (k,)
_FEWEST = 3  #: sizes with a minimum between them


def friction_map(ensembles: Ensembles) -> dict[Pillars, Array]:
    """Static friction by pillars, on surfaces of the N with the most kinds of pillars.

    Pillars whose period does not divide its N are taken from surfaces at most a tenth larger.
    """
    found = grouped(
        (scene.n_blocks, (scene.n_p, scene.n_s), static_friction(runs))
        for scene, runs in ensembles.items()
        if has_pillars_alone(scene) and not scene.varied
    )
    common = max(found, key=lambda n: len(found[n]), default=0)
    near = [found[n] for n in sorted(found, reverse=True) if common <= n <= 1.1 * common]
    return dict(sorted({at: sizes[at] for sizes in near for at in sizes}.items()))


def static_friction(runs: Sequence[Run]) -> Array:
    """Static friction of each realisation, (k,)."""
    return np.array([run.static_friction for run in runs])


def samples(sizes: Mapping[Any, Sequence[Run]]) -> dict[Any, Array]:
    """Static friction of each realisation, (k,), by size."""
    return {size: static_friction(runs) for size, runs in sizes.items()}


def distance(pillars: Pillars) -> Fraction:
    """n_s/n_p, which sets the contact fraction."""
    return Fraction(pillars[1], pillars[0])


def families(found: Map) -> dict[Fraction, dict[int, Array]]:
    """Static friction by n_s/n_p and n_p, where n_s/n_p has three sizes or more."""
    sizes = grouped((distance(at), at[0], values) for at, values in found.items())
    return {key: sizes[key] for key in sorted(sizes) if len(sizes[key]) >= _FEWEST}


def largest_difference(groups: Iterable[Mapping[Any, Array]]) -> Interval:
    """Largest difference of mean static friction within a group, among all groups."""
    ends = [sorted(group.values(), key=np.mean) for group in groups]
    return max((difference_interval(each[-1], each[0]) for each in ends), key=attrgetter("mean"))


def answers(ensembles: Ensembles) -> Iterator[str]:
    """A sentence and a table in Markdown; none without what `NEEDS` names."""
    found = friction_map(ensembles)
    by_contact, by_size = (
        [group for group in grouped(items).values() if len(group) > 1]
        for items in (
            ((distance(at), at[0], values) for at, values in found.items()),
            ((at[0], distance(at), values) for at, values in found.items()),
        )
    )
    if not (by_contact and by_size):
        return
    size, contact = largest_difference(by_contact), largest_difference(by_size)
    words = "Static friction depends about equally on the size of pillars and on contact fraction"
    if size.low > contact.high:
        words = "Static friction depends more on the size of pillars than on contact fraction"
    elif contact.low > size.high:
        words = "Static friction depends more on contact fraction than on the size of pillars"
    yield (
        f"**{words}** in the ranges simulated: at the same contact fraction, it differs between "
        f"sizes by up to {number(size)}; at the same size, between contact fractions by up to "
        f"{number(contact)}."
    )
    header = ["n_s/n_p", "contact fraction (%)", "sizes n_p"]
    header += ["friction-minimising n_p", "lowest friction"]
    lines = []
    for kind, sizes in families(found).items():
        percent = f"{100.0 / float(1 + kind) ** 2:.1f}"
        lines.append([str(kind), percent, ", ".join(map(str, sizes)), *lowest_in_words(sizes)])
    yield markdown_table(header, lines)


def lowest_in_words(sizes: Mapping[int, Array]) -> list[str]:
    """Write the friction-minimising n_p and the lowest friction, from samples by n_p."""
    found = lowest(sizes)
    return [str(found), number(mean_interval(sizes[int(found.place)]))]
