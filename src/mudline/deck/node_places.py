"""Where the values of a YAML or JSON text stand, by their paths."""

from __future__ import annotations

import yaml

from mudline.deck.model import Range
from mudline.deck.yaml_core import CoreLoader

Path = tuple[str | int, ...]


def places(text: str) -> dict[Path, Range]:
    """Lines and columns of every value of a document, JSON being YAML; {} when it is none."""
    try:
        root = yaml.compose(text, Loader=CoreLoader)
    except (yaml.YAMLError, RecursionError):
        return {}
    return {} if root is None else node_places(root)


def node_places(root: yaml.Node) -> dict[Path, Range]:
    """The same from a composed document; tables of rows are not entered."""
    found: dict[Path, Range] = {}
    stack: list[tuple[Path, yaml.Node]] = [((), root)]
    while stack:
        path, node = stack.pop()
        start, end = node.start_mark, node.end_mark
        found[path] = Range(start.line + 1, start.column + 1, end.line + 1, end.column + 1)
        if isinstance(node, yaml.MappingNode):
            stack += [((*path, key.value), value) for key, value in node.value if isinstance(key, yaml.ScalarNode)]
        elif isinstance(node, yaml.SequenceNode):
            stack += [((*path, index), value) for index, value in enumerate(node.value)]
    return found
