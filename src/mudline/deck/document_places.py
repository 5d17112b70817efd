"""Where the values of a JSON or YAML document stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from mudline.deck.model import START, Origin, Range
from mudline.diagnostics import Problem

DocumentPath = tuple[str | int, ...]
Wanted = dict[str | int, "Wanted"]
"""Paths as a tree: by key or index, what is wanted below it."""


class Places(Protocol):
    """Finds values in the text of a document."""

    def ranges(self, wanted: Wanted) -> Mapping[DocumentPath, Range]:
        """The places of the values on the wanted paths, as far as there are such values."""


def locate(places: Places, paths: Sequence[DocumentPath]) -> list[Range]:
    """The place of each path: of its value, or of the nearest thing around it."""
    wanted: Wanted = {}
    for path in paths:
        inner = wanted
        for part in path:
            inner = inner.setdefault(part, {})
    found = places.ranges(wanted)
    return [next((found[path[:n]] for n in range(len(path), -1, -1) if path[:n] in found), START) for path in paths]


@dataclass
class DocumentOrigin(Origin):
    """A deck that was read from a document, which is whole or refused."""

    text: Places

    def place(self, problem: Problem, /) -> Range:
        """Lines and columns of a problem."""
        return self.places([problem])[0]

    def places(self, problems: Sequence[Problem]) -> list[Range]:
        """Lines and columns of several problems, found in one pass."""
        return locate(self.text, [_path(problem) for problem in problems])


def _path(problem: Problem) -> DocumentPath:
    """The path of a place among the values, in the document; the whole document where there is none."""
    if problem.where is None or problem.where.section < 0:
        return ()
    section, block, path = problem.where
    return ("sections", section, *(("blocks", block, *path) if block >= 0 else path))
