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
    "merge": (CLEAN.replace("*NODE", "