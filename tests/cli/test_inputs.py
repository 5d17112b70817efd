"""What the commands read: files, directories, standard input; and the names that they report them under."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from mudline.cli.inputs import GivenDecks, Input
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, CLEAN_WARNING
from tests.helpers.processes import TIMEOUT

CONCISE = ("--output-format", "concise")
NAMING = "$LOAD CASE\n*RESTART\n LAST=deck\n$MODEL\n*SEABED PROFILE\n FILE=named.csv\n"
"""A deck that names two files."""


def names(*paths: str, gitignore: bool = True) -> list[str]:
    return [file.name for file in GivenDecks(tuple(paths), not gitignore).collect().files]


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


def test_every_file_counts_once(place: Place) -> None:
    place(CLEAN, "decks/a.keyxm")
    assert names("decks/a.keyxm", "decks", "decks/a.keyxm", "-", "-") == ["decks/a.keyxm", "<stdin>"]


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
    found = GivenDecks(("decks",)).collect()
    assert [file.name for file in found.files] == ["decks/a.keyxm"]
    assert found.code == 2


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


@pytest.mark.parametrize("command", ["lint", "show"])
def test_standard_input_that_is_closed(command: str) -> None:
    words = f"import sys; sys.stdin = None; from mudline.__main__ import main; sys.exit(main(['{command}', '-']))"
    done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, timeout=TIMEOUT, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.endswith("standard input is closed\n")


# -------------------------------------------------------------- searched directories without what .gitignore files hide


@pytest.fixture
def decks(place: Place, folder: Path) -> Path:
    for name in ("a.keyxm", "old/b.keyxm", "runs/1/c.keyxm", "runs/2/d.keyxm", "runs/2/keep.keyxm"):
        place(CLEAN, f"decks/{name}")
    return folder / "decks"


def ignore(folder: Path, *lines: str) -> None:
    (folder / ".gitignore").write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_a_file_that_is_named_is_taken(decks: Path) -> None:
    ignore(decks, "*")
    assert names("decks/a.keyxm") == ["decks/a.keyxm"]


def test_a_hidden_folder_that_is_named_is_searched(decks: Path) -> None:
    (decks.parent / ".git").mkdir()
    ignore(decks.parent, "runs")
    assert len(names("decks")) == 2
    assert len(names("decks/runs")) == 3


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


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("evaluate", "deck.json", "-o", "./deck.json"),
            "-o ./deck.json would replace deck.json, which this run reads",
        ),
        (("evaluate", "deck.json", "--positions", "p.csv", "-o", "p.csv"), "-o p.csv would replace p.csv"),
        (
            ("evaluate", "deck.json", "--positions", "p-nodes.csv", "-o", "p.csv"),
            "p-nodes.csv would replace p-nodes.csv",
        ),
        (("evaluate", "deck.json", "--elements", "p.csv", "-o", "p.csv"), "-o p.csv would replace p.csv"),
        (("evaluate", "deck.json", "--against", "p.csv", "-o", "p.csv"), "-o p.csv would replace p.csv"),
        (("study", "deck.json", "-o", "deck.json"), "-o deck.json would replace deck.json"),
        (("report", "deck.keyxm", "-o", "deck.keyxm"), "-o deck.keyxm would replace deck.keyxm"),
        (("report", "deck.keyxm", "--template", "p.csv", "-o", "p.csv"), "-o p.csv would replace p.csv"),
        (("export", "deck.keyxm", "--to", "orcaflex", "-o", "deck.keyxm"), "-o deck.keyxm would replace deck.keyxm"),
        (
            ("lint", ".", "--output-format", "json=deck.keyxm"),
            "--output-format json: deck.keyxm would replace deck.keyxm",
        ),
        (("lint", ".", "--output-format", "json=mudline.toml"), "would replace mudline.toml"),
        (("lint", ".", "--baseline", "p.json", "--output-format", "json=p.json"), "would replace p.json"),
        (
            ("lint", ".", "--baseline", "deck.keyxm", "--write-baseline"),
            "--baseline deck.keyxm would replace deck.keyxm",
        ),
        (("lint", "named.keyxm", "--output-format", "json=named.csv"), "would replace named.csv"),
        (("lint", ".", "--no-cache", "--jobs", "2", "--output-format", "json=named.csv"), "would replace named.csv"),
        (("convert", "deck.keyxm", "-o", "deck.keyxm", "--to", "json"), "-o deck.keyxm would replace deck.keyxm"),
        (("convert", "deck.keyxm", "-o", "sub/../deck.keyxm", "--to", "json"), "would replace deck.keyxm"),
        (("convert", "deck.keyxm", "-o", "soft.keyxm", "--to", "json"), "-o soft.keyxm would replace deck.keyxm"),
        (("convert", "deck.keyxm", "-o", "hard.keyxm", "--to", "json"), "-o hard.keyxm would replace deck.keyxm"),
        (("convert", "soft.keyxm", "-o", "hard.keyxm", "--to", "json"), "-o hard.keyxm would replace soft.keyxm"),
        (("convert", "named.keyxm", "-o", "named.csv", "--to", "json"), "-o named.csv would replace named.csv"),
        (("convert", "named.keyxm", "-o", "deck.keyxm"), "-o deck.keyxm would replace deck.keyxm"),
        (("migrate", "deck.keyxm", "-o", "deck.keyxm"), "-o deck.keyxm would replace deck.keyxm"),
        (("migrate", "named.keyxm", "-o", "named.csv"), "-o named.csv would replace named.csv"),
        (
            ("batch", "deck.keyxm", "-o", ".", "--form", "csv", "--positions", "deck.csv"),
            "deck.csv would replace deck.csv",
        ),
        (
            ("lint", "--output-format", "json=a.txt", "--output-format", "sarif=./a.txt", "deck.keyxm"),
            "--output-format sarif: ./a.txt is also the file of --output-format json: a.txt",
        ),
        (("lint", "--output-format", "json=a", "--output-format", "json=a", "deck.keyxm"), "is also the file of"),
        (("study", "deck.keyxm", "-o", "a.json", "--plot", "b.png"), "--plot b.png is also the file of -o a.json"),
    ],
)
def test_no_output_replaces_an_input_or_an_output(place: Place, words: tuple[str, ...], said: str) -> None:
    place(CLEAN)
    assert run("convert", "deck.keyxm", "-o", "deck.json").code == 0
    for name in ("p.csv", "p-nodes.csv", "deck.csv"):
        place("node,x,y,z\n1,0,0,0\n", name)
    place("0.0, 0.0\n1.0, 5.0\n", "named.csv")
    place(NAMING, "named.keyxm")
    place("ignore = []\n", "mudline.toml")
    assert run("lint", "deck.keyxm", "--baseline", "p.json", "--write-baseline").code == 0
    Path("sub").mkdir()
    Path("soft.keyxm").symlink_to("deck.keyxm")
    Path("hard.keyxm").hardlink_to("deck.keyxm")
    if "a.json" in words:
        place("", "a.json")
        Path("b.png").symlink_to("a.json")
    held = {path: path.read_bytes() for path in Path().iterdir() if path.is_file()}
    outcome = run(*words)
    assert (outcome.code, said in outcome.err) == (2, True), outcome.err
    assert {path: path.read_bytes() for path in Path().iterdir() if path.is_file()} == held


@pytest.fixture
def with_excluded(place: Place, folder: Path) -> Path:
    """A folder whose configuration excludes a deck with an error."""
    place('exclude = ["old/"]\n', "mudline.toml")
    place(CLEAN, "own.keyxm")
    place(BAD_NUMBER, "old/bad.keyxm")
    return folder


@pytest.mark.usefixtures("with_excluded")
@pytest.mark.parametrize(
    "arguments",
    [("lint",), ("validate",), ("format", "--check"), ("set", "OCEAN.depth=55", "--check"), ("report", "-o", "r.html")],
    ids=lambda arguments: arguments[0],
)
def test_a_search_leaves_out_what_the_configuration_excludes(arguments: tuple[str, ...]) -> None:
    outcome = run(*arguments, ".")
    assert "bad.keyxm" not in outcome.out + outcome.err


@pytest.mark.usefixtures("with_excluded")
@pytest.mark.parametrize("command", ["lint", "format"])
def test_force_exclude_leaves_out_a_file_given_by_name(command: str) -> None:
    assert run(command, "old/bad.keyxm").code == 1
    assert run(command, "--force-exclude", "old/bad.keyxm", "own.keyxm").code == 0


def test_a_key_file_of_a_password_manager_is_no_deck(place: Place) -> None:
    place(CLEAN, "own.keyxm")
    place('<?xml version="1.0"?>\n<KeyFile>\n</KeyFile>\n', "vault.keyx")
    assert names(".") == ["own.keyxm"]
    assert "vault.keyx: skipped, it is a key file of a password manager" in run("lint", "-v", ".").err
    assert "SYN018" in run("lint", "vault.keyx").out


def test_the_name_of_standard_input_finds_its_configuration(place: Place) -> None:
    place('ignore = ["SYN002"]\n', "sub/mudline.toml")
    arguments = ("lint", "-", *CONCISE)
    assert "SYN002" in run(*arguments, stdin=BAD_NUMBER.encode()).out
    assert "SYN002" not in run(*arguments, "--stdin-filename", "sub/deck.keyxm", stdin=BAD_NUMBER.encode()).out


RUSSIAN = CLEAN.replace("Clay", "Глина")


def test_a_deck_in_another_encoding_is_read_and_written_in_it(place: Place, folder: Path) -> None:
    place(RUSSIAN.replace(" 1, ", "  1,").encode("cp866"))
    assert "Глина" in run("show", "deck.keyxm", "--encoding", "cp866").out
    assert "REF" not in run("lint", "deck.keyxm", "--encoding", "cp866", *CONCISE).out
    assert run("format", "--encoding", "cp866", "deck.keyxm").code == 0
    assert "Глина" in (folder / "deck.keyxm").read_bytes().decode("cp866")
    assert run("set", "OCEAN.depth=55", "--encoding", "cp866", "deck.keyxm").code == 0
    assert "55" in (folder / "deck.keyxm").read_bytes().decode("cp866")


def test_the_configuration_gives_the_encoding(place: Place) -> None:
    place('encoding = "cp866"\n', "mudline.toml")
    place(RUSSIAN.encode("cp866"))
    assert "Глина" in run("show", "deck.keyxm").out
    assert "Глина" in run("curves", "deck.keyxm").out


@pytest.mark.parametrize("name", ["nonsense", "hex"])
def test_an_unknown_encoding(place: Place, name: str) -> None:
    place(CLEAN)
    outcome = run("lint", "deck.keyxm", "--encoding", name)
    assert (outcome.code, f"'{name}' is not known" in outcome.err) == (2, True)
    place(f'encoding = "{name}"\n', "mudline.toml")
    assert "encoding must be that of the decks" in run("lint", "deck.keyxm").err


def test_a_deck_that_is_not_in_the_encoding(place: Place) -> None:
    place(RUSSIAN)
    for command in ("show", "lint"):
        outcome = run(command, "deck.keyxm", "--encoding", "ascii")
        assert outcome.code == 2
        assert "deck.keyxm: it is not in ascii" in outcome.err
