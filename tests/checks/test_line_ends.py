"""The findings of a deck are the same whether its lines end with LF, CRLF or CR."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from tests.helpers.builders.decks import CLEAN


@pytest.mark.parametrize("end", [b"\r\n", b"\r"], ids=["CRLF", "CR"])
@pytest.mark.parametrize(
    "text",
    [
        b"*ELEMENT\n GEN=1, 5\n SUCTION=2000.0, 0.0",  # a keyword line and a section line are missing
        CLEAN.replace("Clay", "T\u00f6n").encode("cp1252"),
        CLEAN.replace("*ELEMENT\n", "<<<<<<< ours\n*ELEMENT\n=======\n>>>>>>> theirs\n").encode(),
        CLEAN.encode() + b"\x01\n" * 400,
    ],
    ids=["missing-lines", "code-page", "merge-marks", "binary"],
)
def test_findings_do_not_depend_on_line_ends(text: bytes, end: bytes) -> None:
    found = lint_bytes(text, "deck.keyxm", rules())
    assert found
    other = lint_bytes(text.replace(b"\n", end), "deck.keyxm", rules())
    assert [(one.line, one.column, one.code, one.message) for one in other] == [
        (one.line, one.column, one.code, one.message) for one in found
    ]
