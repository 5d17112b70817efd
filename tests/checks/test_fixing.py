"""Fixes: in passes, never for the worse."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations, starmap
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.limits import MOST_PASSES
from mudline.checks import fixing as fixing_module
from mudline.checks.context import LintContext
from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.fixing import FixResult, fix_bytes, lint_one, with_severities
from mudline.checks.registry import rules
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.language.rules import Rule
from tests.checks.findings import CLAY, CURVES, PIPE, PROPERTIES
from tests.checks.made_rules import finding, replacing

DECK = f"C A riser\n{PIPE}{PROPERTIES} STIFFNESS=Clay\n*SEABED STIFFNESS\n{CLAY}"
TABS = replacing(r"\t", " ")
Replaced = tuple[str, str, str]
"""Pattern, text and kind of a repair."""


def fix(
    text: str | bytes, *chosen: Rule, fixing: Fixing = Fixing.SAFE, unfixable: frozenset[str] = frozenset()
) -> FixResult:
    data = text if isinstance(text, bytes) else text.encode()
    return fix_bytes(data, "deck.keyxm", LintSettings(chosen, fixing=fixing, unfixable=unfixable))


def changed(text: str, *chosen: Rule, fixing: Fixing = Fixing.SAFE) -> str:
    content = fix(text, *chosen, fixing=fixing).changed
    assert content is not None
    return content.decode()


@pytest.mark.parametrize("end", ["\r\n", "\r", "\n"])
@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp1252"])
def test_untouched_bytes_stay(end: str, encoding: str) -> None:
    text = DECK.replace("A riser", "Ø 219 mm").replace("\n", end)
    result = fix(text.replace(" CURVE", "\tCURVE").encode(encoding), TABS)
    assert result.changed == text.encode(encoding)


def test_fixes_that_overlap_are_made_in_passes() -> None:
    pairs = replacing("aa", "a", code="TST002")
    assert changed(f"C {'a' * 9}\n".replace("C ", "C mudline: x ") + DECK, pairs).startswith("C mudline: x a\n")
    one, other = replacing("0.5, 4000", "0.5, 5000"), replacing("4000.0", "6000.0", code="TST003")
    assert "0.5, 5000.0" in changed(DECK, one, other)


def test_unsafe_fixes_are_made_only_when_asked_for() -> None:
    unsafe = replacing("4000.0", "5000.0", kind="unsafe")
    assert fix(DECK, unsafe).changed is None
    assert changed(DECK, unsafe, fixing=Fixing.UNSAFE) == DECK.replace("4000.0", "5000.0")


def test_what_is_unfixable_or_suppressed_is_left() -> None:
    text = DECK.replace(" CURVE", "\tCURVE")
    assert fix(text, TABS, unfixable=frozenset({"TST001"})).changed is None
    assert fix(text.replace("\tCURVE", "C mudline: ignore\n\tCURVE"), TABS).changed is None


@pytest.mark.parametrize(
    "bad",
    [
        replacing("4000.0", "4O00.0"),  # a new error
        replacing("^C A riser\n", ""),  # a lost comment
        replacing("STIFFNESS=Clay\n", "STIFFNESS=7.0\n*OCEAN\n 1.0, 2.0, 3.0\n"),  # a block more
        replacing(" 0.5, 4000.0", " 0.5, 4000.0\udc80"),  # no text of any encoding
    ],
)
def test_a_fix_that_makes_the_deck_worse_is_dropped_and_the_others_are_made(bad: Rule) -> None:
    good = replacing(r"\t", " ", code="TST009")
    result = fix(DECK.replace(", ", ",\t"), bad, good)
    assert result.changed == DECK.encode()
    assert {one.code for one in result.fixed} == {"TST009"}
    assert "not made" in result.note


def test_of_two_repairs_of_one_place_the_second_is_made_where_the_first_cannot_be() -> None:
    result = fix(DECK, replacing("4000.0", "4O00.0"), replacing("4000.0", "5000.0", code="TST002"))
    assert result.changed == DECK.replace("4000.0", "5000.0").encode()
    assert [one.code for one in result.fixed] == ["TST002"]


@pytest.mark.parametrize(
    ("first", "second", "fixing", "made"),
    [
        # the one that begins first, whatever its text
        (("0.5, 4000.0", "0.5, 6000.0", "safe"), ("4000.0", "+7000.0", "safe"), Fixing.SAFE, "0.5, 6000.0"),
        (("4000.0", "+7000.0", "safe"), ("0.5, 4000.0", "0.5, 6000.0", "safe"), Fixing.SAFE, "0.5, 6000.0"),
        # but a safe one before one that guesses
        (("0.5, 4000.0", "0.5, 6000.0", "unsafe"), ("4000.0", "7000.0", "safe"), Fixing.UNSAFE, "0.5, 7000.0"),
        # both, where one ends as the other begins
        (("0.5, ", "0.6, ", "safe"), ("4000.0", "7000.0", "safe"), Fixing.SAFE, "0.6, 7000.0"),
    ],
)
def test_of_repairs_that_overlap_one_is_made_at_once(
    monkeypatch: pytest.MonkeyPatch, first: Replaced, second: Replaced, fixing: Fixing, made: str
) -> None:
    monkeypatch.setattr(fixing_module, "MOST_TRIES", 1)
    chosen = [
        replacing(old, new, code=f"TST00{index}", kind=kind) for index, (old, new, kind) in enumerate((first, second))
    ]
    result = fix(DECK, *chosen, fixing=fixing)
    assert (result.changed, result.note) == (DECK.replace("0.5, 4000.0", made).encode(), "")


def test_a_repair_that_was_refused_is_made_when_another_has_made_it_possible() -> None:
    use = replacing("STIFFNESS=Clay$", "STIFFNESS=Sand")
    curve = " 0.5, 4001.0\n CURVE=Sand\n 0.0, 0.0\n 0.5, 1000.0"
    define = replacing(" 0.5, 4000.0$", curve, code="TST002", kind="unsafe")
    expected = DECK.replace("STIFFNESS=Clay", "STIFFNESS=Sand").replace(" 0.5, 4000.0", curve)
    assert changed(DECK, use, define, fixing=Fixing.UNSAFE) == expected


def test_errors_of_reading_are_fixed_before_others() -> None:
    text = DECK.replace("STIFFNESS=Clay", "STIFNESS=Clay")
    mend = replacing("STIFNESS", "STIFFNESS", code="SYN004", kind="unsafe", severity=Severity.ERROR)
    drop = replacing("\n STIFNESS=Clay", "\n FRICTION=0.3", kind="unsafe", severity=Severity.ERROR)
    assert changed(text, mend, drop, fixing=Fixing.UNSAFE) == DECK


ROWS = " 0.0, 0.0\n 0.1, 1.0\n 0.2, 2.0\n 0.3, 3.0\n 0.4, 4.0\n"
FOUR = f"{CURVES} CURVE=Clay\n{ROWS}"


def test_bad_repairs_among_good_ones_are_found_by_halving(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four, two and two, each: six tries make good ones of halves with a bad one, and one more both together."""
    bad, good = replacing(r"\b[13]\.0$", "x"), replacing(r"\b([24])\.0$", r"\g<1>.5", code="TST002")
    monkeypatch.setattr(fixing_module, "MOST_TRIES", 8)
    result = fix(FOUR, bad, good)
    assert result.changed == FOUR.replace("2.0\n", "2.5\n").replace("4.0\n", "4.5\n").encode()
    monkeypatch.setattr(fixing_module, "MOST_TRIES", 7)
    assert fix(FOUR, bad, good).changed == FOUR.replace("2.0\n", "2.5\n").encode()


