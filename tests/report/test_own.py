"""The report of a study of one's own scenes."""

from plotting.test_sweep import at, rows
from springblock.analysis.statistics import mean_interval
from springblock.beyond.question import number
from springblock.report import own
from springblock.simulation.setup import Setup

HOW = {key: Setup().constants[key] for key in ("integrator", "step", "sample_interval")}


def test_changes_are_from_the_lowest_to_the_highest_value_seed_by_seed():
    """Scatter that both ensembles have leaves the difference exact."""
    speeds = {1e-3: 0.83, 5e-4: 0.9, 2.5e-4: 0.8}
    made = [row | HOW for speed, friction in speeds.items() for row in rows(at(speed), friction)]
    ((name, ends, others, difference),) = own._changes(own.ensembles(made))
    assert (name, ends, others) == ("slider_velocity (m/s)", "0.00025 to 0.001", "–")
    assert difference.startswith("0.03")


def test_a_row_of_means_names_what_ensembles_differ_in():
    made = [row | HOW for speed in (5e-4, 1e-3) for row in rows(at(speed), 0.8)]
    head, means = own._means(own.ensembles(made))
    assert head[:3] == ["slider_velocity (m/s)", "realisations", "static friction"]
    assert [row[:2] for row in means] == [["0.0005", "5"], ["0.001", "5"]]
    exact = number(mean_interval([row["static_friction"] for row in rows(at(5e-4), 0.8)]))
    assert means[0][2] == exact
