"""Findings told as they come for people, together for programs."""

from __future__ import annotations

import click

from mudline import __version__
from mudline.cli.lazy import printing
from mudline.cli.lint_outputs import Outputs
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import tell
from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.output.formats import TEXT, form
from mudline.linting.output.text import statistics_lines
from mudline.syntax.source import Source


class Report:
    """What a run found. `aside`: standard output has other things to carry, and findings go to standard error."""

    def __init__(self, outputs: Outputs, view: View, *, statistics: bool, aside: bool, fixing: bool) -> None:
        self.outputs = outputs
        self.view = view
        self.statistics = statistics
        self.aside = aside
        self.fixing = fixing
        self.found: list[Diagnostic] = []
        self.fixed = 0
        self.names: list[str] = []
        self.files = 0
        self.failing = False

    def add(self, name: str, data: bytes, found: list[Diagnostic], fixed: int, limit: Severity) -> None:
        """The findings that are left in one file, whose content is `data`, and the number of those fixed."""
        self.files += 1
        self.names.append(name)
        self.found += found
        self.fixed += fixed
        self.failing = self.failing or any(one.severity.rank >= limit.rank for one in found)
        if self._as_they_come and found:
            printing("lint").print_findings(found, Source.from_bytes(data, name), self.view.color)
        if self.view.verbose:
            tell(f"{name}: {len(found)} finding{'s' * (len(found) != 1)}")

    @property
    def _as_they_come(self) -> bool:
        return self.outputs.form == TEXT and not (self.view.quiet or self.statistics or self.aside)

    def finish(self) -> None:
        """What stands at the end."""
        found = sorted(self.found, key=lambda diagnostic: diagnostic.sort_key)
        self.outputs.write_files(found, self.names)
        if self.aside:
            self._tell_aside(found)
        elif self.statistics:
            emit(statistics_lines(found))
        elif self.outputs.form != TEXT:
            emit(form(self.outputs.form, self.names, __version__)(found))
        elif self.view.quiet:
            emit(form("concise", self.names, __version__)(found))
        elif self.files:
            self._summary(found)

    def _tell_aside(self, found: list[Diagnostic]) -> None:
        name = self.outputs.form if self.outputs.form != TEXT else "concise"
        pieces = statistics_lines(found) if self.statistics else form(name, self.names, __version__)(found)
        for piece in pieces:
            click.echo(piece, err=True, nl=False)
        if self.fixing and not self.view.quiet and name == "concise":
            click.echo(self._fixed_summary(found), err=True)

    def _summary(self, found: list[Diagnostic]) -> None:
        if self.fixing and (self.fixed or found):
            click.echo(self._fixed_summary(found))
        elif found:
            printing("lint").print_summary(found, self.files, self.view.color)
        else:
            click.echo(f"No findings in {self.files} file{'s' * (self.files != 1)}.")
        if hint := fixable(found):
            click.echo(hint)

    def _fixed_summary(self, found: list[Diagnostic]) -> str:
        total = self.fixed + len(found)
        files = f"{self.files} file{'s' * (self.files != 1)}"
        counts = f"({self.fixed} fixed, {len(found)} remaining)"
        return f"Found {total} finding{'s' * (total != 1)} {counts} in {files}."


def fixable(found: list[Diagnostic]) -> str:
    """How many findings have fixes of each kind, or ""."""
    kinds = [one.fix.applicability for one in found if one.fix is not None]
    safe, unsafe = kinds.count("safe"), kinds.count("unsafe")
    if not kinds:
        return ""
    if not safe:
        return f"{unsafe} fixable with --fix --unsafe-fixes."
    return f"{safe} fixable with --fix" + (f", {unsafe} more with --unsafe-fixes." if unsafe else ".")
