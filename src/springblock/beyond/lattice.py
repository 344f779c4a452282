"""Lattice or layer: what sets the lengths that the paper finds?"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from statistics import mode
from typing import NamedTuple

import numpy as np

from springblock.analysis.correlation import fit_tail, side_times
from springblock.analysis.statistics import Interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, grouped, is_even, number, power
from springblock.beyond.resampling import (
    FEWEST,
    LengthFit,
    Sample,
    SideLength,
    area,
    exponents,
    length_exponents,
    lowest,
    lowest_place,
    means,
)
from springblock.io.records import Record
from springblock.io.rows import markdown_table
from springblock.simulation.run import Array

NEEDS = "groups lattice, disorder and layer"
MICRO = 1e6  #: µm per m
_VARIED = {"spacing", "thickness", "mu_static_std", "mu_dynamic_std", "step"}
_SHORTEST = 3  #: distances that a fit of two unknowns needs


class Layer(NamedTuple):
    """A lattice, its layer and its disorder."""

    spacing: float  #: l, µm
    thickness: float  #: l_z, µm
    scatter: float  #: standard deviation of the static coefficients


Sizes = Mapping[float, Sequence[Record]]  #: realisations by the size of their pillars, µm
Surfaces = Mapping[Layer, Sizes]


def layers(ensembles: Ensembles) -> dict[Layer, Sizes]:
    """Pillars of all sizes on surfaces of one side in m, n_s = n_p, by lattice and layer."""
    items = []
    for scene, runs in ensembles.items():
        if is_even(scene, _VARIED):
            material = runs[0].material
            spacing, thickness = (
                round(MICRO * length, 6) for length in (material.spacing, material.thickness)
            )
            side = round(scene.n_blocks * spacing, 6)
            at = Layer(spacing, thickness, material.mu_static_std)
            items.append(((side, at), scene.n_p * spacing, runs))
    sizes = grouped(items)
    found: dict[float, dict[Layer, Sizes]] = grouped((*place, sizes[place]) for place in sizes)
    return max(found.values(), key=len, default={})


def usual(surfaces: Surfaces) -> Layer:
    """What most surfaces have."""
    return Layer(*map(mode, zip(*surfaces, strict=True)))


def refined(surfaces: Surfaces) -> dict[Layer, Sizes]:
    """Lattices and layers with the usual scatter of each block."""
    scatter = usual(surfaces).scatter
    return {at: sizes for at, sizes in surfaces.items() if at.scatter == scatter}


def evenly_disordered(surfaces: Surfaces) -> dict[Layer, Sizes]:
    """Lattices with the usual layer whose blocks scatter with 1/l: the same disorder per area."""
    common = usual(surfaces)
    product = common.spacing * common.scatter
    return {
        at: sizes
        for at, sizes in surfaces.items()
        if at.thickness == common.thickness and np.isclose(at.spacing * at.scatter, product)
    }


def fits(sizes: Sizes, fit: LengthFit = fit_tail) -> dict[float, SideLength]:
    """l_c on pillars that are long enough, by their size in µm: from r = 1 to a third of a side."""
    found = {}
    for size, runs in sizes.items():
        scene = runs[0].scene
        if "x" in scene.sides and scene.n_p // 3 >= _SHORTEST and len(runs) >= FEWEST:
            times = side_times(runs, scene.pattern, "x")
            found[size] = SideLength(times, scene.n_p // 3, fit)
    return found


def minimum_exponents(rates: Array, surfaces: Surfaces) -> list[Interval]:
    """Exponents of the size of the pillars with the lowest static friction.

    It must lie inside the sizes of each surface.
    """
    samples = [static_friction(runs) for sizes in surfaces.values() for runs in sizes.values()]
    ends = np.cumsum([len(sizes) for sizes in surfaces.values()])[:-1]

    def lengths(*drawn: Sample, axis: int) -> Array:
        parts = np.split(means(drawn, axis), ends, axis=-1)
        found = zip(surfaces.values(), parts, strict=True)
        return np.stack([lowest(np.array(list(sizes)), part) for sizes, part in found], axis=-1)

    return exponents(rates, samples, lengths)


def _inside(sizes: Sizes) -> bool:
    """Whether static friction is lowest on neither the smallest nor the largest pillars."""
    at = int(np.argmin([static_friction(runs).mean() for runs in sizes.values()]))
    return 0 < at < len(sizes) - 1


def minimum(sizes: Sizes) -> Interval:
    """Size of the pillars with the lowest static friction, µm, with its 95 % interval."""
    return lowest_place({size: static_friction(runs) for size, runs in sizes.items()})


#: Lengths along the sides of pillars, by what they are called.
_LENGTHS: dict[str, LengthFit] = {"l_c": fit_tail, "area below c(r)": area}
_MINIMUM = "friction-minimising pillar"


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    surfaces = {at: sizes for at, sizes in layers(ensembles).items() if len(sizes) >= _SHORTEST}
    if not surfaces:
        return
    lengths = _by_name(surfaces)
    answers = list(_laws(refined(surfaces), lengths, 2))
    answers += _laws(evenly_disordered(surfaces), lengths, 1)
    if not answers:
        return
    yield from answers
    header = ["l (µm)", "l_z (µm)", "scatter"]
    header += [*(f"{name} (µm)" for name in (*lengths, _MINIMUM)), "realisations, at least"]
    yield markdown_table(header, [_cells(at, surfaces[at], lengths) for at in surfaces])


def _by_name(surfaces: Surfaces) -> dict[str, dict[Layer, SideLength]]:
    """Lengths on pillars of each size that three lattices or more resolve."""
    named: dict[str, dict[Layer, SideLength]] = {}
    for name, fit in _LENGTHS.items():
        for at, sizes in surfaces.items():
            for size, length in fits(sizes, fit).items():
                named.setdefault(f"{name} on pillars of {size:g} µm", {})[at] = length
    return {name: found for name, found in named.items() if len({a.spacing for a in found}) >= 3}


def _laws(
    surfaces: Surfaces, lengths: Mapping[str, Mapping[Layer, SideLength]], unknowns: int
) -> Iterator[str]:
    """Powers of l and l_z of each length, or of l alone at the same disorder per area."""
    for name, fitted in lengths.items():
        here = {at: fit for at, fit in fitted.items() if at in surfaces}
        if _suffice(here, unknowns):
            spacings = [at.spacing for at in here]
            found = length_exponents(here.values(), _rates(here, unknowns), spacings)
            yield _law(name, found)
    inside = {at: sizes for at, sizes in surfaces.items() if _inside(sizes)}
    if _suffice(inside, unknowns):
        yield _law(_MINIMUM, minimum_exponents(_rates(inside, unknowns), inside))


def _suffice(places: Collection[Layer], unknowns: int) -> bool:
    """Whether there are three spacings and, where it is varied, three thicknesses."""
    varied = list(zip(*places, strict=True))[:unknowns]
    return bool(varied) and all(len(set(values)) >= 3 for values in varied)


def _rates(places: Collection[Layer], unknowns: int) -> Array:
    return np.log([at[:unknowns] for at in places])


def _law(name: str, found: Sequence[Interval]) -> str:
    with_lattice = f"a = {number(found[0])}, with the lattice {power(found[0])}"
    if len(found) == 1:
        return f"**{name}** at the same disorder per area ~ l^a: {with_lattice}."
    return (
        f"**{name}** ~ l^a l_z^b: {with_lattice}; "
        f"b = {number(found[1])}, with the layer {power(found[1])}."
    )


def _cells(at: Layer, sizes: Sizes, lengths: Mapping[str, Mapping[Layer, SideLength]]) -> list[str]:
    each = [found.get(at) for found in lengths.values()]
    cells = [number(length.interval, factor=at.spacing) if length else "" for length in each]
    fewest = min(len(runs) for runs in sizes.values())
    return [*(f"{value:g}" for value in at), *cells, number(minimum(sizes)), str(fewest)]
