"""Findings as workflow commands, which the GitHub runner turns into annotations of a change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mudline.checks.output import visible
from mudline.language.diagnostics import Diagnostic, Severity

SUMMARY = "workflow commands, shown as annotations of a change"

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Yield a command for each finding; columns, the last one included, are given if a finding lies in one line."""
    for finding in diagnostics:
        values: dict[str, str | int] = {
            "file": finding.file.removeprefix("./"),
            "line": finding.line,
            "endLine": finding.end_line,
        }
        if finding.line == finding.end_line:
            values |= {"col": finding.column, "endColumn": max(finding.column, finding.end_column - 1)}
        values["title"] = f"{finding.code} {finding.slug}"
        plain = {name: _data(str(value)).replace(":", "%3A").replace(",", "%2C") for name, value in values.items()}
        written = ",".join(f"{name}={value}" for name, value in plain.items())
        yield f"::{_COMMANDS[finding.severity]} {written}::{_data(visible(finding.message))}\n"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
