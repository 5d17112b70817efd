"""A scheduler of dask and worker processes on loopback, as `dask scheduler` and `dask worker` start them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from tests.processes import TIMEOUT

ROOT = Path(__file__).parents[2]
_LOOPBACK = ("--host", "127.0.0.1", "--no-dashboard")


def wait_until(condition: Callable[[], object], what: str, seconds: float = TIMEOUT) -> None:
    """Wait for a condition; fails when it takes too long."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited {seconds:g} s: {what}"
        time.sleep(0.01)


@dataclass
class Processes:
    """The processes of a cluster; `folder` has their logs, `environment` what differs from that of this process.

    `options` are those of both commands, such as --tls-*.
    """

    folder: Path
    environment: dict[str, str]
    options: tuple[str, ...] = ()
    address: str = ""
    scheduler: subprocess.Popen[bytes] | None = None
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)
    _started: int = 0

    def _start(self, *words: str) -> tuple[subprocess.Popen[bytes], Path]:
        self._started += 1
        log = self.folder / f"{self._started}.log"
        with log.open("wb") as stream:
            command = [sys.executable, "-m", "dask", *words, *self.options]
            environment = {**os.environ, **self.environment}
            process = subprocess.Popen(command, stdout=stream, stderr=stream, env=environment, start_new_session=True)
        return process, log

    def start_scheduler(self) -> None:
        """Start a scheduler at a free port."""
        protocol = ("--protocol", "tls") if self.options else ()
        self.scheduler, log = self._start("scheduler", *_LOOPBACK, "--port", "0", *protocol)
        mark = "Scheduler at:"
        wait_until(partial(_says, log, mark), f"no scheduler: {log}")
        line = next(line for line in log.read_text(encoding="utf-8").splitlines() if mark in line)
        self.address = line.split(mark)[1].strip()

    def start_workers(self, count: int) -> None:
        """Start workers until so many are alive; returns when the scheduler knows them."""
        self.workers = [one for one in self.workers if one.poll() is None]
        for process, log in [self._worker() for _ in range(count - len(self.workers))]:
            wait_until(partial(_says, log, "Registered to:"), f"no worker: {log}")
            self.workers.append(process)

    def _worker(self) -> tuple[subprocess.Popen[bytes], Path]:
        words = ("worker", self.address, *_LOOPBACK, "--nthreads", "1", "--no-nanny", "--memory-limit", "0")
        return self._start(*words, "--local-directory", str(self.folder))

    def kill_worker(self) -> int:
        """Kill the first worker; returns the exit code of its process."""
        self.workers[0].send_signal(signal.SIGKILL)
        return self.workers.pop(0).wait(TIMEOUT)

    def end(self) -> None:
        """Kill all processes and wait for them."""
        for process in (*self.workers, *([self.scheduler] if self.scheduler else ())):
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait(TIMEOUT)


def _says(log: Path, text: str) -> bool:
    return text in log.read_text(encoding="utf-8")


@contextmanager
def running(
    folder: Path, workers: int, environment: dict[str, str] | None = None, options: tuple[str, ...] = ()
) -> Iterator[Processes]:
    """A scheduler with workers, which end with the block."""
    path = os.pathsep.join([str(ROOT / "src"), str(ROOT)])
    processes = Processes(folder, {"PYTHONPATH": path, "OPENBLAS_NUM_THREADS": "1", **(environment or {})}, options)
    try:
        processes.start_scheduler()
        processes.start_workers(workers)
        yield processes
    finally:
        processes.end()
