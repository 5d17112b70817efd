"""Differences between two decks, tolerances, the two compared decks, and numbers as spans."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from mudline.language.codes.fields import SYN002, SYN006, SYN017
from mudline.language.codes.references import REF013, REF014
from mudline.language.deck.model import Origin
from mudline.language.deck.parameters import Parameters
from mudline.language.diagnostics import Blocks, DeckError, Where
from mudline.language.keywords.model import Block
from mudline.model.scene.model import Scene

Value: TypeAlias = float | int | str | list["Value"] | None
"""A value as reported; None for a missing value."""

Kind = Literal["added", "removed", "changed"]


@dataclass(frozen=True, slots=True)
class Difference:
    """One difference of two decks.

    Attributes:
        kind: "added", "removed" or "changed".
        group: group in a report.
        where: path with `/` between the steps.
        before: value in the first deck; None if missing.
        after: value in the second deck; None if missing.
        before_line: line in the first file, from 1; None for a value that is in no line of the file.
        after_line: line in the second file, likewise.
    """

    kind: Kind
    group: str
    where: str
    before: Value = None
    after: Value = None
    before_line: int | None = None
    after_line: int | None = None


@dataclass(frozen=True, slots=True)
class Allowance:
    """Allowed difference of two numbers relative to the larger number; NaN is equal to NaN."""

    relative: float = 0.0

    def arrays(self, first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return a mask of equal values of two arrays of one shape."""
        same: NDArray[np.bool_] = (first == second) | (np.isnan(first) & np.isnan(second))
        if self.relative:
            # Halves, because the difference of two large numbers may overflow; inf equals only itself.
            with np.errstate(invalid="ignore"):
                apart = np.abs(first / 2 - second / 2)
                near = apart <= self.relative * np.maximum(np.abs(first / 2), np.abs(second / 2))
            same |= near & np.isfinite(first) & np.isfinite(second)
        return same

    def values(self, first: object, second: object) -> bool:
        """Return True if two values are equal; texts compare without case."""
        if first == second:
            return True
        if isinstance(first, int | float) and isinstance(second, int | float):
            return bool(self.arrays(np.array([first], dtype=np.float64), np.array([second], dtype=np.float64))[0])
        if isinstance(first, list | tuple) and isinstance(second, list | tuple):
            return len(first) == len(second) and all(map(self.values, first, second))
        if isinstance(first, str) and isinstance(second, str):
            return first.casefold() == second.casefold()
        return False


def plain(value: float | str | None) -> Value:
    """Return a value as in JSON: None for NaN, a text for an infinite number."""
    if value is None or isinstance(value, str) or math.isfinite(value):
        return value
    return None if math.isnan(value) else str(value)


_NO_VALUE = (SYN002, SYN006, SYN017, REF013, REF014)


@dataclass
class Side:
    """A resolved deck, its parameters, and the lines of its file."""

    scene: Scene
    names: dict[str, str] = field(default_factory=dict)
    """Names as in the deck, by their casefolded form."""

    def path(self, path: str) -> str:
        """Return a path of casefolded names with the names as in the deck."""
        return "/".join(self.names.get(step, step) for step in path.split("/"))

    @cached_property
    def parameters(self) -> Parameters:
        """Evaluated parameters."""
        return Parameters(self.scene.deck)

    def comparable(self, block: Block, where: Where) -> Block:
        """Return a block; as written if one of its equations has no value, so that their texts are compared."""
        if (where.section, where.block) not in self._valueless:
            return block
        return cast("Block", self.scene.context.written.at(where))

    @cached_property
    def _valueless(self) -> set[tuple[int, int]]:
        """Section and block of equations with problems."""
        places = (problem.where for problem in self.scene.noticed if problem.code in _NO_VALUE)
        return {(where.section, where.block) for where in places if where is not None}

    def line(self, where: Where | None) -> int | None:
        """Return the line of a place; None for a place that is in no line of this file."""
        deck = self.scene.deck
        if type(deck.origin) is Origin or where is None or not 0 <= where.section < len(deck.own_sections):
            return None
        return deck.place(where).line

    def require(self) -> None:
        """Raise DeckError for parts that could not be read, and for equations without a value."""
        self.scene.deck.require()
        unknown = [
            problem
            for problem in self.scene.noticed
            if problem.code in _NO_VALUE and problem.blocking is not Blocks.NEVER
        ]
        if unknown:
            raise DeckError(self.scene.deck.diagnose(unknown))


