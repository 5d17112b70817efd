"""Searched directories without what `.gitignore` files hide."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from mudline.cli.inputs import collect
from tests.builders.decks import CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import run


def names(*paths: str, gitignore: bool = True) -> list[str]:
    return [file.name for file in collect(paths, gitignore=gitignore).files]


@pytest.fixture
def decks(place: Place, folder: Path) -> Path:
    for name in ("a.keyxm", "old/b.keyxm", "runs/1/c.keyxm", "runs/2/d.keyxm", "runs/2/keep.keyxm"):
        place(CLEAN, f"decks/{name}")
    return folder / "decks"


def ignore(folder: Path, *lines: str) -> None:
    (folder / ".gitignore").write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_what_is_hidden_is_left_out(decks: Path) -> None:
    ignore(decks, "# generated", "", "/old/", "runs/*/[cd].keyxm")
    for given in ("decks", "decks/", "./decks"):
        assert [name.rpartition("decks/")[2] for name in names(given)] == ["a.keyxm", "runs/2/keep.keyxm"]
    assert len(names("decks", gitignore=False)) == 5


def test_a_file_that_is_named_is_taken(decks: Path) -> None:
    ignore(decks, "*")
    assert names("decks/a.keyxm") == ["decks/a.keyxm"]


def test_deeper_files_go_first_and_may_take_back(decks: Path) -> None:
    ignore(decks, "*.keyxm")
    ignore(decks / "runs/2", "!keep.keyxm")
    assert names("decks") == ["decks/runs/2/keep.keyxm"]


def test_nothing_in_a_hidden_folder_is_taken_back(decks: Path) -> None:
    ignore(decks, "runs/")
    ignore(decks / "runs", "!*")
    assert names("decks") == ["decks/a.keyxm", "decks/old/b.keyxm"]


def test_patterns_hold_from_their_own_folder(decks: Path) -> None:
    ignore(decks / "runs", "/2/d.keyxm", "/runs", "/old")
    assert "decks/runs/2/d.keyxm" not in names("decks")
    assert "decks/old/b.keyxm" in names("decks")
    assert len(names("decks")) == 4


def test_files_above_hold_in_a_repository(decks: Path) -> None:
    ignore(decks.parent, "/decks/runs/2", "decks")
    assert len(names("decks")) == 5
    (decks.parent / ".git").mkdir()
    assert names("decks/runs") == ["decks/runs/1/c.keyxm"]
    (decks / ".git").write_text("gitdir: elsewhere", encoding="utf-8")
    assert len(names("decks/runs")) == 3


def test_a_hidden_folder_that_is_named_is_searched(decks: Path) -> None:
    (decks.parent / ".git").mkdir()
    ignore(decks.parent, "runs")
    assert len(names("decks")) == 2
    assert len(names("decks/runs")) == 3


def test_the_folder_of_git_is_not_searched(decks: Path) -> None:
    (decks / ".git").mkdir()
    (decks / ".git/x.keyxm").write_text(CLEAN, encoding="utf-8")
    assert not [name for name in names("decks") if ".git" in name]
    assert "decks/.git/x.keyxm" in names("decks", gitignore=False)


def test_names_in_any_bytes(decks: Path) -> None:
    (decks / ".gitignore").write_bytes(b"\xff\xfe*.keyxm\n/old\n")
    assert "decks/old/b.keyxm" not in names("decks")


def test_a_folder_of_that_name_hides_nothing(decks: Path) -> None:
    (decks / ".gitignore").mkdir()
    assert len(names("decks")) == 5


def test_a_file_that_cannot_be_read_is_told(decks: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ignore(decks, "*")
    reading = Path.read_bytes

    def refusing(path: Path) -> bytes:
        if path.name == ".gitignore":
            raise PermissionError(13, os.strerror(13), str(path))
        return reading(path)

    monkeypatch.setattr(Path, "read_bytes", refusing)
    outcome = run("validate", "decks")
    assert outcome.code == 2
    assert outcome.err.startswith("mudline: decks/.gitignore: permission denied")


@pytest.mark.parametrize("command", ["lint", "validate", "format", "migrate"])
def test_commands_that_search(decks: Path, command: str) -> None:
    ignore(decks, "*")
    outcome = run(command, "decks")
    assert outcome.code == 2
    assert outcome.err.endswith("; --no-gitignore takes what a .gitignore hides)\n")
    assert run(command, "decks", "--no-gitignore").code == 0


def test_decks_in_json_are_hidden_too(decks: Path) -> None:
    ignore(decks, "*.json")
    (decks / "x.json").write_text('{"format": "mudline-deck/1"}', encoding="utf-8")
    for options, found in ((), False), (("--no-gitignore",), True):
        rows = json.loads(run("validate", "decks", "--output-format", "json", *options).out)
        assert ("x.json" in json.dumps(rows)) is found
