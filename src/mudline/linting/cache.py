"""Findings kept from run to run, for decks whose content, settings and program are what they were."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from mudline.cache_folder import cache_folder
from mudline.linting.cache_entries import packed, unpacked
from mudline.linting.cache_files import file_of, read_entries, write_entries
from mudline.linting.cache_keys import key, of_settings, program, stands_alone
from mudline.linting.lint_file import FileReport
from mudline.linting.settings import LintSettings

LONGEST = 100_000
"""Letters of the findings of one deck; more of them are not kept."""


@dataclass
class Cache:
    """What is known from runs before in a working folder, and what this run adds."""

    path: Path
    known: dict[str, str]
    new: dict[str, str] = field(default_factory=dict)
    _program: str = field(default_factory=program)
    _starts: dict[int, tuple[LintSettings, bytes]] = field(default_factory=dict)

    def key(self, name: str, data: bytes, settings: LintSettings) -> str:
        """What the findings of a file are kept under; "" if they cannot be kept."""
        return key(self._start(settings), name, data) if stands_alone(name, data) else ""

    def get(self, key: str, name: str) -> FileReport | None:
        """What is known of a file, or None."""
        held = self.known.get(key)
        if held is None:
            return None
        try:
            return FileReport(name, unpacked(held, name))
        except ValueError:
            del self.known[key]
            return None

    def put(self, key: str, report: FileReport) -> None:
        """Keep what was found in a file."""
        held = packed(report.found)
        if len(held) <= LONGEST:
            self.new[key] = held

    def save(self) -> None:
        """Write what was added, if anything was."""
        if self.new:
            write_entries(self.path, {**self.known, **self.new})

    def _start(self, settings: LintSettings) -> bytes:
        """Settings are few, hold for many files, and are alive as long as they stand here."""
        found = self._starts.get(id(settings))
        if found is None:
            found = self._starts[id(settings)] = (settings, of_settings(settings, self._program))
        return found[1]


def opened() -> Cache | None:
    """The cache of the working folder; None where there is no place for one."""
    folder = cache_folder()
    if folder is None:
        return None
    try:
        path = file_of(folder, Path.cwd())
    except OSError:  # the working folder is gone
        return None
    return Cache(path, read_entries(path))
