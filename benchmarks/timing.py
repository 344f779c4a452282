"""How CPU time is measured for results/tables/benchmark.parquet, and what its rows hold.

CPU time counts, and that of the clock on the wall only where several cores share the work. What is
compared runs in turn, a repetition of each and then the next of each (A B A B ...), so that a
machine that gets slower or busier does so for all. Values are medians over the repetitions; a ratio
is the median of the ratios within them.
"""

import resource
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import ArrayLike, NDArray

from benchmarks.peers.missing import Missing
from springblock.io.schemas import column

SCHEMA = pa.schema(
    [
        column("part", pa.string(), "1", "kernel, realisation, scaling, cores, peak or study"),
        column("name", pa.string(), "1", "what is measured"),
        column("scene", pa.string(), "1", "flat, pillars or grooves; empty where there is none"),
        column("n_blocks", pa.int32(), "blocks", "side N of the surface; 0 where there is none"),
        column("value", pa.float64(), "see unit", "median over the repetitions; NaN if missing"),
        column(
            "unit",
            pa.string(),
            "1",
            "unit of value, low and high; times are CPU times but for those of cores",
        ),
        column("low", pa.float64(), "see unit", "lower quartile of the repetitions"),
        column("high", pa.float64(), "see unit", "upper quartile"),
        column(
            "ratio",
            pa.float64(),
            "1",
            "kernel: to a step of the leapfrog; realisation: to all steps by the C loop; scaling: "
            "to N = 120, all moving; cores: to one core; study: to the whole; NaN without one",
        ),
        column(
            "of_peak",
            pa.float64(),
            "1",
            "share of the core's measured multiply-add peak; NaN where operations are not counted",
        ),
        column("repetitions", pa.int32(), "1", "measurements behind the value; 0 if missing"),
        column("note", pa.string(), "1", "what to know of it; why it is missing"),
    ]
)

#: Names that history.csv finds its rows by.
BLOCK_STEP = "ns per block and step"
WITH_PRELUDE = "with the prelude"

Array = NDArray[np.float64]
Row = dict[str, Any]


def clock() -> float:
    """CPU seconds of this process, and of the processes that it has waited for."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def interleaved(
    runs: Mapping[str, Callable[[], object]],
    repetitions: int,
    clock: Callable[[], float] = clock,
) -> dict[str, Array]:
    """Seconds of every run by a clock, of the CPU, one number per repetition, taken in turn."""
    seconds = np.empty((repetitions, len(runs)))
    for repetition in seconds:
        for k, run in enumerate(runs.values()):
            start = clock()
            run()
            repetition[k] = clock() - start
    return dict(zip(runs, seconds.T, strict=True))


def row(
    part: str,
    name: str,
    unit: str,
    values: ArrayLike,
    scene: str = "",
    n_blocks: int = 0,
    reference: ArrayLike | None = None,
    note: str = "",
    at_peak: ArrayLike | None = None,
) -> Row:
    """One row from the values of all repetitions, and what they are compared with in the same ones.

    `at_peak` is what the values would be if the core did nothing but multiply-adds.
    """
    each = np.atleast_1d(values)
    low, middle, high = np.quantile(each, [0.25, 0.5, 0.75])
    ratio = np.nan if reference is None else float(np.median(each / np.asarray(reference)))
    of_peak = np.nan if at_peak is None else float(np.median(np.asarray(at_peak) / each))
    return {
        "part": part,
        "name": name,
        "scene": scene,
        "n_blocks": n_blocks,
        "value": float(middle),
        "unit": unit,
        "low": float(low),
        "high": float(high),
        "ratio": ratio,
        "of_peak": of_peak,
        "repetitions": each.size,
        "note": note,
    }


def missing(
    part: str, name: str, unit: str, why: Missing, scene: str = "", n_blocks: int = 0
) -> Row:
    """The row of something that could not be measured here."""
    empty = row(part, name, unit, np.nan, scene, n_blocks, note=f"missing: {why}")
    return {**empty, "repetitions": 0}


def printed(rows: Sequence[Row]) -> str:
    """The rows as one table of text."""
    lines = [
        ("part", "what", "scene", "N", "value", "quartiles", "unit", "of peak", "ratio", "note")
    ]
    for each in rows:
        value, low, high = (f"{each[key]:#.3g}".rstrip(".") for key in ("value", "low", "high"))
        lines.append(
            (
                each["part"],
                each["name"],
                each["scene"],
                str(each["n_blocks"] or ""),
                value if each["repetitions"] else "missing",
                f"{low} - {high}" if each["repetitions"] > 1 else "",
                each["unit"],
                "" if np.isnan(each["of_peak"]) else f"{100.0 * each['of_peak']:.0f} %",
                "" if np.isnan(each["ratio"]) else f"{each['ratio']:.2f}",
                each["note"],
            )
        )
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )
