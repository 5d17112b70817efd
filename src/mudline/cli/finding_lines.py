"""Findings for people: place and message, then the source line with a mark under the fault."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence

from mudline.basics.short_repr import counted
from mudline.checks.output import visible
from mudline.cli.streams import Line, Part, View
from mudline.language.diagnostics import Diagnostic, Severity, Span
from mudline.language.syntax.source import Source

EXCERPT_WIDTH = 120
"""Columns of a source line that are shown without a terminal."""

STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold blue"}

_CUT = "..."
_NARROWEST_LINE = 20
_FOLLOWS = "    follows: "


def print_findings(view: View, findings: Iterable[Diagnostic], source: Source) -> None:
    """Print the findings of one file, each with its source line; with `-v` also the findings that follow from it."""
    view.lines(_lines(findings, source, view))


def _lines(findings: Iterable[Diagnostic], source: Source, view: View) -> Iterator[Line]:
    width, encoding = min(view.width or EXCERPT_WIDTH, EXCERPT_WIDTH), (sys.stdout.encoding or "utf-8").lower()
    for finding in findings:
        yield _headline(finding, encoding)
        yield from excerpt(finding, source, width, encoding)
        for each in finding.following if view.verbose else ():
            yield [_FOLLOWS, *_headline(each, encoding)]


def print_summary(view: View, findings: Sequence[Diagnostic], files: int) -> None:
    """Print how many findings of each severity there are in how many files."""
    parts: list[Part] = []
    for severity, style in STYLES.items():
        if count := sum(finding.severity is severity for finding in findings):
            word = f"{count} {severity.value}" if severity is Severity.INFO else counted(count, severity.value)
            parts += [", ", (word, style)]
    view.lines([["Found ", *parts[1:], f" in {counted(files, 'file')}."]])


def _headline(finding: Diagnostic, encoding: str) -> list[Part]:
    style = STYLES[finding.severity]
    return [
        (visible(f"{finding.file}:{finding.line}:{finding.column}", encoding), "bold"),
        ": ",
        (finding.severity.value, style),
        " ",
        (finding.code, style),
        f" {visible(finding.message, encoding)} ",
        (f"[{finding.slug}]", "dim"),
    ]


def excerpt(finding: Diagnostic, source: Source, width: int, encoding: str = "utf-8") -> Iterator[Line]:
    """Yield the source line with a mark under the fault; a long line is cut around it."""
    line = source.line_span(finding.line)
    number = str(finding.line)
    width = max(_NARROWEST_LINE, width - len(f" {number} | "))
    start = min(line.start + finding.column - 1, line.end)
    end = min(line.start + finding.end_column - 1, line.end) if finding.end_line == finding.line else line.end
    piece = _window(source.text, line, start, width, encoding)
    if not source.readable or not source.text[slice(*piece)].strip():
        yield []
        return

    def shown(first: int, last: int) -> str:
        return visible(source.text[first:last], encoding)

    left, right = _CUT if piece.start > line.start else "", _CUT if piece.end < line.end else ""
    before = _cells(left + shown(piece.start, start))
    marks = "^" * max(1, _cells(shown(start, min(end, piece.end))))
    yield [(f" {number} | ", "cyan"), left + shown(*piece) + right]
    yield [(f" {' ' * len(number)} | ", "cyan"), " " * before, (marks, STYLES[finding.severity])]


def _window(text: str, line: Span, start: int, width: int, encoding: str) -> Span:
    """Return the part of a line that fits into `width` columns and shows the text around `start`."""
    if line.end - line.start <= width and _cells(visible(text[slice(*line)], encoding)) <= width:
        return line
    first = max(line.start, start - width // 3)
    left = width - 2 * len(_CUT)
    last = first
    while last < line.end and (left := left - _cells(visible(text[last], encoding))) >= 0:
        last += 1
    return Span(first, max(last, min(start + 1, line.end)))


def _cells(text: str) -> int:
    """Return the columns that a text without control characters takes."""
    if text.isascii():
        return len(text)
    from rich.cells import cell_len  # noqa: PLC0415 - most decks are ASCII

    return cell_len(text)
