"""One line a release in history.csv: how fast the solver was, and on which processor.

version, date      of the package, and of the measurement
code               digest of the sources of `simulate`
cpu, vectors       the processor, and the widest vectors that it has: avx512, avx2 or other
leapfrog_ns, ...   ns per block and step, N = 120, all blocks moving
leapfrog_to_c      a step of the leapfrog, over one of the same method in C
percent_of_peak    operations of the leapfrog, over the multiply-adds that one core could have done
flat_to_c, ...     a whole realisation with its prelude, over all its steps in C

All times are CPU times. What could not be measured is left empty.
"""

import csv
import io
import re
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from benchmarks.timing import BLOCK_STEP, WITH_PRELUDE, Row

FILE = Path(__file__).with_name("history.csv")
PARTS = ("kernel", "realisation")  #: of the measurement, which a line is made from
#: What tells one line from another.
_KEYS = ("version", "cpu", "vectors")
#: What the name of a processor says besides its name.
_NO_NAME = re.compile(r"\((R|TM)\)|\b\d+-Core\b|\bCPU\b|\bProcessor\b|@.*")

Line = dict[str, str]


def release(machine: Mapping[str, str]) -> Line:
    """Return what a line begins with: which code, when, and on what."""
    version, _, code = machine["code_version"].partition("+")
    return {
        "version": version,
        "date": datetime.now(UTC).date().isoformat(),
        "code": code,
        "cpu": " ".join(_NO_NAME.sub(" ", machine["cpu"]).split()),
        "vectors": machine["vectors"],
    }


def measured(rows: Iterable[Row], n: int) -> Line:
    """Return what a line goes on with, from the rows of its parts on surfaces of N = n."""
    found = {
        (each["name"], each["unit"], each["scene"]): each
        for each in rows
        if each["part"] in PARTS and each["n_blocks"] == n
    }

    def step(name: str, key: str = "value") -> float:
        return found.get((name, BLOCK_STEP, "flat"), {}).get(key, np.nan)

    def run(scene: str) -> float:
        return found.get((WITH_PRELUDE, "s", scene), {}).get("ratio", np.nan)

    numbers = {
        "leapfrog_ns": step("leapfrog"),
        "c_loop_ns": step("C loop"),
        "leapfrog_to_c": 1.0 / step("C loop", "ratio"),
        "lammps_ns": step("LAMMPS"),
        "rk4_ns": step("rk4"),
        "plain_rk4_ns": step("plain rk4"),
        "percent_of_peak": 100.0 * step("leapfrog", "of_peak"),
        **{f"{scene}_to_c": run(scene) for scene in ("flat", "pillars", "grooves")},
    }
    return {name: _three_digits(number) for name, number in numbers.items()}


def _three_digits(number: float) -> str:
    """Empty for NaN."""
    if np.isnan(number):
        return ""
    return np.format_float_positional(number, 3, fractional=False, trim="-")


def refuse_second(line: Line) -> None:
    """Raise ValueError where the file has a line for this version on this processor."""
    with FILE.open(newline="", encoding="utf-8") as file:
        known = {tuple(each[key] for key in _KEYS) for each in csv.DictReader(file)}
    if tuple(line[key] for key in _KEYS) in known:
        raise ValueError(
            f"version is {line['version']} and {FILE.name} has its line for {line['cpu']} with "
            f"{line['vectors']} already: it may have one for each version and processor"
        )


def text(line: Line) -> str:
    """Return a line as it stands in the file."""
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerow(line.values())
    return out.getvalue()


def append(line: Line) -> None:
    """Add a line to the file; raises ValueError where it would be the second of its kind."""
    refuse_second(line)
    with FILE.open("a", newline="", encoding="utf-8") as file:
        file.write(text(line))
