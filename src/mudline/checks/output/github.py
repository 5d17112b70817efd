"""Findings as workflow commands, which the GitHub runner turns into annotations of a change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mudline.checks.output import LintRun, visible
from mudline.language.diagnostics import Diagnostic, Severity

SUMMARY = "workflow commands, shown as annotations of a change"

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def write(diagnostics: Iterable[Diagnostic], run: LintRun) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Yield a command for each finding; columns, the last one included, are given if a finding lies in one line."""
    for found in diagnostics:
        values: dict[str, str | int] = {
            "file": found.file.removeprefix("./"),
            "line": found.line,
            "endLine": found.end_line,
        }
        if found.line == found.end_line:
            values |= {"col": found.column, "endColumn": max(found.column, found.end_column - 1)}
        values["title"] = f"{found.code} {found.slug}"
        written = ",".join(f"{name}={_property(str(value))}" for name, value in values.items())
        yield f"::{_COMMANDS[found.severity]} {written}::{_data(visible(found.message))}\n"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
