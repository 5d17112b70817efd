"""One run of `mudline lint`: the settings of each deck, its findings without the known ones, and fixed decks.

Of many files the cache answers what it holds; the rest is linted here or in other processes, always in the order given.
The processes end with this one and print nothing.
"""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from mudline.cli.configured import Configured
from mudline.cli.inputs import Input, Inputs
from mudline.cli.lint_known import KnownDecks
from mudline.cli.lint_report import Report
from mudline.cli.processes import Effort, pays, pool, submitted
from mudline.cli.streams import counted, emit_deck, notify, reason, write_text
from mudline.cli.view import View
from mudline.deck.forms import form_of
from mudline.diagnostics import Diagnostic
from mudline.linting.configuration import Configuration, Given
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import UnknownRule, code_fault, plugin_files, rules
from mudline.linting.rule import Rule
from mudline.linting.settings import hidden_codes, merged_settings
from mudline.linting.suppression import Baseline, BaselineError, read_baseline

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future


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

    `elsewhere` lints them instead of this machine's processes.
    `baseline` is the file of the findings that are known already, or that are to be recorded. With `diff` nothing is
    written.
    """

    inputs: Inputs
    settings: Settings
    report: Report
    known: KnownDecks | None = None
    baseline: str | None = None
    _: KW_ONLY
    recording: bool = False
    diff: bool = False
    jobs: int = 0
    elsewhere: Callable[[Inputs, SettingsOf], Generator[Linted, None, None]] | None = None
    _differs: bool = field(default=False, init=False)
    _documents: int = field(default=0, init=False)
    _recorded: Baseline | None = field(default=None, init=False)

    def go(self) -> bool:
        """Lint all files; returns whether there is a reason to fail."""
        self._recorded = _baseline(self.baseline, recording=self.recording)
        with closing(self._linted()) as results:
            for file, data, result in results:
                self._take(file, data, result)
        if self._documents:
            notify(f"{counted(self._documents, 'deck')} in JSON or YAML not fixed: only keyword text is")
        self.report.finish()
        if self._recorded is not None and self.baseline is not None:
            _report_baseline(self._recorded, Path(self.baseline), self.report.view, recording=self.recording)
        return self.report.failing or self._differs

    def _linted(self) -> Generator[Linted, None, None]:
        """Each file with its content and report, made here or on a cluster."""
        if self.elsewhere is None:
            return lint_all(self.inputs, self.settings.of, Effort(self.jobs), self.known)
        return self.elsewhere(self.inputs, self.settings.of)

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

TRIED = 0.05
"""Seconds of linting by which the remaining work is estimated."""

_CHUNK_FILES = 20
_CHUNK_BYTES = 500_000
_CHUNK_KNOWN = 256

SettingsOf = Callable[[Input], LintSettings]
"""The settings of a file."""
Linted = tuple[Input, bytes, FileReport]


class Task(NamedTuple):
    """A file to lint; `known` is its report if the cache has it, `key` the key of its report in the cache, if any."""

    file: Input
    data: bytes
    settings: LintSettings
    key: str = ""
    known: FileReport | None = None

    def lint(self) -> FileReport:
        """The report, from the cache or made in this process."""
        return self.known or lint_one(self.file.name, self.data, self.settings, self.file.folder)


Order = tuple[Task, tuple[str, ...]]
"""A file as it is sent to a process: without its rules, whose functions may not be picklable, and their codes."""


class Sendable(NamedTuple):
    """Settings, the same without their rules, and the codes of these."""

    settings: LintSettings
    without_rules: LintSettings
    codes: tuple[str, ...]


def lint_all(
    inputs: Inputs, settings_of: SettingsOf, effort: Effort, known: KnownDecks | None = None
) -> Generator[Linted, None, None]:
    """Each file that can be read with its content and its report, in the order of the files.

    Files without a finding that are known as such are not read again: their content is given as empty.
    """
    tasks = _tasks(inputs, settings_of, known)
    plugins = plugin_files() if known is not None else ()
    with closing(_reports(tasks, len(inputs.files) - (known.clean.count(1) if known else 0), effort)) as reports:
        for one, report in reports:
            if known is not None and one.key and one.known is None:
                known.cache.put(one.key, report.found, (*report.looked_at, *plugins))
            yield one.file, one.data, report
    if known is not None:
        known.cache.save()


def _tasks(inputs: Inputs, settings_of: SettingsOf, known: KnownDecks | None) -> Iterator[Task]:
    """The files with their reports as far as the cache has them; it is not asked for standard input."""
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
            found = known.cache.get(key, file.name)
            yield Task(file, data, settings, key, None if found is None else FileReport(file.name, found))


def _reports(tasks: Iterable[Task], count: int, effort: Effort) -> Generator[tuple[Task, FileReport], None, None]:
    """The reports of the files in their order, `count` of them not known. Processes are used once that pays."""
    rest = iter(tasks)
    spent = 0.0
    done = 0
    for one in rest:
        start = time.perf_counter()
        report = one.lint()
        spent += time.perf_counter() - start
        done += one.known is None
        yield one, report
        alone = one.settings.fixing is not Fixing.NONE or not done or spent < TRIED
        if not alone and pays(spent / done * (count - done), effort):
            break
    else:
        return
    with pool(effort.processes, "linted decks", __name__) as executor:
        yield from _ahead(rest, executor, 2 * effort.processes)


def _ahead(tasks: Iterable[Task], executor: Executor, most: int) -> Iterator[tuple[Task, FileReport]]:
    """The reports in order, while the processes work ahead on `most` chunks of files."""
    waiting: deque[tuple[list[Task], Future[list[FileReport]] | None]] = deque()
    sendable: dict[int, Sendable] = {}
    for chunk in _chunks(tasks):
        waiting.append((chunk, _sent(executor, [order_of(one, sendable) for one in chunk if one.known is None])))
        if len(waiting) > most:
            yield from _done(*waiting.popleft())
    while waiting:
        yield from _done(*waiting.popleft())


def _done(chunk: list[Task], made: Future[list[FileReport]] | None) -> Iterator[tuple[Task, FileReport]]:
    reports = iter(made.result() if made else ())
    for one in chunk:
        yield one, one.known or next(reports)


def _chunks(tasks: Iterable[Task]) -> Iterator[list[Task]]:
    """Files that are sent to a process together: few enough that none waits long."""
    chunk: list[Task] = []
    files = size = 0
    for one in tasks:
        chunk.append(one)
        if one.known is None:
            files += 1
            size += len(one.data)
        if files >= _CHUNK_FILES or size >= _CHUNK_BYTES or len(chunk) >= _CHUNK_KNOWN:
            yield chunk
            chunk, files, size = [], 0, 0
    if chunk:
        yield chunk


# -------------------------------------------------------------------------------------------------- other processes


def order_of(task: Task, sendable: dict[int, Sendable]) -> Order:
    """A file as it is sent.

    `sendable` has settings that many files share: a process is sent the same object once in a chunk.
    """
    if id(task.settings) not in sendable:
        codes = tuple(rule.code.code for rule in task.settings.rules)
        sendable[id(task.settings)] = Sendable(task.settings, replace(task.settings, rules=()), codes)
    found = sendable[id(task.settings)]
    return task._replace(settings=found.without_rules), found.codes


def _sent(executor: Executor, orders: list[Order]) -> Future[list[FileReport]] | None:
    if not orders:
        return None
    return submitted(executor, lint_orders, orders)


def lint_orders(orders: Sequence[Order]) -> list[FileReport]:
    """What a process does with a chunk."""
    return [one._replace(settings=replace(one.settings, rules=_named(codes))).lint() for one, codes in orders]


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    """The rules of these codes; raises ValueError where a package that has some of them is not installed here."""
    found = tuple(rule for rule in rules() if rule.code.code in codes)
    if missing := sorted(set(codes) - {rule.code.code for rule in found}):
        raise ValueError(f"no rule {', '.join(missing)}: install the package that has it, as where the command runs")
    return found
