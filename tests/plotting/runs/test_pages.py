"""Pictures of runs and surfaces stay on their pages."""

import pytest

from plotting.runs.test_contact import SURFACES
from plotting.runs.test_still import PILLARS, oblong
from springblock import draw_friction, plot, simulate
from springblock.plotting import style
from springblock.plotting.runs import contact

RUN = (PILLARS.contact, *draw_friction(12, 1))


def ended_early():
    """A run that ends when some blocks have detached, with two snapshots."""
    return simulate(*RUN, duration=1.6e-4, snapshot_times=(1e-4, 1.5e-4))


DRAWINGS = {
    "run": lambda: plot(ended_early()),
    "oblong run": lambda: plot(oblong(ended_early())),
    **{name: lambda c=c: contact.draw(c, 30, "its name") for name, c in SURFACES.items()},
}


@pytest.mark.parametrize("name", DRAWINGS)
def test_nothing_leaves_the_page(name):
    picture = DRAWINGS[name]()
    style.settle(picture)
    box = style.journal(picture.get_tightbbox)()  # inches
    width, height = picture.get_size_inches()
    assert 0.0 <= box.x0 < box.x1 <= width
    assert 0.0 <= box.y0 < box.y1 <= height
