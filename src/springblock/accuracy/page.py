"""The page on numerical errors, from its templates and the tables."""

from collections.abc import Callable, Iterable, Sequence
from itertools import product
from math import floor, log10, sqrt
from pathlib import Path
from statistics import median

from springblock.accuracy.conventions import (
    DELAY,
    ENERGY_TOLERANCE,
    ENSEMBLE,
    HORIZON_NUDGE,
    LENGTH,
    MEANS,
    ORDERED,
    OUT_OF_LINE,
    PAPER_STEP,
    PLAIN,
    SAMPLE_INTERVAL,
    SCENES,
    half_width,
)
from springblock.io.rows import Row, listed, markdown_table, select
from springblock.model.defaults import STEP
from springblock.model.material import Material

Cases = dict[tuple[str, str], list[Row]]  #: rows at each step, by quantity and scene
#: Realisations of a scene in the study, by quantity; the decay length needs more.
STUDY_SEEDS = {"static_friction": ENSEMBLE, DELAY: ENSEMBLE, LENGTH: 60}

_PAGE = Path(__file__).with_name("page.md")

_RECOMMENDATION = """Use the default: {coarse:.0e} s takes {share:.0f} % of its CPU time, but
changes t_avg by up to {change:.2f} %, which is {errors:.1f} standard errors of a mean over
{ensemble} seeds."""

#: Names of quantities that are not called by their symbol.
_NAMES = {
    "force": "force before t_max (largest error of each run)",
    "static_friction": "static friction",
    "t_det before horizon": "t_det before the horizon",
}
_UNITS = {"1": ("", 1.0), "s": (" (µs)", 1e6), "blocks": (" (blocks)", 1.0)}
_QUANTITIES = (*MEANS, DELAY, LENGTH)
_SINGLE = ("force", *MEANS, "t_det before horizon")
_LIMIT = 2.0 / Material().omega_max  #: s, stability limit of the leapfrog without damping
_COARSE = 2.0 * STEP  #: the alternative to the default
#: Fields of the template that do not depend on the tables.
_KNOWN = {
    "step": STEP,
    "coarse": _COARSE,
    "paper": PAPER_STEP,
    "limit": _LIMIT,
    "coarse_margin": _LIMIT / _COARSE,
    "margin": _LIMIT / STEP,
    "nudge": HORIZON_NUDGE,
    "ensemble": ENSEMBLE,
    "length_ensemble": STUDY_SEEDS[LENGTH],
    "tolerance": ENERGY_TOLERANCE,
    "out_of_line": OUT_OF_LINE,
    "sample_interval": SAMPLE_INTERVAL,
}
_PERCENT = 100.0


def page(
    precision: list[Row], stability: list[Row], realisations: list[Row], production: list[Row]
) -> str:
    """Fill in the page from the rows of the tables."""
    single = select(precision, comparison="reference")
    leapfrog = select(single, integrator="leapfrog")
    default = select(leapfrog, step=STEP)
    finest_single = select(leapfrog, step=min(row["step"] for row in leapfrog))
    plain = select(single, integrator=PLAIN)
    residuals = [abs(row["energy_error"]) for row in realisations]
    finest, following, *_, coarsest = sorted({row["step"] for row in production})
    flat = select(leapfrog, scene="flat", step=finest)
    missed = {row["quantity"]: row["error"] for row in flat}
    cases = measured(production, (*MEANS, LENGTH))
    means = measured(production, MEANS)
    return _PAGE.read_text(encoding="utf-8").format(
        **_KNOWN,
        biases=_largest(largest_bias, cases),
        errors=_largest(_scatter, cases),
        recommendation=_recommendation(measured(production, ("t_avg",)).values()),
        n_blocks=production[0]["n_blocks"],
        seeds=min(row["realisations"] for row in production),
        finest=finest,
        following=following,
        steps=_steps(means),
        flat_blocks=flat[0]["n_blocks"],
        flat_friction=missed["static_friction"],
        flat_t_avg=missed["t_avg"],
        values=_by_scene("value", _QUANTITIES, production, _value),
        bias_table=_by_scene("bias", _QUANTITIES, production, _bias),
        singles=_by_scene("relative error", _SINGLE, default, _error),
        orders=_by_scene("order", ORDERED, select(precision, comparison="order"), _orders),
        finest_single=finest_single[0]["step"],
        floor=max(row["error"] for row in finest_single if row["quantity"] in ORDERED),
        plain=_static_friction(select(plain, step=PAPER_STEP)),
        plain_twice=_static_friction(select(plain, step=2.0 * PAPER_STEP)),
        single_blocks=_ends("n_blocks", default),
        single_seeds=min(row["realisations"] for row in default),
        reached=listed([_runs(row) for row in select(default, quantity="horizon reached")]),
        n_runs=len(residuals),
        worst_energy=max(residuals),
        median_energy=median(residuals),
        n_cases=len(stability),
        families=", ".join(sorted({row["family"] for row in stability})),
        coarsest=coarsest,
        coarse_bias=_PERCENT * max(abs(_relative(at(coarsest, case))) for case in means.values()),
    )


