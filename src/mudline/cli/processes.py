"""Other processes that work on decks: how many, how they are started, and whether that pays.

They end with this one and print nothing.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Thread
from typing import TYPE_CHECKING, TypeVar

import click

from mudline.cli.signals import ignore_interrupt, interrupt_deferred

if TYPE_CHECKING:  # imported by runs that are large enough
    from concurrent.futures import Executor, Future

PAYS = {"fork": 0.1, "forkserver": 1.5, "spawn": 1.5}
"""Seconds of remaining work from which on other processes are started, by the way in which they are.

A copy of this process is there at once; the others take a part of a second to import everything.
"""

_MOST_ON_WINDOWS = 61
"""Processes that one process can wait for there."""

_Given = TypeVar("_Given")
_Made = TypeVar("_Made")


@dataclass(frozen=True, slots=True)
class Effort:
    """The number of processes at most (0: as many as there are processors)."""

    jobs: int = 0

    @property
    def processes(self) -> int:
        """The number of processes that may be used."""
        if self.jobs:
            wanted = self.jobs
        elif hasattr(os, "sched_getaffinity"):
            wanted = len(os.sched_getaffinity(0))
        else:
            wanted = os.cpu_count() or 1
        return min(wanted, _MOST_ON_WINDOWS) if sys.platform == "win32" else wanted


def pays(estimate: float, effort: Effort) -> bool:
    """Whether so many seconds of work are worth starting processes."""
    return effort.processes > 1 and estimate >= PAYS[start_method()]


def start_method() -> str:
    """How processes are started: as copies of this one on Linux, unless it has threads, which copies would lack."""
    if sys.platform in ("win32", "darwin"):
        return "spawn"
    try:
        threads = len(os.listdir("/proc/self/task"))  # noqa: PTH208 - those of libraries, too
    except OSError:
        return "forkserver"
    return "fork" if threads == 1 else "forkserver"


@contextmanager
def pool(processes: int, work: str, module: str) -> Iterator[Executor]:
    """Processes that do something, in words `work` ("linted decks"); they end at once when not all is done.

    `module` is imported before they start. Ends the command where one has died.
    """
    import multiprocessing  # noqa: PLC0415 - most runs are too small to start processes
    from concurrent.futures.process import BrokenProcessPool, ProcessPoolExecutor  # noqa: PLC0415 - as above

    before = set(multiprocessing.active_children())
    method = start_method()
    context = multiprocessing.get_context(method)
    if method == "forkserver":
        context.set_forkserver_preload([module])
    executor = ProcessPoolExecutor(processes, context, _begin)
    try:
        yield executor
    except BaseException as error:
        for child in set(multiprocessing.active_children()) - before:
            child.kill()
        if not isinstance(error, BrokenProcessPool):
            raise
        message = f"a process that {work} has ended early, perhaps out of memory: give fewer decks, or use --jobs 1"
        raise click.ClickException(message) from error
    finally:
        executor.shutdown(cancel_futures=True)


def _begin() -> None:
    """What each process does first."""
    ignore_interrupt()
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process as soon as the one that started it has ended, by whatever it was killed."""
    from multiprocessing import parent_process  # noqa: PLC0415 - other processes have loaded it
    from multiprocessing.connection import wait  # noqa: PLC0415 - as above

    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


def submitted(executor: Executor, work: Callable[[_Given], _Made], given: _Given) -> Future[_Made]:
    """Give a process something to do."""
    with interrupt_deferred():
        return executor.submit(work, given)
