"""Differences of element sets, whose members are spans of numbers, and spans as texts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.limits import MOST_GENERATED
from mudline.editing.comparison.model import Difference, Pair, Side
from mudline.language.deck.parameters import folded
from mudline.language.keywords.library.mesh import SetGenerate, SetList, SetSubset
from mudline.language.keywords.values import Label

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


class Members(NamedTuple):
    """Members of a set: spans of their numbers, and names of members without a number."""

    spans: Spans
    words: frozenset[str] = frozenset()

    def __str__(self) -> str:
        return ", ".join(filter(None, [text_of(self.spans), *sorted(self.words)]))


_SetLine = SetList | SetGenerate | SetSubset


def set_differences(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of the members of element sets; ALL has all elements."""
    first, second = pair.before.scene.set_table.named, pair.after.scene.set_table.named
    written, others = _written(pair.before), _written(pair.after)
    for name in dict.fromkeys([*first, *second]):
        if name == "all":
            continue
        old, new = first.get(name), second.get(name)
        before = Members(spans_of(pair.before.scene.element_ids[old.elements])) if old else None
        after = Members(spans_of(pair.after.scene.element_ids[new.elements])) if new else None
        if old and new and (old.open or new.open or not (len(old.elements) and len(new.elements))):
            lines, other_lines = written.get(name, []), others.get(name, [])
            if lines == other_lines:  # may be ranges of very many numbers
                continue
            before, after = _members(lines), _members(other_lines)
        same = before and after and before.words == after.words and np.array_equal(before.spans, after.spans)
        if not same:
            title = old.name if old else new.name if new else name
            sides = (before, old), (after, new)
            held = ((str(members), group.where) if members and group else None for members, group in sides)
            yield pair.difference("element sets", f"element sets/{title}", *held)


def _written(side: Side) -> dict[str, list[_SetLine]]:
    """Return the lines of sets by name, for sets with elements that the deck does not define."""
    lines: dict[str, list[_SetLine]] = {}
    for _, block in side.scene.deck.blocks("ELEMENT SETS"):
        for entry in block.sets:
            lines.setdefault(folded(str(entry.name)), []).extend(entry.members)
    return lines


def _members(lines: Sequence[_SetLine]) -> Members:
    """Return the members of a set that its lines name; a GEN= that is invalid names none."""
    spans, words = list[Spans](), set[str]()
    for line in lines:
        match line:
            case SetSubset():
                words.add(f"SUBSET={folded(line.subset)}")
            case SetList():
                words |= {folded(item) for item in line.elements if isinstance(item, Label)}
                spans.append(spans_of(np.array([item for item in line.elements if isinstance(item, int)], np.int64)))
            case SetGenerate():
                start, end, step = line.generate.start, line.generate.end, line.generate.increment
                step = 1 if step is None else step
                if isinstance(start, int) and isinstance(end, int) and isinstance(step, int) and step >= 1:
                    spans.append(spans_of_run(start, min(end, start + MOST_GENERATED * step), step))
    return Members(union(spans), frozenset(words))
