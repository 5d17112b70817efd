"""Findings for people: the place, the message, the source line with a mark under the fault."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rich.cells import cell_len
from rich.text import Text

from mudline.diagnostics import Diagnostic, Severity, Span
from mudline.linting.output import visible
from mudline.syntax.source import Source

STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold blue"}
_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "info"}
_CUT = "..."
_NARROWEST = 20
_FOLLOWS = "    follows: "


@dataclass(frozen=True, slots=True)
class Screen:
    """What findings are shown on: its width in columns, and its encoding."""

    width: int
    encoding: str = "utf-8"


def findings(
    diagnostics: Iterable[Diagnostic], source: Source, screen: Screen, *, following: bool = False
) -> Iterator[Text]:
    """Every finding in one file, as styled plain text; deck text is never read as markup.

    With `following` those that follow from a finding are shown too, indented below it.
    """
    for found in diagnostics:
        yield _headline(found, screen)
        yield from excerpt(found, source, screen)
        for one in found.following if following else ():
            yield Text(_FOLLOWS).append_text(_headline(one, screen))


def _headline(found: Diagnostic, screen: Screen) -> Text:
    style = STYLES[found.severity]
    return Text.assemble(
        (visible(f"{found.file}:{found.line}:{found.column}", screen.encoding), "bold"),
        ": ",
        (found.severity.value, style),
        " ",
        (found.code, style),
        f" {visible(found.message, screen.encoding)} ",
        (f"[{found.slug}]", "dim"),
    )


def excerpt(found: Diagnostic, source: Source, screen: Screen) -> Iterator[Text]:
    """The source line with a mark under the fault; a long line is cut around it."""
    line = _line_span(source, found.line)
    number = str(found.line)
    width = max(_NARROWEST, screen.width - len(f" {number} | "))
    start = min(line.start + found.column - 1, line.end)
    end = min(line.start + found.end_column - 1, line.end) if found.end_line == found.line else line.end
    piece = _window(source.text, line, start, width, screen)
    if not source.readable or not source.text[slice(*piece)].strip():
        yield Text("")
        return

    def shown(first: int, last: int) -> str:
        return visible(source.text[first:last], screen.encoding)

    left, right = _CUT if piece.start > line.start else "", _CUT if piece.end < line.end else ""
    before = cell_len(left + shown(piece.start, start))
    marks = "^" * max(1, cell_len(shown(start, min(end, piece.end))))
    yield Text.assemble((f" {number} | ", "cyan"), left + shown(*piece) + right)
    yield Text.assemble((f" {' ' * len(number)} | ", "cyan"), " " * before, (marks, STYLES[found.severity]))


def _line_span(source: Source, number: int) -> Span:
    """A line without its end, as offsets: a line may be the whole of a large file, and is not copied."""
    starts, text = source.line_starts, source.text
    if number > len(starts):
        return Span(len(text), len(text))
    start, end = starts[number - 1], starts[number] if number < len(starts) else len(text)
    while end > start and text[end - 1] in "\r\n":
        end -= 1
    return Span(start, end)


def _window(text: str, line: Span, start: int, width: int, screen: Screen) -> Span:
    """The part of a line that fits into `width` columns and shows what stands before and behind `start`."""
    if line.end - line.start <= width and cell_len(visible(text[slice(*line)], screen.encoding)) <= width:
        return line
    first = max(line.start, start - width // 3)
    left = width - 2 * len(_CUT)
    last = first
    while last < line.end and (left := left - cell_len(visible(text[last], screen.encoding))) >= 0:
        last += 1
    return Span(first, max(last, min(start + 1, line.end)))


def summary(diagnostics: list[Diagnostic], files: int) -> Text:
    """How many findings of each severity there are."""
    text = Text("Found ")
    for severity, style in STYLES.items():
        if count := sum(found.severity is severity for found in diagnostics):
            plural = "s" if count != 1 and severity is not Severity.INFO else ""
            text.append(", " if len(text) > len("Found ") else "")
            text.append(f"{count} {_WORDS[severity]}{plural}", style)
    return text.append(f" in {files} file{'s' * (files != 1)}.")
