"""Functions over many items: in this process while that is fastest, then in others, or by workers of a scheduler.

Scheduler, workers, retries, heartbeats and TLS are Dask's own, with Dask's configuration.
"""

from __future__ import annotations

import os
import re
import signal
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar, TypeVarTuple

from mudline.basics.installed import install_hint
from mudline.basics.outside import refusing_outside
from mudline.basics.overwriting import ClaimedOutputs, OverwriteError, continue_run, outputs
from mudline.basics.version import __version__
from mudline.language.diagnostics import PluginError

if TYPE_CHECKING:  # imported by runs that are large enough
    from concurrent.futures import Executor, Future

    from distributed import Client

PAYS = {"fork": 0.1, "forkserver": 1.5, "spawn": 1.5}
"""Seconds of remaining work from which on other processes are started, by start method.

A fork is available at once; other processes take a fraction of a second to import everything.
"""
TRIED = 0.05
"""Seconds of work in this process from which the remaining work is estimated."""

CONNECTING = 10.0
"""Seconds to wait for a scheduler, and for its first worker."""

_AHEAD = 4
"""Items sent ahead for each process or worker thread."""
_COUNTED = 5.0
"""Seconds after which the workers of a scheduler are counted again: their number changes."""
_MOST_ON_WINDOWS = 61
"""Processes that one process can wait for on Windows."""

_SAFE_PATH = "PYTHONSAFEPATH"
"""Variable by which Python processes that this one starts import no modules of the working folder."""

_ADDRESS = r"(?P<protocol>tcp|tls)://(?P<host>\[[0-9A-Fa-f:.]+\]|[A-Za-z0-9._-]+):(?P<port>[0-9]{1,5})"
"""Strict pattern of addresses: a form that Dask parses differently would escape the check."""

_LOOPBACK = ("localhost", "127.0.0.1", "[::1]")
"""Hosts that nobody else reaches."""
_ENDED = "a process has ended early, perhaps out of memory: give fewer files, or use --jobs 1"

_Item = TypeVar("_Item")
_Given = TypeVarTuple("_Given")
_Made = TypeVar("_Made")


class RunError(Exception):
    """Reason why items cannot be processed elsewhere, with advice."""


# -------------------------------------------------------------------------------------------------------- what to use


@dataclass(eq=False)
class Pool:
    """Processes, at most `jobs` (0: one for each processor), or the workers of a scheduler; started on first use."""

    jobs: int
    scheduler: str | None
    _stack: ExitStack
    _executor: Executor | None = None
    _client: Client | None = None
    _threads: int = 1
    _counted: float = 0.0

    @property
    def size(self) -> int:
        """Number of items that may be in progress at a time."""
        if self.scheduler is None:
            return processors(self.jobs)
        if self._client is not None and time.monotonic() - self._counted > _COUNTED:
            self._threads, self._counted = max(1, sum(self._client.nthreads().values())), time.monotonic()
        return self._threads

    def submit(self, work: Callable[[*_Given], _Made], given: tuple[*_Given]) -> Future[_Made | Crash]:
        """Submit work for an item; raises RunError."""
        if self._executor is None:
            if self.scheduler is None:
                self._executor = self._stack.enter_context(_processes(self.size, work.__module__))
            else:
                self._client = self._stack.enter_context(_connected(self.scheduler))
                self._executor = self._client.get_executor(pure=False)
                self._stack.callback(self._executor.shutdown, wait=False)
        from concurrent.futures.process import BrokenProcessPool  # noqa: PLC0415 - most runs are too small for it

        try:
            with interrupt_deferred():
                return self._executor.submit(_done, __version__, work, given)
        except (BrokenProcessPool, EOFError, ConnectionError) as error:  # also from the forkserver
            raise RunError(_ENDED) from error

    def result(self, future: Future[_Made] | None) -> _Made | None:
        """Return the result of a future, None for none; raises RunError, and any exception of the function."""
        from concurrent.futures import CancelledError  # noqa: PLC0415 - most runs are too small for it
        from concurrent.futures.process import BrokenProcessPool  # noqa: PLC0415 - as above

        try:
            return None if future is None else future.result()
        except BrokenProcessPool as error:
            raise RunError(_ENDED) from error
        except CancelledError as error:
            raise RunError(f"{self.scheduler}: the scheduler has gone away: start it, and run this again") from error
        except (ImportError, AttributeError) as error:
            if self.scheduler is None:
                raise
            what = f"a worker lacks what this command has ({error}): install mudline {__version__} and its plugins"
            raise RunError(f"{self.scheduler}: {what}") from error
        except Exception as error:
            if type(error).__name__ != "KilledWorker":
                raise
            what = "each worker that tried some of the files has ended, perhaps out of memory: see their logs"
            raise RunError(f"{self.scheduler}: {what}") from error


