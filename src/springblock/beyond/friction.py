"""Static friction against the size of pillars and their distance, at constant total load."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, mean_interval
from springblock.beyond.question import Ensembles, grouped, has_pillars_alone, number
from springblock.beyond.resampling import interval
from springblock.io.rows import markdown_table
from springblock.model.numbers import Array
from springblock.simulation.run import Run

NEEDS = "group friction"
Pillars = tuple[int, int]  #: n_p and n_s, blocks
Map = Mapping[Pillars, Array]  #: static friction of each realisation, (k,)
_FEWEST = 3  #: sizes with a minimum between them
#: In the order of `fractions` in `explained`.
_SHARES = ("size", "contact", "more by size", "interaction")


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


def crossed(found: Map) -> dict[Pillars, Array]:
    """Pillars whose size and whose contact fraction both occur more than once."""
    kept = dict(found)
    while True:
        sizes = Counter(n_p for n_p, _ in kept)
        kinds = Counter(distance(pillars) for pillars in kept)
        fewer = {p: v for p, v in kept.items() if sizes[p[0]] > 1 and kinds[distance(p)] > 1}
        if len(fewer) == len(kept):
            return kept
        kept = fewer


def explained(found: Map) -> dict[str, Interval]:
    """Fractions of the variance of mean static friction over the map.

    These are the fraction that "size" explains beyond contact fraction, the one that "contact"
    explains beyond size, their difference, and the rest, their "interaction". Sizes and contact
    fractions are combined unevenly, so that together they explain less than the sum of what each
    explains alone. The models have a number for each size, one for each contact fraction, or both.
    """
    factors = np.array([(at[0], float(distance(at))) for at in found]).T
    size, contact = (np.equal.outer(each, np.unique(each)).astype(float) for each in factors)
    designs = size, contact, np.hstack([size, contact])
    projections = [np.eye(len(found)) - a @ np.linalg.pinv(a) for a in designs]

    def fractions(*samples: Array, axis: int) -> Array:
        means = np.stack([values.mean(axis=axis) for values in samples], axis=-1)
        # variance that each model leaves unexplained
        by_size, by_contact, by_both = (
            ((means @ left) ** 2).mean(axis=-1) / means.var(axis=-1) for left in projections
        )
        own = by_contact - by_both, by_size - by_both, by_contact - by_size
        return np.stack([*own, by_both])

    shares = np.transpose(interval([*found.values()], fractions))
    return {name: Interval(*share) for name, share in zip(_SHARES, shares, strict=True)}


def answers(ensembles: Ensembles) -> Iterator[str]:
    """A sentence and a table in Markdown; none without what `NEEDS` names."""
    whole = friction_map(ensembles)
    found = crossed(whole)
    if not found:
        return
    shares = explained(found)
    size, contact, more, _ = (number(share, " %", 100.0) for share in shares.values())
    words = "Static friction depends more on the size of pillars than on contact fraction"
    if shares["more by size"].high < 0.0:
        words = "Static friction depends more on contact fraction than on the size of pillars"
    elif not shares["more by size"].low > 0.0:
        words = "Size and contact fraction explain static friction equally well"
    yield (
        f"**{words}**: over the {len(found)} surfaces whose size and contact fraction both occur "
        f"more than once, size, added to contact fraction, explains a further {size} of the "
        f"variance; contact fraction, added to size, a further {contact} (difference: {more}); and "
        f"their interaction up to {100.0 * shares['interaction'].mean:.2g} %."
    )
    header = ["n_s/n_p", "contact fraction (%)", "sizes n_p"]
    header += ["friction-minimising n_p", "lowest friction"]
    lines = []
    for kind, sizes in families(whole).items():
        contact = f"{100.0 / float(1 + kind) ** 2:.1f}"
        lines.append([str(kind), contact, ", ".join(map(str, sizes)), *lowest_in_words(sizes)])
    yield markdown_table(header, lines)


def lowest_in_words(sizes: Mapping[int, Array]) -> list[str]:
    """Write the friction-minimising n_p and the lowest friction, from samples by n_p."""
    found = lowest(sizes)
    return [str(found), number(mean_interval(sizes[int(found.place)]))]
