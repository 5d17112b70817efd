"""Processes that tests start: none of them hears less than it would in a terminal, and none outlives its test."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import IO, NamedTuple

TIMEOUT = 120
"""Seconds for a process that ends by itself: what takes longer hangs."""

_LAUNCHER = """
import os, signal, sys
for number in (signal.SIGHUP, signal.SIGINT, signal.SIGPIPE, signal.SIGQUIT, signal.SIGTERM):
    signal.signal(number, signal.SIG_DFL)
signal.pthread_sigmask(signal.SIG_SETMASK, ())
os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""
"""A shell that starts the suite in the background lets it ignore SIGINT, and all processes inherit that."""


class Running(NamedTuple):
    """A process with its standard output and error."""

    process: subprocess.Popen[bytes]
    out: IO[bytes]
    err: IO[bytes]


@contextmanager
def started(*arguments: str, seconds: float = TIMEOUT) -> Iterator[Running]:
    """Python with arguments, as a process that heeds signals and whose standard input stays open and empty.

    It is killed, with those that it has started, when the block ends before it does, or after so many seconds: then its
    streams end, and whoever waits for them or for the process goes on.
    """
    words = [sys.executable, "-I", "-S", "-c", _LAUNCHER, *arguments]
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, stderr=pipe, start_new_session=True) as process:
        guard = threading.Timer(seconds, end, [process])
        guard.daemon = True
        guard.start()
        try:
            assert process.stdout
            assert process.stderr
            yield Running(process, process.stdout, process.stderr)
        finally:
            guard.cancel()
            end(process)


def end(process: subprocess.Popen[bytes]) -> None:
    """Kill the process group that a process leads, if the process still runs."""
    if process.poll() is None:
        with suppress(ProcessLookupError, PermissionError):  # it ended just now
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(TIMEOUT)
