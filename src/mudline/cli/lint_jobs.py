"""Linting many files: what the cache holds, the rest here or in other processes, always in the order given."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from mudline.cli.inputs import Input, Inputs
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.fixing import FileReport, lint_one

if TYPE_CHECKING:  # both are imported by runs that are large enough
    from mudline.cli.lint_pool import Arguments, Pool, Promise
    from mudline.linting.cache import Cache

PAYS = 1.5
"""Seconds of remaining work from which on other processes are started: each takes a part of a second to start."""

TRIED = 0.2
"""Seconds of linting by which the remaining work is estimated."""

CACHED_FILES = 50
CACHED_BYTES = 1_000_000
"""Files, or bytes of fewer files, from which on a run asks the cache."""

_CHUNK_FILES = 16
_CHUNK_BYTES = 500_000
_CHUNK_KNOWN = 256

SettingsOf = Callable[[Input], LintSettings]
"""The settings of a file."""
Linted = tuple[Input, bytes, FileReport]


@dataclass(frozen=True, slots=True)
class Effort:
    """The number of processes at most (0: as many as there are processors), and whether the cache is used."""

    jobs: int = 0
    cached: bool = True

    @property
    def processes(self) -> int:
        """The number of processes that may be used."""
        if self.jobs:
            return self.jobs
        if hasattr(os, "sched_getaffinity"):
            return len(os.sched_getaffinity(0))
        return os.cpu_count() or 1


class Task(NamedTuple):
    """A file to lint; `known` is its report if the cache has it, `key` the key of its report in the cache, if any."""

    file: Input
    data: bytes
    settings: LintSettings
    key: str = ""
    known: FileReport | None = None

    @property
    def arguments(self) -> Arguments:
        """The arguments of `lint_one`."""
        return self.file.name, self.data, self.settings, self.file.folder

    def lint(self) -> FileReport:
        """The report, from the cache or made in this process."""
        return self.known or lint_one(*self.arguments)


def lint_all(inputs: Inputs, settings_of: SettingsOf, effort: Effort) -> Generator[Linted, None, None]:
    """Each file that can be read with its content and its report, in the order of the files."""
    cache = _cache_for(inputs, effort)
    tasks = (_task(file, data, settings_of(file), cache) for file, data in inputs.contents())
    with closing(_reports(tasks, len(inputs.files), effort)) as reports:
        for one, report in reports:
            if cache is not None and one.key and one.known is None:
                cache.put(one.key, report)
            yield one.file, one.data, report
    if cache is not None:
        cache.save()


def _cache_for(inputs: Inputs, effort: Effort) -> Cache | None:
    """The cache, if a run is large enough for it to pay."""
    if not effort.cached or (len(inputs.files) < CACHED_FILES and _size(inputs) < CACHED_BYTES):
        return None
    from mudline.linting.cache import opened  # noqa: PLC0415 - small runs do without it

    return opened()


def _task(file: Input, data: bytes, settings: LintSettings, cache: Cache | None) -> Task:
    """A file with its report if the cache has it; not for fixing, nor for standard input."""
    if cache is None or file.path is None or settings.fixing is not Fixing.NONE:
        return Task(file, data, settings)
    key = cache.key(file.name, data, settings)
    return Task(file, data, settings, key, cache.get(key, file.name) if key else None)


def _reports(tasks: Iterable[Task], count: int, effort: Effort) -> Generator[tuple[Task, FileReport], None, None]:
    """The reports of so many files, in their order. Processes are used once that pays."""
    rest = iter(tasks)
    spent = 0.0
    for done, one in enumerate(rest, 1):
        start = time.perf_counter()
        report = one.lint()
        spent += time.perf_counter() - start
        yield one, report
        if one.settings.fixing is Fixing.NONE and spent >= TRIED and _pays(spent / done * (count - done), effort):
            break
    else:
        return
    from mudline.cli.lint_pool import Pool  # noqa: PLC0415 - as above

    with Pool(effort.processes) as pool:
        yield from _ahead(rest, pool)


def _pays(estimate: float, effort: Effort) -> bool:
    return estimate >= PAYS and effort.processes > 1


def _ahead(tasks: Iterable[Task], pool: Pool) -> Iterator[tuple[Task, FileReport]]:
    """The reports in order, while the processes work ahead on a bounded number of files."""
    waiting: deque[tuple[list[Task], Promise]] = deque()
    for chunk in _chunks(tasks):
        waiting.append((chunk, pool.lint([one.arguments for one in chunk if one.known is None])))
        if len(waiting) > 2 * pool.processes:
            yield from _done(*waiting.popleft())
    while waiting:
        yield from _done(*waiting.popleft())


def _done(chunk: list[Task], promise: Promise) -> Iterator[tuple[Task, FileReport]]:
    made = iter(promise())
    for one in chunk:
        yield one, one.known or next(made)


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


def _size(inputs: Inputs) -> int:
    total = 0
    for file in inputs.files:
        try:
            total += 0 if file.path is None else Path(file.path).stat().st_size
        except OSError:  # reported when it is read
            continue
    return total
