"""docs/reliability.md says what is tested, and no more."""

import re
from pathlib import Path

from faults import test_files
from faults.studies import ROOT

ROWS = re.findall(
    r"^\| (.+?) \| .+? \| .+? \| `(test_\w+)` \|$",
    (ROOT / "docs/reliability.md").read_text(encoding="utf-8"),
    re.MULTILINE,
)
EACH = test_files.test_a_bad_file_is_named_and_set_aside.__name__


def test_each_row_names_a_test_and_each_test_has_a_row():
    names = ("files", "runs")
    files = [Path(__file__).with_name(f"test_{name}.py") for name in names]
    tests = {
        name for file in files for name in re.findall(r"^def (test_\w+)", file.read_text(), re.M)
    }
    assert {test for _, test in ROWS} == tests
    assert [fault for fault, test in ROWS if test == EACH] == list(test_files.FAULTS)
    assert len(ROWS) >= 25
