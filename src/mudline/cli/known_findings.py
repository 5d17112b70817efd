"""Findings that `mudline lint` remembers from earlier runs: decks without any are not read again by its rules."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mudline.checks.configuration import Given
from mudline.cli.config_command import Configured
from mudline.cli.inputs import Input, Inputs
from mudline.language.diagnostics import Coverage, Diagnostic, Edit, Fix, Severity
from mudline.tools.running.remembered import Memory, of_working_folder


@dataclass(eq=False)
class KnownFindings:
    """The memory, and what it knows of the decks of a run in which nothing is found.

    `clean` says how much of each of these was read.
    """

    memory: Memory
    configured: Configured
    inputs: Inputs
    clean: dict[Input, Coverage] = field(default_factory=dict)
    _settings: dict[Path | None, str] = field(default_factory=dict)

    @property
    def all_clean(self) -> bool:
        """Whether nothing is found in any deck of the run."""
        return bool(self.clean) and len(self.clean) == len(self.inputs.files)

    def key(self, file: Input, data: bytes) -> str:
        """What the findings of a file are kept under; its name gives units and form, and is named in findings."""
        configuration = self.configured.of(file.path)
        place = configuration.path
        if place not in self._settings:
            self._settings[place] = repr((str(place), configuration.content))
        return self.memory.key(self._settings[place], file.name, data)

    def get(self, key: str, file: Input) -> tuple[tuple[Diagnostic, ...], Coverage] | None:
        """The findings of a file, and how much of it was read.

        None where they are not known or a file that they depend on has changed.
        """
        held = self.memory.get(key)
        try:
            return tuple(_finding(row, file.name) for row in held[1:]), _coverage(*held[0])
        except (TypeError, ValueError, LookupError, RecursionError):  # None, or what this program does not write
            return None

    def put(self, key: str, found: Sequence[Diagnostic], coverage: Coverage, looked_at: Sequence[str]) -> None:
        """Keep the findings of a file, which depend on what is at some paths, and how much of it was read."""
        covered = (coverage.total, coverage.read, coverage.partly, coverage.unread)
        self.memory.put(key, [covered, *(_row(one) for one in found)], looked_at)

    def look(self) -> None:
        """Find the decks in which nothing is found."""
        for file in self.inputs.files:
            if file.path is None:
                continue
            try:
                data = file.read()
            except OSError:  # reported when the others are read
                continue
            known = self.get(self.key(file, data), file)
            if known and not known[0]:
                self.clean[file] = known[1]


def known_findings(inputs: Inputs, given: Given, configured: Configured) -> KnownFindings | None:
    """What is known of the decks of a run; None where there is no place for a memory."""
    memory = of_working_folder("lint", repr(given))
    if memory is None:
        return None
    found = KnownFindings(memory, configured, inputs)
    if memory:
        found.look()
    return found


def _row(one: Diagnostic) -> list[Any]:
    """A finding as JSON holds it, without the name of its deck."""
    fix = one.fix and (one.fix.applicability, one.fix.message, [(e.start, e.end, e.text) for e in one.fix.edits])
    place = (one.line, one.column, one.end_line, one.end_column)
    following = [_row(each) for each in one.following]
    return [one.code, one.slug, one.severity.value, one.message, *place, fix, one.blocks, following]


def _coverage(total: int, read: int, partly: object, unread: object) -> Coverage:
    """How much of a file was read; raises TypeError for anything else."""
    if not isinstance(partly, dict) or not isinstance(unread, dict):
        raise TypeError
    _check_whole(total, read, *partly.values(), *unread.values())
    return Coverage(total, read, partly, unread)


def _finding(row: Sequence[Any], file: str) -> Diagnostic:
    """What `_row` was made from, in a file of that name; raises TypeError or ValueError for anything else."""
    code, slug, severity, message, line, column, end_line, end_column, fix, blocks, following = row
    if fix is not None:
        applicability, text, edits = fix
        fix = Fix(applicability, text, tuple(Edit(tuple(start), tuple(end), new) for start, end, new in edits))
        _check_texts(applicability, text, *(edit.text for edit in fix.edits))
        for edit in fix.edits:
            (_, _), (_, _) = edit.start, edit.end
            _check_whole(*edit.start, *edit.end)
    place = (line, column, end_line, end_column)
    _check_whole(*place)
    _check_texts(code, slug, message)
    others = tuple(_finding(each, file) for each in following)
    return Diagnostic(file, code, slug, Severity(severity), message, *place, fix, blocks, others)


def _check_whole(*values: object) -> None:
    if not all(type(value) is int for value in values):
        raise TypeError


def _check_texts(*values: object) -> None:
    if not all(isinstance(value, str) for value in values):
        raise TypeError
