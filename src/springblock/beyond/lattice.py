"""Lattice or layer: what sets the lengths that the paper finds?"""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from springblock.beyond.question import Ensembles, Question, number, power
from springblock.beyond.resampling import (
    FittedLength,
    Sample,
    Statistic,
    interval,
    lowest,
    lowest_place,
    means,
    slopes,
)
from springblock.correlation import side_times
from springblock.rows import markdown_table
from springblock.run import Array, Run
from springblock.scene import Scene
from springblock.statistics import Interval
from springblock.tables import Record

MICRO = 1e6  #: µm per m
_VARIED = {"spacing", "thickness", "step"}
_SHORTEST = 3  #: distances that a fit of two unknowns needs


class Layer(NamedTuple):
    """A lattice and its layer, µm."""

    spacing: float
    thickness: float


Sizes = Mapping[float, Sequence[Record]]  #: realisations by the size of their pillars, µm


def layers(ensembles: Ensembles) -> dict[Layer, dict[float, Sequence[Record]]]:
    """Pillars of all sizes on surfaces of one side in m, n_s = n_p, by lattice and layer."""
    found: dict[float, dict[Layer, dict[float, Sequence[Record]]]] = {}
    for scene, runs in ensembles.items():
        if not _is_one(scene):
            continue
        spacing, thickness = (
            round(MICRO * length, 6)
            for length in (runs[0].material.spacing, runs[0].material.thickness)
        )
        side = found.setdefault(round(scene.n_blocks * spacing, 6), {})
        side.setdefault(Layer(spacing, thickness), {})[scene.n_p * spacing] = runs
    most = max(found.values(), key=len, default={})
    return {layer: dict(sorted(most[layer].items())) for layer in sorted(most)}


def _is_one(scene: Scene) -> bool:
    alike = scene.level == 1 and scene.n_p == scene.n_s and scene.direction == "x"
    return alike and set(dict(scene.varied)) <= _VARIED


def fits(sizes: Sizes) -> dict[float, FittedLength]:
    """l_c on pillars that are long enough, by their size in µm: from r = 1 to a third of a side."""
    found = {}
    for size, runs in sizes.items():
        scene = runs[0].scene
        if "x" in scene.sides and scene.n_p // 3 >= _SHORTEST and len(runs) >= 3:
            found[size] = FittedLength(side_times(runs, scene.pattern, "x"), scene.n_p // 3)
    return found


def friction(runs: Sequence[Run]) -> Array:
    """Static friction of each realisation, (k,)."""
    return np.array([run.static_friction for run in runs])


class Law(NamedTuple):
    """Exponents of a length that goes with l^a l_z^b."""

    spacing: Interval  #: a
    thickness: Interval  #: b


def law(places: Sequence[Layer], samples: Sequence[Sequence[Sample]], lengths: Statistic) -> Law:
    """Fit l^a l_z^b to a length in µm at each of these places; samples of one place together.

    `lengths` takes the samples of all places, one after another, and returns (..., places).
    """
    matrix = slopes(np.log(np.array(places)))
    flat = [sample for group in samples for sample in group]

    def exponent(*drawn: Array, axis: int, row: int) -> Array:
        return np.log(lengths(*drawn, axis=axis)) @ matrix[row]

    return Law(*(interval(flat, partial(exponent, row=row)) for row in range(2)))


def length_law(fitted: Mapping[Layer, FittedLength]) -> Law:
    """l_c over spacing and thickness on pillars of one size."""
    found, spacings = list(fitted.values()), [layer.spacing for layer in fitted]

    def lengths(*drawn: Sample, axis: int) -> Array:
        each = [fit(numbers) for fit, numbers in zip(found, drawn, strict=True)]
        return np.stack(each, axis=-1) * spacings

    return law(list(fitted), [[fit.realisations] for fit in found], lengths)


def minimum_law(surfaces: Mapping[Layer, Sizes]) -> Law:
    """Size of the pillars with the lowest static friction over spacing and thickness."""
    samples = [[friction(runs) for runs in sizes.values()] for sizes in surfaces.values()]
    ends = np.cumsum([len(group) for group in samples])[:-1]

    def lengths(*drawn: Array, axis: int) -> Array:
        parts = np.split(means(drawn, axis), ends, axis=-1)
        found = zip(surfaces.values(), parts, strict=True)
        return np.stack([lowest(np.array(list(sizes)), part) for sizes, part in found], axis=-1)

    return law(list(surfaces), samples, lengths)


def minimum(sizes: Sizes) -> Interval:
    """Size of the pillars with the lowest static friction, µm, with its 95 % interval."""
    return lowest_place(np.array(list(sizes)), [friction(runs) for runs in sizes.values()])


def _answers(ensembles: Ensembles) -> Iterator[str]:
    surfaces = {at: sizes for at, sizes in layers(ensembles).items() if len(sizes) >= _SHORTEST}
    if len({at.spacing for at in surfaces}) < 3 or len({at.thickness for at in surfaces}) < 3:
        return
    lengths = {at: fits(sizes) for at, sizes in surfaces.items()}
    laws = []
    for size in sorted({size for found in lengths.values() for size in found}):
        at_size = {at: found[size] for at, found in lengths.items() if size in found}
        if len({at.spacing for at in at_size}) >= 3:
            laws.append((f"l_c on pillars of {size:g} µm", length_law(at_size)))
    laws.append(("friction-minimising pillar", minimum_law(surfaces)))
    for what, found in laws:
        yield (
            f"**{what}** ~ l^a l_z^b: a = {number(found.spacing)}, with the lattice "
            f"{power(found.spacing)}; b = {number(found.thickness)}, with the layer "
            f"{power(found.thickness)}."
        )
    sizes = sorted({size for found in lengths.values() for size in found})
    header = ["l (µm)", "l_z (µm)", *(f"l_c on {size:g} µm (µm)" for size in sizes)]
    header += ["friction-minimising pillar (µm)", "realisations, at least"]
    yield markdown_table(header, [_cells(at, surfaces[at], lengths[at], sizes) for at in surfaces])


def _cells(
    at: Layer, sizes: Sizes, fitted: Mapping[float, FittedLength], columns: Sequence[float]
) -> list[str]:
    found = [
        number(fitted[size].interval, factor=at.spacing) if size in fitted else ""
        for size in columns
    ]
    fewest = min(len(runs) for runs in sizes.values())
    return [*(f"{length:g}" for length in at), *found, number(minimum(sizes)), str(fewest)]


QUESTION = Question(
    "Lattice or layer?",
    """The lattice is refined at one size in metres and one load, 0.6 mm wide, with pillars of 20 to
300 µm, n_s = n_p; then the layer's thickness l_z is varied on the paper's lattice. A length of
physics follows l_z, the only other length of the layer; one that follows the spacing l predicts
nothing. Thresholds are drawn block by block, so that the correlation length of the disorder is l
itself: a refined lattice is a finer disorder, too, and less of it over a length l_z. l_c is that
of A exp(-r/l_c), fitted to c_x(r) from one block to a third of the side, in metres the same on
every lattice. The friction-minimising pillar is where the parabola through the lowest mean static
friction and its neighbours, over the logarithm of size, is lowest: sizes are few, and what
lies between them is interpolated.""",
    "groups lattice and layer",
    _answers,
)