_Held: TypeAlias = tuple[Value, Where | None] | None
"""A value in one of the decks and its place; None if the deck has no such value."""


@dataclass(frozen=True, slots=True)
class Pair:
    """The two decks that are compared."""

    before: Side
    after: Side
    tolerance: Allowance
    reported: set[tuple[Where | None, Where | None]] = field(default_factory=set)
    """Places of the records and blocks whose differences are reported by keyword; None for a deck without them."""

    def difference(self, group: str, where: str, before: _Held, after: _Held) -> Difference:
        """Return the difference of a value that only one of the decks has, or that differs between them."""
        kind: Kind = "added" if before is None else "removed" if after is None else "changed"
        (old, place), (new, other_place) = before or (None, None), after or (None, None)
        return Difference(kind, group, where, old, new, self.before.line(place), self.after.line(other_place))


# ------------------------------------------------------------------------------------------------- numbers as spans

Spans = NDArray[np.int64]
"""First and last numbers (k, 2) in ascending order, with gaps between the spans."""

NO_SPANS: Spans = np.zeros((0, 2), dtype=np.int64)
_WORTH_A_RANGE = 5
"""Least number of equally spaced single numbers that are written as a range with a step."""


def spans_of(numbers: NDArray[np.int64]) -> Spans:
    """Return the spans of numbers in any order."""
    return _joined(numbers, numbers)


def spans_of_run(start: int, end: int, step: int) -> Spans:
    """Return the spans of start, start + step, ... up to end; the step is at least 1."""
    if step == 1 and start <= end:
        return np.array([(start, end)], dtype=np.int64)
    numbers = np.arange(start, end + 1, step, dtype=np.int64)
    return np.column_stack([numbers, numbers])


def union(parts: Sequence[Spans]) -> Spans:
    """Return the spans of all numbers in any of several spans."""
    firsts, lasts = np.concatenate([NO_SPANS, *parts]).T
    return _joined(firsts, lasts)


def text_of(spans: Spans) -> str:
    """Return spans as a text: `1-20, 25, 31-99 step 2`."""
    return ", ".join(_pieces(spans))


def _joined(firsts: NDArray[np.int64], lasts: NDArray[np.int64]) -> Spans:
    """Return spans with gaps between them, from spans that may overlap or touch."""
    if not len(firsts):
        return NO_SPANS
    order = np.argsort(firsts, kind="stable")
    firsts, reached = firsts[order], np.maximum.accumulate(lasts[order])
    begins = np.flatnonzero(firsts[1:] - reached[:-1] > 1) + 1
    ends = np.append(begins - 1, len(firsts) - 1)
    return np.column_stack([firsts[np.append(0, begins)], reached[ends]])


def _pieces(spans: Spans) -> Iterator[str]:
    """Yield pieces of the text: spans, and runs of equally spaced single numbers."""
    written = 0
    for begin, end in _stepped(spans):
        first = max(begin, written)
        if end - first + 1 >= _WORTH_A_RANGE:
            yield from _listed(spans[written:first])
            start, following = int(spans[first, 0]), int(spans[first + 1, 0])
            yield f"{start}-{int(spans[end, 0])} step {following - start}"
            written = end + 1
    yield from _listed(spans[written:])


def _stepped(spans: Spans) -> Iterator[tuple[int, int]]:
    """Yield first and last index of equally spaced single numbers; neighbouring runs may share a number."""
    single = spans[:, 0] == spans[:, 1]
    steps = np.where(single[1:] & single[:-1], spans[1:, 0] - spans[:-1, 0], 0)  # 0 next to several numbers
    begins = np.append(0, np.flatnonzero(steps[1:] != steps[:-1]) + 1)
    ends = np.append(begins[1:], len(steps))
    for at in np.flatnonzero(ends - begins >= _WORTH_A_RANGE - 2).tolist():
        if steps[begins[at]]:
            yield int(begins[at]), int(ends[at])


def _listed(spans: Spans) -> Iterator[str]:
    return (str(first) if first == last else f"{first}-{last}" for first, last in spans.tolist())
