"""Where the values of a YAML or JSON text stand, by their paths."""

from __future__ import annotations

import re

import yaml

from mudline.deck.model import Range
from mudline.deck.yaml_core import CoreLoader

Path = tuple[str | int, ...]
DEEPEST = 100
"""The most levels of a document; the library that composes it crashes the process at some ten thousand."""
_BRACKET = re.compile(r"[\[\]{}]")
_INDENT = re.compile(r"^[ ?-]*+", re.MULTILINE)


def too_deep(text: str) -> bool:
    """Whether a text may be nested deeper than a deck can be: by its brackets, or by dashes and indentation."""
    depth = deepest = 0
    for mark in _BRACKET.findall(text):
        depth = depth + 1 if mark in "[{" else max(depth - 1, 0)
        deepest = max(deepest, depth)
    return deepest > DEEPEST or max(len(found) for found in _INDENT.findall(text)) > 2 * DEEPEST


def within(text: str, mark: yaml.Mark) -> tuple[int, int]:
    """Line and column of a mark; one behind the last line stands at its end."""
    lines = text.count("\n") + 1
    if mark.line < lines:
        return mark.line + 1, mark.column + 1
    return lines, len(text) - text.rfind("\n")


def places(text: str) -> dict[Path, Range]:
    """Lines and columns of every value of a document, JSON being YAML; {} when it is none."""
    try:
        root = yaml.compose(text, Loader=CoreLoader)
    except (yaml.YAMLError, RecursionError):
        return {}
    return {} if root is None else node_places(root, text)


def node_places(root: yaml.Node, text: str) -> dict[Path, Range]:
    """The same from a composed document; tables of rows are not entered."""
    found: dict[Path, Range] = {}
    stack: list[tuple[Path, yaml.Node]] = [((), root)]
    while stack:
        path, node = stack.pop()
        found[path] = Range(*within(text, node.start_mark), *within(text, node.end_mark))
        if isinstance(node, yaml.MappingNode):
            stack += [((*path, key.value), value) for key, value in node.value if isinstance(key, yaml.ScalarNode)]
        elif isinstance(node, yaml.SequenceNode):
            stack += [((*path, index), value) for index, value in enumerate(node.value)]
    return found
