"""Findings that say the same are one: of rows below each other, of a row, of a name; and what joints say."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mudline.checks import engine
from mudline.checks.context import Joined, LintContext
from mudline.checks.engine import joined_findings
from mudline.language.codes.fields import SYN002, SYN003
from mudline.language.codes.lines import SYN014
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import MORE, Blocks, Code, Problem, Repair, Severity, Span

ROWS = [f" {number}, {number}.5, 7\n" for number in range(1, 10)]
TEXT = "$MODEL\n*NODE\n" + "".join(ROWS)
"""Row n of three fields is line n + 2."""
NAMED = Code("TST001", "made", Severity.WARNING)


def context(text: str = TEXT) -> LintContext:
    return LintContext(load_bytes(text.encode(), "deck.keyxm"))


def at(row: int, message: str = "bad", code: Code = SYN002, *, column: int = 1, **more: object) -> Problem:
    """A problem of one character in a row."""
    start = TEXT.index(ROWS[row - 1]) + column
    return Problem(code, message, Span(start, start + 1), **more)  # type: ignore[arg-type] # fields of a problem


def joined(*problems: Problem) -> list[tuple[int, str, int]]:
    """Row, message and number of those below of every finding."""
    found = joined_findings(context(), list(problems))
    lines = [TEXT.count("\n", 0, one.span.start) - 1 if one.span else 0 for one in found]
    return [(line, one.message, len(one.following)) for line, one in zip(lines, found, strict=True)]


def test_two_rows_stay_apart_and_three_are_one() -> None:
    assert joined(at(1), at(2)) == [(1, "bad", 0), (2, "bad", 0)]
    assert joined(at(1), at(2), at(3)) == [(1, "bad; and 2 more rows of this block (2, 3), the last in line 5", 2)]
    assert joined(at(3), at(1), at(2)) == [(1, "bad; and 2 more rows of this block (2, 3), the last in line 5", 2)]


def test_numbers_of_rows_are_named_while_they_are_few() -> None:
    rows = [at(row) for row in range(1, 7)]
    assert joined(*rows[:5])[0][1].endswith("4 more rows of this block (2, 3, 4, 5), the last in line 7")
    assert joined(*rows)[0][1].endswith("5 more rows of this block, the last in line 8")


def test_rows_that_do_not_follow_each_other_or_say_something_else_are_apart() -> None:
    assert len(joined(at(1), at(2), at(4))) == 3
    assert len(joined(at(1), at(2, "worse"), at(3))) == 3
    # but for numbers, which count the rows
    assert len(joined(at(1, "no 1"), at(2, "no 22"), at(3, "no -3"))) == 1
    both = joined(*[at(row) for row in (1, 2, 3)], *[at(row) for row in (5, 6, 7, 8)])
    assert [(row, below) for row, _, below in both] == [(1, 2), (5, 3)]
    other = joined(at(1), at(2), *[at(row, "worse") for row in (3, 4, 5)])
    assert [(row, below) for row, _, below in other] == [(1, 0), (2, 0), (3, 2)]


def test_the_fields_of_a_row_are_one_where_they_are_three_or_all() -> None:
    assert joined(at(1, column=1), at(1, column=4)) == [(1, "bad", 0), (1, "bad", 0)]
    three = [at(1, column=column) for column in (1, 4, 9)]
    assert joined(*three) == [(1, "bad; and 2 more fields of this row", 2)]
    short = "$MODEL\n*NODE\n 1, 2\n"
    two = [Problem(SYN002, "bad", Span(short.index(each), short.index(each) + 1)) for each in ("1", "2")]
    (one,) = joined_findings(context(short), two)
    assert one.message == "bad; and 1 more field of this row"
    assert joined(*(at(1, "open", SYN014, column=column) for column in (1, 4)))[0][2] == 1


def test_three_fields_of_a_row_of_four_are_one() -> None:
    text = "$MODEL\n*NODE\n 1, 2, 3, 4\n"
    three = [Problem(SYN002, "bad", Span(text.index(each), text.index(each) + 1)) for each in "123"]
    assert [one.message for one in joined_findings(context(text), three)] == ["bad; and 2 more fields of this row"]
    assert len(joined_findings(context(text), three[:2])) == 2


def test_rows_whose_fields_are_joined_too_say_both() -> None:
    fields = [at(row, column=column) for row in (1, 2, 3) for column in (1, 4, 9)]
    assert joined(*fields) == [
        (1, "bad; and 2 more fields of this row and 2 more rows of this block (2, 3), the last in line 5", 8)
    ]


def test_what_is_said_of_a_row_twice_is_one_for_any_code() -> None:
    assert joined(at(1, code=NAMED), at(1, code=NAMED, column=4)) == [(1, "bad; and 1 more field of it", 1)]
    assert len(joined(at(1, code=NAMED), at(2, code=NAMED))) == 2
    assert len(joined(at(1, code=NAMED), at(1, "worse", code=NAMED, column=4))) == 2


def test_uses_of_a_name_that_nothing_defines_are_one_in_any_case_of_letters() -> None:
    uses = [at(row, f"no {name}", NAMED, lacks=name) for row, name in ((4, "CLAY"), (2, "Clay"), (7, "clay"))]
    assert joined(*uses[:2]) == [(2, "no Clay; the same in line 6", 1)]
    assert joined(*uses) == [(2, "no Clay; the same in 2 more lines, the last of them line 9", 2)]
    assert len(joined(uses[0], at(5, "no Sand", NAMED, lacks="Sand"))) == 2


def test_that_there_are_more_is_said_of_no_row() -> None:
    more = Problem(SYN002, MORE, Span(TEXT.index(ROWS[3]), TEXT.index(ROWS[3]) + 1))
    assert [row for row, _, _ in joined(at(1), at(2), at(3), more)] == [1, 4]


def test_a_deck_that_has_no_text_keeps_its_findings() -> None:
    problems = [Problem(SYN002, "bad"), Problem(SYN002, "bad"), Problem(SYN002, "bad")]
    assert joined_findings(LintContext(Deck("made by a program")), problems) == problems


# ------------------------------------------------------------------------------------------------------ one of several


def repair(*texts: str) -> Repair:
    return Repair("safe", "mend", tuple((Span(ord(text[0]), ord(text[0]) + 1), text) for text in texts))


def test_a_finding_is_as_bad_as_those_below_it() -> None:
    info, warning, error = (at(row, severity=each) for row, each in enumerate(Severity, 1))
    for cause, others, expected in (
        (info, [info], (Severity.INFO, Blocks.NEVER)),
        (info, [warning], (Severity.WARNING, Blocks.NEVER)),
        (warning, [info], (Severity.WARNING, Blocks.NEVER)),
        (info, [warning, error], (Severity.ERROR, Blocks.ALWAYS)),
        (info, [at(1, severity=Severity.INFO, blocks=Blocks.WITH_TENSION)], (Severity.INFO, Blocks.WITH_TENSION)),
        (info, [at(1, severity=Severity.WARNING, blocks=Blocks.ALWAYS)], (Severity.ERROR, Blocks.ALWAYS)),
        (warning, [at(1, severity=Severity.ERROR, blocks=Blocks.NEVER)], (Severity.ERROR, Blocks.NEVER)),
    ):
        found = engine._joined(cause, others, "words")
        assert (found.weight, found.blocking) == expected
        assert found.following == tuple(others)
        assert found.message == "bad; words"


def test_how_many_are_left_out_is_said_where_a_joint_has_no_words() -> None:
    assert engine._joined(at(1), [at(2)], "").message == "bad; 1 finding that follows from it is left out"
    assert engine._joined(at(1), [at(2)] * 2, "").message == "bad; 2 findings that follow from it are left out"


def test_what_was_below_those_below_is_beside_them() -> None:
    inner = engine._joined(at(3), [at(4)], "x")
    found = engine._joined(engine._joined(at(1), [at(2)], "x"), [inner], "y")
    assert [(one.span, one.following) for one in found.following] == [(at(row).span, ()) for row in (2, 3, 4)]


def test_the_repair_of_findings_that_say_the_same_mends_all_of_them() -> None:
    other = replace(repair("a", "c"), message="mend too")
    one, two, bare = at(1, repair=repair("b", "c")), at(2, repair=other), at(3)
    mended = engine._joined(one, [two], "x").repair
    assert mended is not None
    assert [text for _, text in mended.edits] == ["a", "b", "c"]
    assert (mended.applicability, mended.message) == ("safe", "mend")
    assert engine._joined(one, [two, bare], "x").repair is None
    assert engine._joined(bare, [one], "x").repair is None
    # what follows from a finding of another kind goes with it
    assert engine._joined(one, [at(2, code=SYN003)], "x").repair == one.repair
    assert engine._joined(one, [at(2, code=SYN003, repair=repair("a"))], "x").repair == one.repair


def test_a_joint_may_say_it_in_other_words_at_another_place(monkeypatch: pytest.MonkeyPatch) -> None:
    cause, other, apart = at(1, "cause", NAMED), at(4, "other"), at(7, "apart")
    place = at(9).span
    joint = Joined(cause, [other], "words", "both", place)
    monkeypatch.setattr(engine, "JOINTS", [(frozenset({"TST001"}), lambda *_: iter([joint]))])
    assert joined(cause, other, apart) == [(9, "both; words", 1), (7, "apart", 0)]
    monkeypatch.setattr(engine, "JOINTS", [(frozenset({"TST001"}), lambda *_: iter([Joined(cause, [other])]))])
    assert joined(cause, other) == [(1, "cause; 1 finding that follows from it is left out", 1)]
    # none for a deck without its codes, of nothing, and of what is below another already
    monkeypatch.setattr(engine, "JOINTS", [(frozenset({"TST002"}), lambda *_: iter([joint]))])
    assert len(joined(cause, other)) == 2
    monkeypatch.setattr(engine, "JOINTS", [(frozenset({"TST001"}), lambda *_: iter([Joined(cause, [])]))])
    assert joined(cause, other) == [(1, "cause", 0), (4, "other", 0)]
    below = [Joined(cause, [other], "a"), Joined(other, [apart], "b"), Joined(cause, [apart], "c")]
    monkeypatch.setattr(engine, "JOINTS", [(frozenset({"TST001"}), lambda *_: iter(below))])
    assert joined(cause, other, apart) == [(1, "cause; a; c", 2)]
