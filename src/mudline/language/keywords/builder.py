"""Conversion of the tree of a block to plain values; every fault of a field is one problem."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import cast

from lark import Tree

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import counted
from mudline.basics.spelling import nearest
from mudline.language.codes.fields import SYN002, SYN003, SYN016
from mudline.language.codes.lines import SYN001, SYN004, SYN005, SYN014
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.language.keywords.model import Block, FieldSpec, ListRow, Part, Path, Record, record_schema
from mudline.language.keywords.parsed import Item, ParsedRecord, Places, TableBuilder
from mudline.language.keywords.table import Table, fewest_fields, row_format
from mudline.language.keywords.text import (
    UnreadableError,
    Value,
    cut_number,
    decimal_comma,
    hint,
    instead,
    missing_comma,
    mixed_commas,
    read_value,
    semicolons,
)
from mudline.language.keywords.values import UNKNOWN, Kind, Label, Names, Partly
from mudline.language.syntax.fields import Field, FieldGroup, read_line, split, trimmed
from mudline.language.syntax.grammars import ROW, Content, Node
from mudline.language.syntax.rows import blank_separated, line_spans, row_fields

_OTHER, _TITLE, _IDENT = Kind.OTHER, Kind.TITLE, Kind.IDENT


class Builder:
    """Builder of the records of one block.

    `end` is the end of the file if the last line has no line end, else -1. Fields declared as `older` are read only in
    blocks of an `older` program. The spans of values are added to `places`.
    """

    def __init__(
        self, places: Places, problems: list[Problem], *, slashes: bool, end: int = -1, older: bool = False
    ) -> None:
        self.places = places
        self.text = places.text
        self.end = end
        self.slashes = slashes
        self.older = older
        self.problems = problems
        self.lost = 0
        self.unclosed: Span | None = None

    def build(self, part: type[Record], node: Node, path: Path = (), last: object = None) -> ParsedRecord:
        """Return the record at a path; `last` is the value of the sticky field in the records before it."""
        built = ParsedRecord(part, path)
        schema = record_schema(part)
        row_number = 0
        for child in node.children:
            if isinstance(child, Tree):
                self._child(built, schema.children[child.data], child)
                continue
            if built.last is None:
                self.places.add(path, trimmed(self.text, *child.span))
            if child.type == ROW:
                self._row(built, child, last, row_number)
                row_number += 1
            else:
                self._settings(built, child)
        for slot in schema.tables:
            if slot.required:
                built.tables.setdefault(slot.json, TableBuilder(slot.columns))
        for name, table in built.tables.items():
            built.values[name] = table.finish()
        return built

    def report(self, code: Code, message: str, span: Span, repair: Repair | None = None) -> None:
        """Add a problem."""
        self.problems.append(Problem(code, message, span, repair=repair))

    def short(self, message: str, span: Span) -> None:
        """Report missing values of a row; at the very end of the file the row was probably cut off."""
        if 0 <= self.end <= span.end:
            message = f"the file ends before this row is complete, it seems to be cut off: {message}"
            self.report(SYN014, message, span)
        else:
            self.report(SYN003, message, span)

    def _brackets(self, problems: list[Problem], built: ParsedRecord) -> None:
        """Report the unclosed bracket of a line; it reaches to the end of the line, so there is one at most."""
        self.unclosed = None
        for problem in problems:
            self.problems.append(problem)
            self.unclosed = problem.span
            built.unsure = True

    def _unreadable(self, problem: Problem) -> None:
        """Report a field without a value, unless its open bracket has been reported."""
        if not (self.unclosed and problem.span and self.unclosed.start < problem.span.end):
            self.problems.append(problem)

    def _child(self, built: ParsedRecord, slot: FieldSpec, node: Node) -> None:
        before = built.children.setdefault(slot.json, [])
        last = before[-1].sticky if before else None
        child = self.build(slot.record[node.data], node, (*built.path, slot.json, len(before)), last)
        if child.part.sticky:
            child.sticky = child.part.carries(child.known, last)
        if child.last is None:
            return
        before.append(child)
        built.inner.append(child)
        built.values.setdefault(slot.json, []).append(child.values)
        built.items.append(Item(slot.order, child.first, 1))
        built.reach(child.first)
        built.reach(child.last)

    def _settings(self, built: ParsedRecord, content: Content) -> None:
        line = read_line(self.text, content.span, slashes=self.slashes)
        self._brackets(line.problems, built)
        if built.last is not None or issubclass(built.part, Block):
            keys = record_schema(built.part).keys
            order = min((keys[group.key].order for group in line.groups if group.key in keys), default=0)
            built.items.append(Item(order, content.span.start, 1))
        self._groups(built, line.groups)
        built.reach(content.span.start)

    def _groups(self, built: ParsedRecord, groups: list[FieldGroup]) -> None:
        """Read the settings of a line."""
        schema = record_schema(built.part)
        first = schema.keys.get(groups[0].key) if groups else None
        if first and first.kind is _OTHER and self._of_other_form(built, first, groups):
            return
        if first and first.kind is _TITLE and groups[0].fields[0].text:
            self._rest_of_line(built, first, groups)
            return
        for group in groups:
            slot = schema.keys.get(group.key)
            if slot and slot.json in built.values:  # a key that may occur twice has two fields
                slot = next((s for s in schema.slots if s.key == group.key and s.json not in built.values), slot)
            if slot is None:
                self._unknown_key(group, schema.keys)
            elif slot.json in built.values:
                self.report(SYN001, f"{group.key}= is given twice", group.span)
            else:
                self._setting(built, slot, group)

    def _unknown_key(self, group: FieldGroup, known: Iterable[str]) -> None:
        near = nearest(group.key, known)
        expected = ", ".join(f"{key}=" for key in known)
        message = f"{group.key}= does not belong on this line{hint(near)}: expected {expected}"
        key = trimmed(self.text, group.span.start, self.text.find("=", group.span.start))
        self.report(SYN004, message, group.span, instead(near, key))

    def _of_other_form(self, built: ParsedRecord, slot: FieldSpec, groups: list[FieldGroup]) -> bool:
        """Read a line whose setting announces an unknown form: all text after its key is one value."""
        fields = groups[0].fields
        if slot.about.opaque is None or slot.json in built.values:
            return False
        if not fields[0].text or (len(groups) == 1 and len(fields) == 1):
            return False
        value = read_value(fields[0], slot, [])
        if value in slot.choices and value not in slot.about.opaque:
            return False
        read_value(fields[0], slot, self.problems)
        self._rest_of_line(built, slot, groups)
        return True

    def _rest_of_line(self, built: ParsedRecord, slot: FieldSpec, groups: list[FieldGroup]) -> None:
        """Read all text after the key of a setting as its value."""
        start = self.text.index("=", groups[0].span.start) + 1
        whole = trimmed(self.text, start, groups[-1].span.end)
        self.places.add((*built.path, slot.json), whole)
        built.values[slot.json] = self.text[slice(*whole)]

    def _setting(self, built: ParsedRecord, slot: FieldSpec, group: FieldGroup) -> None:
        fields = group.fields
        if slot.row and not _alone(slot, fields):
            self.lost += issubclass(slot.row, ListRow) and built.unsure
            self._inner_row(built, slot, fields, group.span)
            return
        if slot.many and any(field.text for field in fields):
            self._list(built, slot, fields, group.span)
            return
        while len(fields) > 1 and not fields[-1].text:
            fields.pop()
        if len(fields) > 1:
            message = f"{slot.label} takes one value, found {len(fields)}"
            place = Span(fields[0].span.start, fields[-1].span.end)
            self.problems.append(decimal_comma(fields, [slot.kind], 1) or Problem(SYN003, message, place))
        if not fields[0].text:
            self.places.add((*built.path, slot.json), group.span)
            built.values[slot.json] = UNKNOWN
            self.report(SYN003, f"{slot.label} has no value{_value_of(slot)}", group.span)
            return
        self._value(built, slot, fields)

    def _value(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field]) -> None:
        """Read the value of a setting; of several values the first, if the setting names a new object."""
        self.places.add(built.path, None, (slot.json,), fields)
        built.values[slot.json] = UNKNOWN
        if self.end >= 0 and fields[0].span.end == self.end and cut_number(fields[0].text):
            message = f"the file ends inside {fields[0].text!r}: it seems to be cut off, add what is missing"
            self.report(SYN014, message, fields[0].span)
            return
        try:
            value = read_value(fields[0], slot, self.problems)
            if isinstance(slot.about.older, tuple) and value in slot.about.older and not self.older:
                known = " or ".join(word for word in slot.choices if word not in slot.about.older)
                message = f"only .das decks, of another program, have {slot.label}{value}: write {known}"
                self.report(SYN005, message, fields[0].span)
            if len(fields) == 1 or slot.about.defines:
                built.values[slot.json] = value
        except UnreadableError as fault:
            self._unreadable(fault.problem)
            built.unchosen |= bool(slot.choices) and slot.name == built.part.sticky

    def _row(self, built: ParsedRecord, content: Content, last: object, number: int) -> None:
        """Read a row, or a run of rows that is a table."""
        schema = record_schema(built.part)
        start, count = content.span.start, 1
        if built.unchosen and sum(column.row is not None for column in schema.columns) > 1:
            built.reach(start)
            return
        behind: list[FieldGroup] = []
        if schema.tables and len(schema.row_names) == 1:
            slot, fields = schema.tables[0], list[Field]()
        else:
            fields, behind = self._cut(built, content.span, keys=bool(schema.keys))
            slot = self._slot_of_row(built, number, len(fields), last)
        if slot in schema.tables:
            builder = built.tables.setdefault(slot.json, TableBuilder(slot.columns))
            self.places.runs.setdefault((*built.path, slot.json), []).append((builder.count, content.span))
            table, faulty = builder.add(self.text, content.span)
            count = len(table)
            if faulty:
                self._faulty_rows(built, slot, content.span, table, faulty)
        else:
            self._fill(built, slot, fields, trimmed(self.text, *content.span))
        if behind:
            self._groups(built, behind)
        built.items.append(Item(slot.order, start, count))
        built.reach(start)

    def _faulty_rows(self, built: ParsedRecord, slot: FieldSpec, run: Span, table: Table, rows: list[int]) -> None:
        """Report the faults of some rows of a table; add forgotten braces around labels."""
        columns = record_schema(cast("type[Part]", slot.row)).columns
        faulty = set(rows)
        lines = [line for row, line in enumerate(line_spans(self.text, run)) if row in faulty]
        for number, (row, line) in enumerate(zip(rows, lines, strict=True)):
            if number == MOST_REPORTED:
                self.report(SYN002, f"{counted(len(rows) - number, 'more faulty row')} in this table", line)
                break
            before = len(self.problems)
            values, _ = self._fields(columns, self._cut(built, line, keys=False)[0], line)
            if any(problem.code not in (SYN002, SYN016) for problem in self.problems[before : before + 1]):
                del self.problems[before + 1 :]  # a row that is split wrongly has one problem
            labels = ((at, value) for at, value in enumerate(values.values()) if isinstance(value, Label))
            table.words.update(((row, at), label) for at, label in labels)

    def _cut(self, built: ParsedRecord, span: Span, *, keys: bool) -> tuple[list[Field], list[FieldGroup]]:
        """Return the fields of a row, and the settings after them if the record has `keys`."""
        behind: list[FieldGroup] = []
        if keys:
            line = read_line(self.text, span, slashes=self.slashes)
            problems = line.problems
            fields = [field for group in line.groups if not group.key for field in group.fields]
            behind = [group for group in line.groups if group.key]
        else:
            fields, problems = split(self.text, trimmed(self.text, *span), slashes=self.slashes)
        self._brackets(problems, built)
        if len(fields) == 1 and blank_separated(fields[0].text):
            fields = row_fields(self.text, fields[0].span, len(fields[0].text))
        return fields, behind

    @staticmethod
    def _slot_of_row(built: ParsedRecord, number: int, count: int, last: object) -> FieldSpec:
        """Return the field that a row fills, or the first of several."""
        schema = record_schema(built.part)
        if len(schema.row_names) == 1:
            return [*schema.columns, *schema.tables][0]
        name = built.part.row_slot(number, count, built.known, last)
        return next(slot for slot in schema.slots if slot.name == name)

    def _fill(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field], line: Span) -> None:
        """Read the fields of a row."""
        schema = record_schema(built.part)
        if slot.row and slot.json in built.values:
            expected = record_schema(slot.row).layout
            self.report(SYN001, f"only one line `{expected}` is allowed here: remove this line, or the one above", line)
        elif slot.row:
            self._inner_row(built, slot, fields, line)
        elif slot.many:
            self._list(built, slot, fields, None)
        elif len(schema.columns) == 1 or not any(column.row for column in schema.columns):
            self._columns(built, schema.columns, fields, line)
        elif slot.json in built.values:
            self.report(SYN001, f"{slot.label} is given twice", fields[0].span)
        else:
            self._columns(built, [slot], fields, line)

    def _columns(self, built: ParsedRecord, columns: Sequence[FieldSpec], fields: list[Field], line: Span) -> None:
        """Read fields that belong to the record itself."""
        values, fields = self._fields(columns, fields, line)
        built.values |= values
        self.places.add(built.path, None, [slot.json for slot in columns], fields)

    def _inner_row(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field], span: Span) -> None:
        """Read fields that belong to a row in the record."""
        row = cast("type[Part]", slot.row)
        columns = record_schema(row).columns
        values, fields = self._fields(columns, fields, span)
        names: Sequence[str | int] = [column.json for column in columns]
        if issubclass(row, ListRow):
            self.lost += any(value is UNKNOWN for value in values.values())
            built.values[slot.json] = [values.get(column.json) for column in columns[: len(values)]]
            names = range(len(columns))
        else:
            built.values[slot.json] = values
        self.places.add((*built.path, slot.json), span, names, fields)

    def _fields(
        self, columns: Sequence[FieldSpec], fields: list[Field], line: Span
    ) -> tuple[dict[str, Value], list[Field]]:
        """Return the values of a row, and its fields without those beyond the last column."""
        before = len(self.problems)
        fields = self._counted(columns, fields, line)
        # With a wrong count any value may belong to another column, except the number or name that begins the row.
        wrong = any(problem.weight is Severity.ERROR for problem in self.problems[before:])
        miscounted = wrong or bool(self.unclosed)
        values: dict[str, Value] = dict.fromkeys((slot.json for slot in columns), UNKNOWN) if miscounted else {}
        for slot, field in zip(columns, fields, strict=False):
            if not field.text:
                if slot.required and not miscounted:
                    expected = f": expected {slot.kind.value}" if slot.kind else ""
                    self.short(f"{slot.label} is missing{expected}", field.span)
                values[slot.json] = UNKNOWN if slot.required else None
                continue
            try:
                value = read_value(field, slot, self.problems)
            except UnreadableError as fault:
                self._unreadable(fault.problem)
                value = UNKNOWN
            if not wrong or (slot is columns[0] and (slot.is_text or slot.kind is _IDENT)):
                values[slot.json] = value
        return values, fields

    def _counted(self, columns: Sequence[FieldSpec], fields: list[Field], line: Span) -> list[Field]:
        """Return the fields without trailing empty ones; report a wrong number of fields."""
        columns = columns if self.older else [slot for slot in columns if slot.about.older is not True]
        required, kinds = [slot.required for slot in columns], [slot.kind for slot in columns]
        fewest = fewest_fields(required)
        if len(fields) == 1 and len(columns) > 1 and blank_separated(fields[0].text):
            fields = row_fields(self.text, fields[0].span, len(fields[0].text))
        while len(fields) > max(fewest, 1) and not fields[-1].text:
            fields.pop()
        if len(columns) > 1 and (problem := semicolons(self.text, fields)):
            self.problems.append(problem)
            return fields[:1]
        if len(columns) > 1 and (problem := missing_comma(fields, kinds, fewest)):
            self.problems.append(problem)
            return [field for field in fields[:1] if field.span != problem.span]
        if fewest <= len(fields) <= len(columns):
            if problem := mixed_commas(fields, kinds, fewest):
                self.problems.append(problem)
            return fields
        if self.unclosed:  # the open bracket contains the missing fields
            return fields[: len(columns)]
        if problem := decimal_comma(fields, kinds, fewest):
            self.problems.append(problem)
            return fields[: len(columns)]
        expected = row_format([slot.label for slot in columns], required)
        count = f"{fewest}" if fewest == len(columns) else f"{fewest} to {len(columns)}"
        message = f"{count} fields expected (`{expected}`), found {len(fields)}"
        span = Span(fields[0].span.start, fields[-1].span.end) if fields else line
        if len(fields) < fewest:
            self.short(message, span)
        else:
            self.report(SYN003, message, span)
        return fields[: len(columns)]

    def _list(self, built: ParsedRecord, slot: FieldSpec, fields: list[Field], span: Span | None) -> None:
        """Read fields that are the values of one field."""
        while len(fields) > 1 and not fields[-1].text:
            fields.pop()
        values: list[Value] = []
        read: list[Field] = []
        for field in fields:
            try:
                values.append(read_value(field, slot, self.problems))
                read.append(field)
            except UnreadableError as fault:
                self._unreadable(fault.problem)
                values = Partly(values)
        built.values[slot.json] = values
        self.places.add((*built.path, slot.json), span, range(len(read)), read)


def _value_of(slot: FieldSpec) -> str:
    """Return a placeholder for the value of a setting: the kind of its name, if any."""
    if slot.about.names is Names.SET:
        return ": write the name of a set after it (ALL is every element)"
    return ": write the name of the set after it" if slot.key == "SET" else ""


def _alone(slot: FieldSpec, fields: list[Field]) -> bool:
    """Return True if a setting that may hold a row holds a single word or number."""
    if not (slot.choices or slot.kind) or any(field.text for field in fields[1:]):
        return False
    return not blank_separated(fields[0].text)
