"""One run of `mudline lint`: the settings of each deck, its findings without the known ones, and fixed decks.

Of many files those that are remembered are not linted again; the rest is linted here, in other processes or by the
workers of a scheduler, always in the order given.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from dataclasses import KW_ONLY, field, replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import click

from mudline.cli.configured import Configured
from mudline.cli.inputs import Input, Inputs
from mudline.cli.known_findings import KnownFindings
from mudline.cli.lint_report import Report
from mudline.cli.streams import counted, emit_deck, notify, reason, write_text
from mudline.cli.view import View
from mudline.deck.forms import form_of
from mudline.diagnostics import Diagnostic
from mudline.lean import dataclass
from mudline.linting.configuration import Configuration, Given
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import UnknownRule, code_fault, plugin_files, rules
from mudline.linting.rule import Rule
from mudline.linting.settings import hidden_codes, merged_settings
from mudline.linting.suppression import Baseline, BaselineError, read_baseline
from mudline.running.executors import executor, in_order


@dataclass
class Settings:
    """The settings of each deck, made once for decks of the same ones."""

    configured: Configured
    given: Given
    fail_on: str | None
    fixing: Fixing
    _made: dict[object, LintSettings] = field(default_factory=dict)
    _of_folder: dict[str, LintSettings] = field(default_factory=dict)

    def of(self, file: Input) -> LintSettings:
        """The settings of a file."""
        folder = os.path.dirname(file.path or "-")  # noqa: PTH120 - asked for each of many files
        if folder in self._of_folder:
            return self._of_folder[folder]
        found = self.configured.of(file.path)
        hidden = hidden_codes(found, file.path or file.name)
        key = (found.path, hidden)
        if key not in self._made:
            self._made[key] = self.merged(found, hidden)
        if not found.table("per-file-ignores"):
            self._of_folder[folder] = self._made[key]
        return self._made[key]

    def merged(self, found: Configuration, hidden: tuple[str, ...] = ()) -> LintSettings:
        """A configuration under a command line; `hidden` are codes that it ignores in a file."""
        try:
            return merged_settings(found, self.given, hidden, fail_on=self.fail_on, fixing=self.fixing)
        except UnknownRule as error:
            raise click.UsageError(str(error)) from error


def _baseline(given: str | None, *, recording: bool) -> Baseline | None:
    """The known findings; none yet when they are to be recorded. Ends the command for a file that is not a baseline."""
    if given is None:
        if recording:
            raise click.UsageError("--write-baseline needs --baseline FILE: the file to write")
        return None
    path = Path(given)
    if recording:
        return Baseline(path.parent)
    try:
        return read_baseline(path)
    except OSError as error:
        raise click.ClickException(f"{given}: the baseline cannot be read: {reason(error)}") from error
    except BaselineError as error:
        message = f"{given}: not a baseline: {error}: write a new one with --write-baseline"
        raise click.ClickException(message) from error


def _report_baseline(known: Baseline, path: Path, view: View, *, recording: bool) -> None:
    """Write what was recorded, or report how much of it is no longer found."""
    if recording:
        write_text(path, [known.text()])
        if not view.quiet:
            notify(f"{path.as_posix()}: {counted(known.known.total(), 'finding')} recorded")
    elif view.verbose and (gone := known.gone()):
        notify(f"{path.as_posix()}: {counted(gone, 'recorded finding')} no longer there: write it again")


def checked_settings(config: str | None, given: Given, fixing: str, *, isolated: bool, fail_on: str | None) -> Settings:
    """The settings of a command line; ends the command for a word that names no rule, whatever the files are."""
    settings = Settings(Configured(config, isolated, code_fault), given, fail_on, Fixing(fixing))
    settings.merged(Configuration())
    return settings


@dataclass
class Run:
    """All files: fixed decks are written or shown, known findings left out, the others reported.

    `baseline` is the file of the findings that are known already, or that are to be recorded. With `diff` nothing is
    written.
    """

    inputs: Inputs
    settings: Settings
    report: Report
    known: KnownFindings | None = None
    baseline: str | None = None
    _: KW_ONLY
    recording: bool = False
    diff: bool = False
    jobs: int = 0
    scheduler: str | None = None
    _differs: bool = field(default=False, init=False)
    _documents: int = field(default=0, init=False)
    _recorded: Baseline | None = field(default=None, init=False)

    def go(self) -> bool:
        """Lint all files; returns whether there is a reason to fail."""
        self._recorded = _baseline(self.baseline, recording=self.recording)
        alone = self.settings.fixing is not Fixing.NONE  # a deck that is fixed may be one that others continue
        jobs = 1 if alone else self.jobs
        with closing(lint_all(self.inputs, self.settings.of, self.known, jobs, self.scheduler)) as results:
            for file, data, result in results:
                self._take(file, data, result)
        if self._documents:
            notify(f"{counted(self._documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
        self.report.finish()
        if self._recorded is not None and self.baseline is not None:
            _report_baseline(self._recorded, Path(self.baseline), self.report.view, recording=self.recording)
        return self.report.failing or self._differs

    def _take(self, file: Input, data: bytes, result: FileReport) -> None:
        settings = self.settings.of(file)
        content = data if result.changed is None else result.changed
        if settings.fixing is not Fixing.NONE:
            self._documents += form_of(file.name) != "keyword"
            if result.note:
                notify(f"{file.name}: {result.note}")
            if not self._deliver(file, data, content):
                unfixed = replace(settings, fixing=Fixing.NONE)
                content, result = data, lint_one(file.name, data, unfixed, file.folder)
        found = self._unknown(file, content, list(result.found))
        self.report.add(file.name, content, found, len(result.fixed), settings.fail_on)

    def _unknown(self, file: Input, content: bytes, found: list[Diagnostic]) -> list[Diagnostic]:
        """The findings that the baseline does not hold."""
        if self._recorded is None:
            return found
        path = file.path or file.name
        if self.recording:
            self._recorded.record(found, content, path)
        return self._recorded.unknown(found, content, path)

    def _deliver(self, file: Input, data: bytes, content: bytes) -> bool:
        """Show, print or write what was fixed; returns whether the fixes are made."""
        if self.diff:
            if content != data:
                self._differs = True
                from mudline.cli.changes import print_changes  # noqa: PLC0415 - most runs change nothing

                print_changes(data, content, file.name, self.report.view)
        elif file.path is None:
            emit_deck(content)
        elif content != data:
            return self.inputs.replaced(file, content)
        return True


# ----------------------------------------------------------------------------------------------------------- many files

SettingsOf = Callable[[Input], LintSettings]
"""The settings of a file."""
Linted = tuple[Input, bytes, FileReport]


class Task(NamedTuple):
    """A file to lint; `known` is its report if that is remembered, `key` what it is remembered under, if at all."""

    file: Input
    data: bytes
    settings: LintSettings
    key: str = ""
    known: FileReport | None = None


class Order(NamedTuple):
    """A file as it is sent: without its rules, whose functions may not be picklable, but with their codes.

    `here` is the working folder, below which files are looked for that the deck names.
    """

    task: Task
    codes: tuple[str, ...]
    here: str


def lint_all(
    inputs: Inputs,
    settings_of: SettingsOf,
    known: KnownFindings | None = None,
    jobs: int = 0,
    scheduler: str | None = None,
) -> Generator[Linted, None, None]:
    """Each file that can be read with its content and its report, in the order of the files.

    Files without a finding that are known as such are not read again: their content is given as empty.
    """
    plugins = plugin_files() if known is not None else ()
    orders = _orders(_tasks(inputs, settings_of, known))
    with executor(jobs, scheduler) as pool, closing(in_order(pool, lint_order, orders, len(inputs.files))) as reports:
        for one, made in reports:
            report = made or one.known or FileReport(one.file.name, ())
            if known is not None and one.key and one.known is None:
                known.put(one.key, report.found, (*report.looked_at, *plugins))
            yield one.file, one.data, report
    if known is not None:
        known.memory.save()


def _tasks(inputs: Inputs, settings_of: SettingsOf, known: KnownFindings | None) -> Iterator[Task]:
    """The files with their reports as far as they are remembered; standard input is not."""
    for number, file in enumerate(inputs.files):
        settings = settings_of(file)
        if known is not None and known.clean[number]:
            yield Task(file, b"", settings, known=FileReport(file.name, ()))
        elif (data := inputs.content(file)) is None:
            continue
        elif known is None or file.path is None:
            yield Task(file, data, settings)
        else:
            key = known.key(file, data)
            found = known.get(key, file)
            yield Task(file, data, settings, key, None if found is None else FileReport(file.name, found))


def _orders(tasks: Iterator[Task]) -> Iterator[tuple[Task, Order | None]]:
    """Each file with what is sent of it; settings that many files share are one object, which is sent once."""
    sendable: dict[int, tuple[LintSettings, LintSettings, tuple[str, ...]]] = {}
    here = os.getcwd()  # noqa: PTH109 - sent as text
    for one in tasks:
        if one.known is not None:
            yield one, None
            continue
        if id(one.settings) not in sendable:
            codes = tuple(rule.code.code for rule in one.settings.rules)
            sendable[id(one.settings)] = (one.settings, replace(one.settings, rules=()), codes)
        _, without_rules, codes = sendable[id(one.settings)]
        yield one, Order(one._replace(settings=without_rules), codes, here)


def lint_order(order: Order) -> FileReport:
    """Lint a file, in any process."""
    task = order.task
    settings = replace(task.settings, rules=_named(order.codes))
    return lint_one(task.file.name, task.data, settings, task.file.seen_from(order.here).folder)


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    """The rules of these codes; raises ImportError where a package that has some of them is not installed here."""
    found = tuple(rule for rule in rules() if rule.code.code in codes)
    if missing := sorted(set(codes) - {rule.code.code for rule in found}):
        raise ImportError(f"no rule {', '.join(missing)}")
    return found
