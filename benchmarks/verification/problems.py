"""The problems, their files, and tables of other codes; README.md says what they hold.

Three surfaces that differ in their pattern, small enough for the reference.
"""

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from springblock.files import write_text
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface

SURFACE = ("y", "x", "contact", "mu_static", "mu_dynamic")
T_DET = ("y", "x", "t_det")
FORCE = ("time", "force")
SCALARS = ("quantity", "value", "uncertainty", "unit")  #: rows: horizon, t_max, static friction
#: Share of a sample interval by which times may be rounded.
_ROUNDED = 1e-3


@dataclass(frozen=True)
class Problem:
    """One surface of N x N blocks, pulled along x from rest."""

    name: str
    pattern: Pattern
    seed: int  #: from 0 to 2, the one with which most blocks let go before t_max
    duration: float  #: s

    @property
    def folder(self) -> Path:
        """Where its files are."""
        return Path(__file__).parent / self.name

    @property
    def time(self) -> Array:
        """(n,) s, times of the force curve."""
        return SAMPLE_INTERVAL * np.arange(round(self.duration / SAMPLE_INTERVAL) + 1.0)


_ALL = (
    Problem("flat", Pattern.flat(6), seed=2, duration=1.3e-4),
    Problem("pillared", Pattern.pillars(8, 4, 4), seed=1, duration=4e-4),
    Problem("grooved", Pattern.pillars(6, 5, 1).grooved(2, 1), seed=1, duration=2e-4),
)
PROBLEMS = {problem.name: problem for problem in _ALL}


@dataclass(frozen=True)
class Answer:
    """What a code says about a problem."""

    problem: Problem
    t_det: Array  #: (N, N) s, [y, x], first detachment; NaN where never or not in contact
    force: Array  #: (n,) N, |ΣF_s| at the problem's times; NaN where not given

    @property
    def static_friction(self) -> float:
        """Largest force over P l² N²."""
        normal_force = Material().block_load * self.problem.pattern.n_blocks**2
        return float(self.force.max()) / normal_force

    @property
    def t_max(self) -> float:
        """Time of the largest force, s."""
        return float(self.problem.time[self.force.argmax()])


@dataclass(frozen=True)
class Reference(Answer):
    """The published answer, and by how much it may be wrong."""

    t_det_uncertainty: Array  #: (N, N) s
    force_uncertainty: Array  #: (n,) N
    horizon: float  #: s; detachments before it are compared
    friction_uncertainty: float  #: of the static friction


def write_table(path: Path, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Write comma-separated text, whole or not at all."""
    lines = (",".join(row) for row in (columns, *rows))
    write_text(path, "\n".join(lines) + "\n")


def read_table(path: Path, columns: Sequence[str]) -> Array:
    """Read these columns, (columns, rows); NaN where a field is empty.

    Raises
    ------
    ValueError
        Where it is not a table, a column is missing, or a field is not a number.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file, skipinitialspace=True)
            rows, names = list(reader), reader.fieldnames or []
    except (UnicodeDecodeError, csv.Error):
        raise ValueError(f"{path} must be comma-separated text") from None
    if not set(columns) <= set(names):
        wanted, held = ", ".join(columns), ", ".join(names) or "none"
        raise ValueError(f"{path} must have the columns {wanted}; it has {held}")
    return np.array([[_number(path, row, name) for row in rows] for name in columns])


def _number(path: Path, row: dict[str, str], name: str) -> float:
    try:
        return float(row[name] or "nan")
    except ValueError:
        raise ValueError(f"{path}: {name} must be a number, not {row[name]!r}") from None


def read_surface(problem: Problem) -> Surface:
    """Return the surface of a problem."""
    path = problem.folder / "surface.csv"
    contact, mu_static, mu_dynamic = _on_blocks(problem, path, read_table(path, SURFACE))
    return Surface(contact == 1.0, mu_static, mu_dynamic)


def read_reference(problem: Problem) -> Reference:
    """Return the published reference."""
    path = problem.folder / "t_det.csv"
    t_det, t_det_by = _on_blocks(problem, path, read_table(path, (*T_DET, "uncertainty")))
    force, force_by = read_table(problem.folder / "force.csv", ("force", "uncertainty"))
    value, by = read_table(problem.folder / "scalars.csv", SCALARS[1:3])
    return Reference(problem, t_det, force, t_det_by, force_by, float(value[0]), float(by[2]))


def read_answer(problem: Problem, t_det: Path, force: Path | None) -> Answer:
    """Read the tables of a code.

    Raises
    ------
    ValueError
        Where they do not fit the problem, or leave out what is compared.
    """
    absent = np.full(len(problem.time), np.nan)
    curve = absent if force is None else _force(problem, force)
    return Answer(problem, _t_det(problem, t_det), curve)


def _on_blocks(problem: Problem, path: Path, table: Array) -> Array:
    """Lay columns out on the surface, (columns, N, N), from those beside y and x."""
    n = problem.pattern.n_blocks
    fields, seen = np.full((len(table) - 2, n, n), np.nan), set()
    for y, x, *values in table.T:
        if y not in range(n) or x not in range(n):
            raise ValueError(
                f"{path}: y and x must be whole numbers from 0 to {n - 1}, not {y:g} and {x:g}"
            )
        block = int(y), int(x)
        if block in seen:
            raise ValueError(f"{path} must give block (y, x) = {block} once; it has it again")
        seen.add(block)
        fields[:, *block] = values
    return fields


def _t_det(problem: Problem, path: Path) -> Array:
    (t_det,) = _on_blocks(problem, path, read_table(path, T_DET))
    reference = read_reference(problem)
    allowed = np.isfinite(t_det) & (t_det >= 0.0) & problem.pattern.contact
    missing = np.isnan(t_det)
    for wrong, rule in (
        (~missing & ~allowed, "t_det must be in s, zero or positive, of blocks in contact"),
        (missing & (reference.t_det < reference.horizon), "t_det must be given up to the horizon"),
    ):
        for y, x in np.argwhere(wrong):
            raise ValueError(f"{path}: {rule}; it is {t_det[y, x]:g} at (y, x) = ({y}, {x})")
    return t_det


def _force(problem: Problem, path: Path) -> Array:
    time, force = read_table(path, FORCE)
    rounded = _ROUNDED * SAMPLE_INTERVAL
    if len(time) != len(problem.time) or not (np.abs(time - problem.time) <= rounded).all():
        raise ValueError(
            f"{path}: time must be the multiples of {SAMPLE_INTERVAL:g} s from 0 to "
            f"{problem.duration:g} s, in order"
        )
    if not (np.isfinite(force) & (force >= 0.0)).all():
        raise ValueError(f"{path}: force must be finite and not negative")
    return force
