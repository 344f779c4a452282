"""Means of ensembles and their changes, as rows and in words."""

from plotting.test_sweep import at, rows
from springblock.analysis.ensembles import ensembles
from springblock.analysis.statistics import mean_interval
from springblock.beyond.question import number
from springblock.report.means import changes_over_ends, in_words, means
from springblock.simulation.setup import Setup

HOW = {key: Setup().constants[key] for key in ("integrator", "step", "sample_interval")}


def test_changes_are_from_the_lowest_to_the_highest_value_seed_by_seed():
    """Scatter that both ensembles have leaves the difference exact."""
    speeds = {1e-3: 0.83, 5e-4: 0.9, 2.5e-4: 0.8}
    made = [row | HOW for speed, friction in speeds.items() for row in rows(at(speed), friction)]
    head, (cells,) = in_words(changes_over_ends(ensembles(made), ["static_friction"]))
    assert head == ["from", "to", "runs", "difference", "static_friction"]
    assert cells[:4] == ["slider_velocity = 0.00025 m/s", "0.001", "5, 5", "by seed"]
    assert cells[4].startswith("0.03")


def test_a_row_of_means_names_what_ensembles_differ_in():
    made = [row | HOW for speed in (5e-4, 1e-3) for row in rows(at(speed), 0.8)]
    head, cells = in_words(means(ensembles(made), ["static_friction", "t_max"]))
    assert head == ["slider_velocity (m/s)", "runs", "static_friction", "t_max (µs)"]
    assert [row[:2] for row in cells] == [["0.0005", "5"], ["0.001", "5"]]
    exact = number(mean_interval([row["static_friction"] for row in rows(at(5e-4), 0.8)]))
    assert cells[0][2] == exact
