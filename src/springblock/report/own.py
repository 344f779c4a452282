"""What the report on a study of one's own scenes begins with: means and changes."""

from typing import Any

from springblock.analysis.ensembles import Ensemble, constants, ensembles
from springblock.model.material import Material
from springblock.report.findings import Tables
from springblock.report.means import UNITS, changes_over_ends, in_words, means


def content(tables: Tables) -> dict[str, Any]:
    """Return the means and changes of ensembles, and what all of them share."""
    members = ensembles(tables["realisations"])
    changes = changes_over_ends(members, ["static_friction"])
    return {
        "means": _spaced(*in_words(means(members, ["static_friction", "t_max", "t_avg"]))),
        "changes": _spaced(*in_words(changes)) if changes else (),
        "common": _common(members),
    }


def _spaced(head: list[str], cells: list[list[str]]) -> tuple[list[str], list[list[str]]]:
    """Return a table with the observable that is no symbol as two words."""
    return [name.replace("static_friction", "static friction") for name in head], cells


def _common(members: list[Ensemble]) -> list[str]:
    """Name the parameters that all ensembles share and that are not the paper's."""
    paper = dict(Material().items())
    shared = {name: value for name, value in constants(members).items() if value}
    return [
        f"{name} = {value} {UNITS.get(name, '')}".strip()
        for name, value in shared.items()
        if value != paper.get(name)
    ]
