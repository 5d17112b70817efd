"""The fields of a line to values, each with its place, by the fields that are declared for the line."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.codes import SYN003
from mudline.diagnostics import Problem, Span
from mudline.keywords.fields import Value, decimal_comma, read_value
from mudline.keywords.findings import Findings
from mudline.keywords.layout import Slot
from mudline.keywords.places import Path
from mudline.keywords.table import Column
from mudline.keywords.table_reading import count, fewest, wanted
from mudline.keywords.text import shown
from mudline.syntax.fields import Field
from mudline.syntax.rows import blank_separated


class FieldReader:
    """Reads the fields of the lines of one block.

    A line is `cut` when a bracket in it is not closed: its last field is left out, and how many there are is not told.
    """

    def __init__(self, text: str, findings: Findings) -> None:
        self.text = text
        self.findings = findings

    def apart(self, fields: Sequence[Field]) -> Sequence[Field]:
        """The fields of a line, numbers parted by blanks where it holds nothing else."""
        if len(fields) != 1 or not blank_separated(fields[0].text):
            return fields
        start = fields[0].span.start
        found: list[Field] = []
        for word in fields[0].text.split():
            start = self.text.index(word, start)
            found.append(Field(word, Span(start, start + len(word))))
            start += len(word)
        return found

    def single(self, slot: Slot, fields: Sequence[Field], path: Path) -> Value:
        """The one value of a setting; None when there is none that can be read."""
        fields = self._trimmed(fields, 1)
        where = Span(fields[0].span.start, fields[-1].span.end)
        if len(fields) > 1:
            self._decimal_comma(fields, [slot.column])
            message = f"{slot.label} takes one value, found {len(fields)}: {shown(self.text[slice(*where)])}"
            self.findings.damage(path, Problem(SYN003, message, where))
        if not fields[0].text:
            return None
        self.findings.places.spans[*path, slot.json] = fields[0].span
        return self._value(slot, fields[0], path)

    def many(self, slot: Slot, fields: Sequence[Field], path: Path) -> list[Value]:
        """A list of values on a line; what cannot be read is left out."""
        values: list[Value] = []
        for field in self._trimmed(fields, 1):
            value = self._value(slot, field, path)
            if value is not None:
                self.findings.places.spans[*path, slot.json, len(values)] = field.span
                values.append(value)
        return values

    def row(
        self, columns: Sequence[Slot], fields: Sequence[Field], path: Path, *, cut: bool, by_index: bool = False
    ) -> dict[str, Value]:
        """The values of a row by their names in JSON, None for an empty or unreadable field.

        `by_index`: JSON holds the row as a list, so that the place of a value is its index.
        """
        fields = self._trimmed(fields, len(columns))
        complete = not cut and self._counted(columns, fields, path)
        values: dict[str, Value] = {}
        for index, (slot, field) in enumerate(zip(columns, fields, strict=False)):
            self.findings.places.spans[*path, index if by_index else slot.json] = field.span
            values[slot.json] = self._value(slot, field, path, complete=complete)
        return values

    def _value(self, slot: Slot, field: Field, path: Path, *, complete: bool = True) -> Value:
        """The value of one field; that it is missing is told where the row is `complete`."""
        if not field.text:
            if slot.required and complete:
                self.findings.damage(path, Problem(SYN003, f"{slot.label} is missing", field.span))
            return None
        value, problem = read_value(field, slot)
        if problem:
            self.findings.tell(problem)
        if value is None:
            self.findings.damage(path)
        return value

    def _counted(self, columns: Sequence[Slot], fields: Sequence[Field], path: Path) -> bool:
        """Whether there are as many fields as there may be."""
        shape = [slot.column for slot in columns]
        if fewest(shape) <= len(fields) <= len(shape):
            return True
        self._decimal_comma(fields, shape)
        found = "1 field" if len(fields) == 1 else f"{len(fields)} fields"
        message = f"{found}, expected {count(shape)}: `{wanted(shape)}`"
        self.findings.damage(path, Problem(SYN003, message, Span(fields[0].span.start, fields[-1].span.end)))
        return False

    def _decimal_comma(self, fields: Sequence[Field], columns: Sequence[Column]) -> None:
        if problem := decimal_comma(fields, columns):
            self.findings.tell(problem)

    def _trimmed(self, fields: Sequence[Field], most: int) -> Sequence[Field]:
        """Without the empty fields that trailing commas leave behind the last one that may stand."""
        end = len(fields)
        while end > most and not fields[end - 1].text:
            end -= 1
        return fields[:end]
