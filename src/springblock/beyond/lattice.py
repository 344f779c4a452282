"""Quantities that change with the lattice spacing l, and those that change with the layer l_z."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from statistics import mode
from typing import NamedTuple

import numpy as np

from springblock.analysis.lowest import Lowest, are_apart, lowest
from springblock.analysis.statistics import (
    Interval,
    difference_interval,
    independent_difference,
    mean_interval,
    number,
)
from springblock.beyond.friction import samples
from springblock.beyond.question import (
    UNCHANGED,
    Ensembles,
    direction,
    is_even,
    on_one_side,
    side_length,
)
from springblock.io.records import Record
from springblock.io.rows import listed, markdown_table
from springblock.mechanism.elasticity import Layer

NEEDS = "groups lattice, disorder and layer"
MICRO = 1e6  #: µm per m
_VARIED = {"spacing", "thickness", "mu_static_std", "mu_dynamic_std", "correlation_length", "step"}
_FEWEST = 3  #: surfaces of a comparison
_SIZES = 4  #: least number of sizes of pillars for a minimum of friction


class Lattice(NamedTuple):
    """A lattice, its layer and its disorder."""

    spacing: float  #: l, µm
    thickness: float  #: l_z, µm
    scatter: float  #: standard deviation of the static coefficients
    length: float  #: correlation length of the coefficients, µm; 0 if they are independent


Sizes = Mapping[float, Sequence[Record]]  #: realisations by the size of their pillars, µm
Surfaces = Mapping[Lattice, Sizes]
Changes = dict[str, tuple[str, str]]  #: change of a value by comparison: verb, and all words


class Comparison(NamedTuple):
    """Surfaces that differ in one length: coarse to fine lattices, or thin to thick layers."""

    words: str  #: name of the comparison
    axis: str  #: the length, a field of `Lattice`
    surfaces: Surfaces

    @property
    def fine(self) -> Surfaces:
        """Surfaces whose lattice is no coarser than the layer is thick."""
        return {at: self.surfaces[at] for at in self.surfaces if at.spacing <= at.thickness}


Comparisons = Mapping[str, Comparison]


def by_lattice(ensembles: Ensembles) -> Surfaces:
    """Pillars with n_s = n_p on equally wide surfaces (µm), by lattice and layer, by size.

    Without scatter all realisations are equal; one is listed twice, so that intervals vanish.
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
    """Lattices of one l_z with the same disorder, and layers of one l; three or more of each.

    The disorder is that of the same scatter on all lattices ("block"), the same per area, with a
    scatter proportional to 1/l ("area"), one of a fixed correlation length ("length"), or none.
    """
    common = usual(surfaces)
    product = common.spacing * common.scatter
    ordered = sorted(surfaces, key=lambda at: (-at.spacing, at.thickness))
    layers = [at for at in ordered if at._replace(thickness=common.thickness) == common]
    thick = [at for at in ordered if at.thickness == common.thickness]
    block = [at for at in thick if at._replace(spacing=common.spacing) == common]
    area = [at for at in thick if not at.length and np.isclose(at.spacing * at.scatter, product)]
    length = [at for at in thick if at.length]
    none = [at for at in thick if not at.scatter]
    parts = {
        "block": ("The same scatter on every lattice", "spacing", block),
        "area": ("The same disorder per area", "spacing", area),
        "length": ("Correlated coefficients", "spacing", length),
        "none": ("No disorder", "spacing", none),
        "layer": (f"Thicker layers, l = {common.spacing:g} µm", "thickness", layers),
    }
    return {
        name: Comparison(words, axis, {at: surfaces[at] for at in part})
        for name, (words, axis, part) in parts.items()
        if len(part) >= _FEWEST
    }


def stress_ratio(runs: Sequence[Record]) -> float:
    """Largest elastic stress on a block over the mean, before any slip."""
    stress = Layer(runs[0].scene.contact, runs[0].material).stress
    return float(stress.max() / stress.mean())


def minimum(sizes: Sizes) -> Lowest | None:
    """Sizes of pillars with the lowest static friction, µm."""
    return lowest(samples(sizes)) if len(sizes) >= _SIZES else None


