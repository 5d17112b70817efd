"""Verdicts as they come: findings and a table for people, JSON and CSV in pieces. No text of a deck is kept."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from textwrap import indent
from typing import Protocol

from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.progress import Progress
from mudline.cli.streams import emit
from mudline.cli.verdict import Total, Verdict
from mudline.diagnostics import Diagnostic
from mudline.linting.output.json_objects import as_object
from mudline.results.quantities import csv_lines
from mudline.syntax.source import Source


class Report(Protocol):
    """What is told of each deck, and of all of them."""

    def add(self, verdict: Verdict, found: list[Diagnostic], data: bytes) -> None:
        """Tell of a deck by its content."""

    def finish(self, total: Total) -> None:
        """Tell what stands at the end."""


def report(form: str, view: View, progress: Progress) -> Report:
    """The report in a form: "text", "json" or "csv"."""
    if form == "json":
        return _Json()
    return _Csv() if form == "csv" else _Text(view, progress)


class _Text:
    """The findings of each deck at once; the table, whose widths all rows decide, at the end."""

    def __init__(self, view: View, progress: Progress) -> None:
        self.view = view
        self.progress = progress
        self.verdicts: list[Verdict] = []

    def add(self, verdict: Verdict, found: list[Diagnostic], data: bytes) -> None:
        self.verdicts.append(verdict)
        if found and not self.view.quiet:
            with self.progress.hidden():
                printing("lint").print_findings(found, Source.from_bytes(data, verdict.file), self.view.color)

    def finish(self, total: Total) -> None:
        if self.verdicts:
            printing("validate").print_verdicts(self.verdicts, total, self.view.color)


class _Json:
    """One object; its decks are written when they are judged."""

    def __init__(self) -> None:
        self.mark = '{\n "decks": ['

    def add(self, verdict: Verdict, found: list[Diagnostic], data: bytes) -> None:  # noqa: ARG002 - what a text shows
        row = {**asdict(verdict), "findings": [as_object(each) for each in found]}
        emit([self.mark, "\n", indent(json.dumps(row, indent=1, ensure_ascii=False), "  ")])
        self.mark = ","

    def finish(self, total: Total) -> None:
        begin = f"{self.mark}]" if self.mark != "," else "\n ]"
        rows = indent(json.dumps(asdict(total), indent=1), " ").lstrip()
        emit([begin, f',\n "total": {rows}\n}}\n'])


class _Csv:
    """A line a deck."""

    def __init__(self) -> None:
        emit(csv_lines([[field.name for field in fields(Verdict)]]))

    def add(self, verdict: Verdict, found: list[Diagnostic], data: bytes) -> None:  # noqa: ARG002 - what a text shows
        emit(csv_lines([asdict(verdict).values()]))

    def finish(self, total: Total) -> None:
        """The table has no more rows than decks."""
