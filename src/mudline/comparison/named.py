"""What has a name or a number: nodes, elements, parameters, sets and curves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from mudline.comparison.model import (
    Difference,
    Kind,
    Side,
    Spans,
    Tolerance,
    Value,
    plain,
    spans_of,
    spans_of_run,
    text_of,
    union,
)
from mudline.deck.parameters import Definition, folded
from mudline.diagnostics import Where
from mudline.keywords.table import Table
from mudline.keywords.values import Label
from mudline.scene.force_curves import SceneCurve
from mudline.scene.numbering import MOST_GENERATED, Floats, Ids, Indices, Numbered
from mudline.scene.sets import NamedSet


def nodes(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Coordinates of the nodes."""
    yield from _numbered("nodes", (one, one.scene.nodes), (other, other.scene.nodes), tolerance)
    yield from _labelled("NODE", "nodes", "nodes", one, other)


def elements(one: Side, other: Side) -> Iterator[Difference]:
    """Nodes of the elements; numbers are names here, so no tolerance holds."""
    pair = (one, one.scene.table.numbered), (other, other.scene.table.numbered)
    yield from _numbered("elements", *pair, Tolerance())
    yield from _labelled("ELEMENT", "elements", "elements", one, other)


def common(one: Numbered, other: Numbered) -> tuple[Indices, Indices]:
    """Indices in each of the numbers that both have."""
    if np.array_equal(one.ids, other.ids):
        same = np.arange(len(one.ids), dtype=np.intp)
        return same, same
    at = other.indices(one.ids)
    here = np.flatnonzero(at >= 0)
    return here, at[here]


def _numbered(
    group: str, before: tuple[Side, Numbered], after: tuple[Side, Numbered], tolerance: Tolerance
) -> Iterator[Difference]:
    (one, first), (other, second) = before, after
    here, there = common(first, second)
    differing = np.flatnonzero(~tolerance.arrays(first.values[here], second.values[there]).all(axis=1))
    for i, j in zip(here[differing].tolist(), there[differing].tolist(), strict=True):
        values = _values(group, first.values[i]), _values(group, second.values[j])
        lines = one.line(first.where(i)), other.line(second.where(j))
        yield Difference("changed", group, f"{group}/{first.ids[i]}", *values, *lines)
    for i in np.flatnonzero(second.indices(first.ids) < 0).tolist():
        where, line = f"{group}/{first.ids[i]}", one.line(first.where(i))
        yield Difference("removed", group, where, _values(group, first.values[i]), None, line, None)
    for j in np.flatnonzero(first.indices(second.ids) < 0).tolist():
        where, line = f"{group}/{second.ids[j]}", other.line(second.where(j))
        yield Difference("added", group, where, None, _values(group, second.values[j]), None, line)


def _values(group: str, row: Floats) -> Value:
    """Coordinates of a node, or the whole numbers of an element's nodes."""
    values = [plain(value) for value in row.tolist()]
    return [int(value) if group == "elements" and isinstance(value, float) else value for value in values]


def _labelled(keyword: str, table: str, group: str, one: Side, other: Side) -> Iterator[Difference]:
    """Rows with a {label}, which have no place among the numbers."""
    first, second = _label_rows(one, keyword, table), _label_rows(other, keyword, table)
    for key in sorted(first.keys() - second.keys()):
        cells, where = first[key]
        yield Difference("removed", group, f"{group}/{cells[0]}", cells, None, one.line(where), None)
    for key in sorted(second.keys() - first.keys()):
        cells, where = second[key]
        yield Difference("added", group, f"{group}/{cells[0]}", None, cells, None, other.line(where))


def _label_rows(side: Side, keyword: str, name: str) -> dict[tuple[str, ...], tuple[list[Value], Where]]:
    found: dict[tuple[str, ...], tuple[list[Value], Where]] = {}
    for where, block in side.scene.deck.blocks(keyword):
        for index, entry in enumerate(block.entries):
            table = getattr(entry, name, None)
            if not isinstance(table, Table):
                continue
            rows = sorted({row for (row, _), word in table.words.items() if isinstance(word, Label)})
            for row in rows:
                numbers = enumerate(table.values[row, : table.lengths[row]].tolist())
                cells: list[Value] = [table.words.get((row, column)) or plain(number) for column, number in numbers]
                key = tuple(str(cell).casefold() for cell in cells)
                found[key] = (cells, where.inside("entries", index, name, row))
    return found


_KINDS = {False: "curves", True: "curves of sets"}


