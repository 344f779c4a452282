"""The page on numerical errors, from its templates and the tables."""

from collections.abc import Callable, Iterable, Sequence
from math import floor, log10, sqrt
from pathlib import Path
from statistics import median

from springblock.accuracy import budget
from springblock.accuracy.budget import STUDY_SEEDS, Bias, Cases, at, finest_bias, largest_bias
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
    ensemble_error,
    half_width,
)
from springblock.io.rows import Row, listed, markdown_table, select
from springblock.model.defaults import STEP
from springblock.model.material import Material

_PAGE = Path(__file__).with_name("page.md")
_FULL_SIZE = Path(__file__).with_name("full_size.md")  #: the section on the study's own ensembles

#: Opening, and the section on full size, of a study without errors at full size.
_UNKNOWN = """Errors at full size were not measured. On small surfaces the default step biases means
by at most {most:.1f} % (the ends of 95 % intervals that are farther from zero); “Ensembles of small
surfaces” compares this with the standard error of a mean over {ensemble} seeds. Quote means with
their intervals over seeds, and compare no single runs.
"""

_WITHOUT = """This study was run without `production: true`, which measures errors on surfaces of
the study's size in a quarter of an hour.
"""

_OPENING = """With the default step of {step:.0e} s, results of ensembles are biased by at most
{biases}
on three surfaces of {n_blocks} x {n_blocks} blocks (decay length: on pillars only). Biases
are measured against a step of {finest:.0e} s; each bound is the end of the bias's 95 % interval
that is farther from zero, plus the largest bias that this step may itself have. The standard
error of a mean over {ensemble} seeds, or {length_ensemble} for the decay length, is up to
{errors}.
It exceeds the estimated bias (not its bound) for {larger} of the {n}
combinations of these quantities and surfaces. Quote
means with their intervals over seeds, and include the bias in the error where hundreds of
realisations are pooled. Compare ensembles, not single runs: on patterned surfaces of this size
single runs differ even between steps of {following:.0e} and {finest:.0e} s.
"""

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
_COARSE, _FINE = 2.0 * STEP, STEP / 2.0  #: alternatives to the default
_FOLD = 20  #: largest number of pooled seeds, over the study's
#: Fields of the templates that do not depend on the tables.
_KNOWN = {
    "step": STEP,
    "coarse": _COARSE,
    "fine": _FINE,
    "paper": PAPER_STEP,
    "limit": _LIMIT,
    "coarse_margin": _LIMIT / _COARSE,
    "margin": _LIMIT / STEP,
    "nudge": HORIZON_NUDGE,
    "ensemble": ENSEMBLE,
    "length_ensemble": STUDY_SEEDS[LENGTH],
    "fold": _FOLD,
    "tolerance": ENERGY_TOLERANCE,
    "out_of_line": OUT_OF_LINE,
    "sample_interval": SAMPLE_INTERVAL,
}
_PERCENT = 100.0


def page(
    precision: list[Row],
    stability: list[Row],
    realisations: list[Row],
    production: Sequence[Row] = (),
) -> str:
    """Fill in the page from the rows of the tables, of which `production` may be absent."""
    single = select(precision, comparison="reference")
    leapfrog = select(single, integrator="leapfrog")
    default = select(leapfrog, step=STEP)
    finest = select(leapfrog, step=min(row["step"] for row in leapfrog))
    plain = select(single, integrator=PLAIN)
    paired = select(precision, comparison="paired", integrator="leapfrog")
    scatter = select(precision, comparison="scatter")
    coarsest = max(row["step"] for row in paired)
    residuals = [abs(row["energy_error"]) for row in realisations]
    return _PAGE.read_text(encoding="utf-8").format(
        **_KNOWN,
        opening=_opening(production, select(paired, step=STEP)),
        singles=_by_scene("relative error", _SINGLE, default, _error),
        orders=_by_scene("order", ORDERED, select(precision, comparison="order"), _orders),
        finest=finest[0]["step"],
        floor=max(row["error"] for row in finest if row["quantity"] in ORDERED),
        plain=_static_friction(select(plain, step=PAPER_STEP)),
        plain_half=_static_friction(select(plain, step=PAPER_STEP / 2.0)),
        single_blocks=_ends("n_blocks", default),
        single_seeds=min(row["realisations"] for row in default),
        paired_blocks=scatter[0]["n_blocks"],
        paired_seeds=min(row["realisations"] for row in select(paired, step=STEP)),
        reached=listed([_runs(row) for row in select(default, quantity="horizon reached")]),
        against=scatter[0]["step"],
        paired=_by_scene("bias", MEANS, [*select(paired, step=STEP), *scatter], _paired_bias),
        full_size=_full_size(production, select(leapfrog, scene="flat")),
        n_runs=len(residuals),
        worst_energy=max(residuals),
        median_energy=median(residuals),
        n_cases=len(stability),
        families=", ".join(sorted({row["family"] for row in stability})),
        coarsest=coarsest,
        coarse_bias=_PERCENT * max(abs(row["error"]) for row in select(paired, step=coarsest)),
    )


