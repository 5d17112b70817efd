"""Findings that `mudline lint` remembers from earlier runs: unchanged decks are not read again by its rules."""

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
"""Bytes of decks with findings that are held until these are printed."""

Known = tuple[tuple[Diagnostic, ...], Coverage]
"""The findings of a file, and how much of it was read."""


@dataclass(eq=False)
class KnownFindings:
    """The memory, and the contents of decks of a run with what it knows of them; those without findings are empty."""

    memory: Memory
    configured: Configured
    inputs: Inputs
    known: dict[Input, tuple[bytes, Known]] = field(default_factory=dict)
    _settings: dict[Path | None, str] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """Whether all decks of the run are known."""
        return bool(self.known) and len(self.known) == len(self.inputs.files)

    def key(self, file: Input, data: bytes) -> str:
        """What the findings of a file are kept under; its name gives units and form, and is named in findings.

        What lies outside of its project is not shown, and may be refused.
        """
        configuration = self.configured.of(file.path)
        place = configuration.path
        if place not in self._settings:
            self._settings[place] = repr((str(place), configuration.content))
        project = str(project_of(file.folder)) if file.folder else ""
        return self.memory.key(self._settings[place], project, file.name, data)

    def get(self, key: str) -> Known | None:
        """What is known of a file; None where nothing is, or where a file that it depends on has changed."""
        held = self.memory.get(key)
        try:
            return tuple(_finding(**each) for each in held[1:]), _coverage(*held[0])
        except (TypeError, ValueError, LookupError, RecursionError):  # None, or what this program does not write
            return None

    def put(self, key: str, found: Sequence[Diagnostic], coverage: Coverage, looked_at: Sequence[str]) -> None:
        """Keep the findings of a file, which depend on what is at some paths, and how much of it was read."""
        covered = [*asdict(coverage).values()]
        self.memory.put(key, [covered, *map(asdict, found)], looked_at)

    def look(self) -> None:
        """Find the decks that are known, as far as their contents may be held."""
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
    """What is known of the decks of a run; None where there is no place for a memory."""
    memory = of_working_folder("lint", repr(given))
    if memory is None:
        return None
    found = KnownFindings(memory, configured, inputs)
    if memory:
        found.look()
    return found


# ------------------------------------------------------------------------------- what JSON holds, which may be anything


def _coverage(total: int, read: int, partly: dict[str, int], unread: dict[str, int]) -> Coverage:
    """How much of a file was read; raises TypeError for anything else."""
    _demand(dict, partly, unread)
    _demand(int, total, read, *partly.values(), *unread.values())
    return Coverage(total, read, partly, unread)


def _finding(*, severity: str, fix: list[Any] | None, following: list[dict[str, Any]], **others: Any) -> Diagnostic:  # noqa: ANN401 - as JSON
    """A finding; raises TypeError, ValueError or LookupError for anything else."""
    found = Diagnostic(
        **others,
        severity=Severity(severity),
        fix=None if fix is None else _fix(*fix),
        following=tuple(_finding(**each) for each in following),
    )
    _demand(str, found.file, found.code, found.slug, found.message)
    _demand(int, found.line, found.column, found.end_line, found.end_column)
    _demand(bool, found.blocks)
    return found


def _fix(applicability: str, message: str, edits: list[Any]) -> Fix:
    made = []
    for start, end, text in edits:
        (line, column), (end_line, end_column) = start, end
        _demand(str, text)
        _demand(int, line, column, end_line, end_column)
        made.append(Edit((line, column), (end_line, end_column), text))
    _demand(str, applicability, message)
    return Fix(applicability, message, tuple(made))


def _demand(kind: type, *values: object) -> None:
    """Raise TypeError for a value of another kind."""
    if not all(type(value) is kind for value in values):
        raise TypeError
