"""Correlation of detachment times along the sides of pillars, sections 3.2 and 3.3."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import groupby
from typing import Any

import numpy as np

from springblock.claims import Case, Claim, Evidence, Finding, Row
from springblock.statements.samples import ALONG, INF, POSITIVE, SMALLEST
from springblock.statistics import Interval

_LENGTHS = ("n_p", "n_s", "n_p2", "n_s2")
_FAR = 3  #: blocks, the paper's lower bound of the correlation length
_FEW = 10  #: n_p below which the paper finds l_c difficult to estimate
_CLOSE = 0.1  #: difference between correlation functions that look the same
_TABLES = "tables of correlation along the sides of pillars with n_p of 10 or more"


def _interval(row: Row, name: str) -> Interval:
    return Interval(*(np.array(row[key]) for key in (name, "ci_low", "ci_high")))


def apart(first: Interval, second: Interval) -> Interval:
    """First - second; the errors add up, since tables do not say how they are correlated."""
    return Interval(first.mean - second.mean, first.low - second.high, first.high - second.low)


def _surfaces(rows: Iterable[Row], level: int, smallest: int = SMALLEST) -> list[dict[str, int]]:
    """Lengths of the surfaces in a table of so many levels, sliding along x."""
    along = [row for row in rows if row["direction"] == ALONG and row["n_p"] >= smallest]
    found = {tuple(row[key] for key in _LENGTHS) for row in along}
    surfaces = [dict(zip(_LENGTHS, lengths, strict=True)) for lengths in sorted(found)]
    return [s for s in surfaces if (s["n_p"] > 0) + (s["n_p2"] > 0) == level]


def _find(rows: Iterable[Row], **wanted: Any) -> Row | None:
    """The row with these values that slides along x; None without one."""
    wanted = {"direction": ALONG, **wanted}
    return next((r for r in rows if all(r[key] == value for key, value in wanted.items())), None)


def _lengths(surface: Case) -> dict[str, Any]:
    return {key: value for key, value in surface.items() if value}


def _row_of(table: str, surface: Case, **more: Any) -> str:
    keys = ", ".join(f"{k} = {v}" for k, v in (_lengths(surface) | more).items())
    return f"tables/{table}: {keys}, direction = x"


def long_along_short_across(evidence: Evidence) -> Iterator[Finding]:
    """c_x is larger than c_y three blocks away; c_y falls below 1/e within one block."""
    rows = evidence.correlation
    for surface in _surfaces(rows, 1):
        along, across = (_find(rows, **surface, side=side, r=_FAR) for side in ("x", "y"))
        near = _find(rows, **surface, side="y", r=1)
        if along is None or across is None or near is None:
            continue
        both = (_interval(row, "correlation") for row in (along, across))
        yield Finding(
            _lengths(surface),
            f"c_x(r = {_FAR}) - c_y(r = {_FAR}) (sum of both intervals)",
            apart(*both),
            POSITIVE,
            _row_of("correlation", surface, r=_FAR),
        )
        yield Finding(
            _lengths(surface),
            "c_y(r = 1)",
            _interval(near, "correlation"),
            (-INF, float(np.exp(-1.0))),
            _row_of("correlation", surface, r=1, side="y"),
        )


def exponential(evidence: Evidence) -> Iterator[Finding]:
    """c_x(r) stays close to exp(-r/l_c) wherever that was fitted; the worst r is shown."""
    for surface in _surfaces(evidence.correlation_length, 1, _FEW):
        fit = _find(evidence.correlation_length, **surface, side="x")
        if fit is None:
            continue
        curve = [row for row in evidence.correlation if _on_side_along(row, surface)]
        fitted = [row for row in curve if max(1, fit["r_low"]) <= row["r"] <= fit["r_high"]]
        gaps = [
            apart(_interval(row, "correlation"), Interval(*[np.exp(-row["r"] / fit["l_c"])] * 3))
            for row in fitted
        ]
        if not gaps:
            continue
        worst = int(np.argmax([abs(gap.mean) for gap in gaps]))
        r = fitted[worst]["r"]
        yield Finding(
            _lengths(surface),
            f"c_x(r) - exp(-r/l_c), the largest in the range of the fit, at r = {r}",
            gaps[worst],
            (-_CLOSE, _CLOSE),
            _row_of("correlation", surface, r=r, side="x"),
        )


def _on_side_along(row: Row, surface: Case) -> bool:
    wanted = {**surface, "side": "x", "direction": ALONG}
    return all(row[key] == value for key, value in wanted.items())


def three_blocks(evidence: Evidence) -> Iterator[Finding]:
    """l_c of c_x is three blocks or more."""
    for surface in _surfaces(evidence.correlation_length, 1, _FEW):
        fit = _find(evidence.correlation_length, **surface, side="x")
        if fit is not None:
            source = _row_of("correlation_length", surface, side="x")
            interval = _interval(fit, "l_c")
            yield Finding(_lengths(surface), "l_c of c_x", interval, (_FAR, INF), source, "blocks")


def growing_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c of the largest pillars is larger than that of the smallest it can be estimated for."""
    rows = evidence.correlation_length
    surfaces = _surfaces(rows, 1, _FEW)
    surfaces.sort(key=lambda s: (Fraction(s["n_s"], s["n_p"]), s["n_p"]))
    for ratio, family in groupby(surfaces, key=lambda s: Fraction(s["n_s"], s["n_p"])):
        ends = [_find(rows, **surface, side="x") for surface in family]
        first, last = ends[0], ends[-1]
        if first is None or last is None or first is last:
            continue
        yield Finding(
            {"n_s/n_p": str(ratio)},
            f"l_c at n_p = {last['n_p']} minus l_c at n_p = {first['n_p']} (sum of both intervals)",
            apart(_interval(last, "l_c"), _interval(first, "l_c")),
            POSITIVE,
            f"tables/correlation_length: n_p = {first['n_p']} and {last['n_p']}, side = x",
            "blocks",
        )


def same_length(evidence: Evidence) -> Iterator[Finding]:
    """l_c on grooved pillars lies within a block of that on whole ones of about their size."""
    rows = evidence.correlation_length
    whole = _surfaces(rows, 1, _FEW)
    for surface in _surfaces(rows, 2):
        like = min(whole, key=lambda s: abs(s["n_p"] - surface["n_p"]), default=None)
        pair = [_find(rows, **s, side="x") for s in (surface, like) if s is not None]
        fits = [row for row in pair if row is not None]
        if len(fits) == 2:
            yield Finding(
                _lengths(surface),
                f"l_c on grooved pillars minus l_c at n_p = {fits[1]['n_p']} without grooves "
                "(sum of both intervals)",
                apart(*(_interval(row, "l_c") for row in fits)),
                (-1.0, 1.0),
                f"{_row_of('correlation_length', surface, side='x')} and n_p = {fits[1]['n_p']}",
                "blocks",
            )


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
