"""How static friction varies from one realisation to another, by the size of the surface."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial

import numpy as np
from scipy.special import chdtri

from springblock.analysis.statistics import Interval, mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, grouped, has_pillars_alone, number
from springblock.beyond.resampling import interval
from springblock.io.rows import listed, markdown_table
from springblock.model.scene import Scene
from springblock.simulation.run import Array

NEEDS = "groups flat and variance"
_LEVEL = 0.05  #: of the test of a power law
_VARIANCE = partial(np.var, ddof=1)
Pattern = tuple[int, int]  #: n_p and n_s, blocks; zeros on flat surfaces


def by_pattern(ensembles: Ensembles) -> dict[Pattern, dict[int, Array]]:
    """Static friction by pattern and N, where there are three sizes of surface or more."""
    found = grouped(
        ((scene.n_p, scene.n_s), scene.n_blocks, static_friction(runs))
        for scene, runs in ensembles.items()
        if (scene == Scene(scene.n_blocks) or has_pillars_alone(scene)) and not scene.varied
    )
    return {pattern: sizes for pattern, sizes in sorted(found.items()) if len(sizes) >= 3}


def variance(values: Array) -> Interval:
    """Variance between realisations with its 95 % interval."""
    return interval([values], _VARIANCE)


def exponent(sizes: Mapping[int, Array]) -> Interval | None:
    """x in a variance proportional to n^-x, n = N² blocks; none where this law is rejected."""
    found = {n: float(_VARIANCE(values)) for n, values in sizes.items()}
    if misfit(found, [*map(len, sizes.values())]) > chdtri(len(sizes) - 2, _LEVEL):
        return None
    slope = np.linalg.pinv(_design(sizes))[1]
    return interval(list(sizes.values()), _VARIANCE, lambda values: np.log(values) @ slope)


def misfit(variances: Mapping[int, float], counts: Sequence[int]) -> float:
    """Return chi-squared of the best power law for variances by N, each of `counts` realisations.

    The logarithm of the variance of k normal values has a standard error of about √(2/(k - 1)).
    """
    weights = np.sqrt((np.array(counts) - 1.0) / 2.0)
    design, logs = weights[:, None] * _design(variances), weights * np.log([*variances.values()])
    return float(((logs - design @ (np.linalg.pinv(design) @ logs)) ** 2).sum())


def _design(sizes: Collection[int]) -> Array:
    return np.column_stack([np.ones(len(sizes)), -2.0 * np.log(list(sizes))])


def name(pattern: Pattern) -> str:
    """Name a pattern for readers."""
    return "n_p = {}, n_s = {}".format(*pattern) if any(pattern) else "flat"


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    found = by_pattern(ensembles)
    if found:
        laws = listed([_law(*each) for each in found.items()])
        yield (
            "**The variance of static friction between realisations decreases with the number of "
            f"blocks**, n = N². A law n^-x {laws}. Independent blocks have x = 1, but so has "
            "any surface on which correlation extends over a fixed number of blocks."
        )
        steps = listed([_last_step(*each) for each in found.items()])
        yield f"**Between the two largest surfaces** the variance changes by {steps}."
        header = ["surface", "N", "static friction", "variance / 1e-6", "realisations"]
        yield markdown_table(header, [line for each in found.items() for line in _lines(*each)])


def _last_step(pattern: Pattern, sizes: Mapping[int, Array]) -> str:
    """Compare the variances on the two largest surfaces with x = 1."""
    smaller, larger = list(sizes)[-2:]
    values = [sizes[larger], sizes[smaller]]
    ratio = interval(values, _VARIANCE, lambda found: found[..., 0] / found[..., 1])
    expected = (smaller / larger) ** 2
    within = "within" if ratio.low <= expected <= ratio.high else "outside"
    place = f"{name(pattern)}, N = {smaller} and {larger}"
    one = f"x = 1 gives {expected:.2g}, {within} the interval"
    return f"a factor of {number(ratio)} ({place}; {one})"


def _law(pattern: Pattern, sizes: Mapping[int, Array]) -> str:
    where = f"on pillars with {name(pattern)}" if any(pattern) else "on flat surfaces"
    if (power := exponent(sizes)) is None:
        return f"is rejected {where} (chi-squared test at {100.0 * _LEVEL:g} %)"
    differs = "not " if power.low <= 1.0 <= power.high else ""
    return f"has x = {number(power)} {where} ({differs}significantly different from 1)"


def _lines(pattern: Pattern, sizes: Mapping[int, Array]) -> Iterator[Sequence[str]]:
    for n, values in sizes.items():
        spread = number(variance(values), factor=1e6)
        yield name(pattern), str(n), number(mean_interval(values)), spread, str(len(values))
