"""Where the values of a YAML text stand, by their paths."""

from __future__ import annotations

from typing import Protocol, cast

import yaml

from mudline.deck.faults import DocumentPath, Locate
from mudline.deck.model import START, Range


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


def locator(text: str, root: yaml.Node | None) -> Locate:
    """A function that finds the place of a path, or of the nearest thing around it."""
    lines, width = text.count("\n") + 1, len(text) - text.rfind("\n")
    known: dict[int, dict[str, yaml.Node]] = {}

    def inner(node: yaml.Node, part: str | int) -> yaml.Node | None:
        if isinstance(node, yaml.MappingNode) and isinstance(part, str):
            if id(node) not in known:
                known[id(node)] = {key.value: value for key, value in node.value if isinstance(key, yaml.ScalarNode)}
            return known[id(node)].get(part)
        if isinstance(node, yaml.SequenceNode) and isinstance(part, int) and part < len(node.value):
            return cast("yaml.Node", node.value[part])
        return None

    def locate(path: DocumentPath) -> Range:
        node = root
        if node is None:
            return START
        for part in path:
            below = inner(node, part)
            if below is None:
                if isinstance(node, yaml.ScalarNode) and node.style == "|" and isinstance(part, int):
                    return _row(node, part)
                break
            node = below
        return _range(node.start_mark, node.end_mark, lines, width)

    return locate


def _row(block: yaml.ScalarNode, row: int) -> Range:
    """The line of a row of a table that is a block of text; blank lines are no rows."""
    lines = block.value.split("\n")
    written = [number for number, line in enumerate(lines) if line.strip()]
    number = block.start_mark.line + 2 + (written[row] if row < len(written) else 0)
    return Range(number, 1, number, 1)
