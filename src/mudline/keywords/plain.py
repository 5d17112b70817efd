"""Plain blocks: the values that the reader of blocks finds, without the place of each of them.

The reader of blocks defines their meaning. What is read here has the values that it has there, and nothing to report;
a block with anything else in it, be it a comment among its lines or one odd character, is left to the reader. Most
blocks of most decks are plain, and nobody asks for places in a block without a finding.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any, NamedTuple, cast

import numpy as np

from mudline.diagnostics import Problem, Span
from mudline.keywords.grammar import ROW, SMALL, Tree, fitting, records_of, terminal_of
from mudline.keywords.making import can_be_made, make
from mudline.keywords.model import AS_TEXT, Block, FieldSpec, ListRow, Part, Record, columns_of, record_schema
from mudline.keywords.table import LARGEST_WHOLE, Column, Table, fewest_of, from_rows
from mudline.keywords.text import MIXED_FIELDS, UnreadableError, Value, read_value
from mudline.keywords.values import Equation, Kind
from mudline.limits import LONGEST_TABLE
from mudline.syntax.fields import Field, canonical_key
from mudline.syntax.rows import line_spans, read_number, read_rows
from mudline.syntax.tree import Kind as LeafKind
from mudline.syntax.tree import Leaf

_FIELD = r"[^\s,=\"{}\[\]/]+(?:[ \t]+[^\s,=\"{}\[\]/]+)*"
_EQUATION = r"=\[[^\[\]\"\r\n]*\]"
_BEHIND = rf"[ \t]*((?:{_FIELD}|{_EQUATION})(?:[ \t]*,[ \t]*(?:{_FIELD}|{_EQUATION}))*+)[ \t]*\r?\n"
_SETTING = re.compile(rf"([ \t]*[A-Za-z][\w \t-]*)={_BEHIND}")
_LINE = re.compile(_BEHIND)
_WHOLE = re.compile(r"[-+]?[0-9]{1,16}")
_COMMA = re.compile(r"[ \t]*,[ \t]*(?![^\[]*\])")
_TIGHT_COMMA = re.compile(r"[^ \t],[^ \t]")
_DIGITS = r"[0-9]{1,99}+"
_NUMBER = rf"[-+]?(?:{_DIGITS}(?:\.(?:{_DIGITS})?+)?|\.{_DIGITS})(?:[eE][-+]?{_DIGITS})?"
_NUMBERS = re.compile(rf"(?:[ \t]*+{_NUMBER}[ \t]*+(?:,[ \t]*+{_NUMBER}[ \t]*+)*+\r?\n)++")
"""Rows of numbers that are separated by commas: those of most tables."""
_SHORT_TABLE = 1600
"""Characters of such rows: longer ones are read sooner with arrays."""

Values = dict[str, Any]
_Reading = Callable[[Values, str, object], None]
"""Adds to the values of a record what the fields of a line give; the last argument is that of `Record.row_slot`."""


class _OddError(Exception):
    """Something that is left to the reader of blocks."""


@dataclass(slots=True)
class _Form:
    """How a record of one form is read: what each of its own lines gives, by their indices, and the records in it.

    `part` is what is made of it; None where pydantic makes it with the block.
    """

    carries: Callable[[Values, object], object] | None
    part: type[Record] | None
    lines: list[tuple[int, _Reading]] = field(default_factory=list)
    children: list[tuple[str, _Form]] = field(default_factory=list)

    def values(self, lines: Sequence[str], last: object = None) -> Values:
        """The values of a record from the fields of its lines; `last` is what its sticky field was before."""
        found: Values = {}
        for index, reading in self.lines:
            reading(found, lines[index], last)
        stuck: dict[str, object] = {}
        for name, form in self.children:
            values = form.values(lines, stuck.get(name))
            if form.carries:
                stuck[name] = form.carries(values, stuck.get(name))
            found.setdefault(name, []).append(form.made(values))
        return found

    def made(self, values: Values) -> Values | Part:
        """The record of its values, or these."""
        return make(self.part, values) if self.part else values


def read_plain(
    text: str, leaves: Sequence[Leaf], name: str, declared: type[Block], keys: frozenset[str], start: int = 0
) -> Block | None:
    """Return the model of a plain block; None where it is anything else.

    `leaves` are its lines, in a text of which `text` is the part from `start` on, and `name` is its keyword; `keys` are
    those that the lines may begin with.
    """
    if declared.tabular and leaves and leaves[-1].span.end - leaves[0].span.start > LONGEST_TABLE:
        return None
    try:
        lines = _lines(text, leaves, keys, start, tabular=declared.tabular)
        values = {"keyword": name, **_contents(lines, leaves, declared)}
        if can_be_made(declared):
            return cast("Block", make(declared, values))
        return declared.model_validate(values, context=AS_TEXT)
    except (_OddError, ValueError):
        return None


def _contents(lines: Iterable[tuple[str, str]], leaves: Sequence[Leaf], declared: type[Block]) -> Values:
    """The values of a block: a record at a time where it is a list of records, else all of its lines at once."""
    records = records_of(declared.rule)
    slots = record_schema(declared).slots
    if records and len(slots) == 1:
        entries = _entries(slots[0].record[records.rule], lines, records.opening, tabular=declared.tabular)
        # values of a long block are read as pydantic checks them: all at once would take several times the memory
        at_once = len(leaves) <= SMALL or can_be_made(declared)
        return {slots[0].json: list(entries) if at_once else entries}
    if len(leaves) > SMALL:
        raise _OddError
    terminals: list[str] = []
    written: list[str] = []
    for terminal, fields in lines:
        terminals.append(terminal)
        written.append(fields)
    return _known_form(declared, tuple(terminals), declared.tabular).values(written)


_SETTING_LINE, _RUN_OF_ROWS, _TEXT_LINE = LeafKind.SETTING, LeafKind.RUN, LeafKind.TEXT
"""Members of an enumeration take longer to find, and each line asks for some."""


def _lines(
    text: str, leaves: Sequence[Leaf], keys: frozenset[str], start: int, *, tabular: bool
) -> Iterator[tuple[str, str]]:
    """The terminal of each line, and what stands behind its key; the text of a run that is a table."""
    for kind, (begin, end) in leaves:
        if kind is _SETTING_LINE:
            written, fields = _matched(_SETTING, text, begin - start, end - start).groups()
            yield _terminal(written, keys), fields
        elif kind is _RUN_OF_ROWS or kind is _TEXT_LINE:
            if not tabular:
                for first, last in line_spans(text, Span(begin - start, end - start)):
                    yield ROW, _matched(_LINE, text, first, last + 1)[1]
            elif text[end - start - 1] == "\n":
                yield ROW, text[begin - start : end - start]
            else:
                raise _OddError
        elif kind is not LeafKind.BLANK:
            raise _OddError


def _matched(pattern: re.Pattern[str], text: str, start: int, end: int) -> re.Match[str]:
    """The match of a line; none of a very long one, which would take a hundred times its size in memory."""
    match = pattern.fullmatch(text, start, end) if end - start <= LONGEST_TABLE else None
    if match is None:
        raise _OddError
    return match


@lru_cache(maxsize=1024)
def _terminal(written: str, keys: frozenset[str]) -> str:
    """The terminal of a setting line by its key as it is written."""
    key = canonical_key(written)
    if key not in keys:
        raise _OddError
    return terminal_of(key)


def _entries(
    record: type[Record], lines: Iterable[tuple[str, str]], opening: str, *, tabular: bool
) -> Iterator[Values | Part]:
    """Each record or its values, while its lines are read."""
    if record.sticky:
        raise _OddError
    terminals: list[str] = []
    written: list[str] = []
    for terminal, fields in lines:
        if terminal == opening:
            if terminals:
                form = _known_form(record, tuple(terminals), tabular)
                yield form.made(form.values(written))
            terminals, written = [], []
        elif not terminals:
            raise _OddError
        terminals.append(terminal)
        written.append(fields)
    if terminals:
        form = _known_form(record, tuple(terminals), tabular)
        yield form.made(form.values(written))


def _known_form(record: type[Record], terminals: tuple[str, ...], tabular: bool) -> _Form:  # noqa: FBT001 - for the cache
    """How a record with these lines is read."""
    form = _form_of(record, terminals, tabular)
    if form is None:
        raise _OddError
    return form


@lru_cache(maxsize=1024)
def _form_of(record: type[Record], terminals: tuple[str, ...], tabular: bool) -> _Form | None:  # noqa: FBT001
    tree = fitting(record.rule, terminals) if len(terminals) <= SMALL else None
    try:
        return _form(record, tree, tabular=tabular) if tree else None
    except _OddError:
        return None


def _form(record: type[Record], tree: Tree, *, tabular: bool) -> _Form:
    """How a record is read that has this tree."""
    found = record_schema(record)
    form = _Form(record.carries if record.sticky else None, record if can_be_made(record) else None)
    given: list[str] = []
    for child in tree.children:
        if isinstance(child, Tree):
            slot = found.children[child.rule]
            form.children.append((slot.json, _form(slot.record[child.rule], child, tabular=tabular)))
            continue
        if child.terminal == ROW:
            reading = _row_reading(record, tabular=tabular)
        else:
            slots = [slot for key, slot in found.keys.items() if terminal_of(key) == child.terminal]
            if len(slots) != 1:
                raise _OddError
            reading = _setting_reading(slots[0])
        given.append(child.terminal)
        form.lines.append((child.at, reading))
    lacks_table = found.table and found.table.required and ROW not in given
    if lacks_table or len(set(given)) < len(given) or (not tree.children and not issubclass(record, Block)):
        raise _OddError
    return form


def _setting_reading(slot: FieldSpec) -> _Reading:
    """How the values behind a KEY= are read."""
    one = partial(_one, slot)
    if slot.row is None:
        return partial(_many, slot) if slot.many else one
    row = _values_reading(slot.row, slot)
    if not (slot.choices or slot.kind):
        return row
    return lambda found, fields, last: (row if "," in fields else one)(found, fields, last)


def _row_reading(record: type[Record], *, tabular: bool) -> _Reading:
    """How a row of a record is read, or a run of rows that is its table."""
    schema = record_schema(record)
    if tabular:
        if schema.table is None or schema.columns:
            raise _OddError
        columns = columns_of(schema.table)
        return partial(_table, schema.table.json, columns, _Widths.of(columns))
    if schema.table:
        raise _OddError
    readings = {slot.name: _column_reading(record, slot) for slot in schema.columns}
    if record.row_slot.__func__ is Record.row_slot.__func__:  # type: ignore[attr-defined]  # of a class method
        return readings[schema.columns[0].name]
    return partial(_chosen, record, readings)


def _chosen(record: type[Record], readings: dict[str, _Reading], found: Values, fields: str, last: object) -> None:
    """A row whose field depends on what was read before it."""
    readings[record.row_slot(0, len(_words(fields)), found, last)](found, fields, last)


def _column_reading(record: type[Record], slot: FieldSpec) -> _Reading:
    """How a row is read that fills a field of a record, or that one and those behind it."""
    columns = record_schema(record).columns
    if slot.row:
        return _values_reading(slot.row, slot)
    if slot.many:
        return partial(_many, slot)
    if len(columns) > 1 and any(column.row for column in columns):
        return partial(_one, slot)
    return _values_reading(record, None)


def _values_reading(row: type[Part], slot: FieldSpec | None) -> _Reading:
    """How the fields of a row are read: those of a field `slot`, or of the record itself."""
    json = slot.json if slot else ""
    return partial(_listed if issubclass(row, ListRow) else _fields, row, json)


def _fields(row: type[Part], json: str, found: Values, fields: str, _: object) -> None:
    inner = found.setdefault(json, {}) if json else found
    for word, slot in _counted(row, fields):
        inner[slot.json] = _value(word, slot)


def _listed(row: type[Part], json: str, found: Values, fields: str, _: object) -> None:
    found[json] = [_value(word, slot) for word, slot in _counted(row, fields)]


def _counted(row: type[Part], fields: str) -> Iterator[tuple[str, FieldSpec]]:
    """The fields of a row, each with what it is; there are neither too few nor too many."""
    schema = record_schema(row)
    words = _words(fields)
    if not schema.fewest <= len(words) <= len(schema.columns):
        raise _OddError
    if len(words) >= MIXED_FIELDS and (" " in fields or "\t" in fields) and _TIGHT_COMMA.search(fields):
        raise _OddError  # some of the commas may be decimal ones
    return zip(words, schema.columns, strict=False)


def _many(slot: FieldSpec, found: Values, fields: str, _: object) -> None:
    found[slot.json] = [_value(word, slot) for word in _words(fields)]


def _one(slot: FieldSpec, found: Values, fields: str, _: object) -> None:
    if "," in fields:
        raise _OddError
    found[slot.json] = _value(fields, slot)


class _Widths(NamedTuple):
    """How many fields the rows of a table may have, and which of them are whole numbers."""

    fewest: int
    most: int
    whole: tuple[int, ...]

    @classmethod
    def of(cls, columns: Sequence[Column]) -> _Widths:
        """Those of a table with these columns."""
        whole = tuple(index for index, column in enumerate(columns) if column.whole)
        return cls(fewest_of(columns), len(columns), whole)


def _from_numbers(numbers: list[float], width: int, widths: _Widths) -> Table | None:
    """The table of a few numbers in rows of `width`; None where any of them, or the width, needs a closer look."""
    if not widths.fewest <= width <= widths.most or math.inf in numbers or -math.inf in numbers:
        return None
    for index in widths.whole:
        for number in numbers[index::width] if index < width else ():
            if not number.is_integer() or not 0.0 < abs(number) <= LARGEST_WHOLE:
                return None
    return Table(np.array(numbers).reshape(-1, width))


def _table(json: str, columns: list[Column], widths: _Widths, found: Values, run: str, _: object) -> None:
    if len(run) <= _SHORT_TABLE and _NUMBERS.fullmatch(run):
        rows = run.splitlines()
        commas = {row.count(",") for row in rows}
        if len(commas) == 1:
            numbers = [*map(float, ",".join(rows).split(","))]
            if (short := _from_numbers(numbers, commas.pop() + 1, widths)) is not None:
                found[json] = short
                return
    table, faults = from_rows(read_rows(run, Span(0, len(run)), len(columns)), columns)
    if faults:
        raise _OddError
    found[json] = table


def _words(fields: str) -> list[str]:
    """The fields of a line; one field with blanks may be several that are separated by blanks."""
    if "[" in fields:
        return _COMMA.split(fields)
    words = [word.strip(" \t") for word in fields.split(",")]
    if len(words) == 1 and (" " in fields or "\t" in fields):
        raise _OddError
    return words


def _value(word: str, slot: FieldSpec) -> Value:
    """The value of a field: at once for what most fields hold."""
    kind = slot.kind
    if kind is Kind.NAME:
        if word[0] == "=":
            raise _OddError
        return word
    if not slot.choices:
        if kind is Kind.REAL and (number := read_number(word)) is not None:
            return number
        if (kind is Kind.WHOLE or kind is Kind.IDENT) and _WHOLE.fullmatch(word) and abs(int(word)) <= LARGEST_WHOLE:
            return int(word)
    problems: list[Problem] = []
    try:
        value = read_value(Field(word, Span(0, len(word))), slot, problems)
    except UnreadableError as fault:
        raise _OddError from fault
    if problems or (kind is Kind.IDENT and isinstance(value, Equation)):
        raise _OddError
    if (kind is Kind.OTHER and value not in slot.choices) or value in (slot.about.opaque or ()):
        raise _OddError
    return value
