"""Faults of soil curves and survey tables."""

from __future__ import annotations

from tests.faults.draft import Draft, Row, plain
from tests.faults.kind import Group, scale

CURVES = Group("curves and survey tables")
curve = CURVES.kind


def _middle(draft: Draft) -> Row:
    return draft.curve()[3]


@curve("CRV009")
def columns_exchanged(draft: Draft) -> None:
    """Force first, then ratio, as in `*P-Y`. Seen at any point or at the curve's first line."""
    points = draft.curve()
    draft.needs(all(draft.value(row, 1) > 10.0 for row in points[1:]))
    for row in points[1:]:
        draft.exchange(row, 0, 1)
    draft.mark(points[0], draft.keyed_above(points[0]))


@curve("CRV005")
def forces_in_falling_order(draft: Draft) -> None:
    """The column of forces sorted from large to small, the ratios not. Seen at any point."""
    points = draft.curve()
    forces = [draft.field(row, 1) for row in points]
    for row, force in zip(points, reversed(forces), strict=True):
        draft.write(row, f"{draft.field(row, 0)}, {force}")


@curve("CRV003")
def ratio_twice(draft: Draft) -> None:
    """A ratio typed twice, with two forces."""
    points = draft.curve()
    draft.put(points[3], 0, draft.field(points[2], 0))


@curve("CRV004")
def point_twice(draft: Draft) -> None:
    """A point pasted twice."""
    row = _middle(draft)
    draft.insert(row, row.text)


@curve("CRV001")
def single_point(draft: Draft) -> None:
    """All points of a curve but one deleted. Seen at the curve's first line."""
    points = draft.curve()
    draft.remove(points[1:])
    draft.mark(draft.keyed_above(points[0]), points[0])


@curve("CRV001")
def no_points(draft: Draft) -> None:
    """A curve without points. Seen at the curve's first line."""
    points = draft.curve()
    head = draft.keyed_above(points[0])
    draft.remove(points)
    draft.mark(head)


@curve("CRV007")
def force_at_zero(draft: Draft) -> None:
    """The first point shifted: a force where the pipe only touches. Seen there or at the curve's first line."""
    points = draft.curve()
    draft.put(points[0], 1, plain(draft.value(points[1], 1) * 0.6))
    draft.mark(draft.keyed_above(points[0]))


@curve("CRV007")
def zero_point_left_out(draft: Draft) -> None:
    """The point (0, 0) left out. Seen at the first point or the curve's first line."""
    points = draft.curve()
    draft.mark(draft.keyed_above(points[0]), points[1])
    draft.remove([points[0]])


@curve("CRV006", "CRV012")
def ratios_negative(draft: Draft) -> None:
    """Depths below the mudline negative, as a survey has them. Seen at any point or the curve's first line."""
    points = draft.curve()
    for row in points[1:]:
        draft.put(row, 0, f"-{draft.field(row, 0)}")
    draft.mark(draft.keyed_above(points[0]))


@curve("CRV012")
def forces_negative(draft: Draft) -> None:
    """Forces with the sign of the reaction on the soil. Seen at any point or the curve's first line."""
    points = draft.curve()
    for row in points[1:]:
        draft.put(row, 1, f"-{draft.field(row, 1)}")
    draft.mark(draft.keyed_above(points[0]))


@curve("CRV012", "CRV005")
def one_force_negative(draft: Draft) -> None:
    """A minus before one force. Seen there, or at the point behind."""
    row = _middle(draft)
    draft.put(row, 1, f"-{draft.field(row, 1)}")
    draft.mark(draft.curve()[4])


CURVES.row("force-lost-a-digit", "CRV005", "A force a tenth of what it should be.", scale(_middle, 1, 0.1))


@curve("CRV005")
def force_gained_a_digit(draft: Draft) -> None:
    """A force ten times what it should be. Seen there, or at the point behind, where it falls."""
    points = draft.curve()
    draft.scale(points[3], 1, 10.0)
    draft.mark(points[4])


@curve("CRV008")
def last_force_gained_digits(draft: Draft) -> None:
    """The last force a thousand times too large: it drives every deeper embedment."""
    points = draft.curve()
    draft.scale(points[-1], 1, 1000.0)
    draft.mark(points[-2])


@curve("CRV013")
def plateau_at_the_end(draft: Draft) -> None:
    """The last force repeated: no stiffness below. Seen at one of the last two points."""
    points = draft.curve()
    draft.put(points[-1], 1, draft.field(points[-2], 1))
    draft.mark(points[-2])


@curve("CRV005", "CRV010")
def ratio_without_point(draft: Draft) -> None:
    """A ratio of 10 for 0.10. Seen there, or where the force now falls, or at the curve's first line."""
    points = draft.curve()
    draft.put(points[3], 0, "10.0")
    draft.mark(points[-1], draft.keyed_above(points[0]))


@curve("CRV005", "CRV002")
def points_in_wrong_order(draft: Draft) -> None:
    """Two ratios exchanged, the forces not. Seen at one of the two points, or behind."""
    points = draft.curve()
    one, other = (draft.fields(points[i]) for i in (3, 4))
    draft.write(points[3], f"{other[0]}, {one[1]}")
    draft.write(points[4], f"{one[0]}, {other[1]}")


@curve("SBD017")
def curve_called_a_number(draft: Draft) -> None:
    """A curve named by its strength, so that STIFFNESS= is a number. Seen at the curve or at STIFFNESS=."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    name = row.text.partition("=")[2]
    head = next((each for each in draft.settings("*SEABED STIFFNESS", "CURVE") if each.text[7:] == name), None)
    draft.needs(head)
    if head:
        draft.write(head, "CURVE=1200")
        draft.write(row, "STIFFNESS=1200")
