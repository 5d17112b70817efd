"""The command as a whole: version, help, wrong usage, interruption, an output that is full."""

from __future__ import annotations

import errno
import io
import re
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest

import mudline
from mudline.__main__ import main
from mudline.cli.inputs import Input
from mudline.cli.main import COMMANDS
from tests.cli.conftest import Place
from tests.cli.runner import Stream, process, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN
from tests.helpers.processes import TIMEOUT

EVERY = sorted(COMMANDS)


def test_version() -> None:
    assert run("--version").out == f"mudline {mudline.__version__}\n"
    assert run("--version").code == 0


def test_installed_command_is_the_module() -> None:
    command = Path(sys.executable).with_name("mudline")
    done = subprocess.run([command, "--version"], capture_output=True, text=True, timeout=TIMEOUT, check=True)
    assert done.stdout == f"mudline {mudline.__version__}\n"


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_help_lists_the_commands(option: str) -> None:
    outcome = run(option)
    assert (outcome.code, outcome.err) == (0, "")
    for name, line in COMMANDS.items():
        assert re.search(rf"^  {name} +{re.escape(line)}$", outcome.out, re.MULTILINE)


@pytest.mark.parametrize("command", EVERY)
def test_a_command_has_few_options_of_its_own(command: str) -> None:
    own, _, common = run(command, "--help").out.partition("Common options:")
    assert len(re.findall(r"^  -", own, re.MULTILINE)) <= {"lint": 24, "report": 18}.get(command, 17)
    assert re.findall(r"^  (?:-\w, )?--(\w+)", common, re.MULTILINE) == ["color", "quiet", "verbose", "help"]


@pytest.mark.parametrize("command", EVERY)
def test_help_as_a_command(command: str) -> None:
    outcome = run("help", command)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out == run(command, "--help").out


@pytest.mark.parametrize("command", EVERY)
def test_unknown_option(command: str) -> None:
    outcome = run(command, "--nonsense")
    assert (outcome.code, outcome.out) == (2, "")
    assert f"Try 'mudline {command} --help' for help." in outcome.err
    assert "--nonsense" in outcome.err


def test_message_about_an_argument_does_not_act_on_the_terminal() -> None:
    outcome = run("lint", "\x1b[31mred\x07.keyxm")
    assert outcome.code == 2
    assert "\x1b" not in outcome.err
    assert "\x07" not in outcome.err
    assert "red" in outcome.err
    assert "\x1b" not in run("\x1b[31mlint").err


# ----------------------------------------------------------------------------------------- streams and interruption


def test_too_little_memory(monkeypatch: pytest.MonkeyPatch, place: Place) -> None:
    monkeypatch.setattr(Input, "read", Mock(side_effect=MemoryError))
    outcome = run("lint", place())
    assert (outcome.code, outcome.out, outcome.err) == (1, "", "mudline: out of memory\n")


def test_machine_formats_are_utf_8_and_people_get_what_their_terminal_has(place: Place) -> None:
    name = place(BAD_NUMBER.replace("ten", "z\u00e4hn"))
    ascii_only = {"PYTHONIOENCODING": "ascii"}
    machine = run("lint", name, "--output-format", "json", encoding="ascii")
    assert (machine.code, machine.err) == (1, "")
    assert "'z\u00e4hn' is not a number" in machine.json()[0]["message"]
    people = process("lint", name, env=ascii_only)
    assert people.code == 1
    assert "'z\\xe4hn' is not a number" in people.out
    assert people.output.isascii()
    table = run("curves", place(CLEAN), encoding="ascii")
    assert (table.code, "--------------------" in table.out, table.output.isascii()) == (0, True, True)


@pytest.mark.parametrize("form", ["json", "text"])
def test_output_that_is_full(monkeypatch: pytest.MonkeyPatch, place: Place, form: str) -> None:
    class Disk(io.BytesIO):
        write = Mock(side_effect=OSError(errno.ENOSPC, "No space left on device"))

    disk, errors = Disk(), Stream("utf-8", terminal=False)
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(disk, encoding="utf-8"))
    monkeypatch.setattr(sys, "stderr", errors)
    assert main(["lint", place(BAD_NUMBER), "--output-format", form]) == 2
    assert errors.content() == b"mudline: the output cannot be written: no space left on device\n"
