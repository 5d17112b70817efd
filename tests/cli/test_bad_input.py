"""Bad input of every kind: a clear message, the exit code of the contract, no traceback."""

from __future__ import annotations

import tracemalloc
from hashlib import sha256
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Outcome, assert_fits, run
from tests.helpers.builders.decks import CLEAN

EVERY = [
    ("lint",),
    ("validate",),
    ("show",),
    ("curves",),
    ("evaluate",),
    ("convert", "--to", "yaml"),
]
NAMES = [command[0] for command in EVERY]

BINARY = b"".join(sha256(str(n).encode()).digest() for n in range(600))
LONG = 200_000
IMPORTED = 6_000_000
"""Bytes of what a first run imports on its way."""


def lint(place: Place, text: str | bytes, name: str = "deck.keyxm") -> list[dict[str, object]]:
    outcome = run("lint", place(text, name), "--output-format", "json")
    assert outcome.err == ""
    found: list[dict[str, object]] = outcome.json()
    assert_fits(found, "lint")
    return found


def codes(place: Place, text: str | bytes, name: str = "deck.keyxm") -> set[object]:
    return {each["code"] for each in lint(place, text, name)}


def assert_quiet(outcome: Outcome) -> None:
    assert outcome.code in {0, 1}
    assert "Traceback" not in outcome.err
    assert all(char.isprintable() or char == "\n" for char in outcome.err)


NO_DIAMETER = CLEAN.partition("*GEOMETRIC SETS")[0] + "*SEABED PROPERTIES" + CLEAN.partition("*SEABED PROPERTIES")[2]

BAD = {
    "binary": (BINARY, "SYN012"),
    "utf-16": (CLEAN.encode("utf-16"), "SYN012"),
    "utf-16 without mark": (CLEAN.encode("utf-16-le"), "SYN012"),
    "truncated": (CLEAN.encode()[:-6] + b".0E", "SYN014"),
    "too large": (CLEAN.replace("3000.0", "1e400").encode(), "SYN002"),
    "nan": (CLEAN.replace("3000.0", "nan").encode(), "SYN002"),
    "infinite": (CLEAN.replace("3000.0", "-inf").encode(), "SYN002"),
    "one point": (CLEAN.partition(" 0.1, 1000.0")[0].encode(), "CRV001"),
    "no diameter": (NO_DIAMETER.encode(), "SBD009"),
    "NUL": (CLEAN.replace("Clay", "Cl\0ay").encode(), "SYN012"),
    "no section": (b"*NODE\n 1, 0, 0\n", "SYN007"),
    "nothing": (b"", "SYN019"),
    "a title": (b"C Export riser, rev C\n", "SYN019"),
    "merge": (CLEAN.replace("*NODE", "<<<<<<< HEAD\n*NODE").encode(), "SYN018"),
    "merged in part": (CLEAN.encode() + b"=======\n>>>>>>> survey\n", "SYN018"),
    "pointer": (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 3\n", "SYN018"),
    "web page": (b"<!DOCTYPE html>\n<html><body>404</body></html>\n", "SYN018"),
    "xml": (b'<?xml version="1.0"?>\n<Deck/>\n', "SYN018"),
}


@pytest.mark.parametrize(("data", "code"), BAD.values(), ids=BAD)
def test_fault_has_its_code(place: Place, data: bytes, code: str) -> None:
    assert code in codes(place, data)


@pytest.mark.parametrize("command", EVERY, ids=NAMES)
@pytest.mark.parametrize("data", [data for data, _ in BAD.values()], ids=BAD)
def test_every_command_takes_every_fault(place: Place, data: bytes, command: tuple[str, ...]) -> None:
    assert_quiet(run(command[0], place(data), *command[1:]))


@pytest.mark.parametrize("name", ["binary", "utf-16", "merge", "web page"])
@pytest.mark.parametrize(
    "command", ["curves", "evaluate", "convert --to json", "format", "show", "set OCEAN.depth=1", "migrate"]
)
def test_content_that_is_no_deck_is_refused(place: Place, name: str, command: str) -> None:
    data, code = BAD[name]
    outcome = run(*command.split(), place(data))
    assert (outcome.code, outcome.out) == (1, "")
    line = data[: data.find(b"<<<")].count(b"\n") + 1 if name == "merge" else 1
    assert outcome.err.startswith(f"deck.keyxm:{line}:1: error: {code} ")
    assert Path("deck.keyxm").read_bytes() == data


def test_binary_content_is_not_shown(place: Place) -> None:
    lines = run("lint", place(BINARY)).out.splitlines()
    assert [line for line in lines if line] == [lines[0], "Found 1 error in 1 file."]


ONE_LINE = {
    "digits": "1234," * (LONG // 5),
    "one number": "1" * LONG,
    "blanks": " " * LONG,
    "brackets": "=[" + "(" * LONG,
    "quotes": '"' * LONG,
}


@pytest.mark.untraced
@pytest.mark.parametrize("text", ONE_LINE.values(), ids=ONE_LINE)
@pytest.mark.parametrize("head", ["", "$MODEL\n*SEABED STIFFNESS\n CURVE=A\n ", "$MODEL\n*ELEMENT SETS\n SET="])
def test_file_of_one_long_line(place: Place, head: str, text: str) -> None:
    tracemalloc.start()
    outcome = run("lint", place(head + text))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert_quiet(outcome)
    assert len(outcome.out) < 5000
    assert peak < 40 * LONG + IMPORTED


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "{}", '{"format": 1}', '{"a": NaN}', "[" * 100_000, "1e999"])
@pytest.mark.parametrize("form", ["json", "yaml"])
def test_document_that_is_no_deck(place: Place, form: str, text: str) -> None:
    for command in EVERY:
        outcome = run(command[0], place(text, f"deck.{form}"), *command[1:])
        assert_quiet(outcome)
        assert outcome.code == 1


SOURCE = (SAMPLES / "broken.keyxm").read_bytes()


@given(st.data())
def test_damaged_deck_never_breaks_a_command(data: st.DataObject) -> None:
    body = bytearray(SOURCE)
    for _ in range(data.draw(st.integers(1, 6))):
        at = data.draw(st.integers(0, len(body)))
        length = data.draw(st.integers(0, 30))
        body[at : at + length] = data.draw(st.binary(max_size=12))
    command = data.draw(st.sampled_from(EVERY))
    outcome = run(command[0], "-", *command[1:], stdin=bytes(body))
    assert outcome.code in {0, 1}
    assert "\x1b" not in outcome.err
