"""Many files through the linter: what the cache knows, the rest here or in processes, always in the order given."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from mudline.cli.inputs import Input, Inputs
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.lint_file import FileReport, lint_one

if TYPE_CHECKING:  # both are imported by runs that are large enough
    from mudline.cli.lint_pool import Pool, Promise
    from mudline.linting.cache import Cache

PAYS = 1.5
"""Seconds of work to come from which on other processes are started for it: each takes a part of one to start."""

TRIED = 0.2
"""Seconds of linting by which the work to come is estimated."""

CACHED_FILES = 50
CACHED_BYTES = 1_000_000
"""Files, or bytes of fewer files, from which on a run asks the cache."""

_CHUNK_FILES = 16
_CHUNK_BYTES = 500_000
_CHUNK_KNOWN = 256

Linted = tuple[Input, bytes, FileReport]


@dataclass(frozen=True, slots=True)
class Effort:
    """How a run may work: with how many processes at most (0: as many as there are processors), with a cache or not."""

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
    """A file to lint; `known` is its report if the cache has it, `key` what its report is kept under, if anything."""

    file: Input
    data: bytes
    settings: LintSettings
    key: str = ""
    known: FileReport | None = None

    def lint(self) -> FileReport:
        """The report, made here."""
        return self.known or lint_one(self.file.name, self.data, self.settings, self.file.folder)


def cache_for(inputs: Inputs, effort: Effort) -> Cache | None:
    """The cache, if a run is large enough for it to pay."""
    if not effort.cached or (len(inputs.files) < CACHED_FILES and _size(inputs) < CACHED_BYTES):
        return None
    from mudline.linting.cache import opened  # noqa: PLC0415 - small runs do without it

    return opened()


def task(file: Input, data: bytes, settings: LintSettings, cache: Cache | None) -> Task:
    """A file with what the cache knows of it; fixing, and standard input, ask it nothing."""
    if cache is None or file.path is None or settings.fixing is not Fixing.NONE:
        return Task(file, data, settings)
    key = cache.key(file.name, data, settings)
    return Task(file, data, settings, key, cache.get(key, file.name) if key else None)


def linted(tasks: Iterable[Task], count: int, effort: Effort, cache: Cache | None) -> Iterator[Linted]:
    """The reports of so many files, in their order; new ones go to the cache. Processes are used once that pays."""
    rest = iter(tasks)
    spent = 0.0
    for done, one in enumerate(rest, 1):
        start = time.perf_counter()
        report = one.lint()
        spent += time.perf_counter() - start
        _keep(one, report, cache)
        yield one.file, one.data, report
        if one.settings.fixing is Fixing.NONE and spent >= TRIED and _pays(spent / done * (count - done), effort):
            break
    else:
        return
    from mudline.cli.lint_pool import Pool  # noqa: PLC0415 - nor are processes known to small runs

    with Pool(effort.processes) as pool:
        for one, report in _ahead(rest, pool):
            _keep(one, report, cache)
            yield one.file, one.data, report


def _pays(estimate: float, effort: Effort) -> bool:
    return estimate >= PAYS and effort.processes > 1


def _keep(one: Task, report: FileReport, cache: Cache | None) -> None:
    if cache is not None and one.key and one.known is None:
        cache.put(one.key, report)


def _ahead(tasks: Iterable[Task], pool: Pool) -> Iterator[tuple[Task, FileReport]]:
    """The reports in order, while the processes work on a bounded number of files further behind."""
    waiting: deque[tuple[list[Task], Promise]] = deque()
    for chunk in _chunks(tasks):
        waiting.append((chunk, pool.lint([one for one in chunk if one.known is None])))
        if len(waiting) > 2 * pool.processes:
            yield from _done(*waiting.popleft())
    while waiting:
        yield from _done(*waiting.popleft())


def _done(chunk: list[Task], promise: Promise) -> Iterator[tuple[Task, FileReport]]:
    made = iter(promise())
    for one in chunk:
        yield one, one.known or next(made)


def _chunks(tasks: Iterable[Task]) -> Iterator[list[Task]]:
    """Files that go to a process together: few enough that none waits long."""
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
        except OSError:  # told when it is read
            continue
    return total
