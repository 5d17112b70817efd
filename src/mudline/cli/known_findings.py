"""Findings that `mudline lint` remembers from earlier runs: unchanged decks are not linted again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mudline.basics.outside import project_of
from mudline.checks.configuration import CallerSettings, Configured
from mudline.cli.inputs import Input, Inputs
from mudline.language.diagnostics import Coverage, Diagnostic, Edit, Fix, Severity
from mudline.tools.running.remembered import Memory, of_working_folder

MOST_HELD = 64_000_000
"""Bytes of decks with findings that are kept in memory until these are printed."""

Known = tuple[tuple[Diagnostic, ...], Coverage]
"""Findings of a file, and how much of it was read."""


@dataclass(eq=False)
class KnownFindings:
    """Memory of findings, and the contents of a run's decks with their known findings; empty for decks without any."""

    memory: Memory
    configured: Configured
    inputs: Inputs
    known: dict[Input, tuple[bytes, Known]] = field(default_factory=dict)
    _settings: dict[Path | None, str] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """True if all decks of the run are known."""
        return bool(self.known) and len(self.known) == len(self.inputs.files)

    def key(self, file: Input, data: bytes) -> str:
        """Return the key of the findings of a file.

        Its name is part of the key: it gives units and form, and is in findings. So is its project: files outside are
        not shown, and may be refused.
        """
        configuration = self.configured.of(file.path)
        place = configuration.path
        if place not in self._settings:
            self._settings[place] = repr((str(place), configuration.content))
        project = str(project_of(file.folder)) if file.folder else ""
        return self.memory.key(self._settings[place], project, file.name, data)

    def get(self, key: str) -> Known | None:
        """Return the known findings of a file; None if there are none, or if a file that it depends on has changed."""
        held = self.memory.get(key)
        try:
            return tuple(_finding(**each) for each in held[1:]), _coverage(*held[0])
        except (TypeError, ValueError, LookupError, RecursionError):  # None, or what this program does not write
            return None

    def put(self, key: str, findings: Sequence[Diagnostic], coverage: Coverage, looked_at: Sequence[str]) -> None:
        """Store the findings of a file and how much of it was read; they depend on the content at some paths."""
        covered = [*asdict(coverage).values()]
        self.memory.put(key, [covered, *map(asdict, findings)], looked_at)

    def look(self) -> None:
        """Look up the decks, as far as their contents may be kept in memory."""
        held = 0
        for file in self.inputs.files:
            if file.path is None:
                continue
            try:
                data = file.read()
            except OSError:  # reported when the others are read
                continue
            if known := self.get(self.key(file, data)):
                self.known[file] = (data if known[0] else b"", known)
                held += len(self.known[file][0])
                if held > MOST_HELD:
                    return


def known_findings(inputs: Inputs, given: CallerSettings, configured: Configured) -> KnownFindings | None:
    """Return the known findings for the decks of a run; None where no memory can be kept."""
    memory = of_working_folder("lint", repr(given))
    if memory is None:
        return None
    known = KnownFindings(memory, configured, inputs)
    if memory:
        known.look()
    return known


# ------------------------------------------------------------------------------------- JSON that may hold anything


def _coverage(total: int, read: int, partly: dict[str, int], unread: dict[str, int]) -> Coverage:
    """Return the coverage of a file; raises TypeError for other data."""
    _demand(dict, partly, unread)
    _demand(int, total, read, *partly.values(), *unread.values())
    return Coverage(total, read, partly, unread)


def _finding(*, severity: str, fix: list[Any] | None, following: list[dict[str, Any]], **others: Any) -> Diagnostic:  # noqa: ANN401 - as JSON
    """Return a finding; raises TypeError, ValueError or LookupError for other data."""
    finding = Diagnostic(
        **others,
        severity=Severity(severity),
        fix=None if fix is None else _fix(*fix),
        following=tuple(_finding(**each) for each in following),
    )
    _demand(str, finding.file, finding.code, finding.slug, finding.message)
    _demand(int, finding.line, finding.column, finding.end_line, finding.end_column)
    _demand(bool, finding.blocks)
    return finding


def _fix(applicability: str, message: str, edits: list[Any]) -> Fix:
    checked = []
    for start, end, text in edits:
        (line, column), (end_line, end_column) = start, end
        _demand(str, text)
        _demand(int, line, column, end_line, end_column)
        checked.append(Edit((line, column), (end_line, end_column), text))
    _demand(str, applicability, message)
    return Fix(applicability, message, tuple(checked))


def _demand(kind: type, *values: object) -> None:
    """Raise TypeError for a value of another type."""
    if not all(type(value) is kind for value in values):
        raise TypeError
