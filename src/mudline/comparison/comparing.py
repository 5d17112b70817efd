"""The differences of two decks, among them what each element follows of the blocks that go by set."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

import numpy as np

from mudline.comparison.blocks import blocks, record_values
from mudline.comparison.model import Difference, Side, Tolerance, Value, plain, spans_of, text_of
from mudline.comparison.named import common, curves, elements, nodes, parameters, sets
from mudline.contact.input import LawKind
from mudline.diagnostics import Where
from mudline.keywords.model import Record
from mudline.scene.laws import SetLaw
from mudline.scene.model import Scene
from mudline.scene.numbering import Indices
from mudline.scene.seabed import SeabedShape


def compare(before: Scene, after: Scene, tolerance: float = 0.0) -> list[Difference]:
    """What differs between the meanings of two decks; an empty list when they mean the same.

    `tolerance` is how far two numbers may be apart, relative to the larger one. Raises DeckError for a deck of which
    something could not be read, or in which an equation has no value.
    """
    one, other = Side(before), Side(after)
    one.require()
    other.require()
    return list(_differences(one, other, Tolerance(tolerance)))


def _differences(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    if one.scene.units != other.scene.units:
        yield Difference("changed", "units", "units", one.scene.units, other.scene.units)
    yield from parameters(one, other, tolerance)
    yield from nodes(one, other, tolerance)
    yield from elements(one, other)
    yield from sets(one, other)
    yield from curves(one, other, tolerance)
    yield from _by_element(one, other, tolerance)
    yield from _floor(one, other, tolerance)
    yield from blocks(one, other, tolerance)


def _floor(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """The points of the bed that files hold; what the deck itself says of it is among its blocks."""
    old, new = one.scene.seabed, other.scene.seabed
    same = old.points.shape == new.points.shape and bool(tolerance.arrays(_sorted(old), _sorted(new)).all())
    if not same and (old.file or new.file):
        lines = one.line(old.where), other.line(new.where)
        counts = f"{len(old.points)} points", f"{len(new.points)} points"
        yield Difference("changed", "seabed", "seabed/points", *counts, *lines)


def _sorted(floor: SeabedShape) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return floor.points[np.lexsort(floor.points.T[::-1])] if len(floor.points) else floor.points


_Values = dict[str, object]


@dataclass(frozen=True, slots=True)
class _Followed:
    """The entries of one kind, the one that each element follows (-1 for none), and where they stand."""

    entries: Sequence[_Values]
    places: Sequence[Where]
    of_element: Indices


def _by_element(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Elements that both decks have and that follow something else, as ranges of numbers."""
    yield from _differ("laws", one, other, _laws, tolerance)
    yield from _differ("sections", one, other, _sections, tolerance)
    yield from _differ("bed", one, other, _bed, tolerance)
    names = dict.fromkeys([*one.scene.extensions, *other.scene.extensions])
    for keyword in names:
        yield from _differ(keyword.lower(), one, other, partial(_extension, keyword=keyword), tolerance)


def _differ(
    group: str, one: Side, other: Side, read: Callable[[Side], _Followed], tolerance: Tolerance
) -> Iterator[Difference]:
    here, there = common(one.scene.table.numbered, other.scene.table.numbered)
    if not len(here):
        return
    first, second = read(one), read(other)
    width = len(second.entries) + 1
    pairs = (first.of_element[here] + 1) * width + second.of_element[there] + 1
    starts = np.append(0, np.flatnonzero(pairs[1:] != pairs[:-1]) + 1)  # neighbours mostly follow the same
    for pair in sorted(set(pairs[starts].tolist())):
        i, j = pair // width - 1, pair % width - 1
        old, new = _entry(first, i), _entry(second, j)
        names = [name for name in dict.fromkeys([*old, *new]) if not tolerance.values(old.get(name), new.get(name))]
        if not names:
            continue
        elements = text_of(spans_of(one.scene.element_ids[here[pairs == pair]]))
        lines = (one.line(first.places[i]) if i >= 0 else None, other.line(second.places[j]) if j >= 0 else None)
        for name in names:
            where = f"elements {elements}/{group}" + (f"/{name}" if name else "")
            values = cast("Value", old.get(name)), cast("Value", new.get(name))
            yield Difference("changed", f"{group} of elements", where, *values, *lines)


def _entry(found: _Followed, index: int) -> _Values:
    return found.entries[index] if index >= 0 else {}


def _laws(side: Side) -> _Followed:
    laws = side.scene.laws
    return _Followed(
        [_law(side.scene, grant) for grant in laws.set_laws], [g.where for g in laws.set_laws], laws.of_element
    )


def _law(scene: Scene, grant: SetLaw) -> _Values:
    if grant.kind is LawKind.LINEAR:
        return {"": "linear", "stiffness": plain(grant.stiffness)}
    return {} if grant.kind is LawKind.NONE else {"": scene.law_name(grant)}


def _record(side: Side, record: Record, where: Where) -> _Values:
    return {path: entry.shown for path, entry in record_values(side, record, where).items()}


def _sections(side: Side) -> _Followed:
    table = side.scene.section_table
    places = [section.where for section in table.sections]
    entries = []
    for where in places:
        block = cast("Any", side.scene.deck.sections[where.section].blocks[where.block])
        values = _record(side, block.sets[where.path[1]], where)
        values.pop("option", None)  # the property line has the name of its format
        entries.append(values)
    return _Followed(entries, places, table.of_element)


def _bed(side: Side) -> _Followed:
    bed = side.scene.resistance
    return _Followed([_numbers(entry._asdict()) for entry in bed.values], bed.places, bed.of_element)


def _numbers(given: dict[str, Any]) -> _Values:
    """Values that are given; of pairs, longitudinal and transverse apart."""
    found: _Values = {}
    for name, value in given.items():
        pair = zip(("longitudinal ", "transverse "), value, strict=True) if isinstance(value, tuple) else [("", value)]
        found |= {axis + name: plain(number) for axis, number in pair if not np.isnan(number)}
    return found


def _extension(side: Side, keyword: str) -> _Followed:
    found = side.scene.extensions.get(keyword)
    if found is None:
        return _Followed([], [], np.full(len(side.scene.element_ids), -1, dtype=np.intp))
    pairs = zip(found.entries, found.places, strict=True)
    return _Followed([_record(side, entry, place) for entry, place in pairs], found.places, found.of_element)
