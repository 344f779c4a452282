"""What friction and load peaks depend on, from realisations for which it is known."""

import numpy as np
import pytest

from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.study.mechanism.sensitivities import sensitivities, setting

STIFFER = {"youngs_modulus": 1.41421356e7, "density": 1697.05627, "thickness": 7.0710678e-6}


def run(scene, friction, seed, dip=0.0):
    """Two load peaks with a dip between them, the later one at 3 µs; blocks detach at 1 µs."""
    return Record(
        scene=scene,
        seed=seed,
        time=1e-6 * np.arange(6),
        force=(friction + 1e-4 * seed) * np.array([0.0, 0.99, 0.99 - dip, 1.0, 0.5, 0.6]),
        detachments=np.zeros(6, int),
        switches=np.zeros(6, int),
        t_det=np.where(scene.contact, 1e-6, np.nan),
        normal_force=1.0,
        contact=scene.contact,
    )


def surfaces(best, dip, **own):
    """Pillars with the lowest friction on one size, on a larger surface, and grooves."""
    for seed in (-1, 0, 1):
        for n_p in (3, 4, 6, 12):
            yield run(Scene(24, n_p, n_p, **own), 0.6 + 0.1 * (n_p != best), seed)
        yield run(Scene(36, 6, 6, **own), 0.9, seed)
        yield run(Scene(20, 10, 10, 4, 2, **own), 0.8, seed, dip)


def test_each_setting_has_its_lowest_friction_time_and_load_peak():
    """The friction of the larger surface, which is for the time alone, is not compared."""
    rows = sensitivities([*surfaces(6, 0.05), *surfaces(4, 0.02, gamma=1e6)])
    found = {(row["varied"], row["quantity"]): row for row in rows}
    for varied, size, dip in (("", 6, 0.05), ("gamma", 4, 0.02)):
        assert found[varied, "size"]["mean"] == size
        assert found[varied, "friction"]["mean"] == pytest.approx(0.6)
        assert found[varied, "depth"]["mean"] == pytest.approx(0.1)
        assert found[varied, "lag"]["mean"] == pytest.approx(2e-6)
        assert found[varied, "prominence"]["mean"] == pytest.approx(dip)
        assert found[varied, "size"]["seeds"] == 3


def test_sizes_that_may_have_the_lowest_friction_limit_the_size():
    rows = sensitivities([*surfaces(4, 0.0), *surfaces(4, 0.0)])
    (size,) = [row for row in rows if row["quantity"] == "size"]
    assert (size["mean_low"], size["mean_high"]) == (4.0, 4.0)
    equal = sensitivities(surfaces(0, 0.0))
    (size,) = [row for row in equal if row["quantity"] == "size"]
    assert (size["mean_low"], size["mean_high"]) == (3.0, 12.0)


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        (Scene(12, 3, 3), ("", "")),
        (Scene(18, 3, 6), ("gaps", "× 2")),
        (Scene(20, 10, 10, 9, 1), ("gaps", "× 0.5")),
        (Scene(12, 3, 3, thickness=5e-6), ("l_z", "× 0.5")),
        (Scene(12, 3, 3, mu_dynamic=0.2), ("mu_s - mu_d", "× 2")),
        (Scene(12, 3, 3, **STIFFER), ("K_s", "× 2")),
        (Scene(12, 3, 3, gamma=4e7), ("gamma", "4e+07 1/s")),
        (Scene(12, 3, 3, edges="periodic"), ("edges", "periodic")),
    ],
    ids=str,
)
def test_a_setting_is_what_differs_from_the_papers_surfaces(scene, expected):
    assert setting(scene)[:2] == expected
