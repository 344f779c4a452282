"""Event-located solutions of the small runs, as data that the package brings along.

They depend on nothing but the constants, the surfaces and the code of `reference`, whose digest
is stored with them. `springblock make reference` computes them again, in six CPU minutes.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.accuracy import reference
from springblock.accuracy.conventions import MEANS, SAMPLE_INTERVAL
from springblock.io.parquet import load, origin_of
from springblock.io.rows import Row, select
from springblock.io.schemas import column, lists, numbers, texts
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.provenance import digest_of, digest_of_data

FILE = Path(__file__).with_name("solutions.parquet")
SCHEMA = pa.schema(
    [
        *texts(scene="flat, pillared or grooved"),
        column("seed", pa.int32(), "1", "seed of the coefficients"),
        *numbers("1", static_friction="greatest force over the load"),
        *numbers("s", t_max="time of that force", t_avg="mean first detachment time"),
        *lists(pa.float64(), "N", force="force at the multiples of 8e-8 s, in single precision"),
        *lists(pa.float64(), "s", t_det="first detachment of each block, row by row; or NaN"),
    ]
)
#: Largest difference between two computations of a solution, over its largest value: well above
#: rounding, and below the accuracy of the solution.
TOLERANCE = 1e-6


class Small(NamedTuple):
    """Surfaces of a scene that are small enough for the reference solution."""

    pattern: Pattern
    duration: float  #: s
    seeds: int  #: each takes 5 to 60 CPU s

    def surface(self, seed: int) -> Surface:
        """Return the surface of this seed."""
        return Surface.draw(self.pattern.contact, seed)


SMALL = {
    "flat": Small(Pattern.flat(12), 1.25e-4, 4),
    "pillared": Small(Pattern.pillars(8, 4, 4), 3.5e-4, 6),
    "grooved": Small(Pattern.pillars(6, 5, 1).grooved(2, 1), 2.0e-4, 6),
}


class Solution(NamedTuple):
    """Stored solution of one run; names and units as in `reference.Reference`."""

    time: Array
    force: Array
    t_det: Array
    static_friction: float
    t_max: float
    t_avg: float


def solve(scene: str, seed: int) -> Row:
    """Compute one solution: a row of the table."""
    surface, duration = SMALL[scene].surface(seed), SMALL[scene].duration
    run = reference.solve(surface, duration=duration, sample_interval=SAMPLE_INTERVAL)
    scalars = {name: getattr(run, name) for name in MEANS}
    curves = {"force": run.force.astype(np.float32).tolist(), "t_det": run.t_det.ravel().tolist()}
    return {"scene": scene, "seed": seed, **scalars, **curves}


def solve_all() -> Iterator[Row]:
    """Compute all solutions."""
    runs = [(scene, seed) for scene, small in SMALL.items() for seed in range(small.seeds)]
    for scene, seed in tqdm(runs, desc="reference solutions"):
        yield solve(scene, seed)


def digest() -> str:
    """Return the digest of what determines the solutions."""
    surfaces = []
    for scene, small in SMALL.items():
        for surface in map(small.surface, range(small.seeds)):
            fields = surface.contact, surface.mu_static, surface.mu_dynamic
            surfaces.append([scene, small.duration, np.round(np.array(fields), 12).tolist()])
    code = digest_of(Path(reference.__file__))
    # without those of other laws, which are zero
    constants = {name: value for name, value in Material().items() if value}
    constants["sample_interval"] = SAMPLE_INTERVAL
    return digest_of_data({"code": code, "constants": constants, "surfaces": surfaces})


def stored() -> list[Row]:
    """Return the stored rows; refuse those of other constants, surfaces or code."""
    table = load(FILE)
    if origin_of(table)["solutions"] != digest():
        raise ValueError(
            f"{FILE} holds solutions of other constants, surfaces or code; "
            "replace it by the file that springblock make reference writes"
        )
    return table.to_pylist()


def solutions(scene: str) -> list[Solution]:
    """Return the stored solutions of a scene, by seed."""
    shape = SMALL[scene].pattern.contact.shape
    found = []
    for row in select(stored(), scene=scene):
        force, t_det = np.array(row["force"]), np.array(row["t_det"]).reshape(shape)
        time = SAMPLE_INTERVAL * np.arange(float(len(force)))
        found.append(Solution(time, force, t_det, *(row[name] for name in MEANS)))
    return found


def refuse_changed(rows: Iterable[Row], recorded: Iterable[Row]) -> None:
    """Refuse solutions that differ from the stored ones of the same runs."""
    for row, known in zip(rows, recorded, strict=True):
        for name in Solution._fields[1:]:
            one, other = np.asarray(row[name]), np.asarray(known[name])
            if not np.allclose(one, other, 0.0, TOLERANCE * np.nanmax(other), equal_nan=True):
                run = f"{row['scene']}, seed {row['seed']}"
                raise ValueError(f"{run}: {name} differs from the stored solution in {FILE}")
