"""Findings that `mudline lint` remembers from earlier runs: decks without any are not read again by its rules."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from mudline.basics.outside import project_of
from mudline.checks.configuration import Configured, Given
from mudline.cli.inputs import Input, Inputs
from mudline.language.diagnostics import Coverage, Diagnostic
from mudline.tools.running.remembered import Memory, of_working_folder

if TYPE_CHECKING:
    from pydantic import TypeAdapter


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
        """What the findings of a file are kept under; its name gives units and form, and is named in findings.

        What lies outside of its project is not shown, and may be refused.
        """
        configuration = self.configured.of(file.path)
        place = configuration.path
        if place not in self._settings:
            self._settings[place] = repr((str(place), configuration.content))
        project = str(project_of(file.folder)) if file.folder else ""
        return self.memory.key(self._settings[place], project, file.name, data)

    def get(self, key: str) -> tuple[tuple[Diagnostic, ...], Coverage] | None:
        """The findings of a file, and how much of it was read.

        None where they are not known or a file that they depend on has changed.
        """
        held = self.memory.get(key)
        try:
            found = _reader().validate_python(held[1:]) if held[1:] else ()
            return found, _coverage(*held[0])
        except (TypeError, ValueError, LookupError, RecursionError):  # None, or what this program does not write
            return None

    def put(self, key: str, found: Sequence[Diagnostic], coverage: Coverage, looked_at: Sequence[str]) -> None:
        """Keep the findings of a file, which depend on what is at some paths, and how much of it was read."""
        covered = [*asdict(coverage).values()]
        self.memory.put(key, [covered, *map(asdict, found)], looked_at)

    def look(self) -> None:
        """Find the decks in which nothing is found."""
        for file in self.inputs.files:
            if file.path is None:
                continue
            try:
                data = file.read()
            except OSError:  # reported when the others are read
                continue
            known = self.get(self.key(file, data))
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


def _coverage(total: int, read: int, partly: object, unread: object) -> Coverage:
    """How much of a file was read; raises TypeError for anything else."""
    if not isinstance(partly, dict) or not isinstance(unread, dict):
        raise TypeError
    if not all(type(count) is int for count in (total, read, *partly.values(), *unread.values())):
        raise TypeError
    return Coverage(total, read, partly, unread)


@cache
def _reader() -> TypeAdapter[tuple[Diagnostic, ...]]:
    """Return what makes findings of what JSON holds of them, and raises ValueError for anything else."""
    from pydantic import TypeAdapter  # noqa: PLC0415 - decks without findings do without it

    return TypeAdapter(tuple[Diagnostic, ...])
