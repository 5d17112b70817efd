"""`--scheduler`: output and archive are those of a run without it, whatever becomes of a worker, also at URLs."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from tests.archive.trial import contents, deck, summary, write
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.runner import Outcome, run
from tests.cluster.processes import ROOT, Processes, wait_until
from tests.processes import TIMEOUT, started

s3fs = pytest.importorskip("s3fs", reason="s3fs is not installed")
pytest.importorskip("distributed", reason="distributed is not installed")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="processes are killed by POSIX signals"),
    # Sockets and loops of dask and of S3's client end with the process, not with the command.
    pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"),
]

NOTHING = "tcp://127.0.0.1:9"
"""The address of no scheduler."""
LARGE = (ROOT / "samples" / "legacy-flowline.keyxm").read_text(encoding="utf-8")


RESTART = "$LOAD CASE\n*RESTART\n LAST=d000\n*NO FRICTION\n"

needs_archive = pytest.mark.skipif(not (find_spec("duckdb") and find_spec("pyarrow")), reason="needs mudline[archive]")


def write_decks(folder: Path, count: int, *texts: str) -> str:
    """Decks in turn of some texts, each with a line of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        (folder / f"{i:03}.keyxm").write_text(f"C deck {i}\n{texts[i % len(texts)]}", encoding="utf-8")
    return folder.name


def rows_in(folder: Path) -> list[str]:
    """The keys of all rows that are done."""
    return [json.loads(line)["key"] for path in folder.glob("*.jsonl") for line in path.read_bytes().splitlines()]


@pytest.mark.parametrize(
    "words",
    [
        ("lint", "decks", "missing.keyxm"),
        ("lint", "decks", "--output-format", "json"),
        ("lint", "decks", "--statistics", "--select", "CRV", "--exit-zero"),
        ("validate", "decks", "missing.keyxm"),
        ("validate", "decks", "--output-format", "json"),
        ("evaluate", "decks", "missing.keyxm"),
        ("evaluate", "decks", "--output-format", "json"),
    ],
    ids=" ".join,
)
def test_output_is_that_of_a_run_without_a_cluster(words: tuple[str, ...], cluster: Processes, folder: Path) -> None:
    write_decks(folder / "decks", 9, CLEAN, BAD_NUMBER, UNSORTED)
    assert run(*words, "--scheduler", cluster.address) == run(*words)


def test_a_second_run_takes_over_what_still_holds(cluster: Processes, folder: Path) -> None:
    write_decks(folder / "decks", 9, CLEAN, BAD_NUMBER)
    words = ("lint", "decks", "--output-format", "concise", "-o", "out", "-v", "--scheduler", cluster.address)

    def counts() -> str:
        done = run(*words)
        assert done.out == run(*words[:4], "--no-cache").out
        return done.err.splitlines()[-1].removeprefix(f"mudline: {cluster.address}: ")

    assert counts() == "9 decks done, 0 from an earlier run"
    assert counts() == "0 decks done, 9 from an earlier run"
    damaged = max((folder / "out").iterdir(), key=lambda path: path.stat().st_size)
    lost = damaged.read_bytes().count(b"\n")
    damaged.write_bytes(damaged.read_bytes()[:-20])
    assert counts() == f"{lost} deck{'s' * (lost > 1)} done, {9 - lost} from an earlier run"
    (folder / "decks" / "003.keyxm").write_text(CLEAN, encoding="utf-8")
    assert counts() == "1 deck done, 8 from an earlier run"
    assert run(*words, "--no-cache").err.endswith("9 decks done, 0 from an earlier run\n")
    assert run(*words[:-1], NOTHING).err.endswith(f"{NOTHING}: 0 decks done, 9 from an earlier run\n")


