"""What is killed, damaged, of another version, or no archive at all."""

from __future__ import annotations

import json
import os
import shutil
import signal
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from mudline.archive.store import FORMAT, LOCK
from mudline.files import alone_at
from tests.archive.trial import contents, deck, index, summary, write
from tests.cli.runner import run
from tests.processes import TIMEOUT, started

SLOW = """
import sys, time
from mudline.__main__ import main
from mudline.archive import updating
updating.DECKS = 4
plain = updating.read_deck
def slow(order):
    time.sleep(0.01)
    return plain(order)
updating.read_deck = slow
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two decks and their archive, which each test has a copy of."""
    folder = tmp_path_factory.mktemp("original")
    decks = write(folder / "decks", a=deck("a"), b=deck("b", depth=600.0))
    index(decks, archive=folder / "archive")
    return folder


@pytest.fixture(scope="module")
def before(original: Path) -> dict[str, list[str]]:
    return contents(original / "archive")


@pytest.fixture
def decks(original: Path, tmp_path: Path) -> Path:
    shutil.copytree(original, tmp_path, dirs_exist_ok=True)
    return tmp_path / "decks"


@pytest.fixture
def archive(decks: Path) -> Path:
    return decks.parent / "archive"


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_a_killed_run_loses_nothing(tmp_path: Path) -> None:
    folder = write(tmp_path / "decks", **{f"d{i:03}": deck(f"d{i}", depth=100.0 + i) for i in range(40)})
    killed, whole = tmp_path / "killed", tmp_path / "whole"
    words = ["index", str(folder), "-o", str(killed), "--isolated", "--jobs", "1"]
    with started("-c", SLOW, *words) as running:
        end = time.monotonic() + TIMEOUT
        while (
            not (marker := killed / "archive.json").exists() or "decks" not in json.loads(marker.read_bytes())["tables"]
        ):
            assert time.monotonic() < end
            assert running.process.poll() is None
            time.sleep(0.01)
        running.process.send_signal(signal.SIGKILL)
        running.process.wait(TIMEOUT)
    counts = summary(index(folder, archive=killed))
    again = int(counts.partition(": ")[2].split()[0])
    assert counts == f"40 decks: {again} new, {40 - again} unchanged"
    assert again <= 40 - 4
    index(folder, archive=whole)
    assert contents(killed) == contents(whole)
    assert not list(killed.rglob("*.mudline"))


@pytest.mark.skipif(sys.platform == "win32", reason="there, runs do not wait for each other")
def test_a_run_waits_for_another_one(archive: Path, decks: Path) -> None:
    write(decks, c=deck("c", depth=700.0))
    with ExitStack() as stack:
        with alone_at(archive / LOCK):
            words = ("-m", "mudline", "index", str(decks), "-o", str(archive), "--isolated")
            running = stack.enter_context(started(*words))
            assert running.err.readline().decode() == f"mudline: {archive.as_posix()}: waiting for another run\n"
        assert running.process.wait(TIMEOUT) == 0
    assert summary(index(decks, archive=archive)) == "3 decks: 3 unchanged"


def test_a_run_that_is_killed_between_files_and_manifest_is_tidied(archive: Path, decks: Path) -> None:
    left = archive / "data" / "decks-00112233445566778899aabbccddeeff.parquet"
    views = archive / ".archive.duckdb.0011223344556677.mudline"
    left.write_bytes(b"left")
    views.write_bytes(b"left")
    write(decks, c=deck("c"))
    index(decks, archive=archive)
    assert left.exists()
    assert not views.exists()
    os.utime(left, (1.0, 1.0))
    write(decks, d=deck("d"))
    index(decks, archive=archive)
    assert not left.exists()
    assert len(list((archive / "data").iterdir())) == 8


def some_file(archive: Path, table: str) -> Path:
    (found,) = archive.glob(f"data/{table}-*.parquet")
    return found


