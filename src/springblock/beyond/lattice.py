"""Lattice or layer: what changes with the spacing l, and what with the layer's thickness l_z?"""

from collections.abc import Iterator, Mapping, Sequence
from statistics import mode
from typing import NamedTuple

import numpy as np

from springblock.analysis.correlation import side_times
from springblock.analysis.statistics import Interval, difference_interval, mean_interval
from springblock.beyond.clusters import precursors
from springblock.beyond.friction import static_friction
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
from springblock.mechanism.elasticity import pull
from springblock.simulation.run import Array

NEEDS = "groups lattice, disorder and layer"
MICRO = 1e6  #: µm per m
_VARIED = {"spacing", "thickness", "mu_static_std", "mu_dynamic_std", "correlation_length", "step"}
_FEWEST = 3  #: surfaces of a comparison, and distances that a fit of two unknowns needs
_SIZES = 4  #: of pillars, among which the lowest friction is looked for


class Layer(NamedTuple):
    """A lattice, its layer and its disorder."""

    spacing: float  #: l, µm
    thickness: float  #: l_z, µm
    scatter: float  #: standard deviation of the static coefficients
    length: float  #: over which coefficients are alike, µm; 0 where each block has its own


Sizes = Mapping[float, Sequence[Record]]  #: realisations by the size of their pillars, µm
Surfaces = Mapping[Layer, Sizes]
Told = dict[str, tuple[bool, str]]  #: whether a value changes, and how, by comparison


class Comparison(NamedTuple):
    """Surfaces that differ in one length: coarse to fine lattices, or thin to thick layers."""

    words: str  #: what else is the same
    axis: str  #: the length, of `Layer`
    surfaces: Surfaces


def layers(ensembles: Ensembles) -> dict[Layer, Sizes]:
    """Pillars of all sizes on surfaces of one side in m, n_s = n_p, by lattice and layer."""
    items = []
    for scene, runs in ensembles.items():
        if is_even(scene, _VARIED):
            material = runs[0].material
            lengths = material.spacing, material.thickness, material.correlation_length
            spacing, thickness, length = (round(MICRO * each, 6) for each in lengths)
            side = round(scene.n_blocks * spacing, 6)
            at = Layer(spacing, thickness, material.mu_static_std, length)
            items.append(((side, at), scene.n_p * spacing, runs))
    sizes = grouped(items)
    found: dict[float, dict[Layer, Sizes]] = grouped((*place, sizes[place]) for place in sizes)
    return max(found.values(), key=len, default={})


def usual(surfaces: Surfaces) -> Layer:
    """What most surfaces have."""
    return Layer(*map(mode, zip(*surfaces, strict=True)))


def comparisons(surfaces: Surfaces) -> dict[str, Comparison]:
    """Lattices of one l_z, refined with each disorder, and layers of one l; three or more of each.

    Refined are blocks that scatter alike ("block"), the same disorder per area, whose scatter goes
    with 1/l ("area"), disorder of one correlation length ("length"), and none.
    """
    common = usual(surfaces)
    product = common.spacing * common.scatter
    words = {
        "block": "where blocks scatter alike on all lattices",
        "area": "at the same disorder per area",
        "length": "with disorder of one correlation length",
        "none": "without disorder",
        "layer": f"with l = {common.spacing:g} µm",
    }
    parts: dict[str, dict[Layer, Sizes]] = {name: {} for name in words}
    for at in sorted(surfaces, key=lambda at: (-at.spacing, at.thickness)):
        is_thick = at.thickness == common.thickness
        belongs = {
            "block": is_thick and (at.scatter, at.length) == (common.scatter, common.length),
            "area": is_thick and np.isclose(at.spacing * at.scatter, product) and not at.length,
            "length": is_thick and at.length > 0.0,
            "none": is_thick and not at.scatter,
            "layer": at._replace(thickness=common.thickness) == common,
        }
        for name in (name for name, is_part in belongs.items() if is_part):
            parts[name][at] = surfaces[at]
    axes = {"layer": "thickness"}
    return {
        name: Comparison(words[name], axes.get(name, "spacing"), part)
        for name, part in parts.items()
        if len(part) >= _FEWEST
    }


def decay(sizes: Sizes, size: float) -> SideLength | None:
    """Decay length on pillars of one size, blocks: from r = 1 to a third of a side."""
    runs = sizes.get(size, ())
    if len(runs) < FEWEST or "x" not in runs[0].scene.sides:
        return None
    scene = runs[0].scene
    times, last = side_times(runs, scene.pattern, "x"), scene.n_p // 3
    return SideLength(times, last) if last >= _FEWEST else None


def stress_ratio(runs: Sequence[Record]) -> float:
    """Largest elastic stress on a block over the mean, before any slip; there is no scatter."""
    stress = np.hypot(*pull(runs[0].scene.contact, runs[0].material).reshape(2, -1))
    return float(stress.max() / stress.mean())


def samples(sizes: Sizes) -> dict[float, Array]:
    """Static friction of each realisation by size, (k,)."""
    return {size: _of_all(runs, static_friction(runs)) for size, runs in sizes.items()}


def _of_all(runs: Sequence[Record], values: Array) -> Array:
    """Values of all realisations; where nothing scatters, of the only one, twice: exact."""
    return values if runs[0].material.mu_static_std else np.repeat(values[:1], 2)


def minimum(sizes: Sizes) -> Lowest | None:
    """Sizes of pillars with the lowest static friction, µm."""
    return lowest(samples(sizes)) if len(sizes) >= _SIZES else None


