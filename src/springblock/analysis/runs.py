"""Ensembles in Python: `ensemble`, and the runs that it returns."""

from collections.abc import Callable
from functools import partial
from operator import itemgetter
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike
from tqdm import tqdm

from springblock.analysis.ensembles import OBSERVABLES, Ensemble, mean
from springblock.analysis.statistics import Interval, number
from springblock.model.notebook import Shown
from springblock.model.numbers import check_whole
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.run import Realisation
from springblock.simulation.setup import DEFAULT, Setup
from springblock.simulation.simulate import simulate
from springblock.simulation.threads import in_threads

if TYPE_CHECKING:
    import pandas as pd


class Runs(Shown, list[Realisation]):
    """Realisations of one surface with the seeds 0, 1, ..., in this order."""

    def table(self) -> "pd.DataFrame":
        """Return the observables of each run, times in s, by its seed."""
        try:
            import pandas as pd
        except ModuleNotFoundError:
            raise ModuleNotFoundError("a table of runs needs pandas: pip install pandas") from None
        return pd.DataFrame(self._rows()).set_index("seed")

    def means(self) -> dict[str, Interval]:
        """Return the mean of each column of the table, with its 95 % interval (Student's t)."""
        return {name: mean(Ensemble({}, self._rows()), name) for name in OBSERVABLES}

    def _rows(self) -> list[dict[str, Any]]:
        columns = ({name: getattr(run, name) for name in OBSERVABLES} for run in self)
        return [{"seed": seed} | row for seed, row in enumerate(columns)]

    def __repr__(self) -> str:
        friction = number(self.means()["static_friction"])
        return f"<{len(self)} runs on {self[0].name}: static friction {friction}>"


def ensemble(
    contact: Pattern | ArrayLike,
    setup: Setup = DEFAULT,
    direction: str | float = "x",
    seeds: int = 20,
    jobs: int = 2,
    **options: Any,
) -> Runs:
    """Simulate one surface with the seeds 0, 1, ... of its friction coefficients.

    Parameters
    ----------
    contact : Pattern, or (N_y, N_x) bool
        Blocks in contact with the substrate.
    setup, direction
        As in `simulate`.
    seeds : int
        Number of realisations, at least one.
    jobs : int
        Cores to use, at least one.
    **options
        `duration` and `snapshot_times`, as in `simulate`.
    """
    begun = compute_prelude(contact, setup, direction)
    how: dict[str, Any] = {"prelude": begun, "progress": False} | options

    def run(seed: int) -> Realisation:
        return simulate(Surface.draw(contact, seed, setup.material), setup, direction, **how)

    return realisations(run, seeds, jobs)


def realisations(run: Callable[[int], Realisation], seeds: int, jobs: int) -> Runs:
    """Return what `run` returns for the seeds 0, 1, ..., computed on several cores."""

    def numbered(seed: int) -> tuple[int, Realisation]:
        return seed, run(seed)

    tasks = [partial(numbered, seed) for seed in range(check_whole("seeds", seeds))]
    done = in_threads(tasks, check_whole("jobs", jobs))
    counted = tqdm(done, total=seeds, unit=" runs", disable=None, delay=10.0)  # on a terminal
    return Runs(run for _, run in sorted(counted, key=itemgetter(0)))
