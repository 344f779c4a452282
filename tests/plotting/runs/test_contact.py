"""The picture of a surface shows the mask that the solver takes."""

import numpy as np
import pytest
from matplotlib.patches import FancyArrowPatch
from matplotlib.text import Text

from springblock import Pattern
from springblock.plotting.runs import contact as picture_of

GROOVED = Pattern.pillars(60, 28, 32).grooved(8, 2)
SURFACES = {
    "flat": Pattern.flat(8).contact,
    "grooved": GROOVED.contact,
    "oblong": GROOVED.contact[:20],
    "one row": np.array([[True, False, True]]),
}


def texts(picture):
    return " ".join(text.get_text() for text in picture.findobj(Text))


@pytest.mark.parametrize("name", SURFACES)
def test_blocks_are_those_of_the_mask(name):
    contact = SURFACES[name]
    whole, detail = picture_of.draw(contact, "x").axes
    np.testing.assert_array_equal(whole.images[0].get_array(), contact)
    assert whole.get_xlim() == (-0.5, contact.shape[1] - 0.5)
    left, right, bottom, top = detail.images[0].get_extent()
    rows, columns = (
        slice(round(bottom + 0.5), round(top + 0.5)),
        slice(round(left + 0.5), round(right + 0.5)),
    )
    np.testing.assert_array_equal(detail.images[0].get_array(), contact[rows, columns])
    assert contact[rows, columns].any()


def test_the_share_in_contact_is_said():
    assert "8 of 9 blocks in contact, 88.9 %" in texts(
        picture_of.draw(np.arange(9).reshape(3, 3) > 0, "x")
    )


@pytest.mark.parametrize(
    ("direction", "said", "towards"),
    [
        ("x", "$x$", (1, 0)),
        (90, "$y$", (0, 1)),
        ("30", "30°", (np.sqrt(0.75), 0.5)),
        (180, "180°", (-1, 0)),
    ],
)
def test_the_arrow_goes_where_the_slider_goes(direction, said, towards):
    whole = picture_of.draw(GROOVED.contact, direction).axes[0]
    (arrow,) = whole.findobj(FancyArrowPatch)
    corners = arrow.get_path().vertices[:-1]  # the last one closes the head
    way = corners - corners[0]
    tip = way[np.argmax(np.hypot(*way.T))]
    assert tip / np.hypot(*tip) == pytest.approx(towards, abs=1e-6)
    assert f"sliding direction {said}" in texts(whole.figure)
