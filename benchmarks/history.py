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

import re
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from benchmarks.timing import BLOCK_STEP, WITH_PRELUDE, Row

FILE = Path(__file__).with_name("history.csv")
PARTS = ("kernel", "realisation")  #: of the measurement, which a line is made from
#: What the name of a processor says besides its name.
_NO_NAME = re.compile(r"\((R|TM)\)|\b\d+-Core\b|\bCPU\b|\bProcessor\b|@.*|,")


def line(machine: Mapping[str, str], rows: Iterable[Row], n: int) -> str:
    """Return the line of a release, from the rows of its parts on surfaces of N = n."""
    found = {(row.name, row.unit, row.scene): row for row in rows if row.n_blocks == n}
    absent = Row("", "", "", np.nan)

    def step(name: str) -> Row:
        return found.get((name, BLOCK_STEP, "flat"), absent)

    scenes = ("flat", "pillars", "grooves")
    numbers = [
        *(step(name).value for name in ("leapfrog", "C loop")),
        1.0 / step("C loop").ratio,
        *(step(name).value for name in ("LAMMPS", "rk4", "plain rk4")),
        100.0 * step("leapfrog").of_peak,
        *(found.get((WITH_PRELUDE, "s", scene), absent).ratio for scene in scenes),
    ]
    version, _, code = machine["code_version"].partition("+")
    day = datetime.now(UTC).date().isoformat()
    cpu = " ".join(_NO_NAME.sub(" ", machine["cpu"]).split())
    return ",".join([version, day, code, cpu, machine["vectors"], *map(_three_digits, numbers)])


def _three_digits(number: float) -> str:
    """Empty for NaN."""
    if np.isnan(number):
        return ""
    return np.format_float_positional(number, 3, fractional=False, trim="-")
