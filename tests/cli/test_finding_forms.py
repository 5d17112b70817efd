"""Forms of findings, for what no deck makes yet: fixes, places that are not there, other encodings."""

from __future__ import annotations

import json

import pytest

from mudline.cli.lint_report import statistics_lines
from mudline.cli.printing import Screen, excerpt, findings, summary
from mudline.diagnostics import Diagnostic, Edit, Fix, Severity
from mudline.linting.output import LONGEST, form, visible, visible_lines
from mudline.syntax.source import Source
from tests.cli.runner import assert_fits

SCREEN = Screen(80)
TEXT = Source.from_bytes(b"first\n second, x\n", "deck.keyxm")


def found(line: int = 2, column: int = 2, end_line: int = 2, end_column: int = 8, fix: Fix | None = None) -> Diagnostic:
    place = (line, column, end_line, end_column)
    return Diagnostic("deck.keyxm", "SYN004", "unknown-setting", Severity.ERROR, "no such setting", *place, fix)


def lines(diagnostic: Diagnostic, source: Source = TEXT, screen: Screen = SCREEN) -> list[str]:
    return [text.plain for text in excerpt(diagnostic, source, screen)]


def test_fix_in_json() -> None:
    fix = Fix("unsafe", "write SET=", (Edit((2, 2), (2, 8), "SET"), Edit((3, 1), (3, 1), "\n")))
    objects = json.loads("".join(form("json", [], "")([found(fix=fix), found()])))
    assert_fits(objects, "lint")
    assert objects[0]["fix"] == {
        "applicability": "unsafe",
        "message": "write SET=",
        "edits": [
            {"start": [2, 2], "end": [2, 8], "text": "SET"},
            {"start": [3, 1], "end": [3, 1], "text": "\n"},
        ],
    }
    assert [json.loads(line) for line in form("jsonl", [], "")([found(fix=fix), found()])] == objects


def test_nothing() -> None:
    assert list(form("jsonl", [], "")([])) == []
    assert list(statistics_lines([])) == []
    assert list(findings([], TEXT, SCREEN)) == []


def test_excerpt() -> None:
    assert lines(found()) == [" 2 |  second, x", "   |  ^^^^^^"]


@pytest.mark.parametrize(
    ("diagnostic", "under"),
    [
        (found(end_column=2), "   |  ^"),
        (found(column=10, end_column=11), "   |          ^"),
        (found(column=99, end_column=120), "   |           ^"),
        (found(end_line=3, end_column=1), "   |  ^^^^^^^^^"),
    ],
    ids=["empty", "last", "beyond", "to the next line"],
)
def test_mark(diagnostic: Diagnostic, under: str) -> None:
    assert lines(diagnostic)[1] == under


@pytest.mark.parametrize("line", [3, 4, 99])
def test_line_that_is_blank_or_not_there(line: int) -> None:
    assert lines(found(line=line, column=1, end_line=line, end_column=1)) == [""]


def test_number_of_a_far_line() -> None:
    source = Source.from_bytes(b"\n" * 999 + b"abc", "deck.keyxm")
    place = found(line=1000, column=2, end_line=1000, end_column=3)
    assert lines(place, source) == [" 1000 | abc", "      |  ^"]


def test_summary() -> None:
    warning = Diagnostic("a", "X", "x", Severity.WARNING, "m", 1, 1, 1, 1)
    assert summary([found()], 1).plain == "Found 1 error in 1 file."
    assert summary([found(), found(), warning], 2).plain == "Found 2 errors, 1 warning in 2 files."
    assert summary([warning, warning], 1).plain == "Found 2 warnings in 1 file."


@pytest.mark.parametrize(
    ("text", "encoding", "shown"),
    [
        ("plain [x]", "utf-8", "plain [x]"),
        ("a\tb\x1bc\x9bd\x7f\u202e", "utf-8", "a b\ufffdc\ufffdd\ufffd\ufffd"),
        ("\u00e4\u6f22", "utf-8", "\u00e4\u6f22"),
        ("\u00e4\u6f22", "latin-1", "\u00e4\\u6f22"),
        ("\u00e4\x07", "ascii", "\\xe4\\ufffd"),
        ("\udcff", "utf-8", "\ufffd"),
    ],
)
def test_visible_text(text: str, encoding: str, shown: str) -> None:
    assert visible(text, encoding) == shown


def test_text_that_nobody_reads_to_its_end_is_cut() -> None:
    assert visible("x" * LONGEST) == "x" * LONGEST
    assert visible("x" * (LONGEST + 1)) == "x" * (LONGEST - 3) + "..."
    assert len(visible("\x1b" * 10_000_000)) == LONGEST


def test_visible_lines_keep_their_ends() -> None:
    assert visible_lines("a\n\tb\n") == "a\n\tb\n"
    assert visible_lines("a\n\tb\x1b\r\n") == "a\n\tb\ufffd\ufffd\n"
