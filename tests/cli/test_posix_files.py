"""Links, pipes and permissions, where the system is of the Unix kind."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest

from mudline.cli.inputs import collect
from mudline.files import replacement, write_atomically
from tests.builders.decks import CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.processes import TIMEOUT


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_links_and_pipes_in_a_directory_are_no_trap(place: Place, folder: Path) -> None:
    place(CLEAN, "decks/a.keyxm")
    (folder / "decks/loop").symlink_to(folder / "decks", target_is_directory=True)
    (folder / "decks/gone.keyxm").symlink_to(folder / "nowhere")
    os.mkfifo(folder / "decks/pipe.keyxm")
    assert [file.name for file in collect(["decks"]).files] == ["decks/a.keyxm"]


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


def test_the_mask_of_the_process_is_left_alone(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "umask", Mock(side_effect=AssertionError("another thread may be making a file")))
    write_atomically(folder / "new", b"x")
    write_atomically(folder / "new", b"y")
    assert (folder / "new").read_bytes() == b"y"


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


def test_loop_of_links(place: Place, folder: Path) -> None:
    (folder / "a.json").symlink_to("b.json")
    (folder / "b.json").symlink_to("a.json")
    outcome = run("convert", place(), "-o", "a.json")
    assert outcome.code == 2
    assert outcome.err.startswith("mudline: a.json: cannot be written: ")


def test_device_is_written_to(place: Place) -> None:
    words = [sys.executable, "-m", "mudline", "convert", place(), "-o", "/dev/stdout", "--to", "json", "-q"]
    done = subprocess.run(words, capture_output=True, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout == run("convert", place(), "--to", "json").output
    assert run("convert", place(), "-o", "/dev/null", "--to", "json").code == 0
    assert not Path("/dev/null").is_file()