def measures(sizes: Sizes, best: float, middle: float, broad: float) -> dict[str, Interval]:
    """Return the quantities compared, on pillars of the best size and on larger ones, µm."""
    found = {}
    if best in sizes:
        runs, where, force = sizes[best], f"on pillars of {best:g} µm", samples(sizes)
        exact = mean_interval([stress_ratio(runs)] * 2)
        found[f"stress concentration {where}"] = exact
        found[f"static friction {where}"] = mean_interval(force[best])
        shares = [100.0 * (run.t_det < run.t_max)[run.scene.contact].mean() for run in runs]
        possible = Interval(*np.clip(mean_interval(shares), 0.0, 100.0))
        found[f"share of precursors {where} (%)"] = possible
        if broad in sizes:
            more = f"on pillars of {broad:g} µm minus that {where}"
            found[f"static friction {more}"] = difference_interval(force[broad], force[best])
    for size in (middle, broad):
        if size in sizes and (blocks := side_length(sizes[size])):
            spacing, where = MICRO * sizes[size][0].material.spacing, f"on pillars of {size:g} µm"
            metres = Interval(*(spacing * limit for limit in blocks))
            found[f"decay length {where} (µm)"] = metres
            if size == broad:
                found[f"decay length {where} (blocks)"] = blocks
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
    changed = {
        each: changes(compared, {at: own[each] for at, own in found.items() if each in own})
        for each in quantities
    }
    moves = _moves(compared)
    yield _conclusion(compared, changed, moves)
    cells = [
        [name, *(by[kind][1] if kind in by else "" for kind in compared)]
        for name, by in changed.items()
    ]
    yield markdown_table(["change of", *(each.words for each in compared.values())], cells)
    bullets = (
        f"- {compared[kind].words}: {verb}, {places}." for kind, (verb, places) in moves.items()
    )
    yield "**The friction-minimising size:**\n\n" + "\n".join(bullets)
    header = ["scatter", "l (µm)", "l_z (µm)", *quantities]
    header += [
        "friction-minimising size (µm)",
        "sizes (µm)",
        "realisations per size, at least",
    ]
    lines = []
    for at, sizes in surfaces.items():
        scatter = f"{at.scatter:g}" + (f", correlated over {at.length:g} µm" if at.length else "")
        values = [number(found[at][each]) if each in found[at] else "" for each in quantities]
        own = [str(minimum(sizes) or ""), ", ".join(f"{size:g}" for size in sizes)]
        fewest = min(len({run.seed for run in runs}) for runs in sizes.values())
        lines.append([scatter, f"{at.spacing:g}", f"{at.thickness:g}", *values, *own, f"{fewest}"])
    yield markdown_table(header, lines)


def changes(compared: Comparisons, values: Mapping[Lattice, Interval]) -> Changes:
    """Return how a value changes from the first to the last surface of each comparison, l <= l_z.

    The words are the difference or, between values without scatter, the verb; and a note if the
    means are not monotonic.
    """
    changed = {}
    for kind, each in compared.items():
        known = [values[at] for at in each.fine if at in values]
        if len(known) >= 2:
            verb = direction(known[0], known[-1])
            apart = independent_difference(known[-1], known[0])
            words = verb if apart.low == apart.high else number(apart)
            means = [float(value.mean) for value in known]
            in_turn = sorted(means) in (means, means[::-1])
            changed[kind] = verb, words if in_turn else f"{words}, not monotonic"
    return changed


def _moves(compared: Comparisons) -> Changes:
    """Return whether the friction-minimising size changes for l <= l_z, and its values.

    Sizes compared are those common to all surfaces of a comparison.
    """
    changed = {}
    for kind, each in compared.items():
        fine = {at: sizes for at, sizes in each.fine.items() if len(sizes) >= _SIZES}
        common = sorted(set.intersection(*map(set, fine.values()))) if len(fine) >= 2 else []
        if len(common) >= _SIZES:
            best = {
                at: lowest(samples({s: sizes[s] for s in common})) for at, sizes in fine.items()
            }
            verb = "changes" if are_apart(best.values()) else UNCHANGED
            axis = "l" if each.axis == "spacing" else "l_z"
            places = [
                f"{size} µm at {axis} = {getattr(at, each.axis):g} µm" for at, size in best.items()
            ]
            among = listed([f"{size:g}" for size in common])
            changed[kind] = verb, f"{listed(places)} (sizes compared: {among} µm)"
    return changed


def _conclusion(compared: Comparisons, changed: Mapping[str, Changes], moves: Changes) -> str:
    """Write how the friction-minimising size, friction and the decay length in µm change."""
    thicker, places = moves.get("layer", ("is not compared", ""))
    friction = next(name for name in changed if name.startswith("static friction"))
    values = [f"{friction} {_refined(compared, changed[friction])}"]
    if lengths := [name for name in changed if name.startswith("decay") and "(µm)" in name]:
        length = lengths[-1].replace(" (µm)", ", in µm,")
        values.append(f"the {length} {_refined(compared, changed[lengths[-1]])}")
    return (
        f"**On thicker layers, the friction-minimising size {thicker}**"
        + (f": it is {places}" if places else "")
        + f". **On finer lattices, with l <= l_z, it {_refined(compared, moves)}.** As the "
        f"lattice is refined, {'; '.join(values)}."
    )


def _refined(compared: Comparisons, changed: Changes) -> str:
    """Write the change on finer lattices, by disorder where it depends on it."""
    kinds: dict[str, list[str]] = {}
    for kind, (verb, _) in changed.items():
        if kind != "layer":
            kinds.setdefault(verb, []).append(f"*{compared[kind].words.lower()}*")
    if len(kinds) < 2:
        return next(iter(kinds), "is not compared")
    return listed([f"{verb} for {listed(each)}" for verb, each in kinds.items()])
