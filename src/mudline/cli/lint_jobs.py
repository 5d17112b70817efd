"""Linting many files: what the cache holds, the rest here or in other processes, always in the order given.

The processes end with this one and print nothing.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from mudline.cli.inputs import Input, Inputs
from mudline.cli.lint_known import KnownDecks
from mudline.cli.processes import Effort, pays, pool, submitted
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import plugin_files, rules
from mudline.linting.rule import Rule

if TYPE_CHECKING:  # imported by runs that are large enough
    from concurrent.futures import Executor, Future

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
        waiting.append((chunk, _sent(executor, [_order(one, sendable) for one in chunk if one.known is None])))
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


def _order(task: Task, sendable: dict[int, Sendable]) -> Order:
    """`sendable` has settings that many files share: a process is sent the same object once in a chunk."""
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
    return tuple(rule for rule in rules() if rule.code.code in codes)