def _opening(rows: Sequence[Row], small: Sequence[Row]) -> str:
    """Summarise bias and scatter at the default: at full size, or else on small surfaces."""
    if not rows:
        most = max(max(abs(row["ci_low"]), abs(row["ci_high"])) for row in small)
        return _UNKNOWN.format(most=_PERCENT * most, **_KNOWN)
    finest, following = _finest(rows)
    cases = budget.measured(rows, (*MEANS, LENGTH))
    larger = [_scatter(case) > Bias.of(at(STEP, case)).estimate for case in cases.values()]
    return _OPENING.format(
        biases=_largest(largest_bias, cases),
        errors=_largest(_scatter, cases),
        larger=sum(larger),
        n=len(larger),
        n_blocks=rows[0]["n_blocks"],
        finest=finest,
        following=following,
        **_KNOWN,
    )


def _finest(rows: Sequence[Row]) -> list[float]:
    """Return the two finest steps."""
    return sorted({row["step"] for row in rows})[:2]


def _largest(share: Callable[[list[Row]], float], cases: Cases) -> str:
    """Write the largest share of each quantity with its name."""
    most: dict[str, float] = {}
    for (quantity, _), case in cases.items():
        name = _name(quantity)
        most[name] = max(most.get(name, 0.0), share(case))
    return ", ".join(f"{_PERCENT * number:.2f} % ({name})" for name, number in most.items())


def _full_size(rows: Sequence[Row], flat: Sequence[Row]) -> str:
    """Fill in the section from the rows of the table `production`, or state their absence.

    `flat` are those of single runs of the leapfrog on flat surfaces.
    """
    if not rows:
        return _WITHOUT
    finest, following = _finest(rows)
    pillars = select(rows, quantity="t_avg", scene="pillared")
    default, fine = at(STEP, pillars), at(_FINE, pillars)
    missed = {row["quantity"]: row["error"] for row in select(flat, step=finest)}
    return _FULL_SIZE.read_text(encoding="utf-8").format(
        **_KNOWN,
        finest=finest,
        following=following,
        n_blocks=rows[0]["n_blocks"],
        seeds=_ends("realisations", rows),
        flat_blocks=flat[0]["n_blocks"],
        flat_friction=missed["static_friction"],
        flat_t_avg=missed["t_avg"],
        values=_by_scene("value", _QUANTITIES, rows, _value),
        biases=_by_scene("bias", _QUANTITIES, rows, _bias),
        fine_seconds=budget.spent(fine, 10),
        seconds=budget.spent(default, 10),
        change=_PERCENT * abs(default["value"] / fine["value"] - 1.0),
        **_excesses(rows),
    )


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


def _paired_bias(bias: Row, scatter: Row) -> str:
    """Return a bias ± half its interval, and the error of a mean, in percent."""
    half = _PERCENT / 2.0 * (bias["ci_high"] - bias["ci_low"])
    error = _PERCENT * ensemble_error(scatter)
    return f"{_PERCENT * bias['error']:+.3f} ± {half:.3f} ({error:.2f})"


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
    row = at(STEP, rows)
    percent = _PERCENT / row["scale"]
    bias, low, high = (percent * row[key] for key in ("bias", "ci_low", "ci_high"))
    finest, error = _PERCENT * finest_bias(rows), _PERCENT * _scatter(rows)
    return f"{bias:+.3f} [{low:+.3f}, {high:+.3f}] ± {finest:.3f} ({error:.2f})"


def _excesses(rows: Sequence[Row]) -> dict[str, str | int]:
    """Tabulate the total error at each step over that at the best step, in the worst case.

    For the CPU time of the study's seeds, and of `_FOLD` times as many. Counts the rows in which
    the paper's step has a smaller entry than the default.
    """
    groups = {
        "static friction, t_max - t_avg, decay length": STUDY_SEEDS,
        "t_max": ("t_max",),
        "t_avg": ("t_avg",),
    }
    finer, lines = 0, []
    for name, quantities in groups.items():
        cases = budget.measured(rows, quantities).values()
        for fold in (1, _FOLD):
            found = [budget.excess(case, fold) for case in cases]
            label = name if fold == 1 else f"{name}, {fold} times the seeds"
            worst = {step: max(each[step] for each in found) for step in found[0]}
            finer += worst[_FINE] < worst[STEP]
            lines.append([label, *(f"{ratio:.2f}" for ratio in worst.values())])
    table = markdown_table(["step (s)", *(f"{step:.0e}" for step in worst)], lines)
    return {"excess": table, "finer": finer, "n_rows": len(lines)}
