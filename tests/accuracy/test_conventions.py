"""What is said of errors follows from the tables."""

import numpy as np
import pytest

from springblock.accuracy.conventions import ensemble_error, order


def test_the_ensemble_error_falls_with_the_root_of_the_number_of_seeds():
    scatter = {"ci_low": -0.01984217, "ci_high": 0.01984217, "realisations": 100}
    assert ensemble_error(scatter, 100) == pytest.approx(0.01, rel=1e-6)
    assert ensemble_error(scatter, 25) == pytest.approx(0.02, rel=1e-6)


def test_an_order_is_that_of_steps_where_errors_have_settled():
    steps = np.array([8e-8, 4e-8, 2e-8, 1e-8, 5e-9])
    assert order(steps, np.where(steps > 2e-8, 1.0, 3e3 * steps)) == pytest.approx(1.0)
