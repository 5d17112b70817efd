"""Files outside of a project: they are read, no message shows their text, and they can be refused."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from mudline.basics import outside
from mudline.checks.configuration import refuses_outside
from mudline.cli import DONE, FOUND, WRONG_USAGE
from tests.cli.runner import run

MODEL = """\
$MODEL
*OCEAN
 100, 1025, 9.81
*NODE
 1, -0.01, 0
 2, -0.01, 10
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.28, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 STIFFNESS=50000
"""
PROFILE = "*SEABED PROFILE\n TYPE=2D\n FILE={}\n"
RESTART = "$LOAD CASE\n*RESTART\n LAST={}\n"
MOTIONS = "$MODEL\n*VESSEL\n VESSEL=FPSO\n INITIAL POSITION=1, 0, 0\n$LOAD CASE\n*RAO\n VESSEL=FPSO\n FILE={}\n"
VARIATION = "$PREPROCESSOR\n*VARIATION\n NAME=v\n SECTION=MODEL, KEYWORD=OCEAN, ACTION=ADD\n FILE={}\n"
TEXT = "root:x:0:0:hunter2\nhunter3, hunter4\n"
POINTS = "0, 0\n10, 0\n"


@pytest.fixture(autouse=True)
def fresh() -> Iterator[None]:
    for cached in (outside.project_of, refuses_outside):
        cached.cache_clear()
    yield
    for cached in (outside.project_of, refuses_outside):
        cached.cache_clear()


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project with a folder of decks; files of other people lie beside it."""
    (tmp_path / "theirs").mkdir()
    (tmp_path / "ours" / "decks").mkdir(parents=True)
    (tmp_path / "ours" / "mudline.toml").touch()
    (tmp_path / "ours" / "shared.txt").write_text(POINTS, encoding="utf-8")
    (tmp_path / "theirs" / "profile.txt").write_text(POINTS, encoding="utf-8")
    (tmp_path / "theirs" / "secret.txt").write_text(TEXT, encoding="utf-8")
    (tmp_path / "theirs" / "base.keyxm").write_text(MODEL, encoding="utf-8")
    return tmp_path


def deck(project: Path, text: str, name: str = "deck.keyxm") -> str:
    path = project / "ours" / "decks" / name
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("text", "commands"),
    [
        (MODEL + PROFILE, ("lint", "validate", "evaluate", "show")),
        (MODEL + RESTART, ("lint", "validate", "evaluate", "show")),
        (RESTART, ("lint", "validate", "evaluate", "curves")),
        (MOTIONS, ("lint", "validate")),
        (VARIATION + MODEL, ("lint", "expand")),
    ],
)
@pytest.mark.parametrize("form", ["path", "link"])
def test_no_message_shows_the_text_of_a_file_outside(
    project: Path, text: str, commands: tuple[str, ...], form: str
) -> None:
    name = "../../theirs/secret.txt"
    if form == "link":
        (project / "ours" / "decks" / "link.txt").symlink_to(project / "theirs" / "secret.txt")
        name = "link.txt"
    given = deck(project, text.format(name))
    for command in commands:
        more = ("-o", str(project / "out")) if command == "expand" else ()
        outcome = run(command, given, *more)
        assert outcome.code in {DONE, FOUND, WRONG_USAGE}
        assert "hunter" not in outcome.out + outcome.err
        assert "root:x" not in outcome.out + outcome.err


def test_a_fault_outside_has_its_line(project: Path) -> None:
    (project / "theirs" / "profile.txt").write_text("0, 0\n10, hunter2\n", encoding="utf-8")
    outcome = run("lint", deck(project, MODEL + PROFILE.format("../../theirs/profile.txt")))
    assert "line 2 is not as it should be; its text is not shown" in outcome.out


@pytest.mark.parametrize(
    "text", [MODEL + PROFILE.format("../../theirs/profile.txt"), RESTART.format("../../theirs/base")]
)
@pytest.mark.parametrize("command", ["lint", "validate"])
def test_files_outside_are_refused_on_demand(project: Path, text: str, command: str) -> None:
    given = deck(project, text)
    allowed = run(command, given)
    assert "outside of the project" not in allowed.out + allowed.err
    refused = run(command, given, "--no-outside")
    assert refused.code == FOUND
    assert "outside of the project" in refused.out
    assert "error" in refused.out
    inside = run(command, deck(project, MODEL + PROFILE.format("../shared.txt"), "inside.keyxm"), "--no-outside")
    assert "outside of the project" not in inside.out


@pytest.mark.parametrize("command", ["lint", "validate", "evaluate", "curves", "study"])
def test_a_configuration_refuses_them_for_every_command(project: Path, command: str) -> None:
    (project / "ours" / "mudline.toml").write_text("no-outside = true\n", encoding="utf-8")
    given = deck(project, RESTART.format("../../theirs/base"))
    outcome = run(command, given)
    assert outcome.code == FOUND
    assert "outside of the project" in outcome.out + outcome.err


def test_a_batch_refuses_them_too(project: Path) -> None:
    (project / "ours" / "mudline.toml").write_text("no-outside = true\n", encoding="utf-8")
    deck(project, RESTART.format("../../theirs/base"))
    outcome = run("batch", str(project / "ours"), "-o", str(project / "out"), "--output-format", "json", "--jobs", "2")
    assert "outside of the project" in outcome.out + outcome.err


def test_a_configuration_that_cannot_be_read_refuses_them(project: Path) -> None:
    (project / "ours" / "mudline.toml").write_text("no-outside = 3\n", encoding="utf-8")
    outcome = run("evaluate", deck(project, RESTART.format("../../theirs/base")))
    assert (outcome.code, outcome.out) == (2, "")
    assert "no-outside is true or false, not 3" in outcome.err


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such files")
def test_what_only_looks_like_a_file_is_not_read(project: Path) -> None:
    os.mkfifo(project / "ours" / "fifo")
    (project / "ours" / "link").symlink_to("/proc/self/environ")
    for name in ("/proc/self/environ", "/dev/zero", "../fifo", "../link"):
        outcome = run("lint", deck(project, MODEL + PROFILE.format(name)))
        assert "was not found" in outcome.out, name
