"""Check of a configuration file as it is written, before YAML drops or converts parts of it."""

import re
from collections import Counter
from pathlib import Path

import yaml

#: PyYAML's reader in C is ten times as fast, where it is installed.
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
#: A decimal number. Others of YAML are easily meant as something else: 010 is 8, and 1:30 is 90.
NUMBER = re.compile(r"[-+]?(?!0[0-9])([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
#: What values may be, by the ends of YAML's tags; keys may also be merge keys, <<.
_KINDS = ("str", "int", "float", "bool", "null", "merge", "seq", "map")
_MOST = 10**6  #: largest number of values, with those that aliases repeat


def check_file(file: Path) -> None:
    """Refuse repeated keys, numbers and dates of YAML's own, and aliases without end."""
    try:
        with file.open(encoding="utf-8") as text:
            _size(yaml.compose(text, LOADER), "it", {})
    except (ValueError, yaml.YAMLError) as error:
        raise ValueError(f"{file}: {' '.join(str(error).split())}") from None


def _size(node: yaml.Node, key: str, sizes: dict[int, int]) -> int:
    """Check a node, and return the number of its values; `sizes` has those of earlier nodes."""
    kind = node.tag.rpartition(":")[2]
    if kind not in _KINDS or (kind in ("int", "float") and not NUMBER.fullmatch(node.value)):
        text = node.value if isinstance(node, yaml.ScalarNode) else "a collection"
        meant = yaml.load(text, LOADER) if kind in ("int", "float") else f"a {kind}"
        raise ValueError(
            f"{key} is {text}, which YAML takes for {meant}; write a decimal number, or put a text "
            "in quotes"
        )
    if isinstance(node, yaml.ScalarNode):
        return 1
    if id(node) not in sizes:
        sizes[id(node)] = 0  # until it is known
        sizes[id(node)] = 1 + sum(_size(part, name, sizes) for name, part in _parts(node, key))
    if not 0 < sizes[id(node)] <= _MOST:
        raise ValueError(f"{key} contains itself, or has more than {_MOST} values with its aliases")
    return sizes[id(node)]


def _parts(node: yaml.CollectionNode, key: str) -> list[tuple[str, yaml.Node]]:
    """Return the values of a node with their keys, each key once."""
    if isinstance(node, yaml.SequenceNode):
        return [(f"{key}.{i}", part) for i, part in enumerate(node.value)]
    names = [str(name.value) for name, _ in node.value]
    (name, times), *_ = Counter(names).most_common(1) or [("", 0)]
    if times > 1:
        raise ValueError(f"{key} has the key {name!r} twice; remove one, or rename it")
    return [
        (f"{key}.{name}".removeprefix("it."), part)
        for name, (_, part) in zip(names, node.value, strict=True)
    ]
