"""The chunks of a run: their sizes, order, failures, and files; with a client that does the work in this process."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import pytest

from mudline.cluster import running, storage
from mudline.cluster.running import (
    Chunk,
    Finished,
    Item,
    Job,
    Made,
    Pace,
    Row,
    Run,
    Store,
    WrongVersionError,
    run_chunk,
    still_holds,
)
from mudline.cluster.scheduler import ClusterError

distributed = pytest.importorskip("distributed", reason="distributed is not installed")


@dataclass
class Done:
    """A future that is settled."""

    status: str
    value: Finished | None = None
    error: BaseException | None = None

    def add_done_callback(self, call: Callable[[Done], None]) -> None:
        call(self)

    def result(self) -> Finished | None:
        return self.value

    def exception(self) -> BaseException | None:
        return self.error


@dataclass
class Client:
    """Does each chunk when it is sent; those with an item of `deadly` end their worker."""

    deadly: frozenset[object] = frozenset()
    status: str = "running"
    workers: dict[str, int] = field(default_factory=lambda: {"tcp://a:1": 2})
    sizes: list[int] = field(default_factory=list)
    lost: str = ""
    losses: int = 1_000_000

    def nthreads(self) -> dict[str, int]:
        return self.workers

    def submit(self, call: Callable[[Chunk], Finished], chunk: Chunk, **_: object) -> Done:
        self.sizes.append(len(chunk.items))
        if self.lost and self.losses > 0:
            self.losses -= 1
            return Done(self.lost)
        if self.deadly & {item.given for item in chunk.items}:
            return Done("error", error=distributed.KilledWorker("task", None, 3))
        try:
            return Done("finished", call(chunk))
        except OSError as error:
            return Done("error", error=error)

    def cancel(self, _: object, *, force: bool) -> None:
        assert force


def double(given: object) -> Made:
    if given == 13:
        raise ZeroDivisionError("13")
    return Made(2 * cast("int", given))


def run_of(client: Client, store: str, count: int, **others: Any) -> Run:  # noqa: ANN401 - as Job takes them
    items = [Item(f"key {number}", number) for number in range(count)]
    return Run(lambda: cast("Any", client), Job("double", double, items, count, Store(store), **others), "tcp://a")


def test_rows_come_in_order_and_are_taken_over(folder: Path) -> None:
    client = Client()
    assert list(run_of(client, str(folder), 10).rows()) == [Row(2 * number) for number in range(10)]
    assert sum(client.sizes) == 10
    again = run_of(Client(), str(folder), 12)
    assert [row.result for row in again.rows()] == [2 * number for number in range(12)]
    assert (again.taken, again.done) == (10, 2)
    fresh = run_of(Client(), str(folder), 10, fresh=True)
    assert len(list(fresh.rows())) == fresh.done == 10


def test_nothing_is_connected_when_all_is_done(folder: Path) -> None:
    list(run_of(Client(), str(folder), 5).rows())
    again = run_of(Client(), str(folder), 5)
    again.connect = lambda: pytest.fail("connected")
    assert len(list(again.rows())) == again.taken == 5


def test_a_fault_in_one_deck_is_its_result(folder: Path) -> None:
    rows = list(run_of(Client(), str(folder), 20).rows())
    assert rows[13] == Row(None, "ZeroDivisionError: 13")
    assert [row.result for row in rows if not row.failed] == [2 * n for n in range(20) if n != 13]
    again = run_of(Client(), str(folder), 20)
    assert list(again.rows()) == rows
    assert again.done == 1


def test_the_deck_that_ends_its_workers_is_found(folder: Path) -> None:
    rows = list(run_of(Client(deadly=frozenset({5})), str(folder), 12).rows())
    assert [number for number, row in enumerate(rows) if row.failed] == [5]
    assert rows[5].failed == "each worker that tried it ended, perhaps out of memory"
    assert [row.result for row in rows if not row.failed] == [2 * n for n in range(12) if n != 5]


def test_results_that_cannot_be_written_are_reported(folder: Path) -> None:
    (folder / "file").write_text("", encoding="utf-8")
    rows = list(run_of(Client(), str(folder / "file" / "below"), 5, fresh=True).rows())
    assert all("Error: " in row.failed for row in rows)


def test_results_of_a_folder_that_is_not_shared_are_missed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(storage, "write", lambda *_: None)
    with pytest.raises(ClusterError, match="give -o a folder or URL that all machines share"):
        list(run_of(Client(), str(folder), 5).rows())


@pytest.mark.parametrize("lost", ["lost", "cancelled"])
def test_a_scheduler_that_goes_away_ends_the_run(folder: Path, lost: str) -> None:
    with pytest.raises(ClusterError, match=r"tcp://a: the scheduler has gone away; 0 of 5 are done"):
        list(run_of(Client(lost=lost), str(folder), 5).rows())


@pytest.mark.parametrize("lost", ["lost", "cancelled"])
def test_an_answer_that_is_lost_with_its_worker_is_asked_for_again(folder: Path, lost: str) -> None:
    client = Client(lost=lost, losses=2)
    assert list(run_of(client, str(folder), 5).rows()) == [Row(2 * number) for number in range(5)]
    assert sum(client.sizes) > 5


def test_a_run_without_workers_ends(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = run_of(Client(workers={}), str(folder), 5)
    monkeypatch.setattr(running, "LONGEST_ALONE", -1.0)
    run._check_alive()
    with pytest.raises(ClusterError, match="no worker is left: start one with dask worker"):
        run._check_alive()
    run.client = cast("Any", Client(status="closed"))
    with pytest.raises(ClusterError, match="the scheduler has gone away"):
        run._check_alive()


def test_chunks_take_about_a_second() -> None:
    pace = Pace()
    assert pace.size(1000, 2) == 4
    for _ in range(10):
        size = pace.size(10**6, 2)
        pace.took(size, 0.01 * size)
    assert pace.size(10**6, 2) == 100
    assert pace.size(100, 2) == 50, "the last ones are half as long"
    pace.took(10, 100.0)
    assert 1 <= pace.size(10**6, 2) < 30


def test_a_chunk_done_twice_is_there_once(folder: Path) -> None:
    chunk = Chunk("double", double, (Item("a", 1), Item("b", 2)), str(folder))
    assert run_chunk(chunk).file == run_chunk(chunk).file
    [path] = folder.iterdir()
    path.write_bytes(path.read_bytes().replace(b"4", b"5"))
    with pytest.raises(ValueError, match="damaged: its name is not the digest of its content"):
        Store(str(folder)).rows_of(path.name)
    assert Store(str(folder)).known("double") == {}


def test_another_version_does_nothing(folder: Path) -> None:
    with pytest.raises(WrongVersionError, match=r"a worker has mudline .*, the command 0.0.1"):
        run_chunk(Chunk("double", double, (), str(folder), "0.0.1"))


def test_a_row_holds_while_its_files_do(folder: Path) -> None:
    other = folder / "other.csv"
    other.write_text("1", encoding="utf-8")
    run_chunk(
        Chunk("named", lambda given: Made(1, (cast("str", given),)), (Item("a", str(other)),), str(folder / "out"))
    )
    [(line,)] = Store(str(folder / "out")).known("named").values()
    assert still_holds(line)
    other.write_text("12", encoding="utf-8")
    assert not still_holds(line)
    other.unlink()
    assert not still_holds(line)


def test_paths_are_found_from_another_working_folder(folder: Path) -> None:
    assert storage.resolved("a/deck.keyxm", str(folder)) == "a/deck.keyxm"
    assert storage.resolved("a/deck.keyxm", "/elsewhere") == "/elsewhere/a/deck.keyxm"
    assert storage.resolved("/a/deck.keyxm", "/elsewhere") == "/a/deck.keyxm"
    assert storage.resolved("s3://a/deck.keyxm", "/elsewhere") == "s3://a/deck.keyxm"
