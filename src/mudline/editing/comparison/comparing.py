"""Differences of two decks: values by name or number, and laws and sections element by element."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from mudline.basics.limits import MOST_GENERATED
from mudline.editing.comparison.blocks import blocks, record_values
from mudline.editing.comparison.model import (
    Allowance,
    Difference,
    Pair,
    Side,
    Spans,
    Value,
    plain,
    spans_of,
    spans_of_run,
    text_of,
    union,
)
from mudline.language.deck.parameters import Definition, folded, name_key
from mudline.language.diagnostics import Where
from mudline.language.keywords.library.mesh import SetGenerate, SetList, SetSubset
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Label
from mudline.model.contact.input import LawKind
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.laws import ResistanceValues, SetLaw
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Numbered
from mudline.model.scene.seabed import SeabedShape


def compare(before: Scene, after: Scene, tolerance: float = 0.0) -> list[Difference]:
    """Return the semantic differences of two decks; an empty list if both mean the same.

    `tolerance` is the allowed difference of two numbers relative to the larger number. Raises DeckError for a deck with
    parts that could not be read, or with an equation without a value.
    """
    pair = Pair(Side(before), Side(after), Allowance(tolerance))
    pair.before.require()
    pair.after.require()
    of_keywords = list(blocks(pair))  # first, so that differences of elements do not repeat them
    of_files = partial(seabed_points, of_files=True)
    groups = (_units, _parameters, _nodes, _elements, _sets, _curves, _by_element, of_files)
    return [*(difference for differences in groups for difference in differences(pair)), *of_keywords]


def _units(pair: Pair) -> Iterator[Difference]:
    old, new = pair.before.scene.units, pair.after.scene.units
    if old != new:
        yield Difference("changed", "units", "units", old, new)


def seabed_points(pair: Pair, *, of_files: bool = False) -> Iterator[Difference]:
    """Yield the difference of the points of a profile or a surface; their order does not count.

    With `of_files` points in the decks are left out, as they are compared with their blocks.
    """
    old, new = pair.before.scene.seabed, pair.after.scene.seabed
    if of_files and not (old.file or new.file):
        return
    same = old.points.shape == new.points.shape and bool(pair.tolerance.arrays(_sorted(old), _sorted(new)).all())
    if not same:
        held = ((f"{len(floor.points)} points", floor.where) for floor in (old, new))
        yield pair.difference("seabed", "seabed/points", *held)


def _sorted(floor: SeabedShape) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return floor.points[np.lexsort(floor.points.T[::-1])] if len(floor.points) else floor.points


# ------------------------------------------------------------------------------------------ by name or by number


def _nodes(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of node coordinates."""
    yield from _numbered("nodes", pair.before.scene.nodes, pair.after.scene.nodes, pair)
    yield from _labelled("NODE", "nodes", pair)


