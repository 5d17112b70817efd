"""Comments that hide findings."""

from __future__ import annotations

import pytest

from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import fix_bytes
from mudline.checks.registry import select
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.forms.yaml import to_yaml
from mudline.language.deck.loading import load_bytes
from tests.checks.findings import CURVES, found

FALLING = f"{CURVES} CURVE=Clay\n 0.0, 0.0\n 0.1, 1200.0\n 0.5, 900.0\n 1.0, 2000.0\n"
"""A CRV005 at 6:2 and a REF003 at 3:8."""
CODES = ("CRV005", "REF003", "STY010")


def codes(text: str, *chosen: str) -> list[str]:
    return [code for code, _, _ in found(text, *(chosen or CODES))]


def before(line: str, comment: str) -> str:
    assert line in FALLING
    return FALLING.replace(line, f"{comment}\n{line}")


@pytest.mark.parametrize(
    "comment",
    [
        "C mudline: ignore CRV005",
        "C mudline: ignore crv005",
        "C mudline: ignore decreasing-force",
        "C mudline: ignore CRV",
        "C mudline: ignore",
        "c  MudLine :Ignore  CRV005 -- remoulded, see REF003",
        "C mudline: ignore -- as measured",
        "C mudline: ignore CRV005\n\nC another comment",
    ],
)
def test_the_next_line(comment: str) -> None:
    assert codes(before(" 0.5, 900.0", comment)) == ["REF003"]


def test_several_codes_by_comma_or_blank() -> None:
    both = FALLING.replace(" CURVE", "C mudline: ignore-block CRV005 ,unused-curve\n CURVE")
    assert codes(both) == []
    assert codes(both.replace(" ,", " ")) == []


def test_a_comment_holds_for_one_line_only() -> None:
    assert codes(before(" 0.1, 1200.0", "C mudline: ignore CRV005")) == ["REF003", "STY010", "CRV005"]


def test_the_block_that_a_comment_stands_in() -> None:
    other = f"*SEABED STIFFNESS\n{FALLING.removeprefix(CURVES).replace('Clay', 'Sand')}"
    inside = before(" 1.0, 2000.0", "C mudline: ignore-block CRV005, REF003") + other
    assert [line for _, line, _ in found(inside, *CODES)] == [10, 13]
    assert codes(before("*SEABED", "C mudline: ignore-block CRV005")) == ["STY010", "REF003", "CRV005"]


@pytest.mark.parametrize("place", ["$MODEL", "*SEABED", " 1.0, 2000.0"])
def test_the_whole_file(place: str) -> None:
    assert codes(before(place, "C mudline: ignore-file CRV005, REF003")) == []
    assert codes(FALLING + "C mudline: ignore-file") == []


def test_errors_of_reading_can_be_hidden_and_the_scene_stays() -> None:
    text = FALLING.replace("900.0", "9OO.0")
    hidden = text.replace(" 0.5", "C mudline: ignore SYN002\n 0.5")
    assert codes(text, "SYN", "CRV") == ["SYN002"]
    assert codes(hidden, "SYN", "CRV") == []


def test_what_hides_nothing_is_told_at_the_word() -> None:
    text = before(" 0.5, 900.0", "C mudline: ignore CRV005, CRV001, CRV003")
    assert found(text, *CODES) == [("REF003", 3, 8)]
    assert found(text, "CRV", "STY010") == [("STY010", 6, 27), ("STY010", 6, 35)]
    (one, two) = lint_bytes(text.encode(), "deck.keyxm", select(["CRV", "STY010"]))
    assert one.message == "CRV001 is not found in the next line: remove it from this comment"
    assert [fix.edits[0].start for fix in (one.fix, two.fix) if fix] == [(6, 27), (6, 33)]


