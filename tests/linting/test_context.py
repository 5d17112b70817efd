"""Rules look only at curves that are not ordinary: they find the same as if they looked at all."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from mudline.deck.loading import load_bytes
from mudline.diagnostics import Problem
from mudline.linting.registry import rules
from mudline.linting.rule import MOST_POINTS, LintContext

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
@settings(max_examples=150)
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
