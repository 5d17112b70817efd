"""The tree of a block to plain values, with the place of each and every fault of a field as one problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from lark import Tree

from mudline.codes.fields import SYN003
from mudline.codes.lines import SYN001, SYN004, SYN014
from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.keywords.grammar import ROW, Content, Node
from mudline.keywords.model import Block, FieldSpec, ListRow, Part, Record, record_schema
from mudline.keywords.numbers import cut_number
from mudline.keywords.places import Path, Places
from mudline.keywords.table import fewest_fields, row_format
from mudline.keywords.text import (
    MIXED_FIELDS,
    TableBuilder,
    UnreadableError,
    Value,
    decimal_comma,
    hint,
    instead,
    mixed_commas,
    read_value,
    semicolons,
)
from mudline.keywords.unknown import UNKNOWN, Partly
from mudline.keywords.values import Kind, Names
from mudline.spelling import nearest
from mudline.syntax.fields import Field, Group, read_line, split, trimmed
from mudline.syntax.rows import blank_separated

_OTHER, _TITLE, _IDENT = Kind.OTHER, Kind.TITLE, Kind.IDENT


@dataclass(slots=True)
class Item:
    """A line or a record in a record: where it is written, where it stands, how many it counts for."""

    order: int
    position: int
    count: int


@dataclass(slots=True)
class ParsedRecord:
    """A record as plain values, and what is needed to place comments in it.

    One is `unsure` where lines or settings of it could not be used: what it seems to lack may be there.
    """

    part: type[Record]
    values: dict[str, Any] = field(default_factory=dict)
    children: dict[str, list[ParsedRecord]] = field(default_factory=dict)
    items: list[Item] = field(default_factory=list)
    sticky: object = None
    first: int = 0
    last: int | None = None
    unsure: bool = False

    @property
    def known(self) -> dict[str, Any]:
        """The values that could be read."""
        return {name: value for name, value in self.values.items() if value is not UNKNOWN}

    def reach(self, position: int) -> None:
        """Take note of a line."""
        if self.last is None:
            self.first = self.last = position
        elif position > self.last:
            self.last = position


class Builder:
    """Reads the lines of one block; `end` is where the file ends behind a last line that has no line end, or -1."""

    def __init__(
        self,
        text: str,
        places: Places,
        problems: list[Problem],
        *,
        slashes: bool,
        end: int = -1,
        recording: bool = True,
        attaching: bool = True,
    ) -> None:
        self.text = text
        self.end = end
        self.slashes = slashes
        self.places = places
        self.recording = recording
        self.attaching = attaching
        self.problems = problems
        self.lost = 0
        self.asked = False
        self.unclosed: Span | None = None
        self.unchosen: set[Path] = set()

    def build(self, part: type[Record], node: Node, path: Path = (), last: object = None) -> ParsedRecord:
        """The values of a record; `last` is what the sticky field of the records before it gave."""
        built = ParsedRecord(part)
        found = record_schema(part)
        tables: dict[str, TableBuilder] = {}
        row_number = 0
        for child in node.children:
            if isinstance(child, Tree):
                self._child(built, found.children[child.data], child, path)
                continue
            if self.recording and built.last is None:
                self.places.spans[path] = trimmed(self.text, *child.span)
            if child.type == ROW:
                self._row(built, child, path, last, row_number, tables)
                row_number += 1
            else:
                self._settings(built, child, path)
        for name, table in tables.items():
            built.values[name] = table.finish()
        if found.table and found.table.required and found.table.json not in built.values:
            built.values[found.table.json] = TableBuilder(self, found.table, (*path, found.table.json)).finish()
        return built

    def report(self, code: Code, message: str, span: Span, repair: Repair | None = None) -> None:
        """Note a fault."""
        self.problems.append(Problem(code, message, span, repair=repair))

    def short(self, message: str, span: Span) -> None:
        """A value or more is missing in a row; at the very end of the file it was cut off."""
        if 0 <= self.end <= span.end:
            message = f"the file ends before this row is complete, it seems to be cut off: {message}"
            self.report(SYN014, message, span)
        else:
            self.report(SYN003, message, span)

    def _brackets(self, problems: list[Problem], built: ParsedRecord) -> None:
        """The bracket that a line does not close; it reaches to the end of the line, so there is one at most."""
        self.unclosed = None
        for problem in problems:
            self.problems.append(problem)
            self.unclosed = problem.span
            built.unsure = True

    def _unreadable(self, problem: Problem) -> None:
        """A field without a value; one with an open bracket has been reported as such."""
        if not (self.unclosed and problem.span and self.unclosed.start < problem.span.end):
            self.problems.append(problem)

    def _child(self, built: ParsedRecord, slot: FieldSpec, node: Node, path: Path) -> None:
        before = built.children.setdefault(slot.json, [])
        inner = (*path, slot.json, len(before))
        last = before[-1].sticky if before else None
        child = self.build(slot.record[node.data], node, inner, last)
        if child.part.sticky:
            child.sticky = child.part.carries(child.known, last)
        if child.last is None:
            return
        before.append(child)
        built.values.setdefault(slot.json, []).append(child.values)
        if self.attaching:
            built.items.append(Item(slot.order, child.first, 1))
        built.reach(child.first)
        built.reach(child.last)

    def _settings(self, built: ParsedRecord, content: Content, path: Path) -> None:
        found = record_schema(built.part)
        line = read_line(self.text, content.span, slashes=self.slashes)
        self.unclosed = None
        if line.problems:
            self._brackets(line.problems, built)
        opening = built.last is None and not issubclass(built.part, Block)
        self._groups(built, line.groups, path)
        if self.attaching and not opening:
            order = min((found.keys[g.key].order for g in line.groups if g.key in found.keys), default=0)
            built.items.append(Item(order, content.span.start, 1))
        built.reach(content.span.start)

    def _groups(self, built: ParsedRecord, groups: list[Group], path: Path) -> None:
        """Settings that stand on one line."""
        found = record_schema(built.part)
        first = found.keys.get(groups[0].key) if groups else None
        if (
            first
            and first.kind is _OTHER
            and first.json not in built.values
            and self._of_other_form(built, first, groups, path)
        ):
            return
        if first and first.kind is _TITLE and groups[0].fields[0].text:
            self._rest_of_line(built, first, groups, path)
            return
        for group in groups:
            slot = found.keys.get(group.key)
            if slot and slot.json in built.values:  # a key that may stand twice has a field for each
                slot = next((s for s in found.slots if s.key == group.key and s.json not in built.values), slot)
            if slot is None:
                expected = ", ".join(f"{key}=" for key in found.keys)
                near = nearest(group.key, found.keys)
                message = f"{group.key}= does not belong on this line{hint(near)}: expected {expected}"
                key = trimmed(self.text, group.span.start, self.text.find("=", group.span.start))
                self.report(SYN004, message, group.span, instead(near, key))
            elif slot.json in built.values:
                self.report(SYN001, f"{group.key}= is given twice", group.span)
            else:
                self._setting(built, slot, group, (*path, slot.json))

    def _of_other_form(self, built: ParsedRecord, slot: FieldSpec, groups: list[Group], path: Path) -> bool:
        """Read a line that says that it has a form which is not known: all behind its key is one value."""
        open_ = slot.kind is Kind.OTHER and slot.about.opaque is not None
        if not open_ or not groups[0].fields[0].text or (len(groups) == 1 and len(groups[0].fields) == 1):
            return False
        value = read_value(groups[0].fields[0], slot, [])
        if value in slot.choices and value not in (slot.about.opaque or ()):
            return False
        read_value(groups[0].fields[0], slot, self.problems)
        self._rest_of_line(built, slot, groups, path)
        return True

    def _rest_of_line(self, built: ParsedRecord, slot: FieldSpec, groups: list[Group], path: Path) -> None:
        """All behind the key of a setting as its value."""
        start = self.text.index("=", groups[0].span.start) + 1
        whole = trimmed(self.text, start, groups[-1].span.end)
        self.places.spans[*path, slot.json] = whole
        built.values[slot.json] = self.text[slice(*whole)]

    def _setting(self, built: ParsedRecord, slot: FieldSpec, group: Group, path: Path) -> None:
        if self.recording:
            self.places.spans[path] = group.span
        fields = group.fields
        if slot.row and not _alone(slot, fields):
            self.lost += issubclass(slot.row, ListRow) and built.unsure
            built.values[slot.json] = self._row_values(slot.row, fields, path)
            return
        if slot.many and any(given.text for given in fields):
            built.values[slot.json] = self._list(slot, fields, path)
            return
        while len(fields) > 1 and not fields[-1].text:
            fields.pop()
        if len(fields) > 1:
            message = f"{slot.label} takes one value, found {len(fields)}"
            place = Span(fields[0].span.start, fields[-1].span.end)
            self.problems.append(decimal_comma(fields, [slot.kind], 1) or Problem(SYN003, message, place))
        if not fields[0].text:
            built.values[slot.json] = UNKNOWN
            self.report(SYN003, f"{slot.label} has no value{_value_of(slot)}", group.span)
            return
        self._value(built, slot, fields, path)

    def _value(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field], path: Path) -> None:
        """The value of a setting; of several the first one, where it names a new thing."""
        built.values[slot.json] = UNKNOWN
        if self.recording:
            self.places.spans[path] = fields[0].span
        if fields[0].span.end == self.end and cut_number(fields[0].text):
            message = f"the file ends inside {fields[0].text!r}: it seems to be cut off, add what is missing"
            self.report(SYN014, message, fields[0].span)
            return
        try:
            value = read_value(fields[0], slot, self.problems)
            if len(fields) == 1 or slot.about.defines:
                built.values[slot.json] = value
        except UnreadableError as fault:
            self._unreadable(fault.problem)
            if slot.choices and slot.name == built.part.sticky:
                self.unchosen.add(path[:-1])

    def _row(
        self,
        built: ParsedRecord,
        content: Content,
        path: Path,
        last: object,
        number: int,
        tables: dict[str, TableBuilder],
    ) -> None:
        found = record_schema(built.part)
        behind: list[Group] = []
        if self.unchosen and path in self.unchosen and sum(column.row is not None for column in found.columns) > 1:
            built.reach(content.span.start)  # which format it has is not known
            return
        if found.table and not found.columns:
            slot, fields = found.table, list[Field]()
        else:
            fields, behind, problems = self._cut(content.span, keys=bool(found.keys))
            self.unclosed = None
            if problems:
                self._brackets(problems, built)
            if len(fields) == 1 and blank_separated(fields[0].text):
                fields = self._apart(fields[0])
            if len(found.row_names) == 1:
                slot = found.columns[0] if found.columns else cast("FieldSpec", found.table)
            else:
                name = built.part.row_slot(number, len(fields), built.known, last)
                slot = next(s for s in found.slots if s.name == name)
        inner = (*path, slot.json) if self.recording or slot is found.table or slot.row or slot.many else ()
        count = 1
        if slot is found.table:
            table = tables.setdefault(slot.json, TableBuilder(self, slot, inner))
            count = table.add(content.span)
        elif slot.row and slot.json in built.values:
            message = (
                f"one line only has its place here (`{record_schema(slot.row).wanted}`): remove it, or the one above"
            )
            self.report(SYN001, message, trimmed(self.text, *content.span))
        elif slot.row:
            if self.recording:
                self.places.spans[inner] = trimmed(self.text, *content.span)
            built.values[slot.json] = self._row_values(slot.row, fields, inner)
        elif slot.many:
            built.values[slot.json] = self._list(slot, fields, inner)
        elif found.mixed:
            self._single(built, slot, fields, path)
        else:
            built.values |= self._fields(found.columns, fields, path)
        if behind:
            self._groups(built, behind, path)
        if self.attaching:
            built.items.append(Item(slot.order, content.span.start, count))
        built.reach(content.span.start)

    def _cut(self, span: Span, *, keys: bool) -> tuple[list[Field], list[Group], list[Problem]]:
        """The fields of a row, and the settings behind them on the line of a record that has `keys`."""
        if not keys:
            fields, problems = split(self.text, span, slashes=self.slashes)
            return fields, [], problems
        line = read_line(self.text, span, slashes=self.slashes)
        own = [given for group in line.groups if not group.key for given in group.fields]
        return own, [group for group in line.groups if group.key], line.problems

    def _single(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field], path: Path) -> None:
        """A row of one value."""
        if slot.json in built.values:
            self.report(SYN001, f"{slot.label} is given twice", fields[0].span)
            return
        built.values |= self._fields([slot], fields, path)

    def _row_values(self, row: type[Part], fields: list[Field], path: Path) -> dict[str, Value] | list[Value]:
        columns = record_schema(row).columns
        if not issubclass(row, ListRow):
            return self._fields(columns, fields, path)
        values = self._fields(columns, fields, path)
        for index, slot in enumerate(columns):
            if (*path, slot.json) in self.places.spans:
                self.places.spans[*path, index] = self.places.spans.pop((*path, slot.json))
        self.lost += any(value is UNKNOWN for value in values.values())
        return [values.get(slot.json) for slot in columns[: len(values)]]

    def _fields(self, columns: Sequence[FieldSpec], fields: list[Field], path: Path) -> dict[str, Value]:
        before = len(self.problems)
        fields = self._counted(columns, fields, path)
        # Of a wrong count any value may be that of another column, but for the number or name that begins the row.
        wrong = len(self.problems) > before and any(one.weight is Severity.ERROR for one in self.problems[before:])
        miscounted = wrong or bool(self.unclosed)
        values: dict[str, Value] = dict.fromkeys((slot.json for slot in columns), UNKNOWN) if miscounted else {}
        for slot, given in zip(columns, fields, strict=False):
            if self.recording:
                self.places.spans[*path, slot.json] = given.span
            if not given.text:
                if slot.required and not miscounted:
                    self.short(f"{slot.label} is missing", given.span)
                values[slot.json] = UNKNOWN if slot.required else None
                continue
            try:
                value = read_value(given, slot, self.problems)
            except UnreadableError as fault:
                self._unreadable(fault.problem)
                value = UNKNOWN
            if not wrong or (slot is columns[0] and (slot.is_text or slot.kind is _IDENT)):
                values[slot.json] = value
        return values

    def _counted(self, columns: Sequence[FieldSpec], fields: list[Field], path: Path) -> list[Field]:
        """The fields without trailing empty ones; a wrong number of them is a problem."""
        fewest = fewest_fields([slot.required for slot in columns])
        if len(fields) == 1 and len(columns) > 1 and blank_separated(fields[0].text):
            fields = self._apart(fields[0])
        while len(fields) > max(fewest, 1) and not fields[-1].text:
            fields.pop()
        if len(columns) > 1 and (problem := semicolons(self.text, fields)):
            self.problems.append(problem)
            return fields[:1]
        if fewest <= len(fields) <= len(columns):
            if len(fields) >= MIXED_FIELDS and (
                problem := mixed_commas(fields, [slot.kind for slot in columns], fewest)
            ):
                self.problems.append(problem)
            return fields
        if self.unclosed:  # the open bracket holds the fields that are missing
            return fields[: len(columns)]
        if problem := decimal_comma(fields, [slot.kind for slot in columns], fewest):
            self.problems.append(problem)
            return fields[: len(columns)]
        wanted = row_format([slot.label for slot in columns], [slot.required for slot in columns])
        count = f"{fewest}" if fewest == len(columns) else f"{fewest} to {len(columns)}"
        message = f"{count} fields expected (`{wanted}`), found {len(fields)}"
        self.asked |= not fields and not self.recording
        span = Span(fields[0].span.start, fields[-1].span.end) if fields else self.places.find(path)
        if len(fields) < fewest:
            self.short(message, span)
        else:
            self.report(SYN003, message, span)
        return fields[: len(columns)]

    def _apart(self, given: Field) -> list[Field]:
        start = given.span.start
        fields: list[Field] = []
        for word in given.text.split():
            start = self.text.index(word, start)
            fields.append(Field(word, start))
            start += len(word)
        return fields

    def _list(self, slot: FieldSpec, fields: list[Field], path: Path) -> list[Value]:
        while len(fields) > 1 and not fields[-1].text:
            fields.pop()
        values: list[Value] = []
        for given in fields:
            try:
                value = read_value(given, slot, self.problems)
            except UnreadableError as fault:
                self._unreadable(fault.problem)
                values = Partly(values)
                continue
            if self.recording:
                self.places.spans[*path, len(values)] = given.span
            values.append(value)
        return values


def _value_of(slot: FieldSpec) -> str:
    """What to write as the value of a setting, as far as it names something."""
    names = getattr(slot.about, "names", None)
    if names is Names.SET:
        return ": write the name of a set after it (ALL is every element)"
    return ": write the name of the set after it" if slot.key == "SET" else ""


def _alone(slot: FieldSpec, fields: list[Field]) -> bool:
    """Whether a setting that may hold a row holds a word or a number instead."""
    if not (slot.choices or slot.kind) or any(given.text for given in fields[1:]):
        return False
    return not blank_separated(fields[0].text)
