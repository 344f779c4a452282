"""Decay of correlation and lowest friction by the scatter of thresholds."""

import numpy as np
import pytest

from beyond.made_up import ensemble
from springblock.beyond import scatter
from springblock.model.scene import Scene


def scattered(length, best=lambda std: 10.0):
    """Pillars whose l_c and whose friction-minimising n_p follow the scatter."""
    found = {}
    for std in (0.05, 0.1, 0.2):
        varied = () if std == 0.1 else (("mu_static_std", std),)
        for n_p in (4, 10, 20):
            scene = Scene(80, n_p, n_p, varied=varied)
            height = 0.7 + 0.02 * np.log(n_p / best(std)) ** 2
            found[scene] = ensemble(scene, height, length(std), runs=25)
    return found


@pytest.mark.parametrize(
    ("best", "minimum"), [(lambda std: 100.0 * std, "from 4 to 20"), (lambda std: 10.0, ": 10")]
)
def test_the_page_has_the_sizes_of_lowest_friction_by_scatter(best, minimum):
    conclusion, table = scatter.answers(scattered(lambda std: 0.2 / std, best))
    assert conclusion.endswith(f"{minimum}.")
    assert len(table.splitlines()) == 5


@pytest.mark.parametrize(("runs", "are_known"), [(9, False), (10, True)])
def test_ten_realisations_are_enough(runs, are_known):
    few = {scene: every[:runs] for scene, every in scattered(lambda std: 2.0).items()}
    assert bool(scatter.by_scatter(few)) == are_known