def test_a_file_cut_short_is_named_and_its_decks_are_read_again(
    archive: Path, decks: Path, before: dict[str, list[str]]
) -> None:
    path = some_file(archive, "decks")
    path.write_bytes(path.read_bytes()[:-50])
    outcome = run("query", archive, "SELECT 1")
    assert outcome.code == 2
    assert f"{path.as_posix()} has " in outcome.err
    assert "mudline index reads the decks again" in outcome.err
    outcome = index(decks, archive=archive)
    assert path.name in outcome.err
    assert summary(outcome) == "2 decks: 2 new"
    assert contents(archive) == before


def test_a_file_that_changed_without_its_size_is_found(
    archive: Path, decks: Path, before: dict[str, list[str]]
) -> None:
    path = some_file(archive, "curves")
    path.write_bytes(b"x" * path.stat().st_size)
    outcome = run("query", archive, "SELECT count(name) FROM curves")
    assert outcome.code == 2
    assert outcome.err == f"mudline: data/{path.name} is damaged: mudline index reads the decks again\n"
    outcome = index(decks, archive=archive)
    assert f"{path.name} has changed since it was written" in outcome.err
    assert summary(outcome) == "2 decks: 2 new"
    assert contents(archive) == before


def test_files_of_others_are_left_alone(archive: Path, decks: Path) -> None:
    others = [archive / "notes.txt", archive / "data" / "mine.parquet"]
    for path in others:
        path.write_text("x", encoding="utf-8")
        os.utime(path, (1.0, 1.0))
    write(decks, c=deck("c"))
    assert summary(index(decks, archive=archive)) == "3 decks: 1 new, 2 unchanged"
    assert len(contents(archive)["decks"]) == 3
    assert all(path.exists() for path in others)


def test_another_version_is_refused_and_stays(archive: Path, decks: Path) -> None:
    (archive / "archive.json").write_text(json.dumps({"format": "mudline-archive/99"}), encoding="utf-8")
    before = sorted(archive.rglob("*"))
    for outcome in (run("query", archive, "SELECT 1"), index(decks, archive=archive)):
        assert outcome.code == 2
        assert f"has the format 'mudline-archive/99', this mudline reads {FORMAT!r}" in outcome.err
    assert sorted(archive.rglob("*")) == before


@pytest.mark.parametrize("text", ["", "[]", "{}", "\ufeff", "{" * 100_000, f'{{"format": "{FORMAT}", "tables": [1]}}'])
def test_a_damaged_marker_is_named(archive: Path, decks: Path, text: str) -> None:
    (archive / "archive.json").write_text(text, encoding="utf-8")
    for outcome in (run("query", archive, "SELECT 1"), index(decks, archive=archive)):
        assert outcome.code == 2
        assert f"{archive.as_posix()}/archive.json is damaged: index the decks into a new folder" in outcome.err


def test_what_is_no_archive(tmp_path: Path, decks: Path) -> None:
    (tmp_path / "file").write_text("x", encoding="utf-8")
    for name, words in (
        ("nowhere", "nowhere does not exist"),
        ("decks", "decks has no archive.json, so it is not an archive"),
        ("file", "file is a file, not an archive"),
    ):
        outcome = run("query", tmp_path / name, "SELECT 1")
        assert (outcome.code, words in outcome.err) == (2, True), outcome.err
    outcome = index(decks, archive=decks)
    assert outcome.code == 2
    assert "has other files and is not an archive: give a new or empty folder" in outcome.err
    assert index(decks, archive=tmp_path / "file").code == 2
    (tmp_path / "empty").mkdir()
    assert summary(index(decks, archive=tmp_path / "empty")) == "2 decks: 2 new"


def test_the_views_work_in_the_folder_also_when_it_has_moved(
    archive: Path, decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    duckdb = pytest.importorskip("duckdb")
    moved = tmp_path / ("it's [moved] here" if sys.platform == "win32" else "it's [moved]? \n here*")
    shutil.move(archive, moved)
    monkeypatch.chdir(moved)
    with duckdb.connect("archive.duckdb", read_only=True) as connection:
        assert connection.execute("SELECT count(*), count(DISTINCT file) FROM curves").fetchall() == [(2, 2)]
    (moved / "archive.duckdb").unlink()
    index(decks, archive=moved)
    assert (moved / "archive.duckdb").exists()
