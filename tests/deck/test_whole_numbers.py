"""Whole numbers: one that is too large is told apart from one with a fraction."""

from __future__ import annotations

import json

import pytest

from mudline.deck.loading import load_bytes
from mudline.diagnostics import DeckError
from tests.deck.test_faults import messages

LIMIT = "needs a whole number of at most 2^53 (9007199254740992)"


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ("*NODE\n 99999999999999999999, 0.5, 10.0\n", f"1e+20 is too large: node {LIMIT}"),
        ("*NODE\n -1E300, 0.5, 10.0\n", f"-1e+300 is too large: node {LIMIT}"),
        ("*NODE\n 3.5, 0.5, 10.0\n", "3.5 is not a whole number: node needs one"),
        ("*NODE\n GEN=1, 99999999999999999999\n", f"99999999999999999999 is too large: end {LIMIT}"),
        ("*NODE\n GEN=1, 2.5\n", "2.5 is not a whole number: end needs one"),
    ],
)
def test_words(lines: str, message: str) -> None:
    assert messages(f"$MODEL\n{lines}") == [message]


def test_the_largest_one_is_read() -> None:
    assert messages("$MODEL\n*NODE\n 9007199254740992, 0.5, 10.0\n GEN=1, 9007199254740992\n") == []


def test_documents_say_the_same() -> None:
    block = {"keyword": "NODE", "entries": [{"nodes": [[1e20, 0.0, 0.0]]}]}
    document = {"format": "mudline-deck/1", "sections": [{"name": "MODEL", "blocks": [block]}]}
    with pytest.raises(DeckError) as caught:
        load_bytes(json.dumps(document).encode(), "deck.json")
    assert f"1e+20 is too large: node {LIMIT}" in str(caught.value)
