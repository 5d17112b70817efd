"""Linting in other processes, which end with this one and print nothing."""

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
from typing import NamedTuple, Self

import click

from mudline.linting.engine import LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import rules
from mudline.linting.rule import Rule

_MOST_ON_WINDOWS = 61
"""Processes that one process can wait for there."""

Arguments = tuple[str, bytes, LintSettings, Path | None]
"""A file to lint, as the arguments of `lint_one`."""

Promise = Callable[[], Sequence[FileReport]]
"""Waits for the reports of a chunk."""


class Order(NamedTuple):
    """A file as it is sent: `codes` replace the rules of the settings, whose functions may not be picklable."""

    name: str
    data: bytes
    settings: LintSettings
    folder: Path | None
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

    def lint(self, files: Sequence[Arguments]) -> Promise:
        """Send files to a process."""
        if not files:
            return tuple
        with _dying_reported(), _interrupt_deferred():
            future = self._executor.submit(lint_orders, [_order(*file) for file in files])

        def wait() -> Sequence[FileReport]:
            with _dying_reported():
                return future.result()

        return wait


def lint_orders(orders: Sequence[Order]) -> list[FileReport]:
    """What a process does with a chunk."""
    return [lint_one(one.name, one.data, replace(one.settings, rules=_named(one.codes)), one.folder) for one in orders]


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    return tuple(rule for rule in rules() if rule.code.code in codes)


def _order(name: str, data: bytes, settings: LintSettings, folder: Path | None) -> Order:
    return Order(name, data, replace(settings, rules=()), folder, tuple(rule.code.code for rule in settings.rules))


def _method() -> str:
    """How processes are started: never as a copy of this one, which would lack its threads."""
    return "forkserver" if sys.platform not in ("win32", "darwin") else "spawn"


def _quiet() -> None:
    """Ignore Ctrl-C, which reaches all processes of a terminal: the first one ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def _interrupt_deferred() -> Iterator[None]:
    """Block Ctrl-C, also in processes that are started here until they ignore it; this one gets it afterwards."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    received: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: received.append(number))
    masked = sys.platform != "win32" and signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if sys.platform != "win32":
            signal.pthread_sigmask(signal.SIG_SETMASK, masked or ())
        signal.signal(signal.SIGINT, before)
        if received:
            signal.raise_signal(signal.SIGINT)


@contextmanager
def _dying_reported() -> Iterator[None]:
    """End the command where a process has died."""
    try:
        yield
    except BrokenProcessPool as error:
        message = "a process that linted decks has ended early, perhaps out of memory: lint fewer, or use --jobs 1"
        raise click.ClickException(message) from error
