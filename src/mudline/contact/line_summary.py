"""What a line does at a step: where it touches down, how much of it lies on the seabed, and what carries it there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from mudline.quantities import finite


class TouchdownPoint(NamedTuple):
    """A point of a line where the gap of its nodes changes sign, found between two of them by interpolation.

    `contact` says on which side, in the direction of arc length, the line lies on the seabed.
    """

    arc_length: float
    x: float
    y: float
    z: float
    contact: Literal["after", "before"]


class ElementForce(NamedTuple):
    """A force per unit length, and the element that has it: its number, and arc length and place of its middle."""

    force: float
    element: int
    arc_length: float
    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class LineSummary:
    """A line at a step.

    Attributes:
        time: of the step; None for a single state without a time.
        line: its number, from 1; first_element, last_element: the ends of it; length: all of it.
        touchdown: the points where it leaves the seabed or comes down on it, along the line.
        contact_length: how much of it lies below the seabed, between the touchdown points.
        largest_force: where the seabed pushes most; None where it does not push.
        largest_uplift: where the seabed pulls most, by suction or a curve; its force is negative. None without a pull.
        reaction: total normal force on its nodes; a node of several lines counts for the first of them.
        submerged_weight: of its elements in contact with a law that carries; None where it is not known.
        ratio: reaction / submerged weight; None where that is not above 0.
    """

    time: float | None
    line: int
    first_element: int
    last_element: int
    length: float
    touchdown: tuple[TouchdownPoint, ...]
    contact_length: float
    largest_force: ElementForce | None
    largest_uplift: ElementForce | None
    reaction: float | None
    submerged_weight: float | None
    ratio: float | None

    def row(self) -> dict[str, object]:
        """The line as JSON has it."""
        found: dict[str, object] = {name: _bounded(getattr(self, name)) for name in self.__slots__}
        return found | {"touchdown": [_bounded(point) for point in self.touchdown]}


def _bounded(value: object) -> object:
    """A value as JSON can hold it: None for what overflowed."""
    if isinstance(value, TouchdownPoint | ElementForce):
        return {name: _bounded(each) for name, each in value._asdict().items()}
    return finite(value) if isinstance(value, float) else value
