"""Report of `mudline lint`: immediately for people, at the end for programs, on standard output and in files."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

import click

from mudline.basics.installed import may_declare
from mudline.basics.overwriting import claim
from mudline.basics.short_repr import counted
from mudline.checks.configuration import Configured
from mudline.checks.output import TEXT, by_severity, form_module, form_names, visible
from mudline.checks.pages import GROUP
from mudline.cli.inputs import Input
from mudline.cli.streams import emit, notify, say, write_text
from mudline.cli.view import Line, Part, View
from mudline.language.diagnostics import Coverage, Diagnostic, Severity, Span
from mudline.language.syntax.source import Source


def outputs(given: Sequence[str]) -> tuple[str, list[tuple[str, Path]]]:
    """Return the format of standard output, and formats and files, from values of `--output-format`.

    A value is FORM or FORM=FILE. Raises click.UsageError.
    """
    known = [TEXT, *form_names()]
    printed: list[str] = []
    files: list[tuple[str, Path]] = []
    for word in given:
        name, mark, path = word.partition("=")
        if name not in known:
            raise click.UsageError(f"--output-format: {name!r} is not one of {', '.join(known)}")
        if not mark:
            printed.append(name)
        elif not path or name == TEXT:
            what = "text goes to the terminal: write concise=FILE" if path else f"write a file name after {name}="
            raise click.UsageError(f"--output-format {word}: {what}")
        else:
            claim(path, f"--output-format {name}:")
            files.append((name, Path(path)))
    if len(set(printed)) > 1:
        raise click.UsageError(f"--output-format: standard output takes one form, not {', '.join(printed)}")
    return (printed[0] if printed else TEXT), files


class LintOptions(NamedTuple):
    """Options of a run; `recording` writes its findings into the file `baseline`, which else hides them."""

    fix: bool
    diff: bool
    baseline: str | None
    recording: bool
    fail_on: str | None
    statistics: bool
    jobs: int

    @property
    def fixing(self) -> bool:
        """Return True if fixes are made, or shown."""
        return self.fix or self.diff


@dataclass(eq=False)
class LintReport:
    """Findings of a run. With `aside`, findings go to standard error, since standard output carries something else."""

    form: str
    outputs: Sequence[tuple[str, Path]]
    view: View
    configured: Configured
    wanted: LintOptions
    aside: bool
    found: list[Diagnostic] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    fixed: int = 0
    failing: bool = False
    coverage: Coverage = field(default_factory=Coverage)

    def add(self, file: Input, data: bytes, findings: list[Diagnostic], fixed: int) -> None:
        """Add the remaining findings of a file, its content `data`, and the number of fixed findings."""
        name, configuration = file.name, self.configured.of(file.place)
        limit = Severity(self.wanted.fail_on or configuration.value("fail-on"))
        self.names.append(name)
        self.found += findings
        self.fixed += fixed
        self.failing = self.failing or any(finding.severity.rank >= limit.rank for finding in findings)
        as_they_come = self.form == TEXT and not (self.view.quiet or self.wanted.statistics or self.aside)
        if as_they_come and findings:
            shown = findings if self.view.verbose else [*_with_style_folded(findings)]
            print_findings(self.view, shown, Source.from_bytes(data, name))
        if self.view.verbose:
            notify(f"{name}: {counted(len(findings), 'finding')}")

    def finish(self) -> None:
        """Write and print the outputs that need all findings."""
        findings = sorted(self.found, key=lambda diagnostic: diagnostic.sort_key)
        for name, path in self.outputs:
            write_text(path, self._in_form(name, findings))
        printed = "concise" if self.form == TEXT else self.form
        pieces = statistics_lines(findings) if self.wanted.statistics else self._in_form(printed, findings)
        if self.aside:
            for piece in pieces:
                click.echo(piece, err=True, nl=False)
            if self.wanted.fixing and not self.view.quiet and printed == "concise":
                click.echo(self._fixed_summary(findings), err=True)
        elif self.wanted.statistics or self.view.quiet or self.form != TEXT:
            emit(pieces)
        elif self.names:
            self._summary(findings)

    def _in_form(self, name: str, findings: list[Diagnostic]) -> Iterator[str]:
        if may_declare(GROUP):  # remembered findings may come from plugins, which give the addresses of their pages
            from mudline.checks.registry import rules  # noqa: PLC0415 - it imports all rules

            rules()
        yield from form_module(name).write(findings, self.names)

    def _summary(self, findings: list[Diagnostic]) -> None:
        if self.wanted.fixing and (self.fixed or findings):
            say(self._fixed_summary(findings))
        elif findings:
            print_summary(self.view, findings, len(self.names))
        else:
            say(f"No findings in {counted(len(self.names), 'file')}.")
        if hint := fixable(findings):
            say(hint)
        if self.coverage.total:
            say(visible(self.coverage.sentence(), sys.stdout.encoding or "ascii"))

    def _fixed_summary(self, findings: list[Diagnostic]) -> str:
        total = counted(self.fixed + len(findings), "finding")
        return f"Found {total} ({self.fixed} fixed, {len(findings)} remaining) in {counted(len(self.names), 'file')}."


_MOST_ALIKE = 2
"""Findings of one style rule in a file that are listed individually; more are joined into one."""
_LINES_NAMED = 5


def _with_style_folded(findings: list[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings, joined under the first of each frequent style rule: old decks have one on most lines."""
    alike: dict[str, list[Diagnostic]] = {}
    for finding in findings:
        if finding.code.startswith("STY"):
            alike.setdefault(finding.code, []).append(finding)
    for finding in findings:
        first, *others = alike.get(finding.code, [finding])
        if len(others) < _MOST_ALIKE:
            yield finding
        elif finding is first:
            lines = [str(joined.line) for joined in others[:_LINES_NAMED]]
            more = ", ..." if len(others) > _LINES_NAMED else ""
            yield replace(finding, message=f"{finding.message}; {len(others)} more in lines {', '.join(lines)}{more}")


def fixable(findings: list[Diagnostic]) -> str:
    """Return the number of findings with fixes of each kind, or ""."""
    kinds = [finding.fix.applicability for finding in findings if finding.fix is not None]
    safe, unsafe = kinds.count("safe"), kinds.count("unsafe")
    if not kinds:
        return ""
    if not safe:
        return f"{unsafe} fixable with --fix --unsafe-fixes."
    return f"{safe} fixable with --fix" + (f", {unsafe} more with --unsafe-fixes." if unsafe else ".")


def statistics_lines(diagnostics: list[Diagnostic]) -> Iterator[str]:
    """Yield the number of findings of each rule, the most frequent first."""
    counts = Counter((finding.code, finding.slug) for finding in diagnostics)
    for (code, slug), count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        yield f"{count:6}  {code}  {slug}\n"


# ------------------------------------------------- findings for people: with the source line and a mark under the fault

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
    for severity, words in by_severity(findings):
        parts += [", ", (words, STYLES[severity])]
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
