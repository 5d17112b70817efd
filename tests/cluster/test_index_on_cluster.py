"""`mudline index --scheduler`: the archive of a run without it, whatever becomes of a worker or of the command."""

from __future__ import annotations

import os
import signal
import sys
import threading
from pathlib import Path

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.runner import Outcome, run
from tests.cluster.processes import ROOT, Processes, wait_until
from tests.processes import TIMEOUT, started

for library in ("distributed", "s3fs", "duckdb", "pyarrow"):
    pytest.importorskip(library, reason=f"{library} is not installed")

from tests.archive.trial import contents, deck, summary, write  # noqa: E402 - needs DuckDB

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="processes are killed by POSIX signals"),
    # Sockets and loops of dask and of S3's client end with the process, not with the command.
    pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"),
]

LARGE = (ROOT / "samples" / "legacy-flowline.keyxm").read_text(encoding="utf-8")
RESTART = "$LOAD CASE\n*RESTART\n LAST=d000\n*NO FRICTION\n"


def index(cluster: Processes | None, archive: str, *words: str) -> Outcome:
    scheduler = ("--jobs", "1") if cluster is None else ("--scheduler", cluster.address)
    return run("index", *words, "-o", archive, "--isolated", *scheduler)


def settled(folder: Path) -> None:
    """The decks are old enough for their dates to be trusted."""
    for path in folder.rglob("*.*"):
        os.utime(path, ns=(10**18, 10**18))


def files_of(archive: str) -> list[str]:
    return sorted(path.relative_to(archive).parts[0] for path in Path(archive).iterdir())


def test_the_archive_is_that_of_a_run_without_a_cluster(cluster: Processes, folder: Path) -> None:
    decks = write(folder / "decks", **{f"d{i:03}": f"C {i:05}\n{deck()}" for i in range(6)})
    write(decks, bad=BAD_NUMBER, restart=RESTART, copy=f"C {0:05}\n{deck()}")
    settled(decks)
    alone = index(None, "alone", "decks", "missing.keyxm")
    both = index(cluster, "both", "decks", "missing.keyxm")
    assert (both.code, both.out, both.err) == (2, alone.out, alone.err.replace("alone", "both"))
    assert contents(folder / "both") == contents(folder / "alone")
    assert files_of("both") == files_of("alone")

    nowhere = ("--isolated", "--scheduler", "tcp://127.0.0.1:9")
    assert summary(run("index", "decks", "-o", "both", *nowhere)) == "9 decks: 9 unchanged"
    (decks / "d001.keyxm").rename(decks / "moved.keyxm")
    write(decks, d000=f"C {7:05}\n{deck()}", d003=f"C a longer line\n{deck()}", new=CLEAN)
    (decks / "d004.keyxm").unlink()
    words = "9 decks: 1 new, 3 changed, 1 moved, 4 unchanged, 1 gone"
    assert summary(index(cluster, "both", "decks")) == summary(index(None, "alone", "decks")) == words
    assert contents(folder / "both") == contents(folder / "alone")


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


def test_decks_at_an_object_store(cluster: Processes, folder: Path) -> None:
    system = pytest.importorskip("s3fs").S3FileSystem()
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