def measures(sizes: Sizes, best: float, middle: float, broad: float) -> dict[str, Interval]:
    """What is compared, by name: on pillars of the best size and on larger ones, µm."""
    found = {}
    if best in sizes:
        runs, name = sizes[best], f"on pillars of {best:g} µm"
        stress, force = stress_ratio(runs), samples(sizes)
        shares = np.array([100.0 * precursors(run)[run.scene.contact].mean() for run in runs])
        found[f"the largest over the mean elastic stress {name}"] = mean_interval([stress] * 2)
        found[f"static friction {name}"] = mean_interval(force[best])
        found[f"the share of precursors {name} (%)"] = mean_interval(_of_all(runs, shares))
        if broad in sizes:
            key = f"static friction on pillars of {broad:g} µm minus that of {best:g} µm"
            found[key] = difference_interval(force[broad], force[best])
    for size in (middle, broad):
        if fit := decay(sizes, size):
            spacing, blocks = MICRO * sizes[size][0].material.spacing, fit.interval
            key = f"the decay length on pillars of {size:g} µm (µm)"
            found[key] = Interval(*(spacing * limit for limit in blocks))
            if size == broad:
                found[f"the decay length in blocks on pillars of {size:g} µm (blocks)"] = blocks
    return found


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    surfaces = layers(ensembles)
    compared = comparisons(surfaces) if surfaces else {}
    best = minimum(surfaces[usual(surfaces)]) if {"block", "layer"} <= set(compared) else None
    if best is None:
        return
    larger = sorted(size for size in surfaces[usual(surfaces)] if size > best.place) or [best.place]
    found = {
        at: measures(sizes, best.place, larger[0], larger[-1]) for at, sizes in surfaces.items()
    }
    names = list(dict.fromkeys(name for each in found.values() for name in each))
    told = {name: changes(compared, found, name) for name in names}
    for kind in {"area", "length", "none"} & set(compared):  # stress knows of no disorder
        told[names[0]].pop(kind, None)
    told["the friction-minimising size"] = _moves(compared)
    yield from _conclusions(told)
    for name, said in told.items():
        how = "; ".join(words for _, words in said.values())
        yield f"**{_plain(name, upper=True)}** {how}."
    header = ["scatter", "l (µm)", "l_z (µm)", *(name.removeprefix("the ") for name in names)]
    header += ["friction-minimising size (µm)", "sizes (µm)", "realisations, at least"]
    lines = []
    for at, sizes in surfaces.items():
        scatter = f"{at.scatter:g}" + (f", alike over {at.length:g} µm" if at.length else "")
        values = [number(found[at][name]) if name in found[at] else "" for name in names]
        own = [str(minimum(sizes) or ""), ", ".join(f"{size:g}" for size in sizes)]
        fewest = str(min(len(runs) for runs in sizes.values()))
        lines.append([scatter, f"{at.spacing:g}", f"{at.thickness:g}", *values, *own, fewest])
    yield markdown_table(header, lines)


def _plain(name: str, upper: bool = False) -> str:
    """A name without its unit."""
    bare = name.partition(" (")[0]
    return bare[0].upper() + bare[1:] if upper else bare


def _place(at: Layer, axis: str) -> str:
    return f"{'l' if axis == 'spacing' else 'l_z'} = {getattr(at, axis):g} µm"


def changes(
    compared: Mapping[str, Comparison], found: Mapping[Layer, Mapping[str, Interval]], name: str
) -> Told:
    """How a value changes from the first to the last surface of each comparison."""
    said = {}
    unit = name.removeprefix(_plain(name)).replace("(", "").replace(")", "")
    for kind, (words, axis, surfaces) in compared.items():
        known = {at: found[at][name] for at in surfaces if name in found[at]}
        if len(known) >= 2:
            (first, one), *_, (last, other) = known.items()
            verb = change(one, other)
            text = f"{verb} from {number(one, unit)} at {_place(first, axis)} to "
            text += f"{number(other, unit)} at {_place(last, axis)} {words}"
            said[kind] = verb != UNCHANGED, text
    return said


def _moves(compared: Mapping[str, Comparison]) -> Told:
    """How the size with the lowest friction changes, where l <= l_z, among sizes that all have."""
    said = {}
    for kind, (words, axis, surfaces) in compared.items():
        fine = {
            at: sizes
            for at, sizes in surfaces.items()
            if at.spacing <= at.thickness and len(sizes) >= _SIZES
        }
        common = sorted(set.intersection(*map(set, fine.values()))) if len(fine) >= 2 else []
        found = {at: minimum({s: sizes[s] for s in common}) for at, sizes in fine.items()}
        best = {at: each for at, each in found.items() if each}
        if best:
            moves = not set.intersection(*(set(each.alike) for each in best.values()))
            sizes = ", ".join(f"{each} µm at {_place(at, axis)}" for at, each in best.items())
            said[kind] = moves, f"{'changes' if moves else UNCHANGED} {words}: {sizes}"
    return said


def _conclusions(told: Mapping[str, Told]) -> Iterator[str]:
    """Say what changes with l, however the lattice is refined or in some ways, and with l_z."""
    lattice: dict[str, list[str]] = {"in every refinement below": [], "in some": [], "in none": []}
    for name, said in told.items():
        changes = [changed for kind, (changed, _) in said.items() if kind != "layer"]
        if changes and not name.endswith("(blocks)"):
            every, some, none = lattice.values()
            (every if all(changes) else some if any(changes) else none).append(_plain(name))
    layer = [_plain(name) for name, said in told.items() if said.get("layer", (False, ""))[0]]
    parts = [f"{listed(names)} {how}" for how, names in lattice.items() if names]
    yield f"**The spacing l of the lattice changes {'; '.join(parts)}.**"
    yield f"**The thickness l_z of the layer changes {listed(layer) or 'none of these'}.**"
