"""Flat surfaces: isolated precursors anywhere, then the front (section 3.1 of the paper)."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from springblock.claims.rule import Claim, Evidence, Finding
from springblock.claims.samples import (
    ALIKE,
    INF,
    NEGATIVE,
    POSITIVE,
    Mask,
    in_files,
    lags,
    mean,
    over_runs,
    place,
    scenes_along_x,
)
from springblock.run import Array, Run
from springblock.statistics import mean_interval, repeatability

_EARLY = 0.9  #: of t_max
_CORE = 10  #: blocks from the edges of the surface to its core
_SMALL = 0.2  #: difference in standard deviations that is called small (Cohen 1988)
_FLAT = "realisations of the flat surface"


def neighbours(field: Array, outside: float) -> Array:
    """Values of the eight neighbours, (8, N, N), with `outside` beyond the edges."""
    padded, (rows, columns) = np.pad(field, 1, constant_values=outside), field.shape
    shifts = [(y, x) for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.stack([padded[y : y + rows, x : x + columns] for y, x in shifts])


def isolated(run: Run, until: float) -> float:
    """Share of the blocks detached before `until` t_max that had eight resting neighbours then.

    Blocks that never detach, NaN, count as resting.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_det), axis=0)
    return _share(alone, run.t_det < until * run.t_max)


def lonely(run: Run) -> float:
    """Share of the blocks detaching before 0.9 t_max around which no other has by t_max.

    None of these has started a front by itself in a tenth of t_max.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return _share(alone, run.t_det < _EARLY * run.t_max)


def _share(blocks: Mask, among: Mask) -> float:
    return float(blocks[among].mean()) if among.any() else float("nan")


def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Precursors come one by one; up to t_max and up to a tenth of t_max before it."""
    for scene in scenes_along_x(evidence.records, 0):
        for until in (_EARLY, 1.0):
            shares = over_runs(partial(isolated, until=until), evidence.records[scene])
            yield Finding(
                {"N": scene.n_blocks, "t/t_max below": until},
                "share of the blocks detached by then that let go while all eight neighbours were "
                "at rest since the start",
                mean(shares),
                (0.5, INF),
                in_files(scene),
            )


def not_all_nucleate(evidence: Evidence) -> Iterator[Finding]:
    """Some early precursors stay alone until the force maximum."""
    for scene in scenes_along_x(evidence.records, 0):
        yield Finding(
            place(scene),
            "share of the blocks detached before 0.9 t_max around which no other has by t_max",
            mean(over_runs(lonely, evidence.records[scene])),
            POSITIVE,
            in_files(scene),
        )


def peak_before_average(evidence: Evidence) -> Iterator[Finding]:
    """t_max < t_avg on flat surfaces."""
    return lags(evidence, 0, 0, NEGATIVE)


def uniform(evidence: Evidence) -> Iterator[Finding]:
    """Place does not matter: within the core, and at the outermost blocks against the core."""
    for scene in scenes_along_x(evidence.records, 0):
        n = scene.n_blocks
        from_edge = np.minimum(np.arange(n), np.arange(n)[::-1])
        depth = np.minimum.outer(from_edge, from_edge)
        core = depth >= min(_CORE, n // 4)
        times = np.stack([run.t_det for run in evidence.records[scene]])
        yield Finding(
            {"N": n, "part": "core"},
            "share of the variance of t_det that place explains (jackknife)",
            repeatability(times[:, core]),
            (-INF, ALIKE),
            in_files(scene),
        )
        late = [(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times]
        yield Finding(
            {"N": n, "part": "outermost blocks"},
            "mean t_det minus that of the core",
            mean_interval(late),
            (-_SMALL, _SMALL),
            in_files(scene),
            "standard deviations of t_det",
        )


CLAIMS = (
    Claim(
        "Isolated precursors on flat surfaces",
        "3.1",
        "Slip precursors occur as single detachment events before the macroscopic sliding phase.",
        _FLAT,
        isolated_precursors,
    ),
    Claim(
        "Not every precursor starts a front",
        "3.1",
        "Not all the precursors trigger a rupture wave front.",
        _FLAT,
        not_all_nucleate,
    ),
    Claim(
        "t_max < t_avg on flat surfaces",
        "3.1",
        "The force maximum occurs before the average detachment time.",
        _FLAT,
        peak_before_average,
    ),
    Claim(
        "Detachment times are uniform on flat surfaces",
        "3.2",
        "In repeated simulations the spatial distribution of the initial detachment time is "
        "uniform.",
        f"three {_FLAT} or more",
        uniform,
    ),
)
