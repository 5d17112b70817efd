"""Output files: whole or not at all."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest.mock import Mock

import pytest

from mudline.basics import files
from mudline.basics.files import write_atomically
from tests.cli.conftest import Place
from tests.cli.kills import COMMANDS, NEW, OLD, written
from tests.cli.runner import run

FULL = OSError(errno.ENOSPC, "No space left on device")


class BrokenError(Exception):
    """What went wrong while pieces were made."""


def test_old_file_survives_a_failure(folder: Path) -> None:
    def pieces() -> Iterator[bytes]:
        yield b"half"
        raise BrokenError

    (folder / "a").write_bytes(b"old")
    with pytest.raises(BrokenError):
        write_atomically(folder / "a", pieces())
    assert (folder / "a").read_bytes() == b"old"
    assert [path.name for path in folder.iterdir()] == ["a"]


@pytest.mark.parametrize("failure", [KeyboardInterrupt, MemoryError])
def test_nothing_is_left_behind(folder: Path, failure: type[BaseException]) -> None:
    def pieces() -> Iterator[bytes]:
        yield b"half"
        raise failure

    with pytest.raises(failure):
        write_atomically(folder / "new", pieces())
    assert list(folder.iterdir()) == []


def test_command_tells_that_a_file_cannot_be_written(
    place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "out.json").write_text("old", encoding="utf-8")
    name = place()
    monkeypatch.setattr(os, "fsync", Mock(side_effect=FULL))
    outcome = run("convert", name, "-o", "out.json")
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == "mudline: out.json: cannot be written: no space left on device\n"
    assert (folder / "out.json").read_text(encoding="utf-8") == "old"
    assert sorted(path.name for path in folder.iterdir()) == ["deck.keyxm", "out.json"]


# --------------------------------------------------------------------------------------- every command that writes


def test_file_that_may_not_be_written(place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "out.json").write_text("old", encoding="utf-8")
    monkeypatch.setattr(os, "access", Mock(return_value=False))
    outcome = run("convert", place(), "-o", "out.json")
    assert (outcome.code, outcome.err) == (2, "mudline: out.json: cannot be written: permission denied\n")
    assert (folder / "out.json").read_text(encoding="utf-8") == "old"


def full(_: Path, __: int) -> tuple[int, Path]:
    """A new file on a disk without space."""
    return os.open("/dev/full", os.O_WRONLY), Path("none.mudline")


def read_only(_: Path, __: int) -> tuple[int, Path]:
    """A folder of a file system that cannot be written."""
    raise OSError(errno.EROFS, "Read-only file system")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a disk that is full")
@pytest.mark.parametrize("new_file", [full, read_only])
@pytest.mark.parametrize("name", COMMANDS)
def test_nothing_changes_where_nothing_can_be_written(
    folder: Path, monkeypatch: pytest.MonkeyPatch, name: str, new_file: Callable[[Path, int], tuple[int, Path]]
) -> None:
    command = COMMANDS[name]
    written(1, 0, OLD)
    if command.makes:
        assert run(*command.words).code in {0, 1}
    written(1, 0, NEW)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    monkeypatch.setattr(files, "_new_beside", new_file)
    outcome = run(*command.words)
    why = "no space left on device" if new_file is full else "read-only file system"
    assert f"cannot be written: {why}\n" in outcome.err
    assert "Traceback" not in outcome.err
    assert outcome.code == 2
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
