"""The ladder of extremes: nothing silently wrong, every refusal with its line, and a judge that sees what is wrong."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from mudline.diagnostics import DeckError, Diagnostic, Severity
from mudline.study.exact import BOUND, Compared, ExactCurve, ExactLinear, Tally
from mudline.study.stability.families import AnyCell, all_cells, judge, random_cells
from mudline.study.stability.judging import (
    Cell,
    Judgement,
    Verdict,
    curve_deck,
    guarded,
    linear_deck,
    refusal,
)
from mudline.study.stability.paths import PathCell
from mudline.study.stability.pull_out import SUCTION_BOUND, judge_suction, suction_cells

CELLS = all_cells()
FAMILIES = sorted({cell.family for cell in CELLS})
LINEAR = ExactLinear(50000.0, 0.3)


def cell(family: str, value: str) -> AnyCell:
    return next(one for one in CELLS if (one.family, one.value) == (family, value))


@pytest.mark.parametrize("family", FAMILIES)
def test_every_cell_is_right_within_its_bound_or_refused_with_a_line(
    family: str, judged: dict[tuple[str, str], Judgement]
) -> None:
    for one in judged.values():
        if one.family == family:
            assert one.verdict.acceptable, one
            assert one.error <= one.bound
            assert (one.results > 0) is (one.verdict is not Verdict.REFUSED)


def test_the_ladder_reaches_what_it_should() -> None:
    values = {family: [one.value for one in CELLS if one.family == family] for family in FAMILIES}
    for family in ("linear stiffness", "curve stiffness"):
        assert (values[family][0], values[family][-1], len(values[family])) == ("1E-3", "1E15", 19)
    assert values["jump to stiffer"][-1] == values["jump to softer"][-1] == "1E12"
    assert "1E-15" in values["segment width"]
    assert values["ratios up to"][-1] == "1E9"
    assert (values["diameter"][0], values["diameter"][-1]) == ("1E-6", "1E3")
    for family in ("element length", "element length, lateral"):
        assert {"1E-200", "1E200"} <= set(values[family])
    for family in (
        "friction springs",
        "mobilisation lengths",
        "unloading stiffness",
        "lateral spring",
        "nodal stiffness",
    ):
        assert (values[family][0], values[family][-1]) == ("5E-324", "1E308")
    assert "89.99999999999999" in values["slope"]
    assert {"X, Y, Z", "mu", "angle", "slope", "plane", "-1E-400"} <= set(values["negative zero"])


REFUSED_ON_PATHS = {
    ("negative zero", "springs"): "line 18: SBD010",
    ("smoothing, centred", "1E308"): "line 6: RUN001 element 1 at step 0: its force overflows",
    ("nodal smoothing", "1E308"): "line 3: RUN001 node 1 at step 0: the reaction there overflows",
    ("mobilisation lengths", "5E-324"): "line 3: RUN001 node 1: its friction coefficient divided by",
    ("mobilisation lengths", "1E-310"): "line 3: RUN001 node 1",
    ("mobilised coefficients", "1E308"): "line 3: RUN001 node 1",
    ("point of a plane", "1E151"): "line 15: EXT007",
}


def test_nothing_else_is_refused_on_paths(judged: dict[tuple[str, str], Judgement]) -> None:
    paths = {(one.family, one.value) for one in CELLS if isinstance(one, PathCell)}
    refused = {key: one.message for key, one in judged.items() if key in paths and one.verdict is Verdict.REFUSED}
    assert refused.keys() == REFUSED_ON_PATHS.keys()
    for key, message in REFUSED_ON_PATHS.items():
        assert refused[key].startswith(message)


@pytest.mark.parametrize(
    ("family", "value", "message"),
    [
        ("segment width", "1E-17", "line 19: CRV003"),
        ("tiny curve forces", "5E-324", "line 18: CRV011"),
        ("huge linear stiffness", "1E309", "line 14: SYN002"),
        ("huge curve ratios", "1E400", "line 18: SYN002"),
    ],
)
def test_refusals_name_the_line_of_the_number(family: str, value: str, message: str) -> None:
    judged = judge(cell(family, value))
    assert judged.verdict is Verdict.REFUSED
    assert judged.message.startswith(message)


def test_what_overflows_is_refused_and_the_rest_is_right() -> None:
    judged = judge(cell("huge linear stiffness", "1E308"))
    assert judged.verdict is Verdict.RIGHT_UNTIL_REFUSED
    assert judged.message.startswith("line 6: RUN001 element 1")
    assert 0 < judged.results < judge(cell("huge linear stiffness", "1E3")).results


def test_random_decks_are_right_or_refused_and_always_the_same() -> None:
    judged = [judge(one) for one in random_cells(60)]
    assert [one for one in judged if not one.verdict.acceptable] == []
    assert {one.verdict for one in judged} >= {Verdict.RIGHT, Verdict.REFUSED}
    assert [one.text for one in random_cells(9)] == [one.text for one in random_cells(12)[:9]]


@pytest.mark.parametrize("one", suction_cells(), ids=lambda one: f"{one.family} {one.value}")
def test_suction_at_the_ends_of_velocity_and_cohesion(one: object) -> None:
    judged = next(judge_suction(each) for each in suction_cells() if each == one)
    if judged.value == "1E308":  # its stiffness on the release is beyond a float64
        assert (judged.verdict, judged.message[:14]) == (Verdict.REFUSED, "line 6: RUN001")
    elif judged.value == "1E309":
        assert (judged.verdict, judged.message[:15]) == (Verdict.REFUSED, "line 17: SYN002")
    else:
        assert judged.verdict is Verdict.RIGHT, judged
        assert judged.error < SUCTION_BOUND / 4


# ----------------------------------------------------------------------------------------------------- the judge itself


def test_a_law_that_is_off_by_a_little_is_wrong() -> None:
    off = ExactLinear(50000.0 * (1 + 1e-14), 0.3)
    judged = judge(Cell("off", "1", linear_deck("50000.0"), off))
    assert judged.verdict is Verdict.WRONG
    assert "instead of" in judged.message
    assert judged.error > BOUND


def test_a_curve_that_is_off_is_wrong_and_a_huge_one_is_reported_in_words() -> None:
    deck = curve_deck([("0", "0"), ("1", "1000")])
    assert judge(Cell("off", "1", deck, ExactCurve([(0.0, 0.0), (1.0, 1000.000001)], 0.3))).verdict is Verdict.WRONG
    tally = Tally()
    tally.add("it", Compared(1.0, Fraction(10) ** 400, Fraction(10) ** 400))
    assert "a number too large for a float64" in tally.fault


def test_numbers_that_are_none_are_faults() -> None:
    tally = Tally()
    tally.add("it", Compared(float("nan"), Fraction(1), Fraction(1)))
    assert (tally.error, tally.fault) == (float("inf"), "it is nan")
    other = Tally()
    other.add("it", Compared(1.0, Fraction(0), Fraction(0)))
    assert other.error == float("inf")
    minus = Tally()
    minus.add("it", Compared(-0.0, Fraction(0), Fraction(0)))
    assert (minus.error, minus.fault) == (0.0, "it is -0.0")


def test_a_deck_without_a_law_that_is_taken_is_wrong() -> None:
    one = cell("linear stiffness", "1E0")
    assert isinstance(one, Cell)
    judged = judge(replace(one, law=None))
    assert (judged.verdict, judged.message) == (Verdict.WRONG, "a deck without a valid law was accepted")


def test_a_refusal_without_reason_or_line_is_reported() -> None:
    deck = linear_deck("1E308")
    judged = judge(Cell("refused", "1", deck, LINEAR))  # this law has values where the deck has none
    assert (judged.verdict, judged.message) == (Verdict.NO_LINE, "a value that fits a float64 was refused")
    nowhere = DeckError([Diagnostic("deck", "RUN001", "cannot-evaluate", Severity.ERROR, "no", 1, 1, 1, 1)])

    def refuse() -> Judgement:
        raise nowhere

    assert refusal(nowhere) == ""
    assert guarded("a", "1", refuse).verdict is Verdict.NO_LINE
    assert refusal(DeckError([])) == ""


def test_a_warning_of_numpy_and_a_stray_error_are_reported() -> None:
    def divide() -> Judgement:
        np.ones(1) / np.zeros(1)
        return Judgement("a", "1", Verdict.RIGHT)

    def stray() -> Judgement:
        raise KeyError("lost")

    assert guarded("a", "1", divide).verdict is Verdict.WARNED
    assert guarded("a", "1", stray).message == "KeyError: 'lost'"
    assert not Verdict.WARNED.acceptable


def test_exact_curves_hold_the_segment_to_the_right_of_a_point() -> None:
    law = ExactCurve([(0.0, 0.0), (1.0, 2.0), (2.0, 2.0)], 0.5)
    found = [[float(value) for value in law.spring(Fraction(0), Fraction(ratio))[:3]] for ratio in (1.0, 0.5, 3.0)]
    assert found == [[2.0, 0.0, 0.0], [1.0, 2.0, 4.0], [2.0, 0.0, 0.0]]
    assert all(np.isfinite(law.ratios()))
