"""Long blocks of plain records: the values that the reader finds, without a tree of every line.

The reader of blocks defines their meaning. What is read here has the values that it has there, and nothing to report;
a block with anything else in it, be it a comment or one odd character, is left to the reader.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, cast

from lark import Token, Tree
from pydantic import ValidationError

from mudline.diagnostics import Problem, Span
from mudline.keywords.grammar import ROW, SMALL, fitting, records_of, terminal_of
from mudline.keywords.model import Block, FieldSpec, ListRow, Record, record_schema
from mudline.keywords.text import UnreadableError, Value, read_value
from mudline.keywords.values import Equation, Kind
from mudline.syntax.fields import Field, canonical_key
from mudline.syntax.rows import line_spans
from mudline.syntax.tree import Kind as LeafKind
from mudline.syntax.tree import RawBlock

FEWEST = 1000
"""Lines of a block from which on it is worth the attempt."""

_FIELD = r"[^\s,=\"{}\[\]/]+(?:[ \t]+[^\s,=\"{}\[\]/]+)*"
_EQUATION = r"=\[[^\[\]\"\r\n]*\]"
_BEHIND = rf"[ \t]*((?:{_FIELD}|{_EQUATION})(?:[ \t]*,[ \t]*(?:{_FIELD}|{_EQUATION}))*+)[ \t]*\r?\n"
_SETTING = re.compile(rf"([ \t]*[A-Za-z][\w \t-]*)={_BEHIND}")
_LINE = re.compile(_BEHIND)
_WHOLE = re.compile(r"[-+]?[0-9]{1,15}")
_COMMA = re.compile(r"[ \t]*,[ \t]*(?![^\[]*\])")

Values = dict[str, Any]
_Reading = Callable[[str], Values]


class _OddError(Exception):
    """Something that is left to the reader of blocks."""


@dataclass(slots=True)
class _Form:
    """How a record of one form is read: what each of its own lines gives, by their indices, and the records in it."""

    lines: list[tuple[int, _Reading]] = field(default_factory=list)
    children: list[tuple[str, _Form]] = field(default_factory=list)

    def values(self, lines: Sequence[str]) -> Values:
        """The values of a record from the fields of its lines."""
        found: Values = {}
        for index, reading in self.lines:
            found |= reading(lines[index])
        for name, form in self.children:
            found.setdefault(name, []).append(form.values(lines))
        return found


def read_plain(text: str, raw: RawBlock, declared: type[Block], keys: Collection[str]) -> Block | None:
    """Return the model of a block of plain records; None where it is anything else.

    `keys` are those that the lines of the block may begin with.
    """
    records = records_of(declared.rule)
    slots = record_schema(declared).slots
    if len(raw.leaves) < FEWEST or records is None or len(slots) != 1 or declared.tabular:
        return None
    slot = slots[0]
    entries = _entries(slot.record[records.rule], _lines(text, raw, keys), records.opening)
    try:
        return declared.model_validate({"keyword": raw.name, slot.json: entries})
    except (_OddError, ValidationError):
        return None


def _lines(text: str, raw: RawBlock, keys: Collection[str]) -> Iterator[tuple[str, str]]:
    """The terminal of each line, and what stands behind its key."""
    terminals: dict[str, str] = {}
    for kind, span in raw.leaves:
        if kind is LeafKind.SETTING:
            match = _SETTING.fullmatch(text, *span)
            if match is None:
                raise _OddError
            written, fields = match.groups()
            terminal = terminals.get(written)
            if terminal is None:
                key = canonical_key(written)
                if key not in keys:
                    raise _OddError
                terminal = terminals[written] = terminal_of(key)
            yield terminal, fields
        elif kind is LeafKind.TEXT:
            match = _LINE.fullmatch(text, *span)
            if match is None:
                raise _OddError
            yield ROW, match[1]
        elif kind is LeafKind.RUN:
            yield from ((ROW, fields) for fields in _rows(text, span))
        elif kind is not LeafKind.BLANK:
            raise _OddError


def _rows(text: str, run: Span) -> Iterator[str]:
    for start, end in line_spans(text, run):
        match = _LINE.fullmatch(text, start, end + 1)
        if match is None:
            raise _OddError
        yield match[1]


def _entries(record: type[Record], lines: Iterable[tuple[str, str]], opening: str) -> Iterator[Values]:
    """The values of each record, while its lines are read; those of one form are read alike."""
    forms: dict[tuple[str, ...], _Form] = {}

    def values() -> Values:
        kinds = tuple(terminals)
        form = forms.get(kinds)
        if form is None:
            tree = fitting(record.rule, kinds) if len(kinds) <= SMALL else None
            if tree is None:
                raise _OddError
            form = forms[kinds] = _form(record, tree)
        return form.values(written)

    terminals: list[str] = []
    written: list[str] = []
    for terminal, fields in lines:
        if terminal == opening:
            if terminals:
                yield values()
            terminals, written = [], []
        elif not terminals:
            raise _OddError
        terminals.append(terminal)
        written.append(fields)
    yield values()


def _form(record: type[Record], tree: Tree[Token]) -> _Form:
    """How a record is read that has this tree."""
    found = record_schema(record)
    if record.sticky or any("row_slot" in vars(base) for base in record.__mro__ if base is not Record):
        raise _OddError
    form = _Form()
    own: list[str] = []
    for child in tree.children:
        if isinstance(child, Tree):
            slot = found.children[str(child.data)]
            form.children.append((slot.json, _form(slot.record[str(child.data)], child)))
            continue
        if child.type == ROW:
            slots = found.columns
            reading = _row_reading(record)
        else:
            slots = [slot for key, slot in found.keys.items() if terminal_of(key) == child.type]
            reading = _setting_reading(slots)
        own += [slot.json for slot in slots]
        form.lines.append((cast("int", child.start_pos), reading))
    if len(set(own)) < len(own):  # given twice
        raise _OddError
    return form


def _setting_reading(slots: list[FieldSpec]) -> _Reading:
    """What a setting gives: one name, or a few whole numbers."""
    if len(slots) != 1 or slots[0].many or slots[0].choices:
        raise _OddError
    slot = slots[0]
    if slot.kind is Kind.NAME and slot.row is None:
        return partial(_name, slot.json)
    columns = record_schema(slot.row).columns if slot.row and issubclass(slot.row, ListRow) else []
    if not columns or slot.kind or any(column.kind is not Kind.WHOLE for column in columns):
        raise _OddError
    return partial(_some_wholes, slot.json, record_schema(cast("type[ListRow]", slot.row)).fewest, len(columns))


def _row_reading(record: type[Record]) -> _Reading:
    """What a row gives: whole numbers, or two values, of which no two can be one number with a decimal comma."""
    found = record_schema(record)
    columns = found.columns
    if found.table or found.keys or any(column.row or column.choices for column in columns):
        raise _OddError
    if len(columns) == 1 and columns[0].many and columns[0].kind in (Kind.IDENT, Kind.WHOLE):
        return partial(_wholes, columns[0].json)
    if len(columns) == 2 and all(column.required and column.kind and not column.many for column in columns):
        return partial(_pair, columns[0], columns[1])
    raise _OddError


def _name(json: str, fields: str) -> Values:
    if "," in fields or fields[0] == "=":
        raise _OddError
    return {json: fields}


def _wholes(json: str, fields: str) -> Values:
    words = [word.strip(" \t") for word in fields.split(",")]
    if not all(map(_WHOLE.fullmatch, words)):
        raise _OddError
    return {json: list(map(int, words))}


def _some_wholes(json: str, fewest: int, most: int, fields: str) -> Values:
    values = _wholes(json, fields)
    if not fewest <= len(values[json]) <= most:
        raise _OddError
    return values


def _pair(first: FieldSpec, second: FieldSpec, fields: str) -> Values:
    words = _COMMA.split(fields)
    if len(words) != 2:
        raise _OddError
    return {first.json: _value(words[0], first), second.json: _value(words[1], second)}


def _value(word: str, slot: FieldSpec) -> Value:
    if word.startswith("=["):
        if slot.kind is Kind.NAME or slot.kind is Kind.IDENT:
            raise _OddError
        return Equation(word)
    if slot.kind is Kind.NAME:
        return word
    problems: list[Problem] = []
    try:
        value = read_value(Field(word, Span(0, len(word))), slot, problems)
    except UnreadableError as fault:
        raise _OddError from fault
    if problems:
        raise _OddError
    return value