def many(
    work: Callable[[*_Given], _Made],
    items: Iterable[tuple[_Item, tuple[*_Given] | None]],
    count: int,
    jobs: int = 0,
    scheduler: str | None = None,
) -> Generator[tuple[_Item, _Made | Crash | None], None, None]:
    """Yield each of about `count` items with the result of the work, in order; few items are taken ahead.

    An item comes with the arguments of the work, which are pickled. With None there is no work and its result is None.
    The work is a function of a module, which other processes find by its name. If it fails for an item, the result is a
    Crash. Raises RunError, and the other exceptions in NO_CRASH.

    Processes are started, and a scheduler is connected, when needed. Close the generator to end processes at once and
    to cancel the remaining work of a scheduler.
    """
    rest = iter(items)
    spent, done, number = 0.0, 0, 0
    with ExitStack() as stack:
        pool = Pool(jobs, scheduler, stack)
        for item, given in rest:
            if scheduler is not None and given is not None:
                rest = chain([(item, given)], rest)
                break
            start = time.perf_counter()
            result = None if given is None else _tried(work, given)
            spent, done, number = spent + time.perf_counter() - start, done + (given is not None), number + 1
            yield item, result
            if spent >= TRIED and done and pool.size > 1 and spent / done * (count - number) >= PAYS[start_method()]:
                break
        waiting = deque[tuple[_Item, "Future[_Made | Crash] | None"]]()
        for item, given in rest:
            waiting.append((item, None if given is None else pool.submit(work, given)))
            while waiting and (waiting[0][1] is None or len(waiting) > _AHEAD * pool.size):
                first, future = waiting.popleft()
                yield first, pool.result(future)
        yield from ((item, pool.result(future)) for item, future in waiting)


class Crash(NamedTuple):
    """Fault of the program itself: exception and place on one line, and its traceback."""

    summary: str
    traceback: str

    @classmethod
    def of(cls, error: Exception) -> Crash:
        """Return the crash of an exception."""
        *_, last = traceback.extract_tb(error.__traceback__)
        text = "".join(traceback.format_exception(error))
        what = " ".join("".join(traceback.format_exception_only(error)).split())
        return cls(f"{what} ({Path(last.filename).name}, line {last.lineno})", text)


NO_CRASH = (RunError, OverwriteError, PluginError, MemoryError, ImportError)
"""Exceptions that end a run, whatever the item."""


def _tried(work: Callable[[*_Given], _Made], given: tuple[*_Given]) -> _Made | Crash:
    """Return the result of the work, or its crash."""
    try:
        return work(*given)
    except NO_CRASH:
        raise
    except Exception as error:  # noqa: BLE001 - a fault of the program, which is reported as one
        return Crash.of(error)


def _done(version: str, work: Callable[[*_Given], _Made], given: tuple[*_Given]) -> _Made | Crash:
    """Do the work in a process or a worker, and return the result."""
    if version != __version__:
        raise RunError(f"a worker has mudline {__version__}, the command {version}: install the same version")
    from mudline.checks.configuration import refuses_outside  # noqa: PLC0415 - only where there are workers

    with refusing_outside(refuses_outside):
        return _tried(work, given)


# ---------------------------------------------------------------------------------------------------------- processes


