"""The tree of a block to plain values, with the place of each and every fault of a field as one problem."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from mudline.codes import SYN001, SYN003, SYN004
from mudline.diagnostics import Problem, Span
from mudline.keywords.built import Built
from mudline.keywords.field_reader import FieldReader
from mudline.keywords.fields import Value
from mudline.keywords.findings import Findings
from mudline.keywords.formats import every_line
from mudline.keywords.grammar import Content, Node
from mudline.keywords.layout import Slot
from mudline.keywords.model import Block, ListRow, Record, Row, RowAt, layout
from mudline.keywords.places import Path
from mudline.keywords.tables import TableBuilder
from mudline.keywords.text import either, shown, suggestion
from mudline.syntax.fields import Field, Group, read_line, split, trimmed


class Builder:
    """Reads the lines of one block."""

    def __init__(self, text: str, declared: type[Block], findings: Findings) -> None:
        self.text = text
        self.declared = declared
        self.findings = findings
        self.reader = FieldReader(text, findings)
        self.sticky: dict[str, Value] = {}

    def build(self, part: type[Record], node: Node, path: Path = ()) -> Built:
        """The values of a record."""
        built = Built(part, path)
        for child in node.children:
            if isinstance(child, Node):
                self._child(built, child)
                continue
            if not built.items:
                self.findings.places.spans[path] = trimmed(self.text, *child.span)
            if child.key:
                self._settings(built, child)
            else:
                self._row(built, child)
                built.rows += 1
        self._finish(built)
        return built

    def _finish(self, built: Built) -> None:
        """Put in the tables, a mandatory one without rows too; any other mandatory field that is missing is damage."""
        for slot in layout(built.part).slots:
            if slot.table and (slot.required or slot.json in built.tables):
                built.values[slot.json] = self._table(built, slot).finish()
            elif slot.required and slot.json not in built.values:
                self.findings.damage(built.path)

    def _child(self, built: Built, node: Node) -> None:
        slot = layout(built.part).children[node.rule]
        before = built.children.get(slot.json, [])
        child = self.build(slot.record[node.rule], node, (*built.path, slot.json, len(before)))
        if child.items:
            built.add_child(slot, child)

    def _table(self, built: Built, slot: Slot) -> TableBuilder:
        if slot.json not in built.tables:
            path = (*built.path, slot.json)
            row = layout(cast("type[Row]", slot.row))
            built.tables[slot.json] = TableBuilder(self.text, self.findings, row, path, every_line(self.declared))
        return built.tables[slot.json]

    # -------------------------------------------------------------------------------------------------- settings

    def _settings(self, built: Built, content: Content) -> None:
        """A line of settings: the one it begins with, and those that may follow it."""
        keys = layout(built.part).keys
        line = read_line(self.text, content.span, slashes=self.declared.slashes)
        for problem in line.problems:
            self.findings.damage(built.path, problem)
        built.add(keys[content.key], content.position)
        for index, group in enumerate(line.groups):
            key = group.key if index else content.key
            if key not in keys:
                guess = suggestion(key, list(keys))
                allowed = either(f"{name}=" for name in keys)
                message = f"{shown(key)} is no setting of this line{guess}: it takes {allowed}"
                self.findings.damage(built.path, Problem(SYN004, message, group.span))
            elif keys[key].json in built.values:
                self.findings.damage(built.path, Problem(SYN001, f"{key}= is given twice", group.span))
            else:
                cut = bool(line.problems) and group is line.groups[-1]
                self._setting(built, keys[key], group, cut=cut)

    def _setting(self, built: Built, slot: Slot, group: Group, *, cut: bool) -> None:
        """One setting; what is behind an unclosed bracket is left out."""
        path = (*built.path, slot.json)
        fields = group.fields[:-1] if cut else group.fields
        self.findings.places.spans[path] = group.span
        if slot.row:
            built.values[slot.json] = self._values(slot.row, self.reader.apart(fields), path, cut=cut)
            return
        if fields and not fields[0].text:
            self.findings.damage(built.path, Problem(SYN003, f"{slot.label} has no value", group.span))
        value = self.reader.single(slot, fields, built.path) if fields else None
        if value is not None:
            built.values[slot.json] = value
            self.sticky |= {slot.json: value} if slot.sticky else {}
        elif slot.required:
            self.findings.lose()

    # ------------------------------------------------------------------------------------------------------ rows

    def _row(self, built: Built, content: Content) -> None:
        """A row, or a run of rows where the record has nothing but a table."""
        found = layout(built.part)
        if found.table and not found.columns:
            built.add(found.table, content.position, self._table(built, found.table).add(content.span))
            return
        given, problems = split(self.text, content.span, slashes=self.declared.slashes)
        fields = self.reader.apart(given)
        slot = built.part.row_slot(RowAt(built.rows, len(fields), {**self.sticky, **built.values}))
        if slot.table:
            built.add(slot, content.position, self._table(built, slot).add(content.span))
            return
        for problem in problems:
            self.findings.damage(built.path, problem)
        built.add(slot, content.position)
        span = trimmed(self.text, *content.span)
        if slot.json in built.values:
            self.findings.damage(built.path, Problem(SYN001, f"{slot.label} is given twice", span))
        else:
            self._plain_row(built, slot, fields[:-1] if problems else fields, span, cut=bool(problems))

    def _plain_row(self, built: Built, slot: Slot, fields: Sequence[Field], span: Span, *, cut: bool) -> None:
        """A row that stands by itself: a row of its own kind, a list, one value, or the columns of the record."""
        found = layout(built.part)
        if slot.row:
            path = (*built.path, slot.json)
            self.findings.places.spans[path] = span
            built.values[slot.json] = self._values(slot.row, fields, path, cut=cut)
        elif slot.many:
            built.values[slot.json] = self.reader.many(slot, fields, built.path)
        else:
            columns = found.columns if found.plain_row else [slot]
            built.values |= self.reader.row(columns, fields, built.path, cut=cut)

    def _values(
        self, row: type[Row], fields: Sequence[Field], path: Path, *, cut: bool
    ) -> dict[str, Value] | list[Value]:
        """The values of a row as JSON holds it; what a list of numbers stands for is lost when one cannot be read."""
        columns = layout(row).columns
        by_index = issubclass(row, ListRow)
        values = self.reader.row(columns, fields, path, cut=cut, by_index=by_index)
        if cut:
            self.findings.damage(path)
        if by_index and path in self.findings.places.damaged:
            self.findings.lose()
        return list(values.values()) if by_index else values
