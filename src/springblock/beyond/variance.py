"""How static friction varies from one realisation to another, by the size of the surface."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from springblock.analysis.statistics import Interval, mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, Question, has_pillars_alone, number
from springblock.beyond.resampling import exponents, interval
from springblock.io.rows import markdown_table
from springblock.model.scene import Scene
from springblock.simulation.run import Array

Pattern = tuple[int, int]  #: n_p and n_s, blocks; zeros on flat surfaces


def by_pattern(ensembles: Ensembles) -> dict[Pattern, dict[int, Array]]:
    """Static friction by pattern and N, where there are three sizes of surface or more."""
    found: dict[Pattern, dict[int, Array]] = {}
    for scene, runs in ensembles.items():
        if (scene == Scene(scene.n_blocks) or has_pillars_alone(scene)) and not scene.varied:
            sizes = found.setdefault((scene.n_p, scene.n_s), {})
            sizes[scene.n_blocks] = static_friction(runs)
    kept = {pattern: sizes for pattern, sizes in sorted(found.items()) if len(sizes) >= 3}
    return {pattern: dict(sorted(sizes.items())) for pattern, sizes in kept.items()}


def variance(values: Array) -> Interval:
    """Variance between realisations with its 95 % interval."""
    return interval([values], lambda drawn, axis: drawn.var(axis=axis, ddof=1))


def exponent(sizes: Mapping[int, Array]) -> Interval:
    """x in a variance that goes with n^-x, n = N² blocks, with its 95 % interval."""

    def variances(*drawn: Array, axis: int) -> Array:
        return np.stack([values.var(axis=axis, ddof=1) for values in drawn], axis=-1)

    (found,) = exponents(-2.0 * np.log(list(sizes))[:, None], list(sizes.values()), variances)
    return found


def name(pattern: Pattern) -> str:
    """Name a pattern for readers."""
    return "n_p = {}, n_s = {}".format(*pattern) if any(pattern) else "flat"


def _answers(ensembles: Ensembles) -> Iterator[str]:
    found = by_pattern(ensembles)
    for pattern, sizes in found.items():
        power = exponent(sizes)
        alike = "as" if power.low <= 1.0 <= power.high else "unlike"
        yield (
            f"**{name(pattern)}**: the variance goes with n^-x, n = N² blocks, "
            f"x = {number(power)}, {alike} that of independent blocks, x = 1."
        )
    if found:
        header = ["surface", "N", "static friction", "variance / 1e-6", "realisations"]
        yield markdown_table(header, [line for each in found.items() for line in _lines(*each)])


def _lines(pattern: Pattern, sizes: Mapping[int, Array]) -> Iterator[Sequence[str]]:
    for n, values in sizes.items():
        spread = number(variance(values), factor=1e6)
        yield name(pattern), str(n), number(mean_interval(values)), spread, str(len(values))


QUESTION = Question(
    "Does friction average over independent blocks?",
    """Static friction of independent blocks would be a mean over all n = N² of them, and its
variance between realisations would go with 1/n. Correlated detachments, and a maximum instead of a
mean, may make it another power. The exponent is a least-squares slope of the logarithms.""",
    "groups flat and variance",
    _answers,
)
