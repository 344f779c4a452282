"""The notebook runs, and shows what it did when it was written.

`python tests/test_tour.py` runs it and keeps what it shows. Jupyter is not needed for that: what a
cell shows is what it prints and its last expression.
"""

import ast
import base64
import io
import os
import re
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import nbformat
import pytest
from matplotlib.figure import Figure
from nbformat.v4 import new_output

NOTEBOOK = Path(__file__).parents[1] / "docs/tour.ipynb"
#: Single runs on patterned surfaces agree between processors to half a percent.
SCATTER = 0.02


def shown(value: Any) -> Any:
    """Output that Jupyter would keep of a cell's last expression."""
    data = {"text/plain": repr(value)}
    if isinstance(value, Figure):
        picture = io.BytesIO()
        value.savefig(picture, format="png", dpi=80, metadata={"Software": None})
        text = f"<Figure size {value.bbox.width:.0f}x{value.bbox.height:.0f}>"
        data = {"image/png": base64.b64encode(picture.getvalue()).decode(), "text/plain": text}
    return new_output("display_data", data=data)


def run_cell(source: str, names: dict[str, Any]) -> list[Any]:
    """Run one cell, but for Jupyter's own commands; returns its outputs."""
    tree = ast.parse(re.sub(r"^%.*$", "", source, flags=re.MULTILINE))
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    outputs, printed, value = [], io.StringIO(), None
    with redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    if printed.getvalue():
        outputs.append(new_output("stream", name="stdout", text=printed.getvalue()))
    return outputs if value is None else [*outputs, shown(value)]


def run_notebook(notebook: Any) -> None:
    """Run all cells in order, and put what they show in the place of what they have shown."""
    names: dict[str, Any] = {}
    for number, cell in enumerate(each for each in notebook.cells if each.cell_type == "code"):
        cell.outputs = run_cell(cell.source, names)
        cell.execution_count = number + 1


def texts(notebook: Any) -> list[str]:
    """What cells show in words."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output.get("text") or output.data["text/plain"] for output in outputs]


def pictures(notebook: Any) -> int:
    """How many pictures cells show."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return sum("image/png" in output.get("data", {}) for output in outputs)


NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def test_the_notebook_shows_what_it_has_shown(tmp_path, monkeypatch):
    """Words to the letter; numbers within what processors tell apart, the smallest not at all."""
    monkeypatch.chdir(tmp_path)  # where no study is
    stored, now = (nbformat.read(NOTEBOOK, as_version=4) for _ in range(2))
    nbformat.validate(stored)
    run_notebook(now)
    assert pictures(now) == pictures(stored) == 3
    for before, after in zip(texts(stored), texts(now), strict=True):
        assert NUMBER.sub("#", before) == NUMBER.sub("#", after)
        found, expected = (list(map(float, NUMBER.findall(text))) for text in (after, before))
        assert found == pytest.approx(expected, rel=SCATTER, abs=5e-3)
    assert NOTEBOOK.stat().st_size < 400_000


if __name__ == "__main__":
    page = nbformat.read(NOTEBOOK, as_version=4)
    os.chdir("/")  # where no study is
    run_notebook(page)
    nbformat.write(page, NOTEBOOK)
