"""Correlation of detachment times along the sides of pillars, sections 3.2 and 3.3."""

from collections.abc import Iterator

import numpy as np

from springblock.claims.rule import Claim, Evidence, Finding, Row
from springblock.claims.samples import (
    ALONG,
    INF,
    POSITIVE,
    SMALLEST,
    families,
    family_place,
    in_rows,
    interval,
    place,
    scenes_along_x,
    select,
)
from springblock.scene import Scene
from springblock.statistics import Interval

_FAR = 3  #: blocks, the paper's lower bound of the correlation length
_FEW = 10  #: n_p below which the paper finds l_c difficult to estimate
_CLOSE = 0.1  #: difference between correlation functions that look the same
_TABLES = "tables of correlation along the sides of pillars with n_p of 10 or more"


def apart(first: Interval, second: Interval) -> Interval:
    """First - second of the same runs: errors add up, since tables do not say how they go along."""
    return Interval(first.mean - second.mean, first.low - second.high, first.high - second.low)


def between(first: Interval, second: Interval) -> Interval:
    """First - second of different surfaces, from the intervals of both as if independent.

    Errors add up in squares, each side for itself (Zou & Donner 2008, doi:10.1002/sim.3095).
    Realisations of different surfaces with the same seeds are hardly correlated.
    """
    difference = first.mean - second.mean
    below = np.hypot(first.mean - first.low, second.high - second.mean)
    above = np.hypot(first.high - first.mean, second.mean - second.low)
    return Interval(difference, difference - below, difference + above)


def _fits(evidence: Evidence, scene: Scene) -> list[Row]:
    """The row of l_c along the sides that slide along themselves, if there is one."""
    return select(evidence.correlation_length[scene], side=ALONG)


def long_along_short_across(evidence: Evidence) -> Iterator[Finding]:
    """c_x is larger than c_y three blocks away; c_y falls below 1/e within one block."""
    for scene in scenes_along_x(evidence.correlation, 1, SMALLEST):
        rows = evidence.correlation[scene]
        far = [row for side in "xy" for row in select(rows, side=side, r=_FAR)]
        near = select(rows, side="y", r=1)
        if len(far) < 2 or not near:
            continue
        yield Finding(
            place(scene),
            f"c_x(r = {_FAR}) - c_y(r = {_FAR}) (sum of both intervals)",
            apart(*(interval(row, "correlation") for row in far)),
            POSITIVE,
            in_rows("correlation", scene, r=_FAR),
        )
        yield Finding(
            place(scene),
            "c_y(r = 1)",
            interval(near[0], "correlation"),
            (-INF, float(np.exp(-1.0))),
            in_rows("correlation", scene, side="y", r=1),
        )


def exponential(evidence: Evidence) -> Iterator[Finding]:
    """c_x(r) stays close to exp(-r/l_c) wherever that was fitted; the worst r is shown."""
    for scene in scenes_along_x(evidence.correlation_length, 1, _FEW):
        for fit in _fits(evidence, scene):
            gaps = {}
            for row in select(evidence.correlation.get(scene, ()), side=ALONG):
                if 1 <= row["r"] <= fit["r_last"]:  # the interval of l_c has its own claim
                    fitted = np.exp(-row["r"] / fit["l_c"])
                    gaps[row["r"]] = Interval(*(c - fitted for c in interval(row, "correlation")))
            if not gaps:
                continue
            worst = max(gaps, key=lambda r: max(abs(gaps[r].low), abs(gaps[r].high)))
            yield Finding(
                place(scene),
                f"c_x(r) - exp(-r/l_c) where its interval reaches furthest from 0, at r = {worst}",
                gaps[worst],
                (-_CLOSE, _CLOSE),
                in_rows("correlation", scene, side="x", r=worst),
            )


def three_blocks(evidence: Evidence) -> Iterator[Finding]:
    """l_c of c_x is three blocks or more, in a fit through c(0) = 1 or in one free of it."""
    for scene in scenes_along_x(evidence.correlation_length, 1, _FEW):
        for fit in _fits(evidence, scene):
            free = interval(fit, "tail", "tail_low", "tail_high")
            for model, length in (("exp(-r/l_c)", interval(fit, "l_c")), ("A exp(-r/l_c)", free)):
                if np.isnan(length.mean):
                    continue
                yield Finding(
                    {**place(scene), "fit": model},
                    "l_c of c_x",
                    length,
                    (_FAR, INF),
                    in_rows("correlation_length", scene, side="x"),
                    "blocks",
                )


def growing_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c of the largest pillars is larger than that of the smallest it can be estimated for."""
    for family in families(evidence.correlation_length, _FEW):
        fits = [fit for scene in family for fit in _fits(evidence, scene)]
        if len(fits) < 2:
            continue
        n, first, last = family[0].n_blocks, fits[0], fits[-1]
        yield Finding(
            family_place(family[0]),
            f"l_c at n_p = {last['n_p']} minus l_c at n_p = {first['n_p']} (from both intervals)",
            between(interval(last, "l_c"), interval(first, "l_c")),
            POSITIVE,
            f"tables/correlation_length: N = {n}, n_p = {first['n_p']} and {last['n_p']}, side = x",
            "blocks",
        )


def same_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c on grooved pillars lies within a block of that on whole ones of about their size."""
    whole = scenes_along_x(evidence.correlation_length, 1, _FEW)
    for scene in scenes_along_x(evidence.correlation_length, 2, SMALLEST):
        like = sorted(whole, key=lambda s: _unlike(s, scene))[:1]
        fits = [fit for s in (scene, *like) for fit in _fits(evidence, s)]
        if len(fits) < 2:
            continue
        yield Finding(
            place(scene),
            f"l_c on grooved pillars minus l_c at n_p = {fits[1]['n_p']}, n_s = {fits[1]['n_s']} "
            "without grooves (from both intervals)",
            between(*(interval(fit, "l_c") for fit in fits)),
            (-1.0, 1.0),
            "; ".join(in_rows("correlation_length", s, side="x") for s in (scene, *like)),
            "blocks",
        )


def _unlike(first: Scene, second: Scene) -> tuple[int, ...]:
    """How far two scenes are from having the same N, size of pillars and distance."""
    lengths = ((scene.n_blocks, scene.n_p, scene.n_s) for scene in (first, second))
    return tuple(abs(a - b) for a, b in zip(*lengths, strict=True))


CLAIMS = (
    Claim(
        "c_x has a long range, c_y a short one",
        "3.2",
        "While c_y(r) decreases rapidly, c_x(r) displays a correlation over a wide range.",
        _TABLES,
        long_along_short_across,
    ),
    Claim(
        "Exponential decay of c_x",
        "3.2",
        "The correlation functions decrease exponentially, c_x(r) ~ exp(-r/l_c).",
        _TABLES,
        exponential,
    ),
    Claim(
        "Correlation length of three blocks or more",
        "3.2",
        "l_c/l >= 3 where it can be estimated, for n_p of 10 or more.",
        _TABLES,
        three_blocks,
    ),
    Claim(
        "Correlation length grows with n_p",
        "3.2",
        "l_c is slightly increasing with n_p.",
        f"{_TABLES} and two sizes",
        growing_length,
    ),
    Claim(
        "Grooves leave the correlation length unchanged",
        "3.3",
        "The typical correlation length along the longitudinal edges is the same.",
        f"{_TABLES}, with grooves and without",
        same_length,
    ),
)