def test_a_killed_worker_loses_nothing_and_nothing_is_done_twice(cluster: Processes, folder: Path) -> None:
    write_decks(folder / "decks", 60, LARGE, BAD_NUMBER, UNSORTED)
    out = folder / "out"
    left: list[int] = []

    def kill() -> None:
        wait_until(lambda: len(rows_in(out)) >= 8, "nothing is done")
        left.append(60 - len(rows_in(out)))
        assert cluster.kill_worker() == -signal.SIGKILL

    killer = threading.Thread(target=kill)
    killer.start()
    done = run("lint", "decks", "--output-format", "json", "-o", "out", "--scheduler", cluster.address)
    killer.join(TIMEOUT)
    assert left
    assert left[0] > 0
    assert len(cluster.workers) == 1
    assert done == run("lint", "decks", "--output-format", "json", "--no-cache")
    assert len(rows_in(out)) == len(set(rows_in(out))) == 60


def test_an_interrupted_run_goes_on_where_it_stopped(cluster: Processes, folder: Path) -> None:
    write_decks(folder / "decks", 60, LARGE, BAD_NUMBER)
    words = ("lint", "decks", "--output-format", "json", "-o", "out", "-v", "--scheduler", cluster.address)
    with started("-m", "mudline", *words) as running_command:
        wait_until(lambda: len(rows_in(folder / "out")) >= 4, "nothing is done")
        running_command.process.send_signal(signal.SIGINT)
        notes = running_command.err.read().decode()
        assert running_command.process.wait(TIMEOUT) == 130
    assert "mudline: stopped: " in notes
    assert "of 60 decks done; the same command goes on from there" in notes
    assert "Traceback" not in notes
    done = run(*words)
    taken = int(done.err.split(" from an earlier run")[0].split()[-1])
    assert 4 <= taken < 60
    assert done.out == run(*words[:4], "--no-cache").out


def evaluated(*words: str) -> Outcome:
    return run("evaluate", *words, "--output-format", "json", "--form", "npz", "-q")


def write_cases(folder: Path, count: int) -> None:
    """Decks with positions of their own; one has none."""
    write_decks(folder, count, CLEAN)
    for i in range(1, count):
        points = np.array([[0.0, 0.0, 0.0], [-0.2 - i / 100, 10.0, 0.0], [0.3, 20.0, 0.0]])
        np.savez(folder / f"{i:03}.npz", positions=np.stack([points, 1.1 * points]), time=np.array([0.0, 1.0]))


@pytest.mark.parametrize("positions", ["decks", "{folder}/{name}.npz"])
def test_decks_are_evaluated_at_their_positions(positions: str, cluster: Processes, folder: Path) -> None:
    write_cases(folder / "decks", 6)
    alone = evaluated("decks", "--positions", positions, "-o", "alone")
    words = ("decks", "--positions", positions, "-o", "both", "--scheduler", cluster.address)
    assert evaluated(*words) == alone
    assert alone.code == 1
    assert evaluated(*words) == alone
    names = sorted(path.name for path in (folder / "alone").glob("*.npz"))
    assert names == ["001.npz", "002.npz", "003.npz", "004.npz", "005.npz"]
    for name in names:
        assert (folder / "both" / name).read_bytes() == (folder / "alone" / name).read_bytes()


