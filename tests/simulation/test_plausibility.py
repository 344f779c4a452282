"""Warnings on input that is valid but hardly meant, with what a person would type."""

import re
import subprocess
import sys
import warnings

import pytest

from springblock import Material, Pattern, Setup, Surface, simulate
from springblock.model.defaults import STEP
from springblock.provenance import PLAN, planned
from springblock.simulation import plausibility

FLAT, PILLARS = Pattern.flat(12), Pattern.pillars(12, 4, 2)
FINE = {"law": "slip_weakening", "slip_distance": 5e-8, "spacing": 1.25e-6}
DRAG = {"gamma": 5e12, "duration": 1e-3}


def said(pattern=FLAT, runs=1, duration=4e-6, step=STEP, **constants):
    """Return the warnings of runs in one process."""
    setup = Setup(Material(**constants), step=step)
    surface = Surface.draw(pattern, 0, setup.material)
    plausibility._warn_once.cache_clear()
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("default")
        for _ in range(runs):
            simulate(surface, setup, duration=duration)
    return [str(each.message) for each in found]


@pytest.mark.parametrize(
    ("constants", "sentence"),
    [
        ({"pressure": 0.05}, "pressure = 0.05 Pa .* did you mean"),  # MPa
        ({"slider_velocity": 5.0}, "slider_velocity = 5 m/s .* did you mean"),  # mm/s
        ({"spacing": 0.01}, "spacing = 0.01 m exceeds thickness = 1e-05 m"),  # mm
        ({"thickness": 0.01}, "thickness = 0.01 m exceeds the side of the surface, 0.00012 m"),
        (
            {"pattern": PILLARS, **FINE, **DRAG},
            "static friction = .* exceeds the largest coefficient",
        ),
        ({"pattern": PILLARS}, "depends on the spacing .* slip_weakening .* 1.4e-06 m .* refine"),
        ({"pattern": PILLARS, "law": "velocity_weakening", "speed_scale": 1e-2}, "law velocity_we"),
        (
            {**FINE, "slip_distance": 0.1, "step": 5e-9},
            "slip_distance = 0.1 m exceeds thickness = 1e-05 m",
        ),
        (
            {"pattern": PILLARS, **FINE, "spacing": 1e-5},
            "does not resolve fronts with slip_distance",
        ),
    ],
)
def test_one_sentence_says_what_is_hardly_meant(constants, sentence):
    (found,) = said(**constants, runs=2)
    assert len(found.splitlines()) == 1
    assert re.search(sentence, found)


@pytest.mark.parametrize(
    "constants", [{}, {"slider_velocity": 0.2}, {"pattern": PILLARS, "step": 5e-9} | FINE]
)
def test_usual_and_resolved_runs_are_silent(constants):
    assert said(**constants) == []


def test_jobs_of_a_study_are_silent(monkeypatch):
    monkeypatch.setenv(PLAN, planned("a study", []))
    assert said(PILLARS) == []


def test_the_command_warns_on_stderr_and_shows_angles_in_degrees(tmp_path):
    """1.57 is an angle in degrees, whatever was meant."""
    words = ["simulate", "--n-blocks", "12", "--n-p", "4", "--n-s", "2", "--direction", "1.57"]
    words += ["--output", str(tmp_path / "a.parquet")]
    called = subprocess.run(
        [sys.executable, "-m", "springblock", *words], capture_output=True, text=True, check=True
    )
    assert called.stderr.startswith("warning: under the law coulomb static friction")
    assert called.stderr.count("warning") == 1
    assert called.stdout.endswith("sliding at 1.57°\n")
