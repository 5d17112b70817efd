"""Links, pipes and permissions, where the system is of the Unix kind."""

from __future__ import annotations

import errno
import fcntl
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest

from mudline.basics import files
from mudline.basics.files import replacement, write_atomically
from mudline.cli.inputs import GivenDecks
from tests.cli.conftest import Place
from tests.cli.runner import process, run
from tests.helpers.builders.decks import CLEAN
from tests.helpers.processes import TIMEOUT, started


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_links_and_pipes_in_a_directory_are_no_trap(place: Place, folder: Path) -> None:
    place(CLEAN, "decks/a.keyxm")
    (folder / "decks/loop").symlink_to(folder / "decks", target_is_directory=True)
    (folder / "decks/gone.keyxm").symlink_to(folder / "nowhere")
    (folder / "decks/.#a.keyxm").symlink_to("user@host.1234:5678")  # as editors lock files
    os.mkfifo(folder / "decks/pipe.keyxm")
    assert [file.name for file in GivenDecks(("decks",)).collect().files] == ["decks/a.keyxm", "decks/gone.keyxm"]
    for command in (("lint", "-q"), ("format", "-q"), ("validate", "-q")):
        outcome = run(*command, "decks")
        assert (outcome.code, outcome.err) == (2, "mudline: decks/gone.keyxm: no such file or directory\n"), command


def test_a_folder_that_may_be_listed_only_keeps_no_other_deck_from_being_read(
    place: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    place(CLEAN, "decks/a.keyxm")
    place(CLEAN, "decks/closed/b.keyxm")
    looked = os.stat

    def guarded(path: str | Path, **how: bool) -> os.stat_result:
        if "closed/" in str(path):
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return looked(path, **how)

    monkeypatch.setattr(os, "stat", guarded)
    assert [file.name for file in GivenDecks(("decks",)).collect().files] == ["decks/a.keyxm", "decks/closed/b.keyxm"]
    for command in ("lint", "validate"):
        outcome = run(command, "decks", "-q")
        assert (outcome.code, "cannot be" in outcome.err) == (0, False), command


@pytest.mark.parametrize("bits", [0o600, 0o644, 0o755, 0o666])
def test_permissions_are_kept(place: Place, folder: Path, bits: int) -> None:
    (folder / "out.json").write_text("old", encoding="utf-8")
    (folder / "out.json").chmod(bits)
    assert run("convert", place(), "-o", "out.json").code == 0
    assert mode(folder / "out.json") == bits


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_new_file_has_the_permissions_of_the_process(place: Place, folder: Path, mask: int) -> None:
    before = os.umask(mask)
    try:
        assert run("convert", place(), "-o", "out.json").code == 0
        assert os.umask(mask) == mask
    finally:
        os.umask(before)
    assert mode(folder / "out.json") == 0o666 & ~mask


def test_new_content_of_a_private_file_is_never_open_to_others(folder: Path) -> None:
    (folder / "out").write_bytes(b"old")
    (folder / "out").chmod(0o600)
    with replacement(folder / "out") as stream:
        (temporary,) = set(folder.iterdir()) - {folder / "out"}
        assert mode(temporary) == 0o600
        stream.write(b"new")
    assert (mode(folder / "out"), (folder / "out").read_bytes()) == (0o600, b"new")


def test_link_stays_a_link(place: Place, folder: Path) -> None:
    (folder / "real").mkdir()
    (folder / "real/out.json").write_text("old", encoding="utf-8")
    (folder / "link.json").symlink_to("real/out.json")
    assert run("convert", place(), "-o", "link.json").code == 0
    assert (folder / "link.json").is_symlink()
    assert (folder / "real/out.json").read_text(encoding="utf-8").startswith("{")
    assert [path.name for path in (folder / "real").iterdir()] == ["out.json"]


def test_link_to_a_file_that_is_not_there_yet(place: Place, folder: Path) -> None:
    (folder / "link.json").symlink_to("new.json")
    assert run("convert", place(), "-o", "link.json").code == 0
    assert (folder / "link.json").is_symlink()
    assert (folder / "new.json").is_file()


def test_device_is_written_to(place: Place) -> None:
    words = [sys.executable, "-m", "mudline", "convert", place(), "-o", "/dev/stdout", "--to", "json", "-q"]
    done = subprocess.run(words, capture_output=True, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout == run("convert", place(), "--to", "json").output
    assert run("convert", place(), "-o", "/dev/null", "--to", "json").code == 0
    assert not Path("/dev/null").is_file()


# ------------------------------------------------------------- temporary files: removed when a run is ended, and by the


LEFT = ".out.json.0123456789abcdef.mudline"
HELD = """
import sys, time
from pathlib import Path
from mudline.__main__ import main
from mudline.cli import main as command_line
from mudline.basics.files import replacement

def held(arguments):
    with replacement(Path("out.json")) as stream:
        stream.write(b"half")
        stream.flush()
        print("writing", flush=True)
        time.sleep(100)
    return 0

command_line.run = held
sys.exit(main(["convert"]))
"""
"""A run that is in the middle of writing a file."""


@pytest.fixture(autouse=True)
def new_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """No folder has been tidied."""
    monkeypatch.setattr(files, "_tidied", set())


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGINT, 130)], ids=["TERM", "HUP", "INT"]
)
def test_a_run_that_is_ended_leaves_nothing(folder: Path, number: signal.Signals, code: int) -> None:
    with started("-c", HELD) as running:
        assert running.out.readline() == b"writing\n"
        assert len(names(folder)) == 1
        running.process.send_signal(number)
        assert running.process.wait(TIMEOUT) == code
        assert running.err.read() == b""
    assert names(folder) == []


