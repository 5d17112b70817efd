"""Processes that tests start heed signals that the suite ignores, and are ended whatever happens."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import pytest

from tests.processes import TIMEOUT, started

pytestmark = pytest.mark.skipif(os.name != "posix", reason="no process groups here")

SLEEPER = "import time; print('awake', flush=True); time.sleep(600)"
FAMILY = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {SLEEPER!r}])"


@pytest.fixture
def _in_the_background() -> Iterator[None]:
    """What a shell does to the processes that it starts in the background."""
    before = {number: signal.signal(number, signal.SIG_IGN) for number in (signal.SIGINT, signal.SIGTERM)}
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, before)
    yield
    signal.pthread_sigmask(signal.SIG_SETMASK, masked)
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.usefixtures("_in_the_background")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_that_the_suite_ignores_are_heeded(number: signal.Signals) -> None:
    with started("-c", SLEEPER) as running:
        assert running.out.readline() == b"awake\n"
        running.process.send_signal(number)
        assert running.process.wait(TIMEOUT) == -number


def test_standard_input_stays_open_until_the_end() -> None:
    with started("-c", "import sys; print('asked', flush=True); sys.stdin.read()") as running:
        assert running.out.readline() == b"asked\n"
        assert running.process.poll() is None
    assert running.process.returncode == -signal.SIGKILL


def test_a_test_that_fails_ends_what_it_started() -> None:
    with pytest.raises(RuntimeError, match="the test fails"), started("-c", SLEEPER) as running:
        raise RuntimeError("the test fails")
    assert running.process.returncode == -signal.SIGKILL


def test_waiting_ends_when_the_time_is_over() -> None:
    """The pipe ends when the last process that could write to it is dead."""
    with started("-c", FAMILY, seconds=1.0) as running:
        assert running.out.read() in {b"awake\n", b""}
        assert running.process.wait(TIMEOUT) == -signal.SIGKILL