def test_of_repairs_that_are_bad_together_one_is_made() -> None:
    """Either row may be at the ratio 0.25, not both."""
    result = fix(FOUR, replacing(r"0\.2, ", "0.25, "), replacing(r"0\.3, ", "0.25, ", code="TST002"))
    assert result.changed == FOUR.replace("0.2, ", "0.25, ").encode()
    assert [one.code for one in result.fixed] == ["TST001"]
    assert result.note == "1 fix not made: the deck would have had a new error or lost something"


def test_errors_that_were_there_before_keep_nothing_from_being_fixed() -> None:
    text = DECK.replace("STIFFNESS=Clay", "STIFFNESS=Mud").replace(" CURVE", "\tCURVE")
    result = fix(text, TABS)
    assert (result.changed, result.note) == (text.replace("\t", " ").encode(), "")
    other = replacing("STIFFNESS=Mud", "STIFFNESS=Clay\n LATERAL=-1", code="TST002")
    assert fix(text, other).changed is None


@pytest.mark.parametrize(
    ("one", "other", "overlap"),
    [
        ((0, 2), (2, 4), False),
        ((0, 2), (3, 5), False),
        ((0, 3), (2, 4), True),
        ((0, 5), (2, 4), True),
        ((2, 4), (2, 4), True),
        ((2, 2), (0, 2), True),
        ((2, 2), (2, 4), True),
        ((2, 2), (1, 3), True),
        ((2, 2), (2, 2), True),
        ((2, 2), (0, 1), False),
        ((2, 2), (3, 4), False),
        ((2, 2), (3, 3), False),
    ],
)
def test_what_an_insertion_touches_it_overlaps(one: tuple[int, int], other: tuple[int, int], overlap: bool) -> None:
    assert fixing_module._overlap(Span(*one), Span(*other)) is overlap
    assert fixing_module._overlap(Span(*other), Span(*one)) is overlap