def measured(rows: Iterable[Row], quantities: Iterable[str]) -> Cases:
    """Rows of the table `production`, finest step first, by quantity and scene that have any."""
    ordered = sorted(rows, key=lambda row: row["step"])
    keys = product(quantities, SCENES)
    found = {key: select(ordered, quantity=key[0], scene=key[1]) for key in keys}
    return {key: rows for key, rows in found.items() if rows}


def at(step: float, rows: Iterable[Row]) -> Row:
    """Return the one row of this step."""
    (row,) = select(rows, step=step)
    return row


def far_end(row: Row) -> float:
    """Far end of the 95 % interval of a bias, as a share of the quantity."""
    return max(abs(row["ci_low"]), abs(row["ci_high"])) / float(row["scale"])


def finest_bias(rows: Iterable[Row]) -> float:
    """Largest bias of the finest step h itself, as a share of the quantity.

    For an error of order p it is the bias of the next step, r h, against h over r^p - 1. We take
    p = 1, the lower bound of orders across events, and the far end of the 95 % interval.
    """
    finest, following = sorted(rows, key=lambda row: row["step"])[:2]
    return far_end(following) / (following["step"] / finest["step"] - 1.0)


def largest_bias(rows: Sequence[Row]) -> float:
    """Far end of the interval of the default's bias plus the finest step's, as a share."""
    return far_end(at(STEP, rows)) + finest_bias(rows)


def _relative(row: Row) -> float:
    """Return the bias as a share of the quantity."""
    return float(row["bias"] / row["scale"])


def _largest(share: Callable[[list[Row]], float], cases: Cases) -> str:
    """Write the largest share of each quantity with its name."""
    most: dict[str, float] = {}
    for (quantity, _), case in cases.items():
        name = _name(quantity)
        most[name] = max(most.get(name, 0.0), share(case))
    return ", ".join(f"{_PERCENT * number:.2f} % ({name})" for name, number in most.items())


def _recommendation(cases: Iterable[list[Row]]) -> str:
    """Say what the double step saves, and by how much it changes a quantity, given by scene."""
    changes, seconds = {}, []
    for case in cases:
        coarse, default = at(_COARSE, case), at(STEP, case)
        change = abs(_relative(coarse) - _relative(default))
        changes[change / _scatter(case)] = change
        seconds.append((default["cpu_seconds"], coarse["cpu_seconds"]))
    errors, (longest, shorter) = max(changes), max(seconds)
    shown = {"share": shorter / longest, "change": changes[errors]}
    percent = {name: _PERCENT * share for name, share in shown.items()}
    return _RECOMMENDATION.format(errors=errors, **percent, **_KNOWN)


