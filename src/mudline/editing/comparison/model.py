"""Differences between two decks, tolerances, the two decks that are compared, and spans of whole numbers."""

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
from mudline.language.diagnostics import Blocks, DeckError, Problem, Where
from mudline.language.keywords.model import Block
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Ids

Value: TypeAlias = float | int | str | list["Value"] | None
"""A value as it is reported; None where there is none."""

Kind = Literal["added", "removed", "changed"]


@dataclass(frozen=True, slots=True)
class Difference:
    """One difference: its group, and its path with `/` between the steps.

    `before` and `after` are the values in the first and the second deck, None where there is none; lines are counted
    from 1, None for what is not in a line of that file.
    """

    kind: Kind
    group: str
    where: str
    before: Value = None
    after: Value = None
    before_line: int | None = None
    after_line: int | None = None


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Allowed difference of two numbers over the larger one; NaN is equal to NaN."""

    relative: float = 0.0

    def arrays(self, one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Where two arrays of one shape are equal."""
        same: NDArray[np.bool_] = (one == other) | (np.isnan(one) & np.isnan(other))
        if self.relative:
            # Halves, because the difference of two large numbers may overflow; inf differs from everything else.
            with np.errstate(invalid="ignore"):
                apart = np.abs(one / 2 - other / 2)
                near = apart <= self.relative * np.maximum(np.abs(one / 2), np.abs(other / 2))
            same |= near & np.isfinite(one) & np.isfinite(other)
        return same

    def values(self, one: object, other: object) -> bool:
        """Whether two values are equal; texts compare without case."""
        if _is_number(one) and _is_number(other):
            return bool(self.arrays(np.array([one], dtype=np.float64), np.array([other], dtype=np.float64))[0])
        if isinstance(one, list | tuple) and isinstance(other, list | tuple):
            return len(one) == len(other) and all(map(self.values, one, other))
        if isinstance(one, str) and isinstance(other, str):
            return one.casefold() == other.casefold()
        return one == other


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)


def plain(value: float | str | None) -> Value:
    """A value as in JSON: None for NaN, a text for an infinite number."""
    if value is None or isinstance(value, str) or math.isfinite(value):
        return value
    return None if math.isnan(value) else str(value)


Spans = NDArray[np.int64]
"""First and last numbers (k, 2) in ascending order, with a gap between one span and the next."""

NO_SPANS: Spans = np.zeros((0, 2), dtype=np.int64)
_WORTH_A_RANGE = 5
"""Single numbers with one step between them from which on they are written as a range with that step."""
_AT_ONCE = 100_000


def spans_of(numbers: NDArray[np.int64]) -> Spans:
    """The spans of numbers in any order."""
    return _joined(numbers, numbers)


def spans_of_run(start: int, end: int, step: int) -> Spans:
    """The spans of start, start + step, ... up to end; the step is at least 1."""
    if step == 1:
        return np.array([(start, end)] * (start <= end), dtype=np.int64).reshape(-1, 2)
    numbers = np.arange(start, end + 1, step, dtype=np.int64)
    return np.broadcast_to(numbers[:, np.newaxis], (len(numbers), 2))


def union(parts: Sequence[Spans]) -> Spans:
    """The spans of all numbers in any of several."""
    parts = [part for part in parts if len(part)]
    if len(parts) == 1:
        return parts[0]
    return _joined(*(np.concatenate([NO_SPANS[:, end], *(part[:, end] for part in parts)]) for end in (0, 1)))


def text_of(spans: Spans) -> str:
    """Spans as a text: `1-20, 25, 31-99 step 2`."""
    return ", ".join(_pieces(spans))


def _joined(firsts: NDArray[np.int64], lasts: NDArray[np.int64]) -> Spans:
    """Spans that may overlap or touch as ones with gaps between them."""
    if not len(firsts):
        return NO_SPANS
    if not (firsts[1:] >= firsts[:-1]).all():
        alone = firsts is lasts
        order = np.argsort(firsts, kind="stable")
        firsts = firsts[order]
        lasts = firsts if alone else lasts[order]
    if firsts is lasts and (firsts[1:] - firsts[:-1] > 1).all():  # none is next to another: the numbers are the spans
        return np.broadcast_to(firsts[:, np.newaxis], (len(firsts), 2))
    reached = np.maximum.accumulate(lasts)
    begins = np.flatnonzero(firsts[1:] - reached[:-1] > 1) + 1
    ends = np.append(begins - 1, len(firsts) - 1)
    return np.column_stack([firsts[np.append(0, begins)], reached[ends]])