SPANS = st.builds(lambda start, length: Span(start, start + length), st.integers(0, 12), st.integers(0, 3))
OF_A_REPAIR = st.lists(SPANS, min_size=1, max_size=2).filter(
    lambda spans: not any(starmap(fixing_module._overlap, combinations(spans, 2)))
)


@given(st.lists(OF_A_REPAIR, max_size=8))
def test_repairs_that_are_made_together_do_not_overlap_and_no_other_fits(edits: list[list[Span]]) -> None:
    name = Code("TST001", "made-tst001", Severity.WARNING)
    problems = [
        Problem(name, "", spans[0], repair=Repair("safe", "", tuple((span, "") for span in spans))) for spans in edits
    ]
    taken: list[Span] = []
    expected = []
    for problem in sorted(problems, key=lambda each: each.span or Span(0, 0)):
        assert problem.repair is not None
        spans = [span for span, _ in problem.repair.edits]
        if not any(fixing_module._overlap(span, other) for span in spans for other in taken):
            taken += spans
            expected.append(problem)
    assert fixing_module._disjoint(problems) == expected


def test_a_safe_fix_moves_no_block_before_others() -> None:
    """Of three curves in blocks of their own the last one comes first: the second is where it was not."""
    mud, sand = (f"*SEABED STIFFNESS\n CURVE={name}\n 0.0, 0.0\n 0.5, 9000.0\n" for name in ("Mud", "Sand"))
    text, start, end = DECK + mud + sand, DECK.index("\n*SEABED STIFFNESS"), len(DECK + mud)
    edits = (Span(start, start), "\n" + sand.rstrip()), (Span(end, end + len(sand)), "")

    def check(_context: LintContext) -> Iterator[Problem]:
        yield Problem(TABS.code, "move this", edits[0][0], repair=Repair("safe", "move it", edits))

    assert load_bytes(text.encode(), "deck.keyxm").problems == []
    assert fix(text, TABS._replace(check=check)).changed is None


@pytest.mark.parametrize("comment", ["C riser", "C A", "C"])
def test_a_comment_may_be_laid_out_anew_and_not_lost(comment: str) -> None:
    text = DECK.replace("C A riser", "C A  riser")
    assert changed(text, replacing("^C A  riser", "C\tA riser")) == DECK.replace("C A", "C\tA")
    assert fix(text, replacing("^C A  riser", comment)).changed is None