def test_only_rules_that_run_are_judged() -> None:
    text = before(" 0.1, 1200.0", "C mudline: ignore CRV005")
    assert codes(text, "STY010") == []
    assert codes(text, "CRV005") == ["CRV005"]
    assert codes(before(" 0.1, 1200.0", "C mudline: ignore"), "STY010", "CRV005") == ["CRV005"]
    assert "STY010" in [code for code, _, _ in found(before(" 0.1, 1200.0", "C mudline: ignore"))]


def test_words_that_name_no_rule_are_told_with_what_was_meant() -> None:
    text = before(" 0.5, 900.0", "C mudline: ignore CRV0O5, decreasing-forces, xyz")
    told = lint_bytes(text.encode(), "deck.keyxm", select(["STY010"]))
    assert [one.message for one in told] == [
        "'CRV0O5' names no rule: did you mean CRV005?",
        "'decreasing-forces' names no rule: did you mean decreasing-force?",
        "'xyz' names no rule: `mudline rules` lists all rules; remove it",
    ]
    assert [one.fix and one.fix.applicability for one in told] == ["unsafe"] * 3


def test_a_misspelt_suppression_is_never_safely_removed() -> None:
    text = before(" 0.5, 900.0", "C mudline: ignore CRV0O5\nC mudline: ignore-block decreasing-forces, CRV001")
    data, name = text.encode(), "deck.keyxm"
    safe = fix_bytes(data, name, LintSettings(select(["STY010", "CRV"]), fixing=Fixing.SAFE)).changed
    assert safe == data.replace(b", CRV001", b"")
    near = fix_bytes(data, name, LintSettings(select(["STY010"]), fixing=Fixing.UNSAFE)).changed
    assert near == data.replace(b"CRV0O5", b"CRV005").replace(b"forces", b"force")


def test_a_misspelt_instruction_is_told_and_prose_is_not() -> None:
    assert found(before(" 0.5, 900.0", "C mudline: ignroe CRV005"), "STY010") == [("STY010", 6, 12)]
    assert found(before(" 0.5, 900.0", "C mudline: checked by hand"), "STY010") == []
    assert found(before(" 0.5, 900.0", "C mudline: ="), "STY010") == []


def test_the_report_of_unused_comments_can_be_hidden_by_name_only() -> None:
    unused = before(" 0.1, 1200.0", "C mudline: ignore CRV005")
    assert codes(unused.replace("$MODEL", "C mudline: ignore-file STY010\n$MODEL")) == ["REF003", "CRV005"]
    assert "STY010" in codes(unused.replace("$MODEL", "C mudline: ignore-file\n$MODEL"))


@pytest.mark.parametrize("form", ["json", "yaml"])
@pytest.mark.parametrize(
    ("line", "comment", "left"),
    [
        (" 0.5, 900.0", "ignore CRV005", ["REF003"]),
        (" CURVE", "ignore REF003", ["CRV005"]),
        (" 0.1, 1200.0", "ignore-block", []),
        ("$MODEL", "ignore-file CRV005", ["REF003"]),
        (" CURVE", "ignore CRV005", ["STY010", "CRV005", "REF003"]),
    ],
)
def test_documents_hide_what_their_keyword_text_would(form: str, line: str, comment: str, left: list[str]) -> None:
    deck = load_bytes(before(line, f"C mudline: {comment}").encode(), "deck.keyxm")
    text = to_json(deck) if form == "json" else to_yaml(deck)
    told = lint_bytes(text.encode(), f"deck.{form}", select(list(CODES)))
    assert sorted(one.code for one in told) == sorted(left)
    assert all(one.fix is None for one in told)


def test_a_document_that_keyword_text_cannot_say_hides_nothing() -> None:
    deck = load_bytes(before(" 0.5, 900.0", "C mudline: ignore").encode(), "deck.keyxm")
    text = to_json(deck).replace('"Clay"', '"Clay, soft"')
    told = lint_bytes(text.encode(), "deck.json", select(["CRV005"]))
    assert [one.code for one in told] == ["CRV005"]
