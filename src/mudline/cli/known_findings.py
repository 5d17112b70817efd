"""Findings that `mudline lint` remembers from earlier runs: unchanged decks are not linted again."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from mudline.basics.outside import project_of
from mudline.checks.configuration import CallerSettings, Configured
from mudline.checks.report import FileReport
from mudline.cli.inputs import Input
from mudline.language.diagnostics import Coverage, Diagnostic, Edit, Fix, Severity
from mudline.tools.running.remembered import Memory, of_working_folder


class KnownFindings:
    """Reports on decks, by their content and settings."""

    def __init__(self, memory: Memory, configured: Configured) -> None:
        self.memory = memory
        self._configured = configured

    def key(self, file: Input, data: bytes) -> str:
        """Return the key of the findings of a file.

        Its name is part of the key: it gives units and form, and is in findings. So is its project: files outside are
        not shown, and may be refused.
        """
        configuration = self._configured.of(file.path)
        project = str(project_of(file.folder)) if file.folder else ""
        return self.memory.key(str(configuration.path), configuration.content, project, file.name, data)

    def get(self, key: str, name: str) -> FileReport | None:
        """Return the report on a file; None if it is not known, or if a file that it depends on has changed."""
        held = self.memory.get(key)
        if held is None:
            return None
        return FileReport(name, tuple(_finding(**each) for each in held[1:]), coverage=Coverage(*held[0]))

    def put(self, key: str, report: FileReport) -> None:
        """Store the report on a file, which depends on the content of files that it names, and of plugins."""
        from mudline.checks.registry import plugin_files  # noqa: PLC0415 - it imports all rules

        held = [[*asdict(report.coverage).values()], *map(asdict, report.found)]
        self.memory.put(key, held, (*report.looked_at, *plugin_files()))


def known_findings(given: CallerSettings, configured: Configured) -> KnownFindings | None:
    """Return the known findings under the settings of a run; None where no memory can be kept."""
    memory = of_working_folder("lint", repr(given))
    return None if memory is None else KnownFindings(memory, configured)


def _finding(*, severity: str, fix: list[Any] | None, following: list[dict[str, Any]], **others: Any) -> Diagnostic:  # noqa: ANN401 - as JSON
    """Return a finding from what JSON makes of it."""
    return Diagnostic(
        **others,
        severity=Severity(severity),
        fix=None if fix is None else _fix(*fix),
        following=tuple(_finding(**each) for each in following),
    )


def _fix(applicability: str, message: str, edits: list[Any]) -> Fix:
    made = tuple(Edit((line, column), (last, end), text) for (line, column), (last, end), text in edits)
    return Fix(applicability, message, made)
