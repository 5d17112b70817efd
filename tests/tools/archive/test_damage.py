"""What is killed, damaged, of another version, moved, or no archive at all."""

from __future__ import annotations

import shutil
import signal
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from mudline.basics.files import alone_at
from mudline.tools.archive.updating import LOCK
from tests.helpers.processes import TIMEOUT, started
from tests.tools.archive.trial import ask, contents, deck, index, summary, write

KILLED = """
import os, signal, sys
from pathlib import Path
from mudline.__main__ import main
plain = Path.replace
done = []
def replace(self, target):
    if str(target).endswith(".parquet"):
        done.append(target)
        if len(done) == {move}:
            os.kill(os.getpid(), signal.SIGKILL)
    return plain(self, target)
Path.replace = replace
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two decks and their archive, which each test has a copy of."""
    folder = tmp_path_factory.mktemp("original")
    decks = write(folder / "decks", a=deck("a"), b=deck("b", depth=600.0))
    index(decks, archive=folder / "archive")
    return folder


@pytest.fixture
def decks(original: Path, tmp_path: Path) -> Path:
    shutil.copytree(original, tmp_path, dirs_exist_ok=True)
    return tmp_path / "decks"


@pytest.fixture
def archive(decks: Path) -> Path:
    return decks.parent / "archive"


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.alike
@pytest.mark.parametrize(("move", "done"), [(3, False), (9, True), (14, True)])
def test_a_killed_run_leaves_the_archive_before_or_behind_it(archive: Path, decks: Path, move: int, done: bool) -> None:
    """Killed while it writes the third table, and while it moves the written ones to their places."""
    write(decks, a=deck("a", depth=700.0), c=deck("c", curve="Sand"))
    words = ["index", str(decks), "-o", str(archive), "--isolated", "--jobs", "1"]
    with started("-c", KILLED.replace("{move}", str(move)), *words) as running:
        assert running.process.wait(TIMEOUT) == -signal.SIGKILL
    (decks / "b.keyxm").unlink()
    assert summary(index(decks / "c.keyxm", archive=archive)) == f"1 deck: 1 {'unchanged' if done else 'new'}"
    depths = ask(archive, "SELECT d.depth FROM decks AS d JOIN curves USING (file) ORDER BY file")
    assert [row["depth"] for row in depths] == [700.0 if done else 500.0, 600.0, 500.0]
    index(decks, archive=archive)
    index(decks, archive=decks.parent / "whole")
    assert contents(archive) == contents(decks.parent / "whole")
    assert not [path for path in archive.iterdir() if path.is_dir()]


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


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_what_was_read_before_ctrl_c_is_written(archive: Path, decks: Path) -> None:
    write(decks, c=deck("c"), d=deck("d"))
    script = """
import os, signal, sys
from mudline.__main__ import main
from mudline.cli import index_command
plain = index_command.read_deck
def read_deck(data, name, *others):
    if name.endswith("d.keyxm"):
        os.kill(os.getpid(), signal.SIGINT)
    return plain(data, name, *others)
index_command.read_deck = read_deck
sys.exit(main(sys.argv[1:]))
"""
    with started("-c", script, "index", str(decks), "-o", str(archive), "--isolated", "--jobs", "1") as running:
        assert running.process.wait(TIMEOUT) != 0
    assert summary(index(decks, archive=archive)) == "4 decks: 1 new, 3 unchanged"


@pytest.mark.parametrize("damage", ["cut", "changed", "missing", "another version"])
def test_a_damaged_table_is_named_and_nothing_is_written(archive: Path, decks: Path, damage: str) -> None:
    path = archive / "curves.parquet"
    data = path.read_bytes()
    if damage == "missing":
        path.unlink()
    elif damage == "changed":
        at = data.index(b"Clay")
        path.write_bytes(data[:at] + b"Clax" + data[at + 4 :])
    else:
        path.write_bytes(data[:-50] if damage == "cut" else data.replace(b"archive/5", b"archive/6"))
    before = {found: found.read_bytes() for found in archive.iterdir() if found.is_file()}
    outcome = index(write(decks, c=deck("c")), archive=archive)
    assert outcome.code == 2
    assert f"{path.as_posix()} " in outcome.err
    assert outcome.err.endswith("index the decks into a new folder\n")
    left = {found: found.read_bytes() for found in archive.iterdir() if found.is_file()}
    left.pop(archive / "archive.duckdb")
    before.pop(archive / "archive.duckdb")
    assert left == before


def test_what_is_no_archive(tmp_path: Path, decks: Path) -> None:
    (tmp_path / "file").write_text("x", encoding="utf-8")
    outcome = index(decks, archive=tmp_path / "file")
    assert (outcome.code, "is not an archive: give a new or empty folder" in outcome.err) == (2, True)
    (tmp_path / "empty").mkdir()
    assert summary(index(decks, archive=tmp_path / "empty")) == "2 decks: 2 new"


def test_the_views_work_anywhere_and_again_when_the_archive_has_moved(
    archive: Path, decks: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert len(ask(archive, "FROM curves")) == 2
    moved = tmp_path / ("it's [moved] here" if sys.platform == "win32" else "it's [moved]? \n here*")
    shutil.move(archive, moved)
    before = time.time()
    assert "mudline: 2 decks: 2 unchanged" in index(decks, archive=moved).err
    assert (moved / "decks.parquet").stat().st_mtime < before
    assert ask(moved, "SELECT count(*) AS n, count(DISTINCT file) AS files FROM curves") == [{"n": 2, "files": 2}]
