"""What the commands read: files, directories, standard input; and the names that they report them under."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path, PurePath

import pytest

from mudline.cli.inputs import Input, collect
from tests.builders.decks import BAD_NUMBER, CLEAN, CLEAN_WARNING
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.processes import TIMEOUT

CONCISE = ("--output-format", "concise")


def names(*paths: str) -> list[str]:
    return [file.name for file in collect(paths).files]


def test_file_is_reported_as_given(place: Place) -> None:
    place(BAD_NUMBER, "inner/deck.keyxm")
    assert run("lint", "inner/../inner/deck.keyxm", *CONCISE).out.startswith("inner/../inner/deck.keyxm:6:11:")


def test_directory_is_searched_for_decks(place: Place) -> None:
    for name in ("b.keyx", "a/c.KEYXM", "a/b/d.keyxi", "z.das", "notes.txt", "deck.json", "keyxm"):
        place(CLEAN, f"decks/{name}")
    expected = ["decks/a/b/d.keyxi", "decks/a/c.KEYXM", "decks/b.keyx", "decks/z.das"]
    assert names("decks") == expected
    assert names("decks/") == expected
    assert names("./decks") == [f"./{name}" for name in expected]


def test_files_of_folders_come_where_the_name_of_the_folder_does(place: Place, folder: Path) -> None:
    inner = (
        "a.keyxm",
        "a/z.keyxm",
        "a-b/c.keyxm",
        "a-b/c/d.keyxm",
        "b.keyxm",
        "c.keyxm",
        "d.keyxm",
        "e.keyxm",
        "Z/a.das",
    )
    for name in inner:
        place(CLEAN, f"decks/{name}")
    (folder / "decks/b.keyxm.d").mkdir()
    expected = [path.as_posix() for path in sorted(PurePath("decks", name) for name in inner)]
    assert names("decks") == expected
    assert names("decks/b.keyxm", "decks") == ["decks/b.keyxm", *(one for one in expected if one != "decks/b.keyxm")]


def test_current_directory_adds_nothing_to_the_names(place: Place) -> None:
    place(CLEAN, "inner/deck.keyxm")
    assert names(".") == ["inner/deck.keyxm"]


def test_absolute_directory(place: Place, folder: Path) -> None:
    place(CLEAN, "inner/deck.keyxm")
    assert names(str(folder)) == [f"{folder.as_posix()}/inner/deck.keyxm"]


def test_every_file_counts_once(place: Place) -> None:
    place(CLEAN, "decks/a.keyxm")
    assert names("decks/a.keyxm", "decks", "decks/a.keyxm", "-", "-") == ["decks/a.keyxm", "<stdin>"]


def test_files_keep_their_order_and_directories_are_sorted(place: Place) -> None:
    for name in ("z.keyxm", "d/b.keyxm", "d/a.keyxm"):
        place(CLEAN, name)
    assert names("z.keyxm", "d") == ["z.keyxm", "d/a.keyxm", "d/b.keyxm"]


@pytest.mark.parametrize("command", ["lint", "validate"])
def test_directory_without_a_deck(command: str, folder: Path) -> None:
    (folder / "empty").mkdir()
    outcome = run(command, "empty")
    assert outcome.code == 2
    assert outcome.out == ""
    assert outcome.err == "mudline: empty: no deck in this directory (looked for .das, .keyx, .keyxi, .keyxm)\n"


@pytest.mark.parametrize("command", ["lint", "validate"])
def test_missing_path_does_not_keep_the_others_from_being_read(command: str, place: Place) -> None:
    outcome = run(command, "nowhere.keyxm", place(BAD_NUMBER), "gone/")
    assert outcome.code == 2
    assert "6:11" in outcome.out
    assert outcome.err == (
        "mudline: nowhere.keyxm: no such file or directory\nmudline: gone/: no such file or directory\n"
    )


@pytest.mark.parametrize("command", ["show", "curves", "evaluate", "convert"])
def test_one_deck_that_is_missing(command: str) -> None:
    outcome = run(command, "nowhere.keyxm", *(["--to", "json"] if command == "convert" else []))
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == "mudline: nowhere.keyxm: no such file or directory\n"


@pytest.mark.parametrize("command", ["show", "curves", "convert"])
def test_directory_where_one_deck_belongs(command: str, folder: Path) -> None:
    outcome = run(command, str(folder), *(["--to", "json"] if command == "convert" else []))
    assert outcome.code == 2
    assert outcome.err.endswith("is a directory: this command takes one deck\n")


@pytest.mark.parametrize("command", ["lint", "show"])
def test_name_that_is_too_long(command: str) -> None:
    outcome = run(command, "x" * 5000)
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err.endswith("file name too long\n")


@pytest.mark.parametrize("command", ["lint", "show"])
def test_file_that_may_not_be_read(command: str, place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(file: Input) -> bytes:
        raise PermissionError(13, "Permission denied", file.path)

    monkeypatch.setattr(Input, "read", refuse)
    outcome = run(command, place())
    assert (outcome.code, outcome.out, outcome.err) == (2, "", "mudline: deck.keyxm: permission denied\n")


def test_directory_that_may_not_be_read(place: Place, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place(CLEAN, "decks/a.keyxm")
    (folder / "decks/closed").mkdir()
    scan = os.scandir

    def refuse(path: str) -> object:
        if path.endswith("closed"):
            raise PermissionError(13, "Permission denied", path)
        return scan(path)

    monkeypatch.setattr(os, "scandir", refuse)
    found = collect(["decks"])
    assert [file.name for file in found.files] == ["decks/a.keyxm"]
    assert found.code == 2


def test_unreadable_directory_is_not_called_empty(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "closed").mkdir()

    def refuse(path: str) -> object:
        raise PermissionError(13, "Permission denied", path)

    monkeypatch.setattr(os, "scandir", refuse)
    outcome = run("lint", "closed")
    assert (outcome.code, outcome.err) == (2, "mudline: closed: permission denied\n")


def test_standard_input() -> None:
    assert run("lint", "-", *CONCISE, stdin=BAD_NUMBER.encode()).out.startswith("<stdin>:6:11:")


@pytest.mark.parametrize("command", ["lint", "validate", "show", "curves", "evaluate"])
def test_name_of_standard_input_gives_the_form(command: str) -> None:
    document = run("convert", "-", "--to", "json", stdin=CLEAN.encode()).output
    outcome = run(command, "-", "--stdin-filename", "deck.json", stdin=document)
    warned = CLEAN_WARNING.replace("deck.keyxm", "deck.json") if command == "evaluate" else ""
    assert (outcome.code, outcome.err) == (0, warned)


def test_name_of_standard_input_gives_the_units() -> None:
    deck = CLEAN.replace(" 100.0, 1025.0, 9.81", " 100.0, 1025.0, 1.0").encode()
    assert run("show", "-", "--output-format", "json", stdin=deck).json()["units"] == "user"
    named = run("show", "-", "--stdin-filename", "x.keyxi", "--output-format", "json", stdin=deck).json()
    assert (named["units"], named["file"]) == ("imperial", "x.keyxi")


def test_gravity_tells_the_units_of_standard_input() -> None:
    deck = CLEAN.replace("9.81", "32.17").encode()
    assert run("show", "-", "--output-format", "json", stdin=deck).json()["units"] == "imperial"
    assert run("show", "-", "--units", "user", "--output-format", "json", stdin=deck).json()["units"] == "user"


@pytest.mark.parametrize("command", ["lint", "show"])
def test_standard_input_that_is_closed(command: str) -> None:
    words = f"import sys; sys.stdin = None; from mudline.__main__ import main; sys.exit(main(['{command}', '-']))"
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.endswith("standard input is closed\n")


@pytest.mark.parametrize("form", ["json", "yaml", "yml"])
@pytest.mark.parametrize("command", ["show", "curves", "evaluate"])
def test_document_gives_what_its_deck_gives(place: Place, command: str, form: str) -> None:
    expected = run(command, place(), "--output-format", "json").out
    text = run("convert", "deck.keyxm", "--to", "json" if form == "json" else "yaml").output
    outcome = run(command, place(text, f"deck.{form}"), "--output-format", "json")
    warned = CLEAN_WARNING.replace("deck.keyxm", f"deck.{form}") if command == "evaluate" else ""
    assert (outcome.code, outcome.err) == (0, warned)
    assert outcome.out == expected.replace("deck.keyxm", f"deck.{form}")
