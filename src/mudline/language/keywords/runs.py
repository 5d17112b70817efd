"""Runs of rows to the table of a record, with every fault of a row or a field as one problem."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.fields import SYN002, SYN003, SYN016
from mudline.language.diagnostics import Problem, Span
from mudline.language.keywords.model import FieldSpec
from mudline.language.keywords.numbers import not_a_number
from mudline.language.keywords.table import Column, Table, from_rows, row_format
from mudline.language.keywords.text import decimal_comma, in_braces, maybe_label, semicolons
from mudline.language.keywords.values import Equation, Kind, Label
from mudline.language.syntax.fields import split
from mudline.language.syntax.rows import Rows as RawRows
from mudline.language.syntax.rows import read_rows, row_fields, row_starts


class BlockReading(Protocol):
    """The reading of a block, which a table in it adds to."""

    text: str
    problems: list[Problem]
    unclosed: Span | None

    def short(self, message: str, span: Span) -> None:
        """Note a row that is too short."""


class TableBuilder:
    """Collects the runs of one table."""

    def __init__(self, builder: BlockReading, slot: FieldSpec) -> None:
        self.builder = builder
        self.columns: list[Column] = slot.columns
        self.runs: list[tuple[int, Span]] = []
        self.parts: list[Table] = []
        self.count = 0

    def add(self, span: Span) -> int:
        """Read one run; returns its number of rows."""
        text = self.builder.text
        raw = read_rows(text, span, len(self.columns))
        self.runs.append((self.count, span))
        table, faults = from_rows(raw, self.columns)
        if faults:
            self._report(span, raw, table, faults)
        self.parts.append(table)
        self.count += len(table)
        return len(table)

    def finish(self) -> Table:
        """All rows in one table."""
        if len(self.parts) == 1:
            return self.parts[0]
        width = max((part.values.shape[1] for part in self.parts), default=0)
        values = np.full((self.count, width), np.nan)
        words: dict[tuple[int, int], Equation | Label | None] = {}
        start = 0
        for part in self.parts:
            values[start : start + len(part), : part.values.shape[1]] = part.values
            words |= {(row + start, column): word for (row, column), word in part.words.items()}
            start += len(part)
        lengths = [part.lengths for part in self.parts] or [np.zeros(0, dtype=np.intp)]
        return Table(values, np.concatenate(lengths), words)

    def _report(self, span: Span, raw: RawRows, table: Table, faults: dict[tuple[int, int], str]) -> None:
        text = self.builder.text
        starts = row_starts(text, span)

        def line(row: int) -> Span:
            end = text.find("\n", starts[row], span.end)
            return Span(starts[row], span.end if end < 0 else end)

        short = {row for row, column in faults if column < 0}
        reported = 0
        broken: set[int] = set()
        for (row, column), fault in sorted(faults.items()):
            if row in short and column >= 0:
                continue
            if self._label(table, raw, line(row), row, column):
                continue
            reported += 1
            if reported > MOST_REPORTED:
                continue
            if row not in broken and self._brackets(line(row)):
                broken.add(row)
            if row not in broken:
                self._fault(line(row), row, column, fault, raw)
        if reported > MOST_REPORTED:
            message = f"{reported - MOST_REPORTED} more faulty rows or fields in this table"
            self.builder.problems.append(Problem(SYN002, message, line(-1)))

    def _label(self, table: Table, raw: RawRows, line: Span, row: int, column: int) -> bool:
        """A word where a node number belongs is taken for a label whose braces were forgotten."""
        word = raw.words.get((row, column), "")
        if column < 0 or self.columns[column].kind is not Kind.IDENT or (label := maybe_label(word)) is None:
            return False
        table.words[row, column] = label
        place = row_fields(self.builder.text, line, len(self.columns))[column].span
        message = f"{word!r} is not a number: if it is a label, write {label}"
        self.builder.problems.append(Problem(SYN016, message, place, repair=in_braces(word, place)))
        return True

    def _brackets(self, line: Span) -> bool:
        """Whether the fault of a row is an unclosed bracket, which is then reported instead."""
        _, problems = split(self.builder.text, line)
        for problem in problems:
            if problem.span != self.builder.unclosed:
                self.builder.problems.append(problem)
        return bool(problems)

    def _fault(self, line: Span, row: int, column: int, fault: str, raw: RawRows) -> None:
        text = self.builder.text
        if column < 0:
            fields, _ = split(text, line)
            required = [column.required for column in self.columns]
            if problem := decimal_comma(fields, [column.kind for column in self.columns], sum(required)):
                self.builder.problems.append(problem)
                return
            if problem := semicolons(text, fields):
                self.builder.problems.append(problem)
                return
            wanted = row_format([column.label for column in self.columns], required)
            place = Span(fields[0].span.start, fields[-1].span.end)
            message = f"{fault} (`{wanted}`)"
            if len(fields) < sum(required):
                self.builder.short(message, place)
            else:
                self.builder.problems.append(Problem(SYN003, message, place))
            return
        place = row_fields(text, line, len(self.columns))[column].span
        word = raw.words.get((row, column))
        if word == "":
            self.builder.short(fault, place)
            return
        if word and (problem := semicolons(text, row_fields(text, line, len(self.columns)))):
            self.builder.problems.append(problem)
            return
        wrong = word and not_a_number(word, place, self.columns[column].label, self.columns[column].kind)
        self.builder.problems.append(wrong or Problem(SYN002, fault, place))
