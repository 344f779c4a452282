"""The schema of configurations, which editors and other programs read as it is committed.

`PYTHONPATH=src:tests python tests/study/test_schema.py` renews what scenes declare.
"""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import Field, fields
from typing import Any

import pytest
import yaml
from snakemake.utils import validate

from springblock.model.material import Material
from springblock.model.scene import FIELDS
from springblock.study.configuration import TIMES, completed
from studies import PAPER, ROOT, SCHEMA

FILE = ROOT / "workflow/schemas/config.schema.yaml"
#: Fields of scenes whose keys in a grid take more than lists of their values.
TOLD = {"n_s", "direction", "snapshot_times"}


class Plain(yaml.SafeDumper):
    """Writes equal parts in full, without anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def with_constants(schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return the schema with what the fields of `Scene` declare, as values and as lists."""
    one = {name: _value(each) for name, each in FIELDS.items()}
    many: dict[str, Any] = {
        name: {
            "description": f"value, or list of values: {value['description']}",
            "if": {"type": "array"},
            "then": {"minItems": 1, "uniqueItems": True, "items": value},
            "else": value,
        }
        for name, value in one.items()
    }
    material = [each.name for each in fields(Material)]
    whole = deepcopy(dict(schema))
    grid, axes = whole["$defs"]["grid"], whole["$defs"]["axes"]
    whole["properties"] |= {name: one[name] for name in TIMES}
    whole["properties"]["material"]["properties"] = {name: one[name] for name in material}
    axes["properties"] = {name: many.pop(name) for name in material}
    by_hand = {
        key: each for key, each in grid["properties"].items() if key not in many or key in TOLD
    }
    grid["properties"] = many | by_hand
    return whole


def _value(each: Field[Any]) -> dict[str, Any]:
    """Return the schema of one value of a field."""
    said, kind = each.metadata, dict[str, Any]({"type": "string", "minLength": 1})
    if each.type is int:
        kind = {"type": "integer", "minimum": 1}
    elif "may_vanish" in said:
        kind = {"type": "number", "minimum" if said["may_vanish"] else "exclusiveMinimum": 0}
    elif said.get("choices"):
        kind = {"enum": [*filter(None, said["choices"])]}
    return kind | {"description": f"{said['meaning']}; {said['unit']}"}


def test_the_committed_schema_has_what_scenes_declare():
    assert with_constants(SCHEMA) == SCHEMA


@pytest.mark.parametrize("name", ["config", "own"])
def test_a_validator_that_knows_nothing_else_takes_the_projects_configurations(name):
    configuration = PAPER | yaml.safe_load((ROOT / f"config/{name}.yaml").read_text())
    validate(completed(configuration), FILE, set_default=False)


if __name__ == "__main__":
    told = FILE.read_text().partition("$schema")[0]
    written = yaml.dump(
        with_constants(SCHEMA),
        Dumper=Plain,
        sort_keys=False,
        width=110,
        default_flow_style=None,
        allow_unicode=True,
    )
    FILE.write_text(told + written, encoding="utf-8")
