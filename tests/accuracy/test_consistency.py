"""Ensembles tell changed physics from changed rounding."""

import numpy as np
import pytest

from springblock import Material, Setup
from springblock.accuracy.consistency import (
    LEVEL,
    OBSERVABLES,
    SCENES,
    SEEDS,
    compare,
    differences,
    ensembles,
)


def test_this_processor_and_these_packages_give_the_recorded_physics(springblock):
    said = springblock("verify", "--physics")
    assert "0 of 9 means differ significantly (together, at 1 %): the same physics" in said
    assert said.count(f"of {SEEDS} runs differ") == len(SCENES) * len(OBSERVABLES)


@pytest.mark.parametrize(
    "setup",
    [
        Setup(step=4e-8),
        Setup(Material(mu_dynamic=1.005 * 0.6)),
        Setup(Material(mu_dynamic=0.995 * 0.6)),
    ],
    ids=["twice the step", "mu_d + 0.5 %", "mu_d - 0.5 %"],
)
def test_changed_physics_is_found(setup):
    found = {(each.scene, each.observable): each for each in differences(ensembles(setup))}
    assert found["flat", "t_avg"].is_significant
    if setup.material != Material():
        assert sum(each.is_significant for each in found.values()) >= 5


def test_rounding_raises_few_false_alarms(rng):
    """In all runs or in some, by much in a few: avalanches that take another order."""
    alarms, tries, recorded = 0, 400, np.ones(SEEDS)
    for share in rng.uniform(size=tries):
        apart = rng.standard_t(1.5, (9, SEEDS)) * (rng.uniform(size=(9, SEEDS)) < share)
        found = [compare("flat", "t_avg", recorded + 1e-4 * each, recorded) for each in apart]
        alarms += any(each.is_significant for each in found)
    assert alarms / tries < LEVEL + 3.0 * np.sqrt(LEVEL / tries)
    assert not compare("flat", "t_avg", recorded * (1.0 + 1e-12), recorded).differing
