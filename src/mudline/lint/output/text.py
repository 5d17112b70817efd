"""Findings for people: the place, the message, the source line with a mark under the fault."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rich.cells import cell_len
from rich.text import Text

from mudline.diagnostics import Diagnostic, Severity
from mudline.syntax.source import Source

STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold blue"}
_EXCERPT = 110
_BEFORE = 40


def findings(diagnostics: Iterable[Diagnostic], source: Source) -> Iterator[Text]:
    """Every finding in one file, as styled plain text; deck text is never read as markup."""
    for found in diagnostics:
        yield _headline(found)
        yield from excerpt(found, source)


def _headline(found: Diagnostic) -> Text:
    style = STYLES[found.severity]
    return Text.assemble(
        (visible(f"{found.file}:{found.line}:{found.column}"), "bold"),
        ": ",
        (found.severity.value, style),
        " ",
        (found.code, style),
        f" {visible(found.message)} ",
        (f"[{found.slug}]", "dim"),
    )


def excerpt(found: Diagnostic, source: Source) -> Iterator[Text]:
    """The source line with a caret under the fault; a long line is cut around it."""
    line = source.line(found.line) if found.line <= len(source.line_starts) else ""
    if not line.strip():
        yield Text("")
        return
    start = min(found.column - 1, len(line))
    end = min(found.end_column - 1, len(line)) if found.end_line == found.line else len(line)
    first = max(0, start - _BEFORE) if len(line) > _EXCERPT else 0
    last = min(len(line), first + _EXCERPT)
    left, right = "..." if first else "", "..." if last < len(line) else ""
    number = str(found.line)
    margin = " " * len(number)
    shown = left + visible(line[first:last]) + right
    before = cell_len(left + visible(line[first:start]))
    marks = "^" * max(1, cell_len(visible(line[start : min(end, last)])))
    yield Text.assemble((f" {number} | ", "cyan"), shown)
    yield Text.assemble((f" {margin} | ", "cyan"), " " * before, (marks, STYLES[found.severity]))


def visible(text: str) -> str:
    """Text in which nothing can act on a terminal: tabs are blanks, control characters a replacement mark."""
    return "".join(" " if char == "\t" else char if char.isprintable() else "\ufffd" for char in text)


def summary(diagnostics: list[Diagnostic], files: int) -> Text:
    """How many findings of each severity there are."""
    where = f"{files} file{'s' * (files != 1)}"
    if not diagnostics:
        return Text(f"No findings in {where}.", style="green")
    counts = {severity: sum(found.severity is severity for found in diagnostics) for severity in STYLES}
    words = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "info"}
    parts = [
        (f"{count} {words[severity]}{'s' * (count != 1 and severity is not Severity.INFO)}", STYLES[severity])
        for severity, count in counts.items()
        if count
    ]
    text = Text("Found ")
    for index, part in enumerate(parts):
        text.append(", " if index else "")
        text.append(*part)
    return text.append(f" in {where}.")
