"""The page on numerical errors, from its templates and the tables."""

from collections.abc import Callable, Iterable, Sequence
from math import floor, log10, sqrt
from pathlib import Path
from statistics import median

from springblock.accuracy.budget import (
    STUDY_SEEDS,
    Bias,
    Cases,
    at,
    finest_bias,
    largest_bias,
    measured,
)
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

_PAGE = Path(__file__).with_name("page.md")

_RECOMMENDATION = """Use the default, whose biases are at most {default:.1f} standard errors of a
mean over {ensemble} seeds; {coarse:.0e} s takes {share:.0f} % of its CPU time, but its biases reach
{most:.1f} standard errors."""

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
        recommendation=_recommendation(means),
        n_blocks=production[0]["n_blocks"],
        seeds=" to ".join(map(str, sorted({*_ends("realisations", production)}))),
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


def _recommendation(means: Cases) -> str:
    """Compare the default with the double step: largest bias of any mean, and CPU time."""
    most, seconds = {}, {}
    for step in (STEP, _COARSE):
        rows = {key: at(step, case) for key, case in means.items()}
        most[step] = max(Bias.of(rows[key]).estimate / _scatter(means[key]) for key in means)
        seconds[step] = max(row["cpu_seconds"] for row in rows.values())
    share = _PERCENT * seconds[_COARSE] / seconds[STEP]
    return _RECOMMENDATION.format(default=most[STEP], most=most[_COARSE], share=share, **_KNOWN)


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