def parameters(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Values of the parameters."""
    first, second = one.parameters, other.parameters
    for name in dict.fromkeys([*first.values, *second.values]):
        old, new = first.values.get(name), second.values.get(name)
        if old is None or new is None or not tolerance.values(old, new):
            places = first.definitions.get(name), second.definitions.get(name)
            lines = one.line(_place(places[0])), other.line(_place(places[1]))
            yield Difference(_kind(old, new), "parameters", f"parameters/{name}", _plain(old), _plain(new), *lines)


def _kind(old: object, new: object) -> Kind:
    return "added" if old is None else "removed" if new is None else "changed"


def _place(thing: Definition | NamedSet | SceneCurve | None) -> Where | None:
    return None if thing is None else thing.where


def _plain(value: float | str | None) -> Value:
    return plain(value) if isinstance(value, float) else value


@dataclass(slots=True)
class _Members:
    """What a set holds: numbers, and words for what has none.

    The numbers are those of several arrays and of ranges (first, last, step). They become spans only where two sets do
    not hold the same arrays and ranges: most sets of two versions of a deck do.
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

    def same(self, other: _Members) -> bool:
        """Whether another set holds the same."""
        return self.words == other.words and (self._given_alike(other) or np.array_equal(self.spans, other.spans))

    def _given_alike(self, other: _Members) -> bool:
        """Whether the same arrays and ranges are given."""
        if self.ranges != other.ranges or len(self.arrays) != len(other.arrays):
            return False
        return all(np.array_equal(one, two) for one, two in zip(self.arrays, other.arrays, strict=True))


_NO_MEMBERS = _Members()


def sets(one: Side, other: Side) -> Iterator[Difference]:
    """Members of the element sets; ALL is what the elements are."""
    first, second = one.scene.set_table.named, other.scene.set_table.named
    written, others = _written(one), _written(other)
    for name in dict.fromkeys([*first, *second]):
        if name == "all":
            continue
        old, new = first.get(name), second.get(name)
        before = _members(one, old.elements) if old else None
        after = _members(other, new.elements) if new else None
        if old and new and (old.open or new.open or not (len(old.elements) and len(new.elements))):
            before, after = written.get(name, _NO_MEMBERS), others.get(name, _NO_MEMBERS)
        if before is None or after is None or not before.same(after):
            lines = one.line(_place(old)), other.line(_place(new))
            title = (old or new or NamedSet(name, np.zeros(0, dtype=np.intp), None)).name
            texts = _text(before), _text(after)
            yield Difference(_kind(old, new), "element sets", f"element sets/{title}", *texts, *lines)


def _text(members: _Members | None) -> str | None:
    return None if members is None else ", ".join(filter(None, [text_of(members.spans), *sorted(members.words)]))


def _members(side: Side, indices: Indices) -> _Members:
    return _Members([side.scene.element_ids[indices]])


def _written(side: Side) -> dict[str, _Members]:
    """What sets hold by their lines: for those with elements that the deck does not show."""
    found: dict[str, _Members] = {}
    for _, block in side.scene.deck.blocks("ELEMENT SETS"):
        for entry in block.sets:
            members = found.setdefault(folded(str(entry.name)), _Members())
            for member in entry.members:
                if subset := getattr(member, "subset", None):
                    members.words.add(f"SUBSET={folded(str(subset))}")
                if listed := getattr(member, "elements", None):
                    members.words |= {folded(item) for item in listed if isinstance(item, Label)}
                    whole = [item for item in listed if isinstance(item, int)]
                    members.arrays.append(np.array(whole, dtype=np.int64))
                if given := getattr(member, "generate", None):
                    members.ranges += _generated(given.start, given.end, given.increment)
    return found


def _generated(start: object, end: object, step: object) -> list[tuple[int, int, int]]:
    """The range of a GEN=; none where it is not one."""
    step = 1 if step is None else step
    if not (isinstance(start, int) and isinstance(end, int) and isinstance(step, int)) or step < 1:
        return []
    return [(start, min(end, start + MOST_GENERATED * step), step)]


def curves(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Points of the force-embedment curves; the later curve of a name holds."""
    first, second = _curves(one), _curves(other)
    for name in dict.fromkeys([*first, *second]):
        old, new = first.get(name), second.get(name)
        lines = one.line(_place(old)), other.line(_place(new))
        if old is None or new is None:
            before, after = (None if curve is None else _shown(_points(curve)) for curve in (old, new))
            yield Difference(_kind(old, new), "curves", _title(old or new), before, after, *lines)
            continue
        yield from _points_differ(_title(old), (one, old), (other, new), tolerance)


def _points_differ(
    name: str, before: tuple[Side, SceneCurve], after: tuple[Side, SceneCurve], tolerance: Tolerance
) -> Iterator[Difference]:
    (one, old), (other, new) = before, after
    first, second = _points(old), _points(new)
    if first.shape == second.shape:
        if tolerance.arrays(first, second).all():
            return
        if tolerance.arrays(first[:, 0], second[:, 0]).all():
            for i in np.flatnonzero(~tolerance.arrays(first[:, 1], second[:, 1])).tolist():
                ratio, force, forced = first[i, 0].item(), first[i, 1].item(), second[i, 1].item()
                lines = _point_line(one, old, first[i]), _point_line(other, new, second[i])
                yield Difference("changed", "curves", f"{name}/{ratio!r}", force, forced, *lines)
            return
    mine, theirs = set(map(tuple, first.tolist())), set(map(tuple, second.tolist()))
    for ratio, force in sorted(mine - theirs):
        line = _point_line(one, old, np.array([ratio, force]))
        yield Difference("removed", "curves", f"{name}/{ratio!r}", force, None, line, None)
    for ratio, force in sorted(theirs - mine):
        line = _point_line(other, new, np.array([ratio, force]))
        yield Difference("added", "curves", f"{name}/{ratio!r}", None, force, None, line)


def _title(curve: SceneCurve | None) -> str:
    return "" if curve is None else f"{_KINDS[curve.embedment]}/{curve.name}"


def _curves(side: Side) -> dict[str, SceneCurve]:
    return {f"{_KINDS[curve.embedment]}/{folded(curve.name)}": curve for curve in side.scene.laws.curves}


def _points(curve: SceneCurve) -> Floats:
    """The points in ascending order, each once."""
    return np.unique(curve.points, axis=0) if len(curve.points) else curve.points


def _shown(points: Floats) -> Value:
    return [[plain(value) for value in row] for row in points.tolist()]


def _point_line(side: Side, curve: SceneCurve, point: Floats) -> int | None:
    at = np.flatnonzero((curve.points == point).all(axis=1))
    return side.line(curve.point(int(at[0]))) if len(at) else side.line(curve.where)
