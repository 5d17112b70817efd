"""Linting in other processes, which end with this one and say nothing of their own."""

from __future__ import annotations

import multiprocessing
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, NamedTuple, Self

import click

from mudline.linting.engine import LintSettings
from mudline.linting.lint_file import FileReport, lint_one
from mudline.linting.registry import rules
from mudline.linting.rule import Rule

if TYPE_CHECKING:
    from mudline.cli.lint_jobs import Task

_MOST_ON_WINDOWS = 61
"""Processes that one process can wait for there."""

Promise = Callable[[], Sequence[FileReport]]
"""Waits for the reports of a chunk."""


class Order(NamedTuple):
    """A file to lint, as it is sent: `codes` stand for the rules of the settings, whose functions may not travel."""

    name: str
    data: bytes
    folder: Path | None
    settings: LintSettings
    codes: tuple[str, ...]


class Pool:
    """Processes that lint. Leaving it before all is done ends them at once."""

    def __init__(self, processes: int) -> None:
        self.processes = min(processes, _MOST_ON_WINDOWS) if sys.platform == "win32" else processes
        self._before = set(multiprocessing.active_children())
        context = multiprocessing.get_context(_method())
        if _method() == "forkserver":
            context.set_forkserver_preload([__name__])
        self._executor = ProcessPoolExecutor(self.processes, context, _quiet)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            for child in set(multiprocessing.active_children()) - self._before:
                child.kill()
        self._executor.shutdown(cancel_futures=True)

    def lint(self, tasks: Sequence[Task]) -> Promise:
        """Send files to a process."""
        if not tasks:
            return tuple
        orders = [_order(task) for task in tasks]
        try:
            with _deaf():
                future = self._executor.submit(lint_orders, orders)
        except BrokenProcessPool as error:
            raise _lost() from error

        def wait() -> Sequence[FileReport]:
            try:
                return future.result()
            except BrokenProcessPool as error:
                raise _lost() from error

        return wait


def lint_orders(orders: Sequence[Order]) -> list[FileReport]:
    """What a process does with a chunk."""
    return [lint_one(one.name, one.data, replace(one.settings, rules=_named(one.codes)), one.folder) for one in orders]


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    return tuple(rule for rule in rules() if rule.code.code in codes)


def _order(task: Task) -> Order:
    codes = tuple(rule.code.code for rule in task.settings.rules)
    return Order(task.file.name, task.data, task.file.folder, replace(task.settings, rules=()), codes)


def _method() -> str:
    """How processes are started: never as a copy of this one, whose threads would be lost in it."""
    return "forkserver" if sys.platform not in ("win32", "darwin") else "spawn"


def _quiet() -> None:
    """Ctrl-C reaches all processes of a terminal: the first one tells the others to end."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def _deaf() -> Iterator[None]:
    """Processes that are started here do not hear Ctrl-C even before they can say so; this one hears it afterwards."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    masked = sys.platform != "win32" and signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if sys.platform != "win32":
            signal.pthread_sigmask(signal.SIG_SETMASK, masked or ())
        signal.signal(signal.SIGINT, before)
        if heard:
            signal.raise_signal(signal.SIGINT)


def _lost() -> click.ClickException:
    message = "a process that linted decks has ended early, as when memory runs out: lint fewer decks, or use --jobs 1"
    return click.ClickException(message)
