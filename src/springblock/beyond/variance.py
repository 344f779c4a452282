"""How static friction varies from one realisation to another, by the size of the surface."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from springblock.analysis.statistics import Interval, mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, grouped, has_pillars_alone, number
from springblock.beyond.resampling import interval
from springblock.io.rows import listed, markdown_table
from springblock.model.scene import Scene
from springblock.simulation.run import Array

NEEDS = "groups flat and variance"
FAR = 3.0  #: standard errors of a variance from a power law that does not describe it
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


def exponent(sizes: Mapping[int, Array]) -> Interval:
    """x in a variance proportional to n^-x, n = N² blocks, with its 95 % interval."""
    slope = np.linalg.pinv(_design(sizes))[1]
    return interval(list(sizes.values()), _VARIANCE, lambda values: np.log(values) @ slope)


def misfit(sizes: Mapping[int, Array]) -> float:
    """Largest distance of a variance from the power law, in its standard errors.

    The logarithm of the variance of k normal values has a standard error of about √(2/(k - 1)).
    """
    design, logs = _design(sizes), np.log([_VARIANCE(values) for values in sizes.values()])
    left = logs - design @ (np.linalg.pinv(design) @ logs)
    counts = np.array([len(values) for values in sizes.values()])
    return float(np.abs(left * np.sqrt((counts - 1) / 2.0)).max())


def _design(sizes: Mapping[int, Array]) -> Array:
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
            "**The variance of static friction between realisations decreases approximately as "
            f"n^-x**, where n = N² blocks. We find {laws}. Independent blocks have x = 1, but so "
            "has any surface on which correlation extends over a fixed number of blocks."
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
    if misfit(sizes) > FAR:
        return f"no power law {where}"
    power = exponent(sizes)
    differs = "not " if power.low <= 1.0 <= power.high else ""
    return f"x = {number(power)} {where} ({differs}significantly different from 1)"


def _lines(pattern: Pattern, sizes: Mapping[int, Array]) -> Iterator[Sequence[str]]:
    for n, values in sizes.items():
        spread = number(variance(values), factor=1e6)
        yield name(pattern), str(n), number(mean_interval(values)), spread, str(len(values))
