"""Load peaks of pawls and grooves: closed forms of rows, and predictions made beforehand."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ndtr

from springblock import Material, Pattern
from springblock.mechanism.elasticity import Layer
from springblock.mechanism.pawls import _fall, pawl, prominence
from springblock.mechanism.surfaces import TEST
from springblock.mechanism.tables import predicted

MATERIAL = Material()
#: Between neighbouring rows that move as a whole: two diagonal springs, and the axial one across.
COUPLING = {False: 0.5, True: 1.5}


@pytest.mark.parametrize("across", [False, True])
def test_a_groove_of_two_rows_hangs_on_its_edges(across):
    """With K_s = K_int = 1, both of its rows move by 1/(1 + k) of the slider's way."""
    k, of = COUPLING[across], pawl(8, 2, across, MATERIAL)
    edge = 1.0 + k / (1.0 + k)
    stiffness = 1.0 + k + k / (1.0 + k)  # of an edge: slider, next row, and the groove behind
    assert of.next_to == pytest.approx(1.0 / edge)
    assert of.mean == pytest.approx((2.0 * edge + 6.0) / 8.0 / edge)
    assert of.handed_on == pytest.approx(k / stiffness)
    assert of.lost == pytest.approx(2.0 / 8.0 * (1.0 - k / stiffness))


@pytest.mark.parametrize("across", [False, True])
def test_an_edge_shares_as_in_a_layer_of_many_blocks(across):
    """S of one block on an edge between blocks at rest, against that of its whole row."""
    contact = Pattern.flat(30, 24).grooved(4, 2).contact
    row = np.cumsum(contact).reshape(contact.shape)[7] - 1  # of the first row beside a groove
    if across:
        row = np.cumsum(contact.T).reshape(contact.T.shape)[:, 7] - 1
    reduced = Layer(contact.T if across else contact, MATERIAL).stiffness
    force = reduced[row[15], row]
    shared = 1.0 - force.sum() / force[15]
    assert pawl(4, 2, across, MATERIAL).shared == pytest.approx(shared, abs=1e-4)


@pytest.mark.parametrize("drop", [0.2, 0.251, 0.4, 1.0])
def test_the_load_falls_where_edges_let_go_faster_than_it_rises(drop):
    z = np.linspace(-4.0, 4.0, 100_001)
    load = 0.1 * z - drop * ndtr(z)
    steps = np.diff(load)
    assert _fall(drop, 0.1) == pytest.approx(-steps[steps < 0.0].sum(), abs=1e-8)
    assert (_fall(drop, 0.1) > 0.0) == (drop > np.sqrt(2.0 * np.pi) * 0.1)


def test_without_a_drop_or_without_a_core_there_is_one_peak():
    assert prominence(8, 2, False, replace(MATERIAL, mu_dynamic=1.0)) == 0.0
    assert prominence(2, 2, False, MATERIAL) == 0.0


def test_edges_that_let_go_at_once_cost_the_load_what_they_lose():
    even = replace(MATERIAL, mu_static_std=0.0)
    of = pawl(13, 2, False, even)
    assert prominence(13, 2, False, even) == pytest.approx(100.0 * of.lost * 0.4 / of.mean)


def test_predictions_are_those_made_before_any_simulation():
    with (Path(__file__).parent / "predicted.csv").open() as file:
        kept = [(row, float(row["predicted_percent"])) for row in csv.DictReader(file)]
    assert len(kept) == len(TEST)
    for (row, before), surface in zip(kept, TEST, strict=True):
        named = ("n_p", "n_p2", "n_s2", "direction")
        assert [row[key] for key in named] == [str(surface.row[key]) for key in named]
        if surface.n_p2 <= 8:  # wider ones take longer
            assert predicted(surface) == pytest.approx(before, abs=0.006)
