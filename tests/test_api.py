"""What is public stays: names, signatures, options, columns and keys, as tests/api records them.

`python tests/test_api.py` renews the records. Whatever they lose or change is a new major version
(https://semver.org), what they gain a minor one, and `CHANGELOG.md` says so.
"""

import inspect
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import click
import pytest
import yaml

import springblock
from springblock.cli import COMMANDS, main
from springblock.io.records import Record
from springblock.model.material import Material
from springblock.report.dictionary import tables

ROOT = Path(__file__).parents[1]
RECORDS = ROOT / "tests/api"
SCHEMA = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
#: What runs are read back as has no name of its own in the package, but is what users hold.
CLASSES = {"Record": Record}


def signature(function: Any) -> str:
    """Names, order and defaults of arguments; the paper's material is a default with many words."""
    whole = inspect.signature(function)
    plain = [each.replace(annotation=each.empty) for each in whole.parameters.values()]
    plain = [each for each in plain if each.name != "self"]
    text = str(whole.replace(parameters=plain, return_annotation=whole.empty))
    return text.replace(repr(Material()), "Material()")


def members(cls: type) -> Iterator[str]:
    """Fields, properties and methods of a class and of what it inherits from, by name."""
    own = {each.name for each in fields(cls)} if is_dataclass(cls) else set()
    for name in sorted(own | set(dir(cls))):
        if name.startswith("_") or hasattr(Exception, name):
            continue
        member = getattr(cls, name, None)
        called = inspect.isfunction(member) or inspect.ismethod(member)
        yield name + (signature(member) if called else "")


def python() -> Iterator[str]:
    """What `from springblock import ...` gives, and what can be asked of it."""
    for name in sorted([*springblock.__all__, *CLASSES]):
        thing = CLASSES.get(name) or getattr(springblock, name)
        raised = inspect.isclass(thing) and issubclass(thing, Exception)
        yield name + ("" if raised else signature(thing))
        if inspect.isclass(thing):
            yield from (f"    .{member}" for member in members(thing))


def commands() -> Iterator[str]:
    """Every command, with what its arguments and options take."""
    context = click.Context(main)
    for name in COMMANDS:
        yield name
        for parameter in main.get_command(context, name).params:
            yield f"    {' '.join(parameter.opts)}: {taken(parameter)}"


def taken(parameter: click.Parameter) -> str:
    """Type of an option, whether it must be there or may be there again, and its default."""
    kind = parameter.type
    choices = "|".join(map(str, kind.choices)) if isinstance(kind, click.Choice) else kind.name
    words = [choices, *(["required"] if parameter.required else [])]
    words += ["multiple"] if parameter.nargs == -1 or getattr(parameter, "multiple", False) else []
    default = parameter.to_info_dict().get("default")
    said = isinstance(default, str | int | float) and not callable(default)
    return ", ".join(words + ([f"{default} if unsaid"] if said else []))


def columns() -> Iterator[str]:
    """Every table, with type and unit of its columns."""
    for table in tables():
        yield table.where
        for column in table.schema:
            unit = (column.metadata or {}).get(b"unit", b"").decode()
            kind = str(column.type).replace("element: ", "")
            yield f"    {column.name}: {kind}" + (f", {unit}" if unit else "")


def configuration() -> Iterator[str]:
    """Every key of a configuration, with the kind of value that it takes."""
    for key, value in SCHEMA["properties"].items():
        yield f"{key}: {taken_by(value)}"
        yield from keys(value, f"{key}.")
    yield "each grid of a group of scenes"
    yield from keys(SCHEMA["$defs"]["grid"], "    ")


def keys(schema: Any, before: str) -> Iterator[str]:
    """Keys below a key."""
    nested = schema.get("properties", {})
    if isinstance(schema.get("additionalProperties"), dict):
        nested = nested | {"NAME": schema["additionalProperties"]}
    for key, value in nested.items():
        yield f"{before}{key}: {taken_by(value)}"
        yield from keys(value, f"{before}{key}.")


def taken_by(value: Any) -> str:
    """Type of a key's value, a name of the schema's own for it, or the words that it may be."""
    if "$ref" in value:
        return str(value["$ref"]).rpartition("/")[2]
    if "enum" in value:
        return " | ".join(map(str, value["enum"]))
    kind = value.get("type", "any")
    return " | ".join(kind) if isinstance(kind, list) else str(kind)


PARTS = {
    "python": python,
    "commands": commands,
    "tables": columns,
    "configuration": configuration,
}


@pytest.mark.parametrize("part", PARTS)
def test_what_is_public_is_as_recorded(part):
    """Lines that are missing or other break what others have written; new ones are recorded."""
    recorded = (RECORDS / f"{part}.txt").read_text(encoding="utf-8").splitlines()
    found = list(PARTS[part]())
    assert found == recorded, f"{part} has changed: `python tests/test_api.py` records it"


def test_a_changed_signature_is_seen(monkeypatch):
    """An argument that is no longer there, a default that is another one, a lost property."""
    before = list(python())
    monkeypatch.setattr(springblock, "draw_friction", lambda n_blocks, seed=1: None)
    monkeypatch.delattr(springblock.Realisation, "t_first")
    lost = set(before) - set(python())
    assert lost == {"draw_friction(n_blocks, seed, material=None, periodic=False)", "    .t_first"}


if __name__ == "__main__":
    for part, lines in PARTS.items():
        text = "".join(f"{line}\n" for line in lines())
        (RECORDS / f"{part}.txt").write_text(text, encoding="utf-8")
