"""Findings on the terminal."""

from __future__ import annotations

from mudline.cli.console import EXCERPT_WIDTH, console, say
from mudline.diagnostics import Diagnostic
from mudline.linting.output.text import Screen, findings, summary
from mudline.syntax.source import Source


def print_findings(found: list[Diagnostic], source: Source, color: str) -> None:
    """The findings of one file, each with its source line."""
    printer = console(color)
    say(printer, findings(found, source, Screen(min(printer.width, EXCERPT_WIDTH), printer.encoding)))


def print_summary(found: list[Diagnostic], files: int, color: str) -> None:
    """How many findings there are."""
    console(color).print(summary(found, files))