def _elements(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of element nodes; numbers are names here, so the tolerance does not apply."""
    tables = pair.before.scene.table.numbered, pair.after.scene.table.numbered
    yield from _numbered("elements", *tables, replace(pair, tolerance=Allowance()))
    yield from _labelled("ELEMENT", "elements", pair)


def _common(first: Numbered, second: Numbered) -> tuple[Indices, Indices]:
    """Return the indices in each table of the numbers that both have."""
    at = second.indices(first.ids)
    here = np.flatnonzero(at >= 0)
    return here, at[here]


def _numbered(group: str, first: Numbered, second: Numbered, pair: Pair) -> Iterator[Difference]:
    here, there = _common(first, second)
    differing = np.flatnonzero(~pair.tolerance.arrays(first.values[here], second.values[there]).all(axis=1))
    for i, j in zip(here[differing].tolist(), there[differing].tolist(), strict=True):
        yield pair.difference(group, f"{group}/{first.ids[i]}", _held(group, first, i), _held(group, second, j))
    for i in np.flatnonzero(second.indices(first.ids) < 0).tolist():
        yield pair.difference(group, f"{group}/{first.ids[i]}", _held(group, first, i), None)
    for j in np.flatnonzero(first.indices(second.ids) < 0).tolist():
        yield pair.difference(group, f"{group}/{second.ids[j]}", None, _held(group, second, j))


def _held(group: str, table: Numbered, index: int) -> tuple[Value, Where]:
    """Return the coordinates of a node, or the nodes of an element, with their place."""
    values = [plain(value) for value in table.values[index].tolist()]
    if group == "elements":
        values = [int(value) if isinstance(value, float) else value for value in values]
    return values, table.where(index)


def _labelled(keyword: str, group: str, pair: Pair) -> Iterator[Difference]:
    """Yield the differences of rows with a {label} in place of a number."""
    first, second = _label_rows(pair.before, keyword, group), _label_rows(pair.after, keyword, group)
    for key in [*sorted(first.keys() - second.keys()), *sorted(second.keys() - first.keys())]:
        row, _ = first.get(key) or second[key]
        yield pair.difference(group, f"{group}/{row[0]}", first.get(key), second.get(key))


def _label_rows(side: Side, keyword: str, name: str) -> dict[tuple[str, ...], tuple[list[Value], Where]]:
    rows_by_key: dict[tuple[str, ...], tuple[list[Value], Where]] = {}
    for where, block in side.scene.deck.blocks(keyword):
        for index, entry in enumerate(block.entries):
            table = getattr(entry, name, None)
            if not isinstance(table, Table):
                continue
            rows = sorted({row for (row, _), word in table.words.items() if isinstance(word, Label)})
            for row in rows:
                cells = [plain(table.cell(row, column)) for column in range(table.lengths[row])]
                key = tuple(str(cell).casefold() for cell in cells)
                rows_by_key[key] = (cells, where.inside("entries", index, name, row))
    return rows_by_key


_SetLine = SetList | SetGenerate | SetSubset


def _sets(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of the members of element sets; ALL has all elements."""
    first, second = pair.before.scene.set_table.named, pair.after.scene.set_table.named
    written, others = _lines_of_sets(pair.before), _lines_of_sets(pair.after)
    for name in dict.fromkeys([*first, *second]):
        if name == "all":
            continue
        old, new = first.get(name), second.get(name)
        before = text_of(spans_of(pair.before.scene.element_ids[old.elements])) if old else None
        after = text_of(spans_of(pair.after.scene.element_ids[new.elements])) if new else None
        if old and new and (old.open or new.open or not (len(old.elements) and len(new.elements))):
            lines, other_lines = written.get(name, []), others.get(name, [])
            if lines == other_lines:  # may be ranges of very many numbers
                continue
            before, after = _members(lines), _members(other_lines)
        if before != after:
            title = old.name if old else new.name if new else name
            held = ((members, each.where) if each else None for members, each in ((before, old), (after, new)))
            yield pair.difference("element sets", f"element sets/{title}", *held)


def _lines_of_sets(side: Side) -> dict[str, list[_SetLine]]:
    """Return the lines of sets by name, for sets with elements that the deck does not define."""
    lines: dict[str, list[_SetLine]] = {}
    for _, block in side.scene.deck.blocks("ELEMENT SETS"):
        for entry in block.sets:
            lines.setdefault(name_key(str(entry.name)), []).extend(entry.members)
    return lines


def _members(lines: Sequence[_SetLine]) -> str:
    """Return the members of a set that its lines name, as text; a GEN= that is invalid names none."""
    spans, words = list[Spans](), set[str]()
    for line in lines:
        match line:
            case SetSubset():
                words.add(f"SUBSET={name_key(line.subset)}")
            case SetList():
                words |= {folded(item) for item in line.elements if isinstance(item, Label)}
                spans.append(spans_of(np.array([item for item in line.elements if isinstance(item, int)], np.int64)))
            case SetGenerate():
                start, end, step = line.generate.start, line.generate.end, line.generate.increment
                step = 1 if step is None else step
                if isinstance(start, int) and isinstance(end, int) and isinstance(step, int) and step >= 1:
                    spans.append(spans_of_run(start, min(end, start + MOST_GENERATED * step), step))
    return ", ".join(filter(None, [text_of(union(spans)), *sorted(words)]))


_KINDS = {False: "curves", True: "curves of sets"}


def _parameters(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of parameter values."""
    first, second = pair.before.parameters, pair.after.parameters
    for name in dict.fromkeys([*first.values, *second.values]):
        old, new = first.values.get(name), second.values.get(name)
        if old is None or new is None or not pair.tolerance.values(old, new):
            held = (_value(old, first.definitions.get(name)), _value(new, second.definitions.get(name)))
            yield pair.difference("parameters", f"parameters/{name}", *held)


def _value(value: float | str | None, definition: Definition | None) -> tuple[Value, Where | None] | None:
    return None if value is None else (plain(value), definition.where if definition else None)


def _curves(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of points of the force-embedment curves; the last curve of a name applies."""
    first, second = _by_name(pair.before), _by_name(pair.after)
    for name in dict.fromkeys([*first, *second]):
        old, new = first.get(name), second.get(name)
        if old and new:
            yield from _points_differ(_title(old), old, new, pair)
        elif curve := old or new:
            held = ((shown_points(one), one.where) if one else None for one in (old, new))
            yield pair.difference("curves", _title(curve), *held)


def _points_differ(name: str, old: SceneCurve, new: SceneCurve, pair: Pair) -> Iterator[Difference]:
    first, second = _points(old), _points(new)
    same = pair.tolerance.arrays
    if first.shape == second.shape:
        if same(first, second).all():
            return
        if same(first[:, 0], second[:, 0]).all():
            for i in np.flatnonzero(~same(first[:, 1], second[:, 1])).tolist():
                held = _force(old, first[i]), _force(new, second[i])
                yield pair.difference("curves", f"{name}/{first[i, 0].item()!r}", *held)
            return
    mine, theirs = set(map(tuple, first.tolist())), set(map(tuple, second.tolist()))
    for point in [*sorted(mine - theirs), *sorted(theirs - mine)]:
        before = _force(old, np.array(point)) if point in mine else None
        after = _force(new, np.array(point)) if point in theirs else None
        yield pair.difference("curves", f"{name}/{point[0]!r}", before, after)


def _title(curve: SceneCurve) -> str:
    return f"{_KINDS[curve.embedment]}/{curve.name}"


def _by_name(side: Side) -> dict[str, SceneCurve]:
    return {f"{_KINDS[curve.embedment]}/{folded(curve.name)}": curve for curve in side.scene.laws.curves}


def _points(curve: SceneCurve) -> Floats:
    """Return the points in ascending order, each once."""
    return np.unique(curve.points, axis=0) if len(curve.points) else curve.points


def shown_points(curve: SceneCurve) -> Value:
    """Return the points of a curve in ascending order, as a difference shows them."""
    return [[plain(value) for value in row] for row in _points(curve).tolist()]


def _force(curve: SceneCurve, point: Floats) -> tuple[Value, Where]:
    """Return the force of a point, and its place."""
    at = np.flatnonzero((curve.points == point).all(axis=1))
    return point[1].item(), curve.point(int(at[0])) if len(at) else curve.where


# ---------------------------------------------------------------------------------------- laws and sections of elements

Values = dict[str, object]


class EntryMap(NamedTuple):
    """Entries of one kind, their places, and the entry of each element (-1 for none)."""

    entries: Sequence[Values]
    places: Sequence[Where]
    of_element: Indices


def _by_element(pair: Pair) -> Iterator[Difference]:
    """Yield elements of both decks whose laws, sections or resistance differ, as ranges of numbers.

    If the elements have the same record in both decks, or a record in one deck only, the difference of the record is
    reported instead.
    """
    yield from follow_differently("laws", partial(laws_followed, describe=law_values), pair)
    yield from follow_differently("sections", _sections, pair)
    numbers = partial(resistance_followed, describe=lambda values, _: numbers_given(values._asdict()))
    yield from follow_differently("bed", numbers, pair)
    for keyword in dict.fromkeys([*pair.before.scene.extensions, *pair.after.scene.extensions]):
        yield from follow_differently(keyword.lower(), partial(_extension, keyword=keyword), pair)


def follow_differently(
    group: str, read: Callable[[Side], EntryMap], pair: Pair, descriptions: Mapping[int, str] | None = None
) -> Iterator[Difference]:
    """Yield the differences between the entries of elements that both decks have.

    `descriptions` describes the elements to compare by their number, if they are not those of the decks.
    """
    before, after = pair.before, pair.after
    here, there = _common(before.scene.table.numbered, after.scene.table.numbered)
    if descriptions is not None:
        chosen = np.isin(before.scene.element_ids[here], list(descriptions))
        here, there = here[chosen], there[chosen]
    if not len(here):
        return
    first, second = read(before), read(after)
    entries, others = ([*zip([{}, *each.entries], [None, *each.places], strict=True)] for each in (first, second))
    width = len(others)
    followed = (first.of_element[here] + 1) * width + second.of_element[there] + 1
    for both in np.unique(followed).tolist():
        (old, at), (new, there_at) = entries[both // width], others[both % width]
        if tuple(place and place._replace(path=place.path[:2]) for place in (at, there_at)) in pair.reported:  # records
            continue
        same = pair.tolerance.values
        names = [name for name in dict.fromkeys([*old, *new]) if not same(old.get(name), new.get(name))]
        if not names:
            continue
        elements = _called(before.scene.element_ids[here[followed == both]], descriptions)
        for name in names:
            where = f"{elements}/{group}" + (f"/{name}" if name else "")
            held = (cast("Value", old.get(name)), at), (cast("Value", new.get(name)), there_at)
            yield pair.difference(f"{group} of elements", where, *held)


def _called(ids: NDArray[np.int64], descriptions: Mapping[int, str] | None) -> str:
    if descriptions is None:
        return f"elements {text_of(spans_of(ids))}"
    return "; ".join(dict.fromkeys(descriptions[number] for number in ids.tolist()))


def laws_followed(side: Side, describe: Callable[[Scene, SetLaw], Values]) -> EntryMap:
    """Return the laws of a deck as `describe` gives them, and the law of each element."""
    laws = side.scene.laws
    entries = [describe(side.scene, law) for law in laws.set_laws]
    return EntryMap(entries, [law.where for law in laws.set_laws], laws.of_element)


def law_values(scene: Scene, law: SetLaw) -> Values:
    """Return the stiffness of a linear law, else the name of a law."""
    if law.kind is LawKind.LINEAR:
        return {"": "linear", "stiffness": plain(law.stiffness)}
    return {} if law.kind is LawKind.NONE else {"": scene.law_name(law)}


def _sections(side: Side) -> EntryMap:
    table = side.scene.section_table
    places = [section.where for section in table.sections]
    entries = []
    for where in places:
        values = record_values(side, side.scene.deck.at(where), where)
        values.pop("option", None)  # the property line has the name of its format
        if side.scene.deck.at(where._replace(path=())).keyword == "TAPER":
            start = np.flatnonzero(table.of_element == places.index(where))
            if start.size:
                values["first element"] = str(side.scene.element_ids[start[0]])
        entries.append(values)
    return EntryMap(entries, places, table.of_element)


def resistance_followed(side: Side, describe: Callable[[ResistanceValues, str], Values]) -> EntryMap:
    """Return friction, lateral stiffness and suction as `describe` gives them, and the entry of each element."""
    given, units = side.scene.resistance, side.scene.units
    return EntryMap([describe(values, units) for values in given.values], given.places, given.of_element)


def numbers_given(given: Mapping[str, Any]) -> Values:
    """Return the given values without NaN; pairs are split into longitudinal and transverse."""
    numbers: Values = {}
    for name, value in given.items():
        pair = zip(("longitudinal ", "transverse "), value, strict=True) if isinstance(value, tuple) else [("", value)]
        numbers |= {axis + name: plain(number) for axis, number in pair if not np.isnan(number)}
    return numbers


def _extension(side: Side, keyword: str) -> EntryMap:
    extension = side.scene.extensions.get(keyword)
    if extension is None:
        return EntryMap([], [], np.full(len(side.scene.element_ids), -1, dtype=np.intp))
    entries = [record_values(side, *pair) for pair in zip(extension.entries, extension.places, strict=True)]
    return EntryMap(entries, extension.places, extension.of_element)
