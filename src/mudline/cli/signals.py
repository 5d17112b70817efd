"""Signals that end a run: what the system sends when it wants the program to end is like Ctrl-C, and cleans up."""

from __future__ import annotations

import signal
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