def test_results_that_a_deck_no_longer_gives_are_removed(cluster: Processes, folder: Path) -> None:
    write_cases(folder / "decks", 4)
    words = ("decks", "--positions", "decks", "-o", "both", "--scheduler", cluster.address)
    evaluated(*words)
    for name in ("001", "002"):
        (folder / "decks" / f"{name}.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    (folder / "both" / "002.npz").write_bytes(b"changed by somebody")
    (folder / "decks" / "003.npz").unlink()
    rows = {row["deck"].split("/")[-1]: row["verdict"] for row in evaluated(*words).json()}
    assert set(rows.values()) == {"failed"}
    assert sorted(path.name for path in (folder / "both").glob("*.npz")) == ["002.npz", "003.npz"]


def test_decks_and_results_at_an_object_store(cluster: Processes, folder: Path) -> None:
    system = s3fs.S3FileSystem()
    system.mkdir("bucket")
    write_cases(folder / "decks", 4)
    (folder / "decks" / "deck.json").write_text('{"format": "mudline-deck/1", "sections": 1}', encoding="utf-8")
    (folder / "decks" / "other.json").write_text("{}", encoding="utf-8")
    system.put(str(folder / "decks"), "bucket/decks", recursive=True)
    url = "s3://bucket/decks"
    scheduler = ("--scheduler", cluster.address)
    for command in ("lint", "validate"):
        form = ("--output-format", "json")
        near, alone = run(command, "decks", *form), run(command, url, *form)
        found = run(command, url, *form, *scheduler, "-o", "s3://bucket/out")
        assert found == alone
        assert found.code == near.code
        assert found.out.replace(f"{url}/", "decks/") == near.out
    assert {name.split("/")[-1].split("-")[0] for name in system.find("bucket/out")} == {"lint", "validate"}
    words = (url, "--positions", "{folder}/{name}.npz", "-o", "s3://bucket/results", *scheduler)
    again = evaluated(*words)
    assert evaluated(*words) == again
    rows = {row["deck"].split("/")[-1]: row for row in again.json()}
    near_rows = {row["deck"].split("/")[-1]: row for row in evaluated("decks", "--positions", "decks").json()}
    assert len(rows) == len(near_rows) == 4
    for name, row in rows.items():
        assert row["largest_force"] == near_rows[name]["largest_force"]
    assert system.exists("bucket/results/003.npz")
    assert not system.exists("bucket/results/000.npz")
    assert [name for name in system.find("bucket/results") if "summary." in name]
    missing = run("lint", "s3://bucket/nowhere", "s3://other/deck.keyxm", *scheduler)
    assert missing.code == 2
    assert "mudline: s3://bucket/nowhere: nothing is at this url\n" in missing.err
    assert "mudline: s3://other/deck.keyxm: " in missing.err


# ------------------------------------------------------------------------------------------------------------- archives


def index(cluster: Processes | None, archive: str, *words: str) -> Outcome:
    scheduler = ("--jobs", "1") if cluster is None else ("--scheduler", cluster.address)
    return run("index", *words, "-o", archive, "--isolated", *scheduler)


def settled(folder: Path) -> None:
    """The decks are old enough for their dates to be trusted."""
    for path in folder.rglob("*.*"):
        os.utime(path, ns=(10**18, 10**18))


def files_of(archive: str) -> list[str]:
    return sorted(path.relative_to(archive).parts[0] for path in Path(archive).iterdir())


@needs_archive
def test_the_archive_is_that_of_a_run_without_a_cluster(cluster: Processes, folder: Path) -> None:
    decks = write(folder / "decks", **{f"d{i:03}": f"C {i:05}\n{deck()}" for i in range(6)})
    write(decks, bad=BAD_NUMBER, restart=RESTART, copy=f"C {0:05}\n{deck()}")
    settled(decks)
    alone = index(None, "alone", "decks", "missing.keyxm")
    both = index(cluster, "both", "decks", "missing.keyxm")
    assert (both.code, both.out, both.err) == (2, alone.out, alone.err.replace("alone", "both"))
    assert contents(folder / "both") == contents(folder / "alone")
    assert files_of("both") == files_of("alone")

    nowhere = ("--isolated", "--scheduler", NOTHING)
    assert summary(run("index", "decks", "-o", "both", *nowhere)) == "9 decks: 9 unchanged"
    (decks / "d001.keyxm").rename(decks / "moved.keyxm")
    write(decks, d000=f"C {7:05}\n{deck()}", d003=f"C a longer line\n{deck()}", new=CLEAN)
    (decks / "d004.keyxm").unlink()
    words = "9 decks: 1 new, 3 changed, 1 moved, 4 unchanged, 1 gone"
    assert summary(index(cluster, "both", "decks")) == summary(index(None, "alone", "decks")) == words
    assert contents(folder / "both") == contents(folder / "alone")


@needs_archive
def test_a_killed_worker_loses_nothing_and_an_interrupted_run_goes_on(cluster: Processes, folder: Path) -> None:
    decks = write(folder / "decks", **{f"d{i:03}": f"C {i}\n{LARGE}" for i in range(32)})
    settled(decks)
    assert summary(index(None, "alone", "decks")) == "32 decks: 32 new"

    def chunks() -> int:
        """Those of the run that has not ended; workers may finish one after it."""
        return sum((path.parent / "running").exists() for path in folder.glob("both/.chunks-*/index-*.jsonl"))

    words = ("index", "decks", "-o", "both", "--isolated", "--scheduler", cluster.address)
    with started("-m", "mudline", *words) as running:
        wait_until(lambda: chunks() >= 2, "nothing is done")
        running.process.send_signal(signal.SIGINT)
        notes = running.err.read().decode()
        assert running.process.wait(TIMEOUT) == 130
    assert "of 32 decks done; the same command goes on from there" in notes
    assert not [*folder.glob("both/.chunks-*/running")]

    def kill() -> None:
        wait_until(lambda: chunks() >= 2, "nothing is done")
        assert cluster.kill_worker() == -signal.SIGKILL

    killer = threading.Thread(target=kill)
    killer.start()
    done = summary(index(cluster, "both", "decks"))
    killer.join(TIMEOUT)
    assert len(cluster.workers) == 1
    known = int(done.partition(" unchanged")[0].split()[-1])
    assert 2 <= known < 32
    assert done == f"32 decks: {32 - known} new, {known} unchanged"
    assert files_of("both") == files_of("alone")
    assert contents(folder / "both") == contents(folder / "alone")


@needs_archive
def test_decks_at_an_object_store(cluster: Processes, folder: Path) -> None:
    system = s3fs.S3FileSystem()
    system.mkdir("archived")
    write(folder / "decks", a=deck("a"), b=deck("b", depth=600.0))
    system.put(str(folder / "decks"), "archived/decks", recursive=True)
    url = "s3://archived/decks"
    assert summary(index(cluster, "both", url)) == "2 decks: 2 new"
    assert summary(index(None, "alone", url, "decks")) == "4 decks: 4 new"
    both, alone = contents(folder / "both"), contents(folder / "alone")
    assert both["curves"] == [row for row in alone["curves"] if url in row] != []
    system.rm(f"{url}/b.keyxm")
    assert summary(index(cluster, "both", url)) == "1 deck: 1 unchanged, 1 gone"
    assert index(cluster, "both", "s3://nowhere/decks", "--prune").code == 2
    assert len(contents(folder / "both")["decks"]) == 1


def test_an_archive_at_a_url_is_refused() -> None:
    assert "-o s3://b/archive: an archive is a folder, not a URL" in run("index", "decks", "-o", "s3://b/archive").err


# ----------------------------------------------------------------------------------------------------------- schedulers


def test_local_starts_scheduler_and_workers(folder: Path) -> None:
    write_decks(folder / "decks", 6, CLEAN, BAD_NUMBER)
    done = run("validate", "decks", "--scheduler", "local:2")
    assert done == run("validate", "decks")


def test_a_scheduler_that_goes_away_is_named(cluster: Processes, folder: Path) -> None:
    write_decks(folder / "decks", 60, LARGE)

    def kill() -> None:
        wait_until(lambda: len(rows_in(folder / "out")) >= 4, "nothing is done")
        assert cluster.scheduler
        cluster.scheduler.kill()
        cluster.scheduler.wait(TIMEOUT)

    killer = threading.Thread(target=kill)
    killer.start()
    done = run("lint", "decks", "-q", "-o", "out", "--scheduler", cluster.address)
    killer.join(TIMEOUT)
    assert done.code == 2
    last = done.err.splitlines()[-1]
    assert last.startswith(f"mudline: {cluster.address}: the scheduler has gone away; ")
    assert last.endswith("are done: the same command with -o goes on from there")
