"""Runs of rows to one table, and every fault in them as a problem."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from mudline.codes import SYN001, SYN002, SYN003
from mudline.diagnostics import Problem, Span
from mudline.keywords.fields import decimal_comma, missing_braces
from mudline.keywords.findings import MOST_TOLD, Findings
from mudline.keywords.layout import Layout
from mudline.keywords.places import Path, Runs
from mudline.keywords.table import Table
from mudline.keywords.table_reading import WHOLE_ROW, check, explain
from mudline.keywords.text import shown
from mudline.keywords.values import Label
from mudline.syntax.fields import Field, split
from mudline.syntax.rows import Rows, read_rows

_ROW_STARTS = "-+.,0123456789=[{"


class TableBuilder:
    """Collects the runs of one table, and reads them together.

    `expected` says in words what lines the keyword has.
    """

    def __init__(self, text: str, findings: Findings, row: Layout, path: Path, expected: str) -> None:
        self.text = text
        self.findings = findings
        self.columns = [slot.column for slot in row.columns]
        self.path = path
        self.expected = expected
        self.runs = Runs(text)

    def add(self, span: Span) -> int:
        """Take in one run; returns its number of rows."""
        self.findings.places.runs[self.path] = self.runs
        return self.runs.add(span)

    def finish(self) -> Table:
        """All rows in one table."""
        raw = self._rows()
        table, faults, doubts = check(raw, self.columns)
        self.findings.lost += any(column == 0 for _, column in faults)
        for row, places in groupby(faults[:MOST_TOLD], key=lambda place: place[0]):
            self._tell_row(raw, row, [column for _, column in places])
        for row, column in doubts[: MOST_TOLD + 1]:
            word = Field(raw.words[row, column], self.runs.cell(row, column))
            self.findings.tell(missing_braces(word, Label("{" + word.text + "}")))
        if len(faults) > MOST_TOLD:
            message = f"{len(faults) - MOST_TOLD} more faulty fields or rows in this table: only the first are listed"
            self._damage(Problem(SYN002, message, self.runs.line(faults[-1][0])))
        return table

    def _damage(self, problem: Problem) -> None:
        self.findings.damage(self.path[:-1], problem)

    def _rows(self) -> Rows:
        spans = self.runs.spans
        if len(spans) == 1:
            return read_rows(self.text, spans[0], len(self.columns))
        pieces = (self.text[slice(*span)] for span in spans)
        joined = "".join(piece if piece.endswith("\n") else f"{piece}\n" for piece in pieces)
        return read_rows(joined, Span(0, len(joined)), len(self.columns))

    def _tell_row(self, raw: Rows, row: int, faults: Sequence[int]) -> None:
        """The faults of one row; of an unclosed bracket that alone, of text that is no row at all one fault."""
        line = self.runs.line(row)
        fields, problems = split(self.text, line)
        if not problems and WHOLE_ROW in faults and self.text[line.start] not in _ROW_STARTS:
            message = f"{shown(self.text[slice(*line)])} is no line of this keyword: expected {self.expected}"
            problems = [Problem(SYN001, message, line)]
        for problem in problems:
            self._damage(problem)
        for column in faults if not problems else ():
            self._tell(raw, row, column, fields)

    def _tell(self, raw: Rows, row: int, column: int, fields: list[Field]) -> None:
        message, place = explain(raw, self.columns, row, column), self.runs.cell(row, column)
        if column == WHOLE_ROW:
            if comma := decimal_comma(fields, self.columns):
                self.findings.tell(comma)
            self._damage(Problem(SYN003, message, place))
        else:
            missing = raw.words.get((row, column)) == ""
            self._damage(Problem(SYN003 if missing else SYN002, message, place))
