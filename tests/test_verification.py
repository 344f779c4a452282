"""Others can trust the verification problems: files are whole, and the comparison is exact."""

import re

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks.verification.__main__ import main
from benchmarks.verification.entries import solved_by
from benchmarks.verification.metrics import Metrics, errors, uncertainties
from benchmarks.verification.problems import (
    PROBLEMS,
    SCALARS,
    Answer,
    read_reference,
    read_surface,
    read_table,
)
from springblock import Surface

ENTRIES = (PROBLEMS["flat"].folder.parent / "ENTRIES.md").read_text(encoding="utf-8")


@pytest.fixture(params=PROBLEMS)
def problem(request):
    return PROBLEMS[request.param]


def test_surfaces_are_those_of_their_seeds(problem):
    """17 digits hold every bit."""
    read, drawn = read_surface(problem), Surface.draw(problem.pattern.contact, problem.seed)
    for name in ("contact", "mu_static", "mu_dynamic"):
        np.testing.assert_array_equal(getattr(read, name), getattr(drawn, name))
    assert (read.mu_dynamic < read.mu_static)[read.contact].all()


def test_references_are_whole(problem):
    """Every contact block lets go, within the horizon; scalars follow from the force."""
    reference = read_reference(problem)
    np.testing.assert_array_equal(np.isfinite(reference.t_det), problem.pattern.contact)
    assert np.nanmax(reference.t_det) < reference.horizon <= problem.duration
    assert len(reference.force) == len(problem.time)
    (values,) = read_table(problem.folder / "scalars.csv", SCALARS[1:2])
    expected = [reference.t_max, reference.static_friction]
    np.testing.assert_allclose(values[1:], expected, rtol=1e-11)
    before = np.nansum(reference.t_det < reference.t_max)
    assert before > 5  # so that the force before the peak tests more than loading


def test_checks_agree_within_the_uncertainty(problem):
    """An RMS over blocks of largest disagreements is no less than that of any check.

    Half the step leaves at most half of what the leapfrog is off by.
    """
    bounds = uncertainties(read_reference(problem))
    agreement = read_table(problem.folder / "agreement.csv", Metrics._fields).T
    assert (agreement <= 1.01 * np.array(bounds)).all()  # both are rounded
    assert max(bounds[:3]) < 1e-4
    tolerance, coarse, fine = agreement
    assert (tolerance < 1e-7).all()
    assert (fine <= coarse / 2).all()


def test_errors_are_those_that_were_made(problem):
    """Times late by a hundredth of t_max, a force that is too large by a part in a thousand."""
    reference = read_reference(problem)
    late = reference.t_det + 0.01 * reference.t_max
    found = errors(Answer(problem, late, 1.001 * reference.force), reference)
    peak = reference.force.argmax()
    share = reference.force[:peak].max() / reference.force[peak]
    np.testing.assert_allclose(found, (0.01, 1e-3, 1e-3 * share, 0), rtol=1e-9)


def test_blocks_out_of_order_are_counted_once(problem):
    """The first one, let go last, overtakes all others and is one block out of order."""
    reference = read_reference(problem)
    t_det = reference.t_det.copy()
    t_det.flat[np.nanargmin(t_det)] = 1.0
    found = errors(Answer(problem, t_det, reference.force), reference)
    assert found.out_of_order == 1
    backwards = Answer(problem, -reference.t_det, reference.force)
    blocks = np.count_nonzero(problem.pattern.contact)
    assert errors(backwards, reference).out_of_order == blocks - 1


def test_the_leapfrog_stays_within_its_entry(problem):
    """But for rounding: of an entry to three digits, and of another processor's."""
    section = re.search(rf"## {problem.name.capitalize()}\n(.*?)(?=\n## |\Z)", ENTRIES, re.DOTALL)
    line = re.search(r"\| leapfrog \| 1e-08 \| (\d+) \| \S+ \| (.*) \|", section[1])
    answer, evaluations = solved_by("leapfrog", 1e-8, problem, read_surface(problem))
    found = errors(answer, read_reference(problem))
    assert evaluations == int(line[1])
    assert (np.array(found) <= 1.01 * np.array(line[2].split(" | "), float)).all()


def compare(*arguments):
    return CliRunner().invoke(main, ["compare", *map(str, arguments)])


def test_the_command_prints_a_line_per_metric(problem):
    folder = problem.folder
    both = compare(problem.name, folder / "t_det.csv", "--force", folder / "force.csv")
    assert both.exit_code == 0
    assert re.findall(r"  (\S+) ± ", both.output) == ["0"] * 4
    alone = compare(problem.name, folder / "t_det.csv")
    assert alone.output.count("no force table") == 2
    assert alone.output.count("0 ± ") == 2


FLAT, GROOVED = PROBLEMS["flat"].folder, PROBLEMS["grooved"].folder
WHOLE, FORCE = ((FLAT / f"{name}.csv").read_text() for name in ("t_det", "force"))
HEADER, FIRST, *REST = WHOLE.splitlines(keepends=True)


@pytest.mark.parametrize(
    ("text", "refusal"),
    [
        ("", "must have the columns y, x, t_det; it has none"),
        (WHOLE.replace("0,0,", "0,0,late", 1), "t_det must be a number, not 'late"),
        (WHOLE.replace("0,0,", "0,0,-", 1), "t_det must be in s, zero or positive"),
        (WHOLE.replace("0,0,", "0,6,", 1), "whole numbers from 0 to 5, not 0 and 6"),
        (WHOLE + FIRST, "must give block (y, x) = (0, 0) once"),
        (HEADER + "".join(REST), "up to the horizon; it is nan at (y, x) = (0, 0)"),
        (bytes(range(256)).decode("latin-1"), "must be comma-separated text"),
        (FORCE.replace("2e-07,", "3e-07,", 1), "multiples of 2e-07 s from 0 to 0.00013"),
        (FORCE.replace("2e-07,", "2e-07,-", 1), "force must be finite and not negative"),
    ],
)
def test_a_malformed_table_is_refused(text, refusal, tmp_path):
    table = tmp_path / "table.csv"
    table.write_text(text, encoding="latin-1")
    of_force = (FLAT / "t_det.csv", "--force", table)
    outcome = compare("flat", *(of_force if "force" in text else (table,)))
    assert outcome.exit_code == 1
    assert refusal in outcome.output
    assert re.fullmatch(r"Error: .*\n", outcome.output)


def test_blocks_without_contact_do_not_let_go(tmp_path):
    table, whole = tmp_path / "table.csv", (GROOVED / "t_det.csv").read_text()
    table.write_text(whole + "5,5,1e-4,0\n")
    assert "in contact; it is 0.0001 at (y, x) = (5, 5)" in compare("grooved", table).output
    table.write_text(whole + "5,5,nan,0\n")
    assert compare("grooved", table).exit_code == 0
