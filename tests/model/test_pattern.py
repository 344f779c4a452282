"""Contact masks against the paper's definitions (sections 3.2 and 3.3)."""

import numpy as np
import pytest

from springblock import Pattern

GROOVED = Pattern.pillars(120, 58, 62).grooved(8, 2, along="x")


def segments(line):
    """First block and length of each segment in contact along a line."""
    starts = np.flatnonzero(np.diff(line.astype(int), prepend=0) == 1)
    ends = np.flatnonzero(np.diff(line.astype(int), append=0) == -1) + 1
    return list(zip(starts.tolist(), (ends - starts).tolist(), strict=True))


def test_a_flat_surface_touches_everywhere():
    assert Pattern.flat(7).contact.all()
    assert Pattern.flat(7).origins.tolist() == [[0, 0]]


def test_a_rectangle_is_cut_as_a_square_is():
    """Half as many rows of pillars, with the same margins."""
    square, wide = Pattern.pillars(24, 4, 2), Pattern.pillars(24, 4, 2, n_rows=12)
    assert wide.contact.shape == wide.shape == (12, 24)
    np.testing.assert_array_equal(wide.contact, square.contact[:12])
    np.testing.assert_array_equal(wide.origins, square.origins[: len(square.origins) // 2])
    assert Pattern.flat(5, n_rows=2).contact.shape == (2, 5)
    assert Pattern(9, n_rows=9) == Pattern(9)


@pytest.mark.parametrize(
    ("n", "n_p", "n_s"),
    [(120, 2, 2), (120, 60, 60), (12, 4, 2), (14, 4, 3)],
)
def test_pillars_and_gaps_alternate(n, n_p, n_s):
    """Half a gap remains at every edge, of an odd one its larger half at the far edge.

    The paper's pillars, with n_s = n_p, bear on a quarter of the surface.
    """
    contact = Pattern.pillars(n, n_p, n_s).contact
    expected = [(start, n_p) for start in range(n_s // 2, n, n_p + n_s)]
    for line in (contact[n_s // 2], contact[:, n_s // 2]):
        assert segments(line) == expected
    assert not contact[0].any()
    assert contact.sum() == (n // (n_p + n_s) * n_p) ** 2


def test_origins_are_the_first_blocks_of_the_pillars():
    pattern = Pattern.pillars(12, 4, 2).grooved(1, 2)
    assert pattern.origins.tolist() == [[1, 1], [1, 7], [7, 1], [7, 7]]
    for y, x in pattern.origins:
        assert pattern.contact[y, x]
        assert not pattern.contact[y - 1, x]
        assert not pattern.contact[y, x - 1]


@pytest.mark.parametrize(("n_p2", "pawls"), [(8, 6), (10, 5)])
def test_pawls_fill_their_pillar_from_edge_to_edge(n_p2, pawls):
    """Grooves along x cut the pillar's y axis: 58 = 6·8 + 5·2 = 5·10 + 4·2."""
    contact = Pattern.pillars(120, 58, 62).grooved(n_p2, 2, along="x").contact
    assert segments(contact[:, 60]) == [(31 + k * (n_p2 + 2), n_p2) for k in range(pawls)]
    assert segments(contact[31]) == [(31, 58)]


def test_grooves_along_y_are_the_transpose_of_grooves_along_x():
    turned = Pattern.pillars(120, 58, 62).grooved(8, 2, along="y")
    np.testing.assert_array_equal(turned.contact, GROOVED.contact.T)
    assert (GROOVED.levels[-1].along, turned.levels[-1].along) == ("x", "y")
    assert GROOVED.levels[0].along is None


def test_grooves_on_a_flat_surface_are_stripes():
    contact = Pattern.flat(12).grooved(4, 2, along="x").contact
    assert segments(contact[:, 0]) == [(1, 4), (7, 4)]
    assert (contact == contact[:, :1]).all()


def test_crossed_grooves_are_pillars_upon_pillars():
    base = Pattern.pillars(16, 11, 5)
    crossed = base.grooved(5, 1, along="x").grooved(5, 1, along="y")
    np.testing.assert_array_equal(crossed.contact, base.pillared(5, 1).contact)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Pattern.pillars(120, 7, 4), r"gap = 7 \+ 4 = 11 must divide N = 120"),
        (lambda: Pattern.pillars(24, 4, 2, n_rows=13), "6 must divide N_y = 13; it leaves 1"),
        (lambda: Pattern.pillars(25, 4, 2, n_rows=12), "6 must divide N_x = 25; it leaves 1"),
        (lambda: Pattern.flat(4, n_rows=0), "n_rows must be at least 1, not 0"),
        (lambda: Pattern.pillars(12, 4, 2).grooved(1, 4), "groove of 4 .* pillar of 4 blocks"),
        (lambda: Pattern.pillars(12, 4, 2).grooved(2, 1), "do not fill a pillar of 4 blocks"),
        (lambda: Pattern.flat(4097), "N must be at most 4096, not 4097"),
        (lambda: Pattern.flat(4.0), "N must be a whole number, not 4.0"),
        (lambda: Pattern.flat(True), "N must be a whole number, not True"),
        (lambda: Pattern.pillars(12, 0, 2), "n_p must be at least 1, not 0"),
        (lambda: Pattern.pillars(12, 2, -2), "n_s must be at least 1, not -2"),
        (lambda: Pattern.flat(12).grooved(2, 0), "n_s2 must be at least 1, not 0"),
        (lambda: Pattern.flat(12).grooved(4, 2, along="z"), "along must be 'x' or 'y', not 'z'"),
    ],
)
def test_a_level_that_does_not_fit_is_refused(build, message):
    with pytest.raises((TypeError, ValueError), match=message):
        build()