def processors(jobs: int) -> int:
    """Return the number of processes that may be used."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    count = jobs or usable or 1
    return min(count, _MOST_ON_WINDOWS) if sys.platform == "win32" else count


def start_method() -> str:
    """Return the start method of processes: fork on Linux, unless this process has threads, which forks would lack."""
    if sys.platform in ("win32", "darwin"):
        return "spawn"
    try:
        threads = len(os.listdir("/proc/self/task"))  # noqa: PTH208 - including threads of libraries
    except OSError:
        return "forkserver"
    return "fork" if threads == 1 else "forkserver"


@contextmanager
def _processes(count: int, module: str) -> Iterator[Executor]:
    """Start processes that import a module first; they end at once if the block is left by an exception."""
    import multiprocessing  # noqa: PLC0415 - most runs are too small to start processes
    from concurrent.futures import ProcessPoolExecutor  # noqa: PLC0415 - as above

    before = set(multiprocessing.active_children())
    method = start_method()
    context = multiprocessing.get_context(method)
    if method == "forkserver":
        context.set_forkserver_preload([module])
    executor = ProcessPoolExecutor(count, context, _begin, (outputs(),))
    safe = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    try:
        yield executor
    except BaseException:
        for child in set(multiprocessing.active_children()) - before:
            child.kill()
        raise
    finally:
        executor.shutdown(cancel_futures=True)
        if safe is None:
            del os.environ[_SAFE_PATH]
        else:
            os.environ[_SAFE_PATH] = safe


def _begin(known: ClaimedOutputs) -> None:
    """Prepare a process: ignore Ctrl-C and a closed terminal, which reach all processes, and watch the parent.

    `known` are the outputs of the run, none of which the process may read.
    """
    continue_run(known)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "SIGHUP"):
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process as soon as its parent has ended for any reason."""
    from multiprocessing import parent_process  # noqa: PLC0415 - other processes have loaded it
    from multiprocessing.connection import wait  # noqa: PLC0415 - as above

    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


@contextmanager
def interrupt_deferred() -> Iterator[None]:
    """Defer Ctrl-C until the block ends; processes started in the block do not receive it until they ignore it."""
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


# ---------------------------------------------------------------------------------------------------------- scheduler


def check_address(address: str) -> None:
    """Raise RunError for an address that is invalid or not safe to use, or if Dask is not installed.

    A scheduler and its workers run any code that they receive: a scheduler that others can reach needs TLS.
    """
    match = re.fullmatch(_ADDRESS, address)
    if match is None or not 0 < int(match["port"]) < 1 << 16:
        raise RunError(f"--scheduler {address}: expected tcp://HOST:PORT or tls://HOST:PORT")
    if find_spec("distributed") is None:
        raise RunError(f"--scheduler needs dask.distributed: {install_hint('cluster')}")
    if match["protocol"] == "tls" or match["host"] in _LOOPBACK:
        return
    import dask.config  # noqa: PLC0415 - as above
    import distributed  # noqa: F401, PLC0415 - brings its defaults, in which this is null

    if dask.config.get("distributed.comm.require-encryption", None) is not False:
        raise RunError(
            f"--scheduler {address}: without TLS, whoever reaches it can run code on it and on this machine: use "
            "tls:// with the certificates of Dask's configuration; on a network that nobody else reaches, set "
            "distributed.comm.require-encryption to false there"
        )


@contextmanager
def _connected(address: str) -> Iterator[Client]:
    """Connect to the scheduler, and wait until it has a worker; raises RunError."""
    import logging  # noqa: PLC0415 - few runs have a scheduler

    import dask.config  # noqa: PLC0415 - as above
    from distributed import Client  # noqa: PLC0415 - as above

    for name in ("asyncio", *logging.root.manager.loggerDict):  # the command reports errors once
        if name.partition(".")[0] in {"asyncio", "distributed", "tornado"}:
            logging.getLogger(name).setLevel(logging.CRITICAL)
    dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 TB"})  # files may be large
    try:
        client = Client(address, timeout=CONNECTING, set_as_default=False)
    except (OSError, TimeoutError, ValueError, RuntimeError, TypeError) as error:
        text = " ".join(str(error).split())[:200]
        raise RunError(f"{address}: the scheduler cannot be reached: {text}") from error
    try:
        client.wait_for_workers(1, timeout=CONNECTING)
        yield client
    except TimeoutError as error:
        raise RunError(f"{address}: the scheduler has no worker: start one with dask worker {address}") from error
    finally:
        client.close(timeout=2)
