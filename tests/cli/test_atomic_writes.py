"""Output files: whole or not at all."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import Mock

import pytest

from mudline.files import write_atomically
from tests.cli.conftest import Place
from tests.cli.runner import run

FULL = OSError(errno.ENOSPC, "No space left on device")


class BrokenError(Exception):
    """What went wrong while pieces were made."""


def test_bytes_and_pieces(folder: Path) -> None:
    write_atomically(folder / "a", b"one piece")
    write_atomically(folder / "b", (piece for piece in (b"two ", b"", b"pieces")))
    assert (folder / "a").read_bytes() == b"one piece"
    assert (folder / "b").read_bytes() == b"two pieces"
    assert sorted(path.name for path in folder.iterdir()) == ["a", "b"]


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


def test_old_file_survives_when_it_cannot_be_replaced(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "a").write_bytes(b"old")

    monkeypatch.setattr(Path, "replace", Mock(side_effect=FULL))
    with pytest.raises(OSError, match="No space"):
        write_atomically(folder / "a", b"new")
    assert (folder / "a").read_bytes() == b"old"
    assert [path.name for path in folder.iterdir()] == ["a"]


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


def test_file_that_may_not_be_written(place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "out.json").write_text("old", encoding="utf-8")
    monkeypatch.setattr(os, "access", Mock(return_value=False))
    outcome = run("convert", place(), "-o", "out.json")
    assert (outcome.code, outcome.err) == (2, "mudline: out.json: cannot be written: permission denied\n")
    assert (folder / "out.json").read_text(encoding="utf-8") == "old"


@pytest.mark.parametrize("options", [("convert", "--to", "json"), ("evaluate",)], ids=["convert", "evaluate"])
def test_directory_is_not_replaced(place: Place, folder: Path, options: tuple[str, ...]) -> None:
    (folder / "out.json").mkdir()
    command, *rest = options
    outcome = run(command, place(), "-o", "out.json", *rest)
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == "mudline: out.json: cannot be written: is a directory\n"


def test_deck_is_replaced_by_its_own_sorted_form(place: Place, folder: Path) -> None:
    name = place()
    before = (folder / name).read_bytes()
    assert run("convert", name, "-o", name).code == 0
    assert (folder / name).read_bytes() != b""
    assert run("lint", name).code == 0
    assert len((folder / name).read_bytes().splitlines()) == len(before.splitlines())


def test_long_name(folder: Path) -> None:
    name = "n" * 250
    write_atomically(folder / name, b"x")
    assert [path.name for path in folder.iterdir()] == [name]


def test_name_of_the_temporary_file_may_be_taken(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken = ".a.7461.mudline"
    (folder / taken).write_bytes(b"another's")
    monkeypatch.setattr(os, "urandom", Mock(side_effect=[b"ta", b"free"]))
    write_atomically(folder / "a", b"x")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"a": b"x", taken: b"another's"}
