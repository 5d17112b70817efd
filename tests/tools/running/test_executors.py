"""Functions over items in other processes, and which schedulers may be used."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Iterator
from concurrent.futures import CancelledError, Future
from contextlib import ExitStack, closing
from importlib.util import find_spec
from pathlib import Path

import pytest

from mudline.tools.running import executors
from mudline.tools.running.executors import Crash, Pool, RunError, check_address, many, start_method


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes are used behind the first item, whatever there is to do."""
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setattr(executors, "TRIED", 0.0)


def squared(number: int) -> tuple[int, int]:
    return number * number, os.getpid()


def end(number: int) -> int:
    """A process that dies, unless it is the one of the test."""
    if multiprocessing.parent_process() is not None:
        os._exit(number)
    return number


def refuse(number: int) -> int:
    if multiprocessing.parent_process() is None:
        return number
    raise MemoryError(number)


def fail_of_odd(number: int) -> int:
    if number % 2:
        raise ValueError(number)
    return number


def numbers(count: int) -> Iterator[tuple[int, tuple[int]]]:
    return ((number, (number,)) for number in range(count))


def items(count: int, taken: list[int]) -> Iterator[tuple[int, tuple[int] | None]]:
    """Numbers, of which every third needs nothing to be done."""
    for number in range(count):
        taken.append(number)
        yield number, None if number % 3 == 2 else (number,)


@pytest.mark.usefixtures("eager")
def test_results_are_in_order_and_few_are_taken_ahead() -> None:
    taken: list[int] = []
    used = set()
    with closing(many(squared, items(200, taken), 200, 2)) as results:
        for done, (number, made) in enumerate(results):
            assert number == done
            assert not isinstance(made, Crash)
            assert (made is None) == (number % 3 == 2)
            if made is not None:
                assert made[0] == number * number
                used.add(made[1])
            assert len(taken) - done <= executors._AHEAD * 2 + 2
    assert os.getpid() in used
    assert len(used) > 1
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
def test_a_process_that_dies_is_reported() -> None:
    with pytest.raises(RunError, match="a process has ended early, perhaps out of memory"):
        list(many(end, numbers(20), 20, 2))
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
def test_what_no_item_is_the_reason_of_ends_all() -> None:
    with pytest.raises(MemoryError, match=r"[0-9]"):
        list(many(refuse, numbers(20), 20, 2))
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
def test_a_fault_is_that_of_its_item() -> None:
    for number, made in many(fail_of_odd, numbers(20), 20, 2):
        if number % 2:
            assert isinstance(made, Crash)
            assert made.summary.startswith(f"ValueError: {number} (test_executors.py, line ")
            assert made.traceback.startswith("Traceback (most recent call last)")
        else:
            assert made == number


def sleep(seconds: float) -> None:
    if multiprocessing.parent_process() is not None:
        time.sleep(seconds)


@pytest.mark.usefixtures("eager")
def test_processes_end_at_once_with_the_block() -> None:
    results = many(sleep, ((number, (1000.0 * (number > 1),)) for number in range(9)), 9, 2)
    with pytest.raises(KeyboardInterrupt), closing(results):  # noqa: PT012 - what is under way is ended
        for number, _ in results:
            if number == 1:
                raise KeyboardInterrupt
    assert multiprocessing.active_children() == []


@pytest.mark.usefixtures("eager")
@pytest.mark.parametrize("method", ["fork", "forkserver", "spawn"])
def test_no_module_of_the_working_folder_is_imported(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, method: str
) -> None:
    for name in ("multiprocessing", "pickle", "struct"):
        (tmp_path / f"{name}.py").write_text("from pathlib import Path\nPath('run').touch()\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(executors, "start_method", lambda: method)
    made = [made for _, made in many(squared, numbers(9), 9, 2)]
    assert len({process for _, process in filter(None, made)}) > 1
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(("threads", "method"), [(["1"], "fork"), (["1", "2"], "forkserver")])
def test_a_process_with_threads_is_not_copied(monkeypatch: pytest.MonkeyPatch, threads: list[str], method: str) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr(os, "listdir", lambda _: threads)
    assert start_method() == method


# ---------------------------------------------------------------------------------------------------------- schedulers

needs_dask = pytest.mark.skipif(find_spec("distributed") is None, reason="distributed is not installed")


@needs_dask
@pytest.mark.parametrize(
    "address", ["tcp://127.0.0.1:8786", "tcp://[::1]:8786", "tcp://localhost:8786", "tls://10.0.0.7:8786"]
)
def test_schedulers_that_are_used(address: str) -> None:
    check_address(address)


ODD = ("tcp://127.0.0.1:1#@example.org:2", "tcp://127.0.0.1:1?x", "tcp://example.org:2@127.0.0.1:1", "tcp://[::1:1")
"""What others may take apart in another way than we do."""


@pytest.mark.parametrize("address", ["8786", "local", "local:2", "tcp://host", "tcp://h:port", "ws://h:1", "", *ODD])
def test_what_is_no_address_is_refused(address: str) -> None:
    with pytest.raises(RunError, match=r"expected tcp://HOST:PORT or tls://HOST:PORT"):
        check_address(address)


@needs_dask
@pytest.mark.parametrize("host", ["10.0.0.7", "127.1", "[::]", "example.org", "localhost.example.org", "[2001:db8::1]"])
def test_another_machine_without_tls_is_refused_unless_dask_is_told_otherwise(host: str) -> None:
    import dask.config  # noqa: PLC0415 - an extra

    address = f"tcp://{host}:8786"
    for value in (None, True, "false"):
        with (
            dask.config.set({"distributed.comm.require-encryption": value}),
            pytest.raises(RunError, match=r"without TLS, whoever reaches it can run code.*require-encryption to false"),
        ):
            check_address(address)
    with dask.config.set({"distributed.comm.require-encryption": False}):
        check_address(address)


class KilledWorker(Exception):  # noqa: N818 - its name in Dask
    """As Dask's."""


@pytest.mark.parametrize(
    ("error", "why"),
    [
        (CancelledError(), "the scheduler has gone away"),
        (ModuleNotFoundError("No module named 'mudline'"), "a worker lacks what this command has"),
        (KilledWorker(), "each worker that tried some of the files has ended"),
    ],
)
def test_what_goes_wrong_at_a_scheduler_is_named(error: BaseException, why: str) -> None:
    future: Future[int] = Future()
    future.set_exception(error)
    with pytest.raises(RunError, match=f"tcp://h:1: {why}"):
        Pool(0, "tcp://h:1", ExitStack()).result(future)


def test_a_worker_of_another_version_is_named() -> None:
    with pytest.raises(RunError, match=r"a worker has mudline .*, the command 9\.9: install the same version"):
        executors._done("9.9", squared, (1,))
