"""Where the values of a YAML or JSON text stand, by their paths."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Protocol

import yaml

from mudline.deck.document import DocumentPath, Locate
from mudline.deck.model import START, Range
from mudline.deck.yaml_core import CoreLoader


class Mark(Protocol):
    """A place that the parser tells, whether its C library or its Python one; both count from 0."""

    line: int
    column: int


def mark_range(text: str, mark: Mark | None) -> Range:
    """Line and column of a mark; one behind the last line stands at its end, none at the start of the text."""
    if mark is None:
        return START
    lines, width = text.count("\n") + 1, len(text) - text.rfind("\n")
    return _range(mark, mark, lines, width)


def _range(start: Mark, end: Mark, lines: int, width: int) -> Range:
    places = [(mark.line + 1, mark.column + 1) if mark.line < lines else (lines, width) for mark in (start, end)]
    return Range(*places[0], *places[1])


def locator(text: str, compose: Callable[[], yaml.Node | None]) -> Locate:
    """A function that finds the place of a path, or of the nearest thing around it; it looks when first asked."""

    @cache
    def found() -> dict[DocumentPath, Range]:
        root = compose()
        return {} if root is None else _places(root, text)

    def locate(path: DocumentPath) -> Range:
        known = found()
        return next((known[path[:n]] for n in range(len(path), -1, -1) if path[:n] in known), START)

    return locate


def compose_json(text: str) -> yaml.Node | None:
    """The nodes of a JSON text, JSON being YAML; None where the YAML parser does not take it."""
    try:
        return yaml.compose(text, Loader=CoreLoader)
    except (yaml.YAMLError, RecursionError):
        return None


def _places(root: yaml.Node, text: str) -> dict[DocumentPath, Range]:
    lines, width = text.count("\n") + 1, len(text) - text.rfind("\n")
    found: dict[DocumentPath, Range] = {}
    stack: list[tuple[DocumentPath, yaml.Node]] = [((), root)]
    while stack:
        path, node = stack.pop()
        found[path] = _range(node.start_mark, node.end_mark, lines, width)
        if isinstance(node, yaml.MappingNode):
            stack += [((*path, key.value), value) for key, value in node.value if isinstance(key, yaml.ScalarNode)]
        elif isinstance(node, yaml.SequenceNode):
            stack += [((*path, index), value) for index, value in enumerate(node.value)]
    return found