def _pieces(spans: Spans) -> Iterator[str]:
    """Pieces of the text; listed spans are joined in large pieces, which takes less memory than a text for each."""
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
    """First and last index of single numbers with one step between them; neighbours may share a number."""
    count = len(spans) - 1
    begins = [np.zeros(1, dtype=np.intp)]
    for start in range(0, count, _AT_ONCE):
        steps = _steps(spans[max(start - 1, 0) : start + _AT_ONCE + 1])
        begins.append(np.flatnonzero(steps[1:] != steps[:-1]) + max(start, 1))
    bounds = np.append(np.concatenate(begins), count)
    for at in np.flatnonzero(np.diff(bounds) >= _WORTH_A_RANGE - 2).tolist():
        begin, end = int(bounds[at]), int(bounds[at + 1])
        if _steps(spans[begin : begin + 2])[0]:
            yield begin, end


def _steps(spans: Spans) -> NDArray[np.int64]:
    """From each span to the next, 0 beside one of several numbers."""
    single = spans[:, 0] == spans[:, 1]
    return np.where(single[1:] & single[:-1], spans[1:, 0] - spans[:-1, 0], 0)


def _listed(spans: Spans) -> Iterator[str]:
    for start in range(0, len(spans), _AT_ONCE):
        some = spans[start : start + _AT_ONCE].tolist()
        yield ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in some)


@dataclass(slots=True)
class Members:
    """Members of a set: numbers, and names for members without one.

    The numbers are those of several arrays and of ranges (first, last, step). They become spans only where two sets do
    not have the same arrays and ranges: most sets of two versions of a deck do.
    """

    arrays: list[Ids] = field(default_factory=list)
    ranges: list[tuple[int, int, int]] = field(default_factory=list)
    words: set[str] = field(default_factory=set)
    _spans: Spans | None = None

    @property
    def spans(self) -> Spans:
        """The numbers."""
        if self._spans is None:
            self._spans = union([*map(spans_of, self.arrays), *(spans_of_run(*given) for given in self.ranges)])
        return self._spans

    def same(self, other: Members) -> bool:
        """Whether another set has the same members."""
        return self.words == other.words and (self._given_alike(other) or np.array_equal(self.spans, other.spans))

    def _given_alike(self, other: Members) -> bool:
        """Whether the same arrays and ranges are given."""
        if self.ranges != other.ranges or len(self.arrays) != len(other.arrays):
            return False
        return all(np.array_equal(one, two) for one, two in zip(self.arrays, other.arrays, strict=True))


_NO_VALUE = (SYN002, SYN006, SYN017, REF013, REF014)


@dataclass
class Side:
    """A resolved deck, its parameters, and the lines of its file."""

    scene: Scene
    names: dict[str, str] = field(default_factory=dict)
    """Names as in the deck, by their folded form."""

    def path(self, path: str) -> str:
        """A path of folded names with the names as in the deck."""
        return "/".join(self.names.get(step, step) for step in path.split("/"))

    @cached_property
    def parameters(self) -> Parameters:
        """The parameters, evaluated."""
        return Parameters(self.scene.deck)

    def comparable(self, block: Block, where: Where) -> Block:
        """A block, or that block as written where one of its equations has no value: then their texts are compared."""
        if (where.section, where.block) not in self._valueless:
            return block
        return cast("Block", self.scene.context.as_written(where))

    @cached_property
    def _valueless(self) -> set[tuple[int, int]]:
        """Section and block of the problems of equations."""
        places = (problem.where for problem in self.scene.noticed if problem.code in _NO_VALUE)
        return {(where.section, where.block) for where in places if where is not None}

    def line(self, where: Where | None) -> int | None:
        """The line of a place; None for what is not in a line of this file."""
        deck = self.scene.deck
        if type(deck.origin) is Origin or where is None or not 0 <= where.section < len(deck.own_sections):
            return None
        return deck.origin.place(Problem(SYN002, "", where=where)).line

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
"""A value in one of the decks and its place; None where that deck has none."""


@dataclass(frozen=True, slots=True)
class Pair:
    """The two decks that are compared."""

    one: Side
    other: Side
    tolerance: Tolerance
    said: set[tuple[Where | None, Where | None]] = field(default_factory=set)
    """Places of the records and blocks whose differences are reported by keyword; None where a deck has none."""

    def difference(self, group: str, where: str, before: _Held, after: _Held) -> Difference:
        """The difference of a value that only one of the decks has, or that is another one in the second."""
        kind: Kind = "added" if before is None else "removed" if after is None else "changed"
        (old, place), (new, other_place) = before or (None, None), after or (None, None)
        return Difference(kind, group, where, old, new, self.one.line(place), self.other.line(other_place))
