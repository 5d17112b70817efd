"""Decks of one element, as text: every number is written as given, so that any can be set to an extreme value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

Pairs = Sequence[tuple[str, str]]
"""Numbers two by two, as a deck has them."""
Pair = tuple[str, str]

DIAMETER = "0.3"
LENGTH = "2.0"


@dataclass(frozen=True, slots=True, kw_only=True)
class SmallDeck:
    """The element along +Y of a deck and its seabed, as texts; an empty text is not in the deck.

    Attributes:
        height: X of both nodes. across: Z of both nodes. start: Y of the first node. length: Y of the second.
        diameter: external; the wall is a quarter of it.
        stiffness: linear, per unit length; not used with a curve or a nodal stiffness.
        curve: embedment ratios and forces.
        nodal: stiffness of the nodes.
        smoothing: half width of the quadratic zone. form: CENTRED or ONE-SIDED.
        unloading: stiffness of the unloading line.
        coefficients, springs: of friction, along and across. criterion: BOX or ELLIPSE. angle: of u1 to +Y.
        mobilisation: lengths along and across, in place of springs.
        lateral: spring to the side. uplift: stiffness and extent of the spring against uplift.
        suction: rows of `*SEABED SUCTION` for the set.
        slope, direction: of a plane through `point`, or through the origin.
    """

    height: str = "-0.05"
    across: str = "0.0"
    start: str = "0.0"
    length: str = LENGTH
    diameter: str = DIAMETER
    stiffness: str = "50000.0"
    curve: Pairs = ()
    nodal: str = ""
    smoothing: str = ""
    form: str = "CENTRED"
    unloading: str = ""
    coefficients: Pair | None = None
    springs: Pair = ("40000.0", "20000.0")
    criterion: str = "BOX"
    angle: str = ""
    mobilisation: Pair | None = None
    lateral: str = ""
    uplift: Pair | None = None
    suction: tuple[str, ...] = ()
    slope: str = ""
    direction: str = "0.0"
    point: tuple[str, str, str] | None = None

    @property
    def text(self) -> str:
        """The deck."""
        return "\n".join(self._lines()) + "\n"

    def _lines(self) -> Iterator[str]:
        yield from ("$MODEL", "*NODE")
        yield f" 1, {self.height}, {self.start}, {self.across}"
        yield f" 2, {self.height}, {self.length}, {self.across}"
        yield from ("*ELEMENT", " 1, 1, 2", "*GEOMETRIC SETS", " OPTION=RIGID", " SET=ALL")
        yield f" 207.0E9, 79.6E9, {self.diameter}, {0.5 * float(self.diameter)!r}, 7850.0"
        yield from ("*SEABED PROPERTIES", " TYPE=ELASTIC", " SET=ALL")
        yield f" STIFFNESS={'Extreme' if self.curve else self.stiffness}"
        if self.mobilisation is not None and self.coefficients is not None:
            yield f" FRICTION={', '.join((*self.coefficients, *self.mobilisation))}"
        if self.lateral:
            yield f" LATERAL={self.lateral}"
        if self.uplift is not None:
            yield f" SUCTION={', '.join(self.uplift)}"
        if self.curve:
            yield from ("*SEABED STIFFNESS", " CURVE=Extreme", *(f" {ratio}, {force}" for ratio, force in self.curve))
        yield from self._seabed()
        yield from self._extensions()

    def _seabed(self) -> Iterator[str]:
        if self.point is not None:
            yield from ("*SEABED PLANES", " PLANE=Only", f" POINT={', '.join(self.point)}")
            yield f" SLOPE={self.slope or '0.0'}, DIRECTION={self.direction}"
        elif self.slope:
            yield from ("*SEABED PROFILE", " TYPE=SLOPING", f" DIRECTION={self.direction}", f" SLOPE={self.slope}")

    def _extensions(self) -> Iterator[str]:
        if self.nodal or self.smoothing:
            yield from ("*SEABED CONTACT", " SET=ALL")
            if self.nodal:
                yield f" NODAL STIFFNESS={self.nodal}"
            yield from (f" SMOOTHING={self.smoothing or 'NONE'}", f" FORM={self.form}")
        if self.unloading:
            yield from ("*SEABED UNLOADING", " SET=ALL", f" STIFFNESS={self.unloading}")
        if self.suction:
            yield from ("*SEABED SUCTION", " SET=ALL", *(f" {row}" for row in self.suction))
        if self.coefficients is not None and self.mobilisation is None:
            yield from ("*SEABED FRICTION", " SET=ALL", f" COEFFICIENTS={', '.join(self.coefficients)}")
            yield f" STIFFNESS={', '.join(self.springs)}"
            yield from (f" DIRECTIONS={self.angle or 'AXIAL'}", f" CRITERION={self.criterion}")
