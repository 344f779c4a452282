"""Clusters of precursors: neighbours that detach before the force maximum."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.statistics import Interval, cluster_sizes, mean_interval
from springblock.beyond.question import Ensembles, grouped, is_even, number
from springblock.io.records import Record
from springblock.io.rows import markdown_table
from springblock.model.scene import Scene

Mask = NDArray[np.bool_]
NEEDS = "groups flat, pillars and grooves"
SHUFFLES = 20
_GROOVED = (58, 8, 0)  #: n_p, n_p2 and n_p3 of the paper's grooved pillars


def mean_size(detached: Mask) -> float:
    """Size of the cluster that a detached block belongs to, averaged over these blocks."""
    sizes = cluster_sizes(detached)
    return float((sizes**2).sum() / sizes.sum()) if sizes.size else np.nan


def precursors(run: Record) -> Mask:
    """Blocks that detach before the force maximum, (N, N)."""
    return run.t_det < run.t_max


def shuffled(detached: Mask, contact: Mask, rng: np.random.Generator) -> Mask:
    """Return the same number of blocks, drawn at random from those in contact, (N, N)."""
    drawn = np.zeros_like(detached)
    drawn[contact] = rng.permutation(detached[contact])
    return drawn


def mixed(masks: Sequence[Mask], rng: np.random.Generator) -> list[Mask]:
    """Permute the states of each block over the realisations, so that blocks are independent."""
    return list(rng.permuted(np.stack(masks), axis=0))


class Clusters(NamedTuple):
    """Clusters of precursors of an ensemble."""

    share: Interval  #: of the blocks in contact that detach before t_max
    observed: Interval  #: mean size, blocks
    ratio: Interval  #: of that to the size for as many blocks anywhere in contact
    ratio_mixed: Interval  #: the same for blocks in the same places, each from another realisation


def clusters(runs: Sequence[Record]) -> Clusters:
    """Return the sizes of clusters of precursors, and their ratios to random arrangements."""
    rng, contact = np.random.default_rng(0), runs[0].scene.contact
    masks = [precursors(run) for run in runs]
    share = [mask[contact].mean() for mask in masks]
    observed = np.array([mean_size(mask) for mask in masks])
    deals = [[mean_size(shuffled(mask, contact, rng)) for _ in range(SHUFFLES)] for mask in masks]
    anywhere = np.mean(deals, axis=1)
    deals = [[mean_size(mask) for mask in mixed(masks, rng)] for _ in range(SHUFFLES)]
    in_place = np.mean(deals, axis=0)
    found = share, observed, observed / anywhere, observed / in_place
    return Clusters(*map(mean_interval, found))


def surfaces(ensembles: Ensembles) -> dict[Scene, Sequence[Record]]:
    """Flat surfaces, pillars with n_s = n_p and grooved ones, of the size that most have."""
    found = grouped(
        (scene.n_blocks, (scene.level, scene.n_p, scene.direction, scene.folder), scene)
        for scene, runs in ensembles.items()
        if len(runs) >= 2 and not scene.varied and scene.direction in ("x", "y")
        if not scene.level or is_even(scene) or (scene.n_p, scene.n_p2, scene.n_p3) == _GROOVED
    )
    most = max(found.values(), key=len, default={})
    return {scene: ensembles[scene] for scene in most.values()}


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    found = {scene: clusters(runs) for scene, runs in surfaces(ensembles).items()}
    if not found:
        return
    anywhere = sum(bool(each.ratio.low > 1.0) for each in found.values())
    smaller = sum(bool(each.ratio.high < 1.0) for each in found.values())
    in_place = sum(bool(each.ratio_mixed.low > 1.0) for each in found.values())
    most = max(found, key=lambda scene: float(found[scene].ratio_mixed.mean))
    yield (
        "**Precursors form larger clusters than expected by chance**: larger than with blocks in "
        f"the same places on {in_place} of {len(found)} surfaces; larger than with as many blocks "
        f"anywhere on {anywhere}, and smaller on {smaller}. The largest ratio to blocks in the "
        f"same places is {number(found[most].ratio_mixed)} (surface: {name(most)})."
    )
    header = ["surface", "detached before t_max", "mean cluster (blocks)"]
    header += ["ratio to anywhere", "ratio to same places"]
    lines = [
        [name(scene), number(share, " %", 100.0), *map(number, sizes)]
        for scene, (share, *sizes) in found.items()
    ]
    yield markdown_table(header, lines)


def name(scene: Scene) -> str:
    """Name a surface for readers."""
    lengths = ", ".join(f"{key} = {length}" for key, length in scene.lengths.items())
    return f"{lengths or 'flat'}, {scene.direction}" if scene.n_p2 else lengths or "flat"
