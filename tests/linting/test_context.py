"""What rules see of a deck: odd curves, and blocks that were read before."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from mudline.deck.loading import load_bytes
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem
from mudline.linting.engine import read_deck
from mudline.linting.registry import rules
from mudline.linting.rule import MOST_POINTS, LintContext
from tests.builders.keyword_texts import mutated
from tests.deck.test_round_trips import texts

HEAD = "$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n*SEABED STIFFNESS\n CURVE=Clay\n"
CLAY = [(0.0, 0.0), (0.1, 1200.0), (0.5, 4200.0)]

Points = list[tuple[float, float]]


def context(points: Points) -> LintContext:
    """What rules see of a deck with a curve."""
    rows = "".join(f" {ratio!r}, {force!r}\n" for ratio, force in points)
    return LintContext(load_bytes((HEAD + rows).encode(), "deck.keyxm"))


def found(seen: LintContext) -> list[Problem]:
    return [problem for rule in rules() for problem in rule.check(seen)]


numbers = st.one_of(st.sampled_from([0.0, -0.1, 0.1, 5.0, 6.0, 1200.0, 1.3e5, 1e-300, 1e300]), st.floats(-10, 1e4))


@st.composite
def curves(draw: st.DrawFn) -> Points:
    """A good curve with a point or two changed, or any points."""
    if draw(st.booleans()):
        return draw(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=6))
    points = list(CLAY)
    for _ in range(draw(st.integers(0, 2))):
        place = draw(st.integers(0, len(points)))
        points[place : place + draw(st.integers(0, 1))] = [draw(st.tuples(numbers, numbers))]
    return points


@given(curves())
@example([(5e-324, 0.0), *CLAY])
@settings(max_examples=50)
def test_nothing_is_missed(points: Points) -> None:
    every = context(points)
    every.__dict__["odd_curves"] = list(enumerate(every.scene.laws.curves))
    assert found(context(points)) == found(every)


def test_a_good_curve_is_not_looked_at() -> None:
    assert context(CLAY).odd_curves == []


def test_long_curves_are_left_to_the_rules() -> None:
    long = [(index / 100.0, 10.0 * index) for index in range(MOST_POINTS + 1)]
    assert [number for number, _ in context(long).odd_curves] == [0]
    assert context(long[:-1]).odd_curves == []


# ------------------------------------------------------------------------- a block that was read before, somewhere else


@given(mutated(texts.map(str.encode)), st.integers(0, 3))
@settings(max_examples=30)
def test_a_block_that_stands_elsewhere(data: bytes, lines: int) -> None:
    read_deck(data, "a.keyxm")
    moved = b"C a line more\n" * lines + data
    plain, again = load_bytes(moved, "a.keyxm"), read_deck(moved, "a.keyxm")
    assert again == plain
    assert again.problems == plain.problems
    assert isinstance(plain.origin, TextOrigin)
    assert isinstance(again.origin, TextOrigin)
    assert again.origin.read.keys() == plain.origin.read.keys()
    for place, block in plain.origin.read.items():
        other = again.origin.read[place]
        assert other.places == block.places
        assert (other.problems, other.trailing, other.lost) == (block.problems, block.trailing, block.lost)