def test_a_safe_fix_leaves_the_blocks_that_there_are() -> None:
    swapped = replacing(r"\*SEABED STIFFNESS", "*RIGID SURFACE")
    assert fix(DECK, swapped).changed is None
    renamed = replacing("=Clay$", "=Sand")
    assert fix(DECK, renamed).changed == DECK.replace("Clay", "Sand").encode()


def test_a_file_that_cannot_be_read_is_not_fixed_and_that_is_told() -> None:
    text = DECK.replace("4000.0", "4O00.0").replace(" CURVE", "\tCURVE")
    result = fix(text, TABS)
    assert (result.changed, result.fixed) == (None, ())
    assert "SYN002 in line" in result.note
    assert fix(text.replace("\t", " "), TABS).note == ""


def test_errors_of_reading_may_be_fixed_themselves() -> None:
    text = DECK.replace("STIFFNESS=Clay", "STIFNESS=Clay").replace(" CURVE", "\tCURVE")
    mend = replacing("STIFNESS", "STIFFNESS", code="SYN004", kind="unsafe", severity=Severity.ERROR)
    assert fix(text, mend, TABS).changed is None
    assert changed(text, mend, TABS, fixing=Fixing.UNSAFE) == DECK
    text = text.replace("STIFNESS", "PRICE")
    wrong = replacing("PRICE", "PRICES", code="SYN004", kind="unsafe", severity=Severity.ERROR)
    assert fix(text, wrong, TABS, fixing=Fixing.UNSAFE).changed is None


def test_fixing_ends_where_rules_do_not() -> None:
    result = fix(DECK, replacing("(4000.0*)$", r"\g<1>0"))
    assert result.changed == DECK.replace("4000.0", f"4000.0{'0' * MOST_PASSES}").encode()
    assert result.note == f"fixing was stopped after {MOST_PASSES} passes: run it again to see what is left"


@pytest.mark.untraced
def test_many_bad_fixes_end_soon() -> None:
    rows = "".join(f" {ratio}.0, {ratio}7.0\n" for ratio in range(300))
    result = fix(f"{CURVES} CURVE=Clay\n{rows}", replacing("7.0$", "x"))
    assert result.changed is None
    assert result.note.startswith("300 fixes not made")


def test_unused_suppressions_are_removed() -> None:
    text = DECK.replace(" CURVE=Clay", "C mudline: ignore CRV005\n CURVE=Clay")
    assert changed(text, *rules()) == DECK


def test_a_document_is_linted_and_not_fixed() -> None:
    data = to_json(load_bytes(DECK.encode(), "deck.keyxm")).encode()
    report = lint_one("deck.json", data, LintSettings(rules(), fixing=Fixing.UNSAFE))
    assert (report.changed, report.fixed, report.note) == (None, (), "")


def test_units_folder_and_dialect_reach_the_rules_before_and_after_fixing(tmp_path: Path) -> None:
    name = Code("TST001", "made-tst001", Severity.WARNING)

    def told(context: LintContext) -> Iterator[Problem]:
        message = f"{context.deck.units} {context.deck.folder} {context.dialect}"
        assert context.text is not None
        for match in re.finditer("Clay|sand", context.text.source.unified):
            span = Span(*match.span())
            yield Problem(name, message, span, repair=Repair("safe", "replace", ((span, "sand"),)))

    rule = TABS._replace(check=told)
    settings = LintSettings((rule,), units="imperial", dialect="flexcom", fixing=Fixing.SAFE)
    report = lint_one("deck.keyxm", DECK.encode(), settings, tmp_path)
    assert report.changed == DECK.replace("Clay", "sand").encode()
    messages = {one.message for one in (*report.fixed, *report.found)}
    assert len(report.fixed) == len(report.found) == 2
    assert messages == {f"imperial {tmp_path} flexcom"}


