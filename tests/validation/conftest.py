"""Physics holds whichever integrator follows it."""

import pytest

from springblock.solver.integrators import INTEGRATORS


@pytest.fixture(params=INTEGRATORS)
def integrator(request):
    """Each integrator in turn."""
    return request.param
