"""Consistency of ensembles: whether the physics is the same where bits differ.

Another processor, compiler or version of numba may change the last bits of a run. Avalanches
amplify them, so that single runs differ while means should not. Small ensembles are compared with
recorded ones of the same seeds: if only rounding has changed, a run is as likely above its record
as below. (Climate models are tested by ensembles after a change of machine: Baker et al. 2015,
doi:10.5194/gmd-8-2829-2015.)

    python -m springblock.accuracy.consistency    # record again, after a deliberate change
"""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray
from pyarrow import csv
from scipy.stats import wilcoxon
from tqdm import tqdm

from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.setup import DEFAULT, Setup
from springblock.simulation.simulate import simulate

SCENES = {
    "flat": Pattern.flat(16),
    "pillars": Pattern.pillars(16, 4, 4),
    "grooves": Pattern.pillars(28, 22, 6).grooved(4, 2),
}
SEEDS = 50
OBSERVABLES = ("static_friction", "t_max", "t_avg")
RECORD = Path(__file__).with_name("consistency.csv")
#: Probability of a false alarm, for all observables of all scenes together.
LEVEL = 0.01
#: Largest relative difference that is rounding, not amplified by avalanches.
_ROUNDING = 1e-9


class Difference(NamedTuple):
    """Comparison of one observable of one scene with its record."""

    scene: str
    observable: str
    differing: int  #: runs that differ by more than rounding
    relative: float  #: difference of the means, over the recorded one
    p_value: float  #: of Wilcoxon's signed-rank test; 1 if no run differs

    @property
    def is_significant(self) -> bool:
        """Whether rounding cannot explain the difference, at a joint level of 1 % (Bonferroni)."""
        return self.p_value < LEVEL / (len(SCENES) * len(OBSERVABLES))

    def __str__(self) -> str:
        change = f"{self.differing} of {SEEDS} runs differ"
        if self.differing:
            change += f", the mean by {self.relative:+.2g} of its value (p = {self.p_value:.2g})"
        return f"{self.scene}, {self.observable}: {change}"


def ensembles(setup: Setup = DEFAULT) -> pa.Table:
    """Simulate all ensembles; one row per realisation, seeds in ascending order."""
    rows = []
    for scene, pattern in SCENES.items():
        prelude = compute_prelude(pattern.contact, setup)
        for seed in tqdm(range(SEEDS), desc=scene, unit="realisation", leave=False):
            surface = Surface.draw(pattern.contact, seed, setup.material)
            run = simulate(surface, setup, prelude=prelude)
            values = {name: getattr(run, name) for name in OBSERVABLES}
            rows.append({"scene": scene, "seed": seed, **values})
    return pa.Table.from_pylist(rows)


def differences(found: pa.Table) -> Iterator[Difference]:
    """Compare ensembles with the recorded ones, seed by seed."""
    tables = found, csv.read_csv(RECORD)
    for scene in SCENES:
        here, there = (table.filter(pc.field("scene") == scene) for table in tables)
        for name in OBSERVABLES:
            yield compare(scene, name, here[name].to_numpy(), there[name].to_numpy())


def compare(
    scene: str, observable: str, found: NDArray[np.float64], recorded: NDArray[np.float64]
) -> Difference:
    """Compare one observable, (seeds,) each."""
    apart = found - recorded
    relative = float(apart.mean() / recorded.mean())
    apart = apart[np.abs(apart) > _ROUNDING * np.abs(recorded)]
    p_value = float(wilcoxon(apart).pvalue) if apart.size else 1.0
    return Difference(scene, observable, apart.size, relative, p_value)


if __name__ == "__main__":
    csv.write_csv(ensembles(), RECORD, csv.WriteOptions(quoting_style="none"))
