"""Check of a configuration file as it is written, before YAML drops or converts parts of it."""

import re
from pathlib import Path

import yaml

from springblock.model.numbers import check_once

#: PyYAML's reader in C is ten times as fast, where it is installed.
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
#: A decimal number. Others of YAML are easily meant as something else: 010 is 8, and 1:30 is 90.
NUMBER = re.compile(r"[-+]?(?!0[0-9])([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
#: What values may be, by the ends of YAML's tags.
_KINDS = ("str", "int", "float", "bool", "null", "seq", "map")
_MOST = 10**5  #: largest number of values, with those that aliases repeat


def check_file(file: Path) -> None:
    """Refuse repeated keys, numbers and dates of YAML's own, and aliases without end."""
    try:
        with file.open(encoding="utf-8") as text:
            left = [("", yaml.compose(text, LOADER))]
        for _ in range(_MOST):
            if not left:
                return
            left += _parts(*left.pop())
    except (ValueError, yaml.YAMLError) as error:
        raise ValueError(f"{file}: {' '.join(str(error).split())}") from None
    key = left[-1][0].partition(".")[0]
    raise ValueError(
        f"{file}: {key} has more than {_MOST} values; no alias may repeat its own part"
    )


def _parts(key: str, node: yaml.Node) -> list[tuple[str, yaml.Node]]:
    """Check a value, and return the values in it, each with its key."""
    kind = node.tag.rpartition(":")[2]
    if kind not in _KINDS or (kind in ("int", "float") and not NUMBER.fullmatch(node.value)):
        text = node.value if isinstance(node, yaml.ScalarNode) else "a collection"
        meant = yaml.load(text, LOADER) if kind in ("int", "float") else f"a {kind}"
        raise ValueError(
            f"{key} is {text}, which YAML takes for {meant}; write a decimal number, or put a text "
            "in quotes"
        )
    if isinstance(node, yaml.ScalarNode):
        return []
    if isinstance(node, yaml.SequenceNode):
        return [(key, part) for part in node.value]
    check_once(key or "the configuration", (str(name.value) for name, _ in node.value))
    return [(f"{key}.{name.value}".removeprefix("."), part) for name, part in node.value]