def test_a_run_that_was_killed_is_tidied_up_by_the_next(place: Place, folder: Path) -> None:
    with started("-c", HELD) as running:
        assert running.out.readline() == b"writing\n"
        running.process.kill()
        running.process.wait(TIMEOUT)
    assert len(names(folder)) == 1
    assert process("convert", place(), "-o", "other.json").code == 0
    assert names(folder) == ["deck.keyxm", "other.json"]


def test_only_temporary_files_are_removed(folder: Path) -> None:
    others = [".a.0123456789abcdef", ".a.0123456789ABCDEF.mudline", ".a.123.mudline", "a.0123456789abcdef.mudline"]
    for name in (LEFT, *others):
        (folder / name).touch()
    (folder / ".folder.0123456789abcdef.mudline").mkdir()
    (folder / ".link.0123456789abcdef.mudline").symlink_to(others[0])
    write_atomically(folder / "new", b"x")
    assert LEFT not in names(folder)
    assert len(names(folder)) == len(others) + 3


def test_a_file_that_was_taken_for_left_behind_is_made_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lock = fcntl.flock
    first: list[str] = []

    def late(handle: int, how: int) -> None:
        if not first:
            first.extend(name for name in names(folder) if name.startswith("."))
            (folder / first[0]).unlink()
        lock(handle, how)

    monkeypatch.setattr(fcntl, "flock", late)
    write_atomically(folder / "new", b"x")
    assert (folder / "new").read_bytes() == b"x"
    assert names(folder) == ["new"]


def test_a_file_that_cannot_be_given_away_is_written_all_the_same(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "out").write_bytes(b"old")
    monkeypatch.setattr(os, "fstat", Mock(side_effect=lambda _: os.stat_result(range(10))))
    monkeypatch.setattr(os, "fchown", Mock(side_effect=PermissionError))
    with replacement(folder / "out") as stream:
        stream.write(b"new")
    assert (folder / "out").read_bytes() == b"new"


def test_a_folder_whose_files_cannot_be_locked(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / LEFT).touch()
    monkeypatch.setattr(fcntl, "flock", Mock(side_effect=OSError(37, "No locks available")))
    write_atomically(folder / "new", b"x")
    assert names(folder) == [LEFT, "new"]


def test_owner_and_group_are_kept_where_they_may_be(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "out").write_bytes(b"old")
    (folder / "out").chmod(0o4750)
    given: list[tuple[int, int]] = []
    own = os.fstat

    def of_another(handle: int) -> os.stat_result:
        found = list(own(handle))
        found[4], found[5] = 12345, 54321
        return os.stat_result(found)

    monkeypatch.setattr(os, "fstat", of_another)
    monkeypatch.setattr(os, "fchown", lambda _, user, group: given.append((user, group)))
    write_atomically(folder / "out", b"new")
    old = (folder / "out").stat()
    assert given == [(-1, old.st_gid), (old.st_uid, -1)]
    assert old.st_mode & 0o7777 == 0o750


def test_rewriting_leaves_other_hard_links_as_they_were(place: Place, folder: Path) -> None:
    name = place("$MODEL\n*NODE\n 1,0,0,0\n")
    (folder / "link.keyxm").hardlink_to(folder / name)
    before = (folder / "link.keyxm").read_bytes()
    assert run("format", name).code == 0
    assert (folder / name).read_bytes() != before
    assert (folder / "link.keyxm").read_bytes() == before
