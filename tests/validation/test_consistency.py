"""Small ensembles have the recorded physics on any processor and with any versions of packages.

Rounding changes the last bits of a run, and avalanches amplify them. If only rounding has changed,
a run is as likely above its record as below: Wilcoxon's signed-rank test over seeds, at 1 % for all
nine samples together. (Climate models are tested so after a change of machine: Baker et al. 2015,
doi:10.5194/gmd-8-2829-2015.)

    PYTHONPATH=tests python tests/validation/test_consistency.py    # records again
"""

from pathlib import Path

import pandas as pd
from scipy.stats import wilcoxon

from springblock import Pattern, Surface, compute_prelude, simulate

SCENES = {
    "flat": Pattern.flat(16),
    "pillars": Pattern.pillars(16, 4, 4),
    "grooves": Pattern.pillars(28, 22, 6).grooved(4, 2),
}
SEEDS = 50
OBSERVABLES = ["static_friction", "t_max", "t_avg"]
RECORD = Path(__file__).with_name("consistency.csv")
LEVEL = 0.01 / (len(SCENES) * len(OBSERVABLES))
ROUNDING = 1e-9  #: largest relative difference that no avalanche has amplified


def ensembles():
    """Observables of all realisations, by scene and seed."""
    rows = {}
    for scene, pattern in SCENES.items():
        prelude = compute_prelude(pattern)
        for seed in range(SEEDS):
            run = simulate(Surface.draw(pattern, seed), prelude=prelude)
            rows[scene, seed] = [getattr(run, name) for name in OBSERVABLES]
    index = pd.MultiIndex.from_tuples(rows, names=["scene", "seed"])
    return pd.DataFrame(rows.values(), index, OBSERVABLES)


def test_this_processor_and_these_packages_give_the_recorded_physics():
    apart = ensembles() / pd.read_csv(RECORD, index_col=["scene", "seed"]) - 1.0
    changed = [
        (scene, name)
        for scene, values in apart.where(apart.abs() > ROUNDING).groupby("scene")
        for name in OBSERVABLES
        if (differing := values[name].dropna()).size and wilcoxon(differing).pvalue < LEVEL
    ]
    assert changed == []


if __name__ == "__main__":
    ensembles().to_csv(RECORD)
