"""Data of a figure in words: surfaces, sliding directions, seeds and material."""

import re
from collections.abc import Iterable, Mapping
from typing import Any

from springblock.model.material import Material, expanded, law_units
from springblock.model.scene import LENGTHS, Scene

#: By level, without pillars and with them.
_SURFACES = (("flat surface", "grooves", "grooves"), ("", "pillars", "grooved pillars"))
_NAMES = {"n_blocks": "N =", "direction": "sliding direction"}


def surface_in_words(*surfaces: Mapping[str, int]) -> str:
    """Name the lengths of surfaces, by level: n_p/n_s = 6/6, 20/20."""
    levels = []
    for size, gap in zip(LENGTHS[::2], LENGTHS[1::2], strict=True):
        pairs = [f"{lengths[size]}/{lengths[gap]}" for lengths in surfaces if lengths.get(size)]
        if pairs:
            levels.append(f"{size}/{gap} = {_listed(pairs)}")
    return ", ".join(levels)


def sample_in_words(sample: Mapping[Scene, range]) -> str:
    """Describe scenes and their seeds; surfaces that differ in their lengths only are listed.

    N and the sliding direction come first if all scenes share them.
    """
    scenes = sorted(sample, key=lambda s: (s.level, *s.lengths.values(), s.n_blocks))
    shared = [name for name in _NAMES if len(_values(scenes, name)) == 1]
    others = [name for name in _NAMES if name not in shared]
    one_surface: dict[tuple[Any, ...], list[Scene]] = {}
    for scene in scenes:
        varied = ", ".join(filter(None, [scene.row["varied"], *_own(scene)]))
        key = _surface(scene), varied, sample[scene], tuple(scene.lengths.items())
        one_surface.setdefault(key, []).append(scene)
    alike: dict[tuple[str, str, range, tuple[str, ...]], list[Scene]] = {}
    for (surface, varied, seeds, _), some in one_surface.items():
        pulled = tuple(_named(some, name) for name in others)
        alike.setdefault((surface, varied, seeds, pulled), []).append(some[0])
    any_varied = any(scene.row["varied"] for scene in scenes)
    kinds: dict[str, list[str]] = {}
    for (surface, varied, seeds, pulled), some in alike.items():
        lengths = surface_in_words(*(scene.lengths for scene in some))
        parts = [lengths, varied or ("no constant varied" if any_varied else ""), *pulled]
        several = f"{len(seeds)} realisations, seeds {seeds[0]} to {seeds[-1]}"
        seeded = several if len(seeds) > 1 else f"seed {seeds[0]}"
        text = f"{', '.join(filter(None, parts))} ({seeded})".strip()
        named = surface if parts[0] or not any(parts) else f"{surface},"
        kinds.setdefault(surface, [named]).append(text)
    sentences = [", ".join(_named(scenes, name) for name in shared)]
    sentences += [f"{named} {'; '.join(texts)}" for named, *texts in kinds.values()]
    return " ".join(f"{text[0].upper()}{text[1:]}." for text in sentences if text)


def file_name(scene: Scene) -> str:
    """Name the file of a surface's drawing or film, in letters, digits and _."""
    if scene.mask:
        return re.sub(r"\W", "_", str(scene.mask))
    sizes = scene.lengths | {"N": scene.n_blocks} | ({"rows": scene.n_rows} if scene.n_rows else {})
    kind = _SURFACES[scene.n_p > 0][min(scene.level, 2)].replace(" ", "_")
    return "_".join([kind, *(f"{name}_{size}" for name, size in sizes.items())])


def _surface(scene: Scene) -> str:
    """Return the kind of surface of a scene."""
    if scene.mask:
        return f"surface {scene.mask}"
    if scene.n_p3:
        return f"pillars grooved twice, the second time along {scene.along_3},"
    return _SURFACES[scene.n_p > 0][scene.level]


def _own(scene: Scene) -> list[str]:
    """Return the properties of a surface that the paper's surfaces lack."""
    rows = f"n_rows = {scene.n_rows}" if scene.n_rows else ""
    edges = "periodic edges" if scene.is_periodic else ""
    fields = {"mu_static": scene.mu_static_field, "mu_dynamic": scene.mu_dynamic_field}
    return [rows, edges, *(f"{name} from {field}" for name, field in fields.items() if field)]


def material_in_words(material: Material) -> str:
    """Name the constants that differ from the paper's."""
    paper, known = dict(Material().items()), dict(material.items())
    units = law_units(known)
    others = []
    for name, value in expanded(known).items():
        if value != paper.get(name):
            shown = value if isinstance(value, str) else f"{value:g} {units.get(name, '')}"
            others.append(f"{name} = {shown}".rstrip())
    rest = "constants not named are the paper's."
    return f"{_listed(others)}; {rest}" if others else rest.capitalize()


def _named(scenes: Iterable[Scene], name: str) -> str:
    return f"{_NAMES[name]} {_listed(_values(scenes, name))}"


def _values(scenes: Iterable[Scene], name: str) -> list[str]:
    values = dict.fromkeys(str(getattr(scene, name)) for scene in scenes)
    angles = name == "direction"
    return [f"{v}°" if angles and v not in ("x", "y") else v for v in values]


def _listed(names: Iterable[str]) -> str:
    """Join names, each once."""
    return ", ".join(dict.fromkeys(names))
