"""Quantities that change with the lattice spacing l, and those that change with the layer l_z."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from statistics import mode
from typing import NamedTuple

import numpy as np

from springblock.analysis.lowest import Lowest, are_apart, lowest
from springblock.analysis.statistics import Interval, difference_interval, mean_interval
from springblock.beyond.clusters import precursors
from springblock.beyond.friction import samples
from springblock.beyond.question import (
    UNCHANGED,
    Ensembles,
    change,
    direction,
    is_even,
    number,
    on_one_side,
)
from springblock.beyond.resampling import side_length
from springblock.io.records import Record
from springblock.io.rows import listed, markdown_table
from springblock.mechanism.elasticity import Layer

NEEDS = "groups lattice, disorder and layer"
MICRO = 1e6  #: µm per m
_VARIED = {"spacing", "thickness", "mu_static_std", "mu_dynamic_std", "correlation_length", "step"}
_FEWEST = 3  #: surfaces of a comparison
_SIZES = 4  #: of pillars, among which the lowest friction is looked for


class Lattice(NamedTuple):
    """A lattice, its layer and its disorder."""

    spacing: float  #: l, µm
    thickness: float  #: l_z, µm
    scatter: float  #: standard deviation of the static coefficients
    length: float  #: over which coefficients are alike, µm; 0 where each block has its own


class Quantity(NamedTuple):
    """What is compared."""

    name: str
    unit: str = ""

    def __str__(self) -> str:
        """Write the heading of a column."""
        bare = self.name.removeprefix("the ")
        return f"{bare} ({self.unit})" if self.unit else bare


Sizes = Mapping[float, Sequence[Record]]  #: realisations by the size of their pillars, µm
Surfaces = Mapping[Lattice, Sizes]
Changes = dict[str, tuple[str, str]]  #: how a value changes, by comparison: verb and sentence


class Comparison(NamedTuple):
    """Surfaces that differ in one length: coarse to fine lattices, or thin to thick layers."""

    words: str  #: what else is the same
    axis: str  #: the length, of `Lattice`
    surfaces: Surfaces


def by_lattice(ensembles: Ensembles) -> Surfaces:
    """Pillars of all sizes on surfaces of one side in m, n_s = n_p, by lattice and layer.

    Without scatter all realisations are equal; one is listed twice, as an exact value.
    """
    items = []
    for scene, runs in ensembles.items():
        if is_even(scene, _VARIED):
            material = runs[0].material
            lengths = material.spacing, material.thickness, material.correlation_length
            spacing, thickness, length = (round(MICRO * each, 6) for each in lengths)
            at = Lattice(spacing, thickness, material.mu_static_std, length)
            side = round(scene.n_blocks * spacing, 6)
            items.append((side, at, scene.n_p * spacing, runs if at.scatter else [runs[0]] * 2))
    return on_one_side(items)


def usual(surfaces: Surfaces) -> Lattice:
    """Return the lattice, layer and disorder that most surfaces have."""
    return Lattice(*map(mode, zip(*surfaces, strict=True)))


def comparisons(surfaces: Surfaces) -> dict[str, Comparison]:
    """Lattices of one l_z, refined with each disorder, and layers of one l; three or more of each.

    Disorder is one scatter of all blocks ("block"), one disorder per area, with a scatter that is
    proportional to 1/l ("area"), disorder of one correlation length ("length"), or none.
    """
    common = usual(surfaces)
    product = common.spacing * common.scatter
    words = {
        "block": "Same scatter on every lattice",
        "area": "Same disorder per area",
        "length": "Disorder of a fixed correlation length",
        "none": "No disorder",
        "layer": f"Thicker layers, l = {common.spacing:g} µm",
    }
    ordered = sorted(surfaces, key=lambda at: (-at.spacing, at.thickness))
    thick = [at for at in ordered if at.thickness == common.thickness]
    own = [at for at in thick if not at.length]
    parts = {
        "block": [at for at in thick if at._replace(spacing=common.spacing) == common],
        "area": [at for at in own if np.isclose(at.spacing * at.scatter, product)],
        "length": [at for at in thick if at.length],
        "none": [at for at in thick if not at.scatter],
        "layer": [at for at in ordered if at._replace(thickness=common.thickness) == common],
    }
    return {
        name: Comparison(
            words[name],
            "thickness" if name == "layer" else "spacing",
            {at: surfaces[at] for at in part},
        )
        for name, part in parts.items()
        if len(part) >= _FEWEST
    }


def stress_ratio(runs: Sequence[Record]) -> float:
    """Largest elastic stress on a block over the mean, before any slip; there is no scatter."""
    stress = Layer(runs[0].scene.contact, runs[0].material).stress
    return float(stress.max() / stress.mean())


def minimum(sizes: Sizes) -> Lowest | None:
    """Sizes of pillars with the lowest static friction, µm."""
    return lowest(samples(sizes)) if len(sizes) >= _SIZES else None


def measures(sizes: Sizes, best: float, middle: float, broad: float) -> dict[Quantity, Interval]:
    """Return the quantities compared, on pillars of the best size and on larger ones, µm."""
    found = {}
    if best in sizes:
        runs, name, force = sizes[best], f"on pillars of {best:g} µm", samples(sizes)
        stress = Quantity(f"the stress concentration {name}")
        found[stress] = mean_interval([stress_ratio(runs)] * 2)  # exact
        found[Quantity(f"static friction {name}")] = mean_interval(force[best])
        shares = [100.0 * precursors(run)[run.scene.contact].mean() for run in runs]
        possible = Interval(*np.clip(mean_interval(shares), 0.0, 100.0))
        found[Quantity(f"the share of precursors {name}", "%")] = possible
        if broad in sizes:
            more = Quantity(f"static friction on pillars of {broad:g} µm minus that of {best:g} µm")
            found[more] = difference_interval(force[broad], force[best])
    for size in (middle, broad):
        if size in sizes and (blocks := side_length(sizes[size])):
            spacing, where = MICRO * sizes[size][0].material.spacing, f"on pillars of {size:g} µm"
            metres = Interval(*(spacing * limit for limit in blocks))
            found[Quantity(f"the decay length {where}", "µm")] = metres
            if size == broad:
                found[Quantity(f"the decay length in blocks {where}", "blocks")] = blocks
    return found


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    surfaces = by_lattice(ensembles)
    compared = comparisons(surfaces) if surfaces else {}
    best = minimum(surfaces[usual(surfaces)]) if {"block", "layer"} <= set(compared) else None
    if best is None:
        return
    larger = [size for size in surfaces[usual(surfaces)] if size > best.place] or [best.place]
    found = {
        at: measures(sizes, best.place, larger[0], larger[-1]) for at, sizes in surfaces.items()
    }
    quantities = list(dict.fromkeys(chain.from_iterable(found.values())))
    changed = {each: changes(compared, found, each) for each in quantities}
    for kind in {"area", "length", "none"} & set(compared):  # elastic stress has no disorder
        changed[quantities[0]].pop(kind, None)
    changed[Quantity("the friction-minimising size")] = _moves(compared)
    yield _conclusion(changed)
    for (name, _), by_comparison in changed.items():
        bullets = "\n".join(f"- {words}" for _, words in by_comparison.values())
        yield f"**{name[0].upper()}{name[1:]}:**\n\n{bullets}"
    header = ["scatter", "l (µm)", "l_z (µm)", *map(str, quantities)]
    header += ["friction-minimising size (µm)", "sizes (µm)", "realisations, at least"]
    lines = []
    for at, sizes in surfaces.items():
        scatter = f"{at.scatter:g}" + (f", correlated over {at.length:g} µm" if at.length else "")
        values = [number(found[at][each]) if each in found[at] else "" for each in quantities]
        own = [str(minimum(sizes) or ""), ", ".join(f"{size:g}" for size in sizes)]
        fewest = min(len({run.seed for run in runs}) for runs in sizes.values())
        lines.append([scatter, f"{at.spacing:g}", f"{at.thickness:g}", *values, *own, f"{fewest}"])
    yield markdown_table(header, lines)


def _place(at: Lattice, axis: str) -> str:
    return f"{'l' if axis == 'spacing' else 'l_z'} = {getattr(at, axis):g} µm"


def changes(
    compared: Mapping[str, Comparison],
    found: Mapping[Lattice, Mapping[Quantity, Interval]],
    quantity: Quantity,
) -> Changes:
    """Say how a value changes from the first to the last surface of each comparison."""
    said = {}
    unit = quantity.unit and f" {quantity.unit}"
    for kind, (words, axis, surfaces) in compared.items():
        known = [(at, found[at][quantity]) for at in surfaces if quantity in found[at]]
        if len(known) >= 2:
            (first, before), (last, after) = known[0], known[-1]
            places = f" at {_place(first, axis)}", f" at {_place(last, axis)}"
            sentence = f"{words}: {change(before, after, unit, places)}."
            said[kind] = direction(before, after), sentence
    return said


def _moves(compared: Mapping[str, Comparison]) -> Changes:
    """Say how the friction-minimising size changes, where l <= l_z, among sizes that all have."""
    said = {}
    for kind, (words, axis, surfaces) in compared.items():
        fine = {
            at: sizes
            for at, sizes in surfaces.items()
            if at.spacing <= at.thickness and len(sizes) >= _SIZES
        }
        common = sorted(set.intersection(*map(set, fine.values()))) if len(fine) >= 2 else []
        if len(common) >= _SIZES:
            best = {
                at: lowest(samples({s: sizes[s] for s in common})) for at, sizes in fine.items()
            }
            verb = "changes" if are_apart(best.values()) else UNCHANGED
            places = ", ".join(f"{each} µm at {_place(at, axis)}" for at, each in best.items())
            among = listed([f"{size:g}" for size in common])
            said[kind] = verb, f"{words}: {verb} ({places}; among {among} µm)."
    return said


def _conclusion(changed: Mapping[Quantity, Changes]) -> str:
    """Say what changes with l (in all refinements of the lattice, in some or in none) and l_z."""
    every, opposite, some, none, layer = (list[str]() for _ in range(5))
    for (name, unit), by_comparison in changed.items():
        verbs = {kind: verb for kind, (verb, _) in by_comparison.items()}
        if unit == "blocks":  # the same in µm is among them
            continue
        if verbs.pop("layer", UNCHANGED) != UNCHANGED:
            layer.append(name)
        found = {*verbs.values()}
        if found == {UNCHANGED}:
            none.append(name)
        elif UNCHANGED in found:
            some.append(name)
        elif found:
            (every if len(found) == 1 else opposite).append(name)
    cases = {
        "in every case below": every,
        "in every case, but not in the same direction": opposite,
        "in some cases": some,
        "in no case": none,
    }
    of_lattice = "; ".join(f"{_grouped(names)} ({how})" for how, names in cases.items() if names)
    return (
        f"**Refining the lattice changes** {of_lattice}. **A thicker layer changes** "
        f"{_grouped(layer) or 'none of these'}."
    )


def _grouped(names: Sequence[str]) -> str:
    """List names, those on the same pillars together."""
    found: dict[str, list[str]] = {}
    for name in names:
        what, on, where = name.partition(" on pillars")
        found.setdefault(on + where, []).append(what)
    parts = [listed(group) + where for where, group in found.items()]
    return ", and ".join(filter(None, [", ".join(parts[:-1]), *parts[-1:]]))