def _steps(means: Cases) -> str:
    """Tabulate CPU time and largest biases, a line for each step, coarsest first."""
    lines = []
    for step in sorted({row["step"] for case in means.values() for row in case}, reverse=True):
        rows = [at(step, case) for case in means.values()]
        by_quantity = [select(rows, quantity=name) for name in MEANS]
        worst = [max(each, key=lambda row: abs(_relative(row))) for each in by_quantity]
        name = f"**{step:.0e}**, default" if step == STEP else f"{step:.0e}"
        seconds = max(row["cpu_seconds"] for row in rows)
        lines.append([name, f"{seconds:.2g}", *map(_interval, worst)])
    lines.append([f"error of {ENSEMBLE} seeds", ""])
    for name in MEANS:
        errors = [_PERCENT * _scatter(means[key]) for key in means if key[0] == name]
        lines[-1].append(f"{min(errors):.2f} to {max(errors):.2f}")
    return markdown_table(["step (s)", "CPU seconds", *map(_name, MEANS)], lines)


def _interval(row: Row) -> str:
    """Return a bias with its interval, in percent; 0 at the finest step."""
    bias, low, high = (_PERCENT / row["scale"] * row[key] for key in ("bias", "ci_low", "ci_high"))
    return f"{bias:+.3f} [{low:+.3f}, {high:+.3f}]" if low < high else "0"


def _by_scene(
    heading: str, quantities: Iterable[str], rows: Sequence[Row], text: Callable[..., str]
) -> str:
    """Return a table with `text` of the rows of each quantity (lines) and scene (columns)."""
    lines = []
    for quantity in quantities:
        cells = [select(rows, scene=scene, quantity=quantity) for scene in SCENES]
        said = [text(*cell) if cell else "" for cell in cells]
        lines.append([_name(quantity), *said])
    return markdown_table([heading, *SCENES], lines)


def _name(quantity: str) -> str:
    return _NAMES.get(quantity, quantity)


def _runs(row: Row) -> str:
    """Write how many runs of a scene reach the horizon; the error is the root of their share."""
    return (
        f"{row['error'] ** 2 * row['realisations']:.0f} of {row['realisations']} ({row['scene']})"
    )


def _error(row: Row) -> str:
    """Format an error; 0 where runs agree to every digit."""
    return f"{row['error']:.1e}" if row["error"] else "0"


def _orders(*rows: Row) -> str:
    """Return the orders of both integrators with their intervals."""
    each = (select(rows, integrator=name)[0] for name in ("leapfrog", "rk4"))
    return "; ".join(f"{r['error']:.1f} [{r['ci_low']:.1f}, {r['ci_high']:.1f}]" for r in each)


def _static_friction(rows: Sequence[Row]) -> str:
    """Return the error of static friction on each scene, in percent."""
    errors = {row["scene"]: row["error"] for row in select(rows, quantity="static_friction")}
    return ", ".join(f"{_PERCENT * errors[scene]:.1f} % ({scene})" for scene in SCENES)


def _ends(name: str, rows: Sequence[Row]) -> tuple[int, int]:
    """Return the smallest and the largest value of a column."""
    values = [row[name] for row in rows]
    return min(values), max(values)


def _scatter(rows: Sequence[Row]) -> float:
    """Standard error of the study's mean, as a share."""
    row = at(STEP, rows)
    seeds = STUDY_SEEDS.get(row["quantity"], ENSEMBLE)
    return float(row["deviation"] / row["scale"] / sqrt(seeds))


def _value(*rows: Row) -> str:
    """Return value ± statistical ± numerical error, to two digits of the statistical error."""
    row = at(STEP, rows)
    unit, factor = _UNITS[row["unit"]]
    value, scale = factor * row["value"], factor * row["scale"]
    statistical = factor * half_width(row["deviation"], row["realisations"])
    places = max(0, 1 - floor(log10(statistical)))
    numbers = (value, statistical, scale * largest_bias(rows))
    return " ± ".join(f"{number:.{places}f}" for number in numbers) + unit


def _bias(*rows: Row) -> str:
    """Return bias, interval, bias of the finest step and error of the mean, in percent."""
    finest, error = _PERCENT * finest_bias(rows), _PERCENT * _scatter(rows)
    return f"{_interval(at(STEP, rows))} ± {finest:.3f} ({error:.2f})"