@pytest.mark.parametrize(
    ("given", "above", "below"),
    [
        ({}, "info", "info"),
        ({"TST002": Severity.ERROR}, "error", "error"),
        ({"TST002": Severity.WARNING}, "warning", "warning"),
        ({"TST001": Severity.ERROR}, "error", "info"),
        ({"TST001": Severity.WARNING, "TST002": Severity.ERROR}, "error", "error"),
        ({"TST001": Severity.ERROR, "TST002": Severity.WARNING}, "error", "warning"),
    ],
)
def test_a_finding_is_as_severe_as_the_worst_below_it(given: dict[str, Severity], above: str, below: str) -> None:
    info = Severity.INFO
    following = finding(code="TST002", severity=info), finding(code="TST003", severity=info)
    (one,) = with_severities(
        [finding(code="TST001", severity=info, following=following)], LintSettings((), severities=given)
    )
    assert one.severity.value == above
    assert [each.severity.value for each in one.following] == [below, "info"]


def test_severities_of_findings_below_another_change_under_it() -> None:
    below = finding(code="TST002", severity=Severity.INFO)
    cause = finding(code="TST001", severity=Severity.ERROR, following=(below,))
    (one,) = with_severities([cause], LintSettings((), severities={"TST002": Severity.WARNING}))
    assert (one.severity, one.following[0].severity) == (Severity.ERROR, Severity.WARNING)


def test_passes_that_are_all_made_are_told_while_there_are_tries(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fixing_module, "MOST_TRIES", 2)
    monkeypatch.setattr(fixing_module, "MOST_PASSES", 1)
    result = fix("C mudline: xxx1\n" + DECK, replacing("xxx1", "xx2"), replacing("xx2", "x3", code="TST002"))
    assert result.note == "fixing was stopped after 1 passes: run it again to see what is left"


@pytest.mark.parametrize(
    ("tries", "count", "note"),
    [(1, 1, "fixing was stopped after 1 tries: run"), (2, 2, "fixing was stopped after 2 tries: run"), (3, 3, "")],
)
def test_a_deck_is_read_so_often_and_no_more(
    monkeypatch: pytest.MonkeyPatch, tries: int, count: int, note: str
) -> None:
    monkeypatch.setattr(fixing_module, "MOST_TRIES", tries)
    result = fix(
        "C mudline: xxx1\n" + DECK,
        replacing("xxx1", "xx2"),
        replacing("xx2", "x3"),
        replacing("x3", "4", code="TST003"),
    )
    assert result.changed is not None
    assert result.changed.decode() == f"C mudline: {('xx2', 'x3', '4')[count - 1]}\n{DECK}"
    assert len(result.fixed) == count
    assert result.note.startswith(note)
    assert bool(result.note) == bool(note)


LINES = [*f"{DECK}".split("\n"), "\t1, 2", "C mudline: ignore CRV005", "C mudline: ignore-block X", " CURV=a", "C\t x"]


@given(st.lists(st.sampled_from(LINES), max_size=30), st.sampled_from([Fixing.SAFE, Fixing.UNSAFE]))
def test_fixing_never_fails_and_twice_is_once(lines: list[str], fixing: Fixing) -> None:
    settings = LintSettings((*rules(), TABS), fixing=fixing)
    data = "\n".join(lines).encode()
    once = fix_bytes(data, "deck.keyxm", settings)
    if once.changed is not None:
        assert fix_bytes(once.changed, "deck.keyxm", settings).changed is None


@pytest.mark.parametrize(
    ("written", "slip"),
    [
        (" 1, 1, 2\n", " 1, n 1, 2\n"),  # {n 1} is a label that nothing defines
        (" 0.5, ", " 0.-5, "),  # 0.E-5 is the ratio of the point above
    ],
)
def test_an_unsafe_fix_puts_no_error_in_the_place_of_another(written: str, slip: str) -> None:
    assert written in DECK
    result = fix(DECK.replace(written, slip, 1), *rules(), fixing=Fixing.UNSAFE)
    assert (result.changed, result.fixed) == (None, ())
    assert "not " in result.note
