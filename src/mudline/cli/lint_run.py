"""The pipeline of `mudline lint`: files, their settings, their reports, and what is done with each."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path

from mudline.cli.changes import tell_changes
from mudline.cli.inputs import Input, Inputs
from mudline.cli.lint_jobs import Effort, Linted, cache_for, linted, task
from mudline.cli.lint_report import Report
from mudline.cli.streams import emit_deck
from mudline.cli.terminal import reason, tell
from mudline.deck.loading import form_of
from mudline.diagnostics import Diagnostic
from mudline.files import write_atomically
from mudline.linting.baseline import Baseline
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.lint_file import FileReport, lint_one
from mudline.linting.output.visible import visible
from mudline.syntax.source import Source

SettingsOf = Callable[[Input], LintSettings]
"""What holds for a file."""


def lint_all(inputs: Inputs, settings_of: SettingsOf, effort: Effort) -> Generator[Linted, None, None]:
    """Each file that can be read with its content and its report, in the order of the files."""
    cache = cache_for(inputs, effort)
    tasks = (task(file, data, settings_of(file), cache) for file, data in inputs.contents())
    yield from linted(tasks, len(inputs.files), effort, cache)
    if cache is not None:
        cache.save()


@dataclass
class Run:
    """What is done with the reports: fixed decks are delivered, known findings taken out, the others told.

    With `diff` nothing is written; `differs` says afterwards that something would have been.
    """

    inputs: Inputs
    settings_of: SettingsOf
    report: Report
    known: Baseline | None = None
    recording: bool = False
    diff: bool = False
    effort: Effort = field(default_factory=Effort)
    differs: bool = False
    documents: int = 0

    def go(self) -> None:
        """All files."""
        with closing(lint_all(self.inputs, self.settings_of, self.effort)) as results:
            for file, data, result in results:
                self._take(file, data, result)
        if self.documents:
            tell(f"{self.documents} deck{'s' * (self.documents != 1)} in JSON or YAML not fixed: only keyword text is")
        self.report.finish()

    def _take(self, file: Input, data: bytes, result: FileReport) -> None:
        settings = self.settings_of(file)
        content = data if result.changed is None else result.changed
        if settings.fixing is not Fixing.NONE:
            self.documents += form_of(file.name) != "keyword"
            if result.note:
                tell(f"{file.name}: {result.note}")
            if not self._deliver(file, data, content):
                unfixed = replace(settings, fixing=Fixing.NONE)
                content, result = data, lint_one(file.name, data, unfixed, file.folder)
        found = self._unknown(file, content, list(result.found))
        self.report.add(file.name, content, found, len(result.fixed), settings.fail_on)

    def _unknown(self, file: Input, content: bytes, found: list[Diagnostic]) -> list[Diagnostic]:
        """The findings that the baseline does not hold."""
        if self.known is None:
            return found
        path = file.path or file.name
        if self.recording:
            self.known.record(found, content, path)
        return self.known.unknown(found, content, path)

    def _deliver(self, file: Input, data: bytes, content: bytes) -> bool:
        """Show, print or write what was fixed; returns whether the fixes are made."""
        if self.diff:
            if content != data:
                self.differs = True
                old, new = (Source.from_bytes(text, file.name).text for text in (data, content))
                tell_changes(old, new, visible(file.name), self.report.view.color)
        elif file.path is None:
            emit_deck(content)
        elif content != data:
            try:
                write_atomically(Path(file.path), content)
            except OSError as error:
                self.inputs.fail(f"{file.name}: cannot be written: {reason(error)}")
                return False
        return True
