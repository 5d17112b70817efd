"""Signals that end a run: what the system sends when it wants the program to end is like Ctrl-C, and cleans up."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
_FIRST = 128
"""Exit codes of shells for what a signal has ended begin here."""


class Ended(KeyboardInterrupt):
    """The system ends the program: by `kill`, at a shutdown, or because its terminal is closed."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.code = _FIRST + number


@contextmanager
def ending_cleans_up() -> Iterator[None]:
    """Raise Ended for SIGTERM and SIGHUP while the block runs; what was ignored before, as by nohup, stays so."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    taken = [number for number in _ENDING if signal.getsignal(number) is signal.SIG_DFL]
    for number in taken:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, _: FrameType | None) -> None:
    raise Ended(number)


def ignore_interrupt() -> None:
    """Ignore Ctrl-C, which reaches all processes of a terminal: the first one ends the others.

    A closed terminal reaches all of them too; SIGTERM ends this one as it would any other program.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in _ENDING:
        signal.signal(number, signal.SIG_DFL if number == signal.SIGTERM else signal.SIG_IGN)


@contextmanager
def interrupt_deferred() -> Iterator[None]:
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
