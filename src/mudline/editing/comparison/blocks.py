"""Comparison of blocks that the scene does not resolve completely: by path and record, opaque blocks line by line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import groupby
from typing import NamedTuple, TypeAlias

from mudline.basics.limits import MOST_MATCHED
from mudline.basics.sequences import differing
from mudline.editing.comparison.model import Difference, Pair, Side, Value, plain
from mudline.language.deck.model import Opaque
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Where
from mudline.language.keywords.model import (
    Block,
    FieldSpec,
    ListRow,
    Part,
    PartValue,
    Path,
    Record,
    Rows,
    record_schema,
)
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import field_text, joined
from mudline.language.syntax.tree import data_lines

_KEYS = {"set", "name", "curve"}


class ComparedValue(NamedTuple):
    """A value, the form in which it is compared, and its place."""

    shown: Value
    compared: object
    where: Where


Flat: TypeAlias = dict[str, ComparedValue]


def flatten(side: Side, blocks: list[tuple[Where, Block]]) -> Flat:
    """Return all values of the blocks of a keyword by path; a named record is found by its name in any block."""
    naming = _Naming(side, later_wins=any(block.facts.later_wins for _, block in blocks))
    flat: Flat = {}
    carried: Flat = {}
    for number, (where, block) in enumerate(blocks, 1):
        keyed = next((slot.json for slot in record_schema(type(block)).slots if _is_keyed(slot)), None)
        walked = block.walk()
        own = naming.add((each for each in walked if each.path[0] != keyed), where, {}, {(): ("", None)})
        if keyed is None:  # the values of a second block get its number
            flat |= own if number == 1 else {f"#{number}/{path}": entry for path, entry in own.items()}
            continue
        carried |= {path: own[path] for name in block.facts.carried if (path := name.rstrip("_")) in own}
        shared = carried | own
        of_records = (each for each in walked if each.path[0] == keyed)
        for path, (first, *values) in groupby(of_records, lambda each: each.path[:2]):
            record: Record = first.value
            name = naming.open(record, where.inside(*path), "", flat)
            flat |= {f"{name}/{inner}": entry for inner, entry in shared.items()}
            naming.add(values, where, flat, {path: (f"{name}/", key_slot(type(record)))})
    return flat


def record_values(side: Side, record: Record, where: Where) -> dict[str, object]:
    """Return the values of one record of an element by path, without the name of the record."""
    inside: _Inside = {(): ("", key_slot(type(record)))}
    values = _Naming(side, later_wins=True).add(record.walk(), where, {}, inside)
    return {path: entry.shown for path, entry in values.items()}


@cache
def key_slot(record: type[Record]) -> FieldSpec | None:
    """Return the field that identifies a record of a list: its set, or its own name."""
    slot = record_schema(record).name
    return slot if slot and {slot.json, slot.key.casefold()} & _KEYS else None


def _identity(record: Record) -> str | None:
    """Return the identity of a record without a name: its required values; None without required values."""
    slots = [slot for slot in record_schema(type(record)).slots if slot.required and not slot.record]
    values = [getattr(record, slot.name, None) for slot in slots]
    words = [field_text(value) for value in values if isinstance(value, float | int | str)]
    for row in (value for value in values if isinstance(value, ListRow)):
        given = (slot.name for slot in record_schema(type(row)).columns if slot.name in row.model_fields_set)
        words.append(joined([getattr(row, name) for name in given]))
    return ", ".join(words) or None


_Inside = dict[Path, tuple[str, FieldSpec | None]]
"""Beginning of the paths of the values in a part, and the field that is no value but its name; by its path."""


class _Naming:
    """Paths of values with the names of records, where they have names, in place of indexes."""

    def __init__(self, side: Side, *, later_wins: bool) -> None:
        self.side = side
        self.later_wins = later_wins
        self.counts: Counter[str] = Counter()
        self.sticky: dict[Where, object] = {}

    def add(self, walked: Iterable[PartValue], where: Where, flat: Flat, inside: _Inside) -> Flat:
        """Add the values of a walk `inside` some parts; return all values."""
        for path, slot, value in walked:
            index = path[-1]
            before, name_of_record = inside[path[:-2] if isinstance(index, int) else path[:-1]]
            if slot is name_of_record:
                continue
            name, place = before + slot.json, where.inside(*path)
            if isinstance(index, int) and not isinstance(value, Record):
                name = f"{name}/{index + 1}"
            if isinstance(value, Record):
                name = self.open(value, place, f"{name}/", flat)
                inside[path] = f"{name}/", key_slot(type(value))
            elif isinstance(value, Part):
                inside[path] = f"{name}/", None
            elif isinstance(value, Table):
                flat.update(_table(value, slot, place, name))
            else:
                flat[name] = _scalar(value, place)
        return flat

    def open(self, record: Record, where: Where, start: str, flat: Flat) -> str:
        """Add a record of a list, and the sticky value that holds for it; return its path."""
        key, index = key_slot(type(record)), int(where.path[-1])
        name = _identity(record) if key is None else getattr(record, key.name, None)
        title = folded(str(name)) if name is not None else "all" if key and key.json == "set" else str(index + 1)
        self.side.names.setdefault(title, "ALL" if name is None and title == "all" else str(name or title))
        path = start + title
        if self.later_wins:
            for old in [old for old in flat if old == path or old.startswith(f"{path}/")] if path in flat else ():
                del flat[old]
        else:
            self.counts[path] += 1
            path += f"#{self.counts[path]}" if self.counts[path] > 1 else ""
        flat[path] = ComparedValue(None, None, where)
        if record.sticky:
            declared = next(slot for slot in record_schema(type(record)).slots if slot.name == record.sticky)
            of_list = where._replace(path=where.path[:-1])
            sticky = self.sticky[of_list] = getattr(record, declared.name, None) or self.sticky.get(of_list)
            flat[f"{path}/{declared.json}"] = _scalar(sticky or declared.about.default, where)
        return path


def _is_keyed(slot: FieldSpec) -> bool:
    return slot.many and bool(slot.record) and all(map(key_slot, slot.record.values()))


def _scalar(value: object, where: Where) -> ComparedValue:
    if isinstance(value, float | int):
        return ComparedValue(plain(value), value, where)
    return ComparedValue(str(value), folded(str(value)), where)


def _table(table: Table, slot: FieldSpec, where: Where, path: str) -> Iterator[tuple[str, ComparedValue]]:
    """Yield the rows of a table; points in ascending order."""
    rows = [(cells, index) for index, cells in enumerate(table.rows())]
    if isinstance(slot.about, Rows) and slot.about.unordered:
        rows.sort(key=lambda row: [(cell is None, *_rank(cell)) for cell in row[0]])
    for number, (cells, index) in enumerate(rows, 1):
        while cells and cells[-1] is None:
            cells.pop()
        yield f"{path}/{number}", ComparedValue([plain(cell) for cell in cells], list(cells), where.inside(index))


def _rank(cell: float | str | None) -> tuple[str, float]:
    return (cell, 0.0) if isinstance(cell, str) else ("", cell or 0.0)


_ONE_IN_ALL = ("MODEL", "PREPROCESSOR")
"""Sections that count as one section, however often they occur."""

_Name = tuple[str, str]


def blocks(pair: Pair) -> Iterator[Difference]:
    """Yield the differences of modelled blocks by value, and of opaque blocks by data line."""
    first, second = _modelled(pair.before), _modelled(pair.after)
    for name in dict.fromkeys([*first, *second]):
        group = _group(name)
        before, after = first.get(name, []), second.get(name, [])
        if not before or not after:  # reported separately, as the block may have no values
            yield pair.difference(group, group, *((None, side[0][0]) if side else None for side in (before, after)))
        yield from flat_differences(group, flatten(pair.before, before), flatten(pair.after, after), pair)
    lines, others = _lines(pair.before), _lines(pair.after)
    for name in dict.fromkeys([*lines, *others]):
        yield from _opaque(name, lines.get(name, []), others.get(name, []), pair)


def flat_differences(group: str, before: Flat, after: Flat, pair: Pair) -> Iterator[Difference]:
    """Yield values by path that differ, or that only one of two decks has."""
    for path in dict.fromkeys([*before, *after]):
        old, new = before.get(path), after.get(path)
        if old and new and pair.tolerance.values(old.compared, new.compared):
            continue
        where = f"{group}/{(pair.before if old else pair.after).path(path)}"
        pair.reported.update(_around(path, before, after))
        held = ((entry.shown, entry.where) if entry else None for entry in (old, new))
        yield pair.difference(group, where, *held)


def _around(path: str, before: Flat, after: Flat) -> Iterator[tuple[Where | None, Where | None]]:
    """Yield the places of a value in both decks, and those of its record and block."""
    record = path.partition("/")[0]
    yield before[record].where if record in before else None, after[record].where if record in after else None
    old, new = (flat[path].where if path in flat else None for flat in (before, after))
    for end in range(3):  # block and record
        yield old and old._replace(path=old.path[:end]), new and new._replace(path=new.path[:end])


def _group(name: _Name) -> str:
    section, keyword = name
    return f"*{keyword}" if section == "MODEL" else f"${section} *{keyword}"


def _modelled(side: Side) -> dict[_Name, list[tuple[Where, Block]]]:
    modelled: dict[_Name, list[tuple[Where, Block]]] = {}
    titles = list(_titles(side))
    for where, _, block in side.scene.deck.every_block():
        if isinstance(block, Block) and not block.facts.defines:
            name = (titles[where.section], block.keyword)
            modelled.setdefault(name, []).append((where, side.comparable(block, where)))
    return modelled


def _titles(side: Side) -> Iterator[str]:
    """Yield the sections by name; a second load case, which differs from the first, has its number."""
    counts: dict[str, int] = {}
    for section in side.scene.deck.sections:
        count = counts[section.name] = counts.get(section.name, 0) + 1
        yield section.name if count == 1 or section.name in _ONE_IN_ALL else f"{section.name} {count}"


_Lines = list[tuple[str, Where]]


def _lines(side: Side) -> dict[_Name, _Lines]:
    """Return the data lines without blanks at their ends; those of blocks of the same keyword follow each other."""
    deck, titles = side.scene.deck, list(_titles(side))
    held = [(Where(), ("", ""), deck.preamble)]
    held += [(Where(index), (titles[index], ""), section.lines) for index, section in enumerate(deck.sections)]
    for where, _, block in deck.every_block():
        if isinstance(block, Opaque):
            held.append((where, (titles[where.section], block.keyword), [f"*{block.keyword}", *block.lines]))
    lines_by_name: dict[_Name, _Lines] = {}
    for where, name, lines in sorted(held):
        lines_by_name.setdefault(name, []).extend((line, where) for line in data_lines(lines))
    return lines_by_name


def _opaque(name: _Name, before: _Lines, after: _Lines, pair: Pair) -> Iterator[Difference]:
    section, keyword = name
    title = _group(name) if keyword else f"${section}" if section else "before the first section"
    old, new = ([line for line, _ in lines] for lines in (before, after))
    for i, i_end, j, j_end in differing(old, new, MOST_MATCHED):
        yield from (pair.difference(title, f"{title}/lines", held, None) for held in before[i:i_end])
        yield from (pair.difference(title, f"{title}/lines", None, held) for held in after[j:j_end])
