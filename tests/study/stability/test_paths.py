"""Cells on paths: the judge sees what is wrong by a little in each law, and knows what must be refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest

from mudline.study.exact import ExactCurve, ExactSmoothed
from mudline.study.exact_geometry import ExactPlane, root, sine_and_cosine
from mudline.study.exact_steps import ExactElement
from mudline.study.stability import paths
from mudline.study.stability.families import returning, sliding, through_zone
from mudline.study.stability.judging import Verdict
from mudline.study.stability.paths import PathCell, Place, exact_element, judge_path
from mudline.study.stability.pull_out import SuctionCell, judge_suction
from mudline.study.stability.small_decks import SmallDeck

OFF = 1.0 + 2.0**-45
RUBS = SmallDeck(coefficients=("0.4", "0.7"))
SIDE = SmallDeck(lateral="3000.0")
Change = Callable[[ExactElement], ExactElement]


def friction(**changes: object) -> Change:
    def changed(element: ExactElement) -> ExactElement:
        assert element.friction is not None
        return replace(element, friction=replace(element.friction, **changes))  # type: ignore[arg-type]

    return changed


def wider(element: ExactElement) -> ExactElement:
    assert isinstance(element.law, ExactSmoothed)
    return replace(element, law=replace(element.law, half_width=element.law.half_width * OFF))


def nodal(element: ExactElement) -> ExactElement:
    assert element.nodal is not None
    return replace(element, nodal=replace(element.nodal, stiffness=element.nodal.stiffness * OFF))


@pytest.mark.parametrize(
    ("deck", "path", "change"),
    [
        (RUBS, sliding, friction(coefficients=(0.4 * OFF, 0.7))),
        (RUBS, sliding, friction(springs=(40000.0, 20000.0 * OFF))),
        (replace(RUBS, mobilisation=("0.1", "0.2")), sliding, friction(mobilisation=(0.1, 0.2 * OFF))),
        (replace(RUBS, criterion="ELLIPSE"), sliding, friction(ellipse=False)),
        (replace(RUBS, criterion="ELLIPSE"), sliding, friction(coefficients=(0.4, 0.7 * OFF))),
        (replace(RUBS, angle="30.0"), sliding, friction(angle=30.0 * OFF)),
        (SmallDeck(unloading="250000.0"), returning, lambda one: replace(one, unloading=250000.0 * OFF)),
        (SIDE, lambda _: [(0.01, 0.0, 0.0), (0.01, 0.0, 0.3)], lambda one: replace(one, lateral=3000.0 * OFF)),
        (
            SmallDeck(uplift=("900.0", "0.1")),
            lambda _: [(-0.05, 0.0, 0.0)],
            lambda one: replace(one, uplift=(900.0 * OFF, 0.1)),
        ),
        (SmallDeck(smoothing="0.01"), through_zone, wider),
        (SmallDeck(nodal="4E4"), sliding, nodal),
        (SmallDeck(slope="5.0"), sliding, lambda one: replace(one, plane=ExactPlane(5.0 * OFF, 0.0, (0.0, 0.0, 0.0)))),
        (SmallDeck(), sliding, lambda one: replace(one, length=one.length * Fraction(OFF))),
    ],
)
def test_a_law_that_is_off_by_a_little_is_wrong(
    monkeypatch: pytest.MonkeyPatch, deck: SmallDeck, path: Callable[[SmallDeck], list[Place]], change: Change
) -> None:
    cell = PathCell("off", "1", deck, path(deck))
    assert judge_path(cell).verdict is Verdict.RIGHT
    monkeypatch.setattr(paths, "exact_element", lambda given: change(exact_element(given)))
    judged = judge_path(cell)
    assert judged.verdict is Verdict.WRONG, judged
    assert judged.error > cell.bound


def test_a_deck_without_a_valid_law_that_is_taken_is_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    def none(_: SmallDeck) -> ExactElement:
        raise ValueError("no law")

    monkeypatch.setattr(paths, "exact_element", none)
    judged = judge_path(PathCell("off", "1", RUBS, ()))
    assert (judged.verdict, judged.message) == (Verdict.WRONG, "a deck without a valid law was accepted")


def test_what_is_refused_without_reason_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    cell = PathCell("huge", "1", SmallDeck(stiffness="1E308"), [(1e6, 0.0, 0.0), (1e-9, 0.0, 0.0)])
    assert judge_path(cell).verdict is Verdict.RIGHT_UNTIL_REFUSED
    monkeypatch.setattr(paths, "exact_element", lambda _: exact_element(SmallDeck()))
    judged = judge_path(cell)  # this law has values where the deck has none
    assert (judged.verdict, judged.message) == (Verdict.NO_LINE, "a value that fits a float64 was refused")


def test_explicit_suction_is_pulled_out() -> None:
    cell = SuctionCell(family="own", value="1", force=("800.0", "0.2"), depth=("0.3", "0.25"), cutoff=("0.1", "0.7"))
    assert judge_suction(cell).verdict is Verdict.RIGHT
    assert judge_suction(replace(cell, force=("-800.0", "0.2"))).verdict is Verdict.REFUSED


def test_angles_and_roots_are_exact() -> None:
    assert sine_and_cosine(-270.0) == (Fraction(1), Fraction(0))
    assert sine_and_cosine(1e100)[0] ** 2 + sine_and_cosine(1e100)[1] ** 2 - 1 < Fraction(1, 10**55)
    assert root(Fraction(9, 4)) == Fraction(3, 2)
    assert ExactPlane(30.0, 0.0, (0.0, 0.0, 0.0)).along((Fraction(0),) * 3)[1] > Fraction(43, 50)


def test_the_steepest_segment_so_far_leaves_out_the_one_behind_a_point() -> None:
    law = ExactCurve([(-1.0, -9.0), (0.0, 0.0), (1.0, 1.0), (2.0, 5.0)], 0.5)
    assert [law.steepest(Fraction(ratio)) for ratio in (0.5, 1.0, 1.5, 9.0)] == [2, 2, 8, 8]
