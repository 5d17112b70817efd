"""Streams that are gone, signals, and names in odd bytes, where the system is of the Unix kind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, process, run
from tests.cli.test_expand_command import STUDY, files
from tests.helpers.builders.decks import BAD_NUMBER
from tests.helpers.processes import TIMEOUT, started

PIPED = {
    "lint": ["lint", str(SAMPLES / "broken.keyxm")],
    "convert": ["convert", str(SAMPLES / "scr-touchdown.keyxm"), "--to", "json"],
    "rules": ["rules"],
    "version": ["--version"],
}


@pytest.mark.parametrize("arguments", PIPED.values(), ids=PIPED)
def test_closed_pipe_ends_quietly(arguments: list[str]) -> None:
    """Nobody reads: not one line, so that also an output that fits into the pipe's buffer meets it closed."""
    read, write = os.pipe()
    os.close(read)
    words = [sys.executable, "-m", "mudline", *arguments]
    done = subprocess.run(words, stdout=write, stderr=subprocess.PIPE, timeout=TIMEOUT, check=False)
    os.close(write)
    assert (done.returncode, done.stderr) == (141, b"")


def test_pipe_that_is_closed_after_the_first_line(folder: Path) -> None:
    points = "".join(f" {i}.0, {i}.0\n" for i in range(10_000))
    (folder / "long.keyxm").write_text(f"$MODEL\n*SEABED STIFFNESS\n CURVE=A\n{points}", encoding="utf-8")
    with started("-m", "mudline", "convert", "long.keyxm", "--to", "json") as running:
        assert running.out.readline() == b"{\n"
        running.out.close()
        assert running.err.read() == b""
        assert running.process.wait(TIMEOUT) == 141


def test_standard_error_that_is_closed(folder: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    words = [sys.executable, "-m", "mudline", "lint", "nowhere"]
    done = subprocess.run(words, stderr=write, stdout=subprocess.PIPE, timeout=TIMEOUT, check=False, cwd=folder)
    os.close(write)
    assert (done.returncode, done.stdout) == (141, b"")


def test_language_server_without_standard_input() -> None:
    words = ["sh", "-c", 'exec "$0" -m mudline lsp <&-', sys.executable]
    done = subprocess.run(words, capture_output=True, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"mudline: standard input is closed: ")
    assert done.stderr.count(b"\n") == 1


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no device that is always full")
@pytest.mark.parametrize("arguments", [PIPED["rules"], PIPED["version"]], ids=["rules", "version"])
def test_output_that_is_full(arguments: list[str]) -> None:
    with Path("/dev/full").open("wb") as full:
        words = [sys.executable, "-m", "mudline", *arguments]
        done = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stderr) == (2, b"mudline: the output cannot be written: no space left on device\n")


def test_interruption(folder: Path) -> None:
    (folder / "deck.keyxm").write_text("$MODEL\n", encoding="utf-8")
    with started("-m", "mudline", "lint", "-v", "deck.keyxm", "-") as running:
        assert running.err.readline() == b"mudline: deck.keyxm: 0 findings\n"
        running.process.send_signal(signal.SIGINT)
        assert running.process.wait(TIMEOUT) == 130
        assert (running.out.read(), running.err.read()) == (b"", b"")


def test_file_name_that_is_no_utf_8(folder: Path) -> None:
    name = os.fsdecode(b"deck-\xff.keyxm")
    (folder / name).write_text(BAD_NUMBER, encoding="utf-8")
    outcome = process("lint", ".", "--output-format", "json")
    assert (outcome.code, outcome.err) == (1, "")
    assert outcome.json()[0]["file"] == name
    assert run("lint", name + "x").err == "mudline: deck-\ufffd.keyxmx: no such file or directory\n"


# --------------------------------------------------------------------------------------------- mudline expand and links


def test_links_are_not_followed_out_of_the_folder(place: Place, folder: Path) -> None:
    name = place(STUDY)
    (folder / "outside").mkdir()
    (folder / "out").mkdir()
    (folder / "out/Near").symlink_to(folder / "outside")
    outcome = run("expand", name, "-o", "out", "--force")
    assert outcome.code == 2
    assert "out/Near/at 50.keyxm: a link in its path leads out of the folder" in outcome.err
    (folder / "out/Near").unlink()
    (folder / "out/Near").mkdir()
    (folder / "out/Near/at 50.keyxm").symlink_to(folder / "outside/file")
    outcome = run("expand", name, "-o", "out", "--force")
    assert outcome.code == 2
    assert "exists already and is not a regular file: it is not overwritten" in outcome.err
    assert files(folder) == ["deck.keyxm"]
