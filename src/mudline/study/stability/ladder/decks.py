"""The decks of the ladder: one element of 2 m on a seabed."""

from __future__ import annotations

from collections.abc import Sequence

Pairs = Sequence[tuple[str, str]]

DIAMETER = "0.3"
LENGTH = 2.0

_LINE = """\
$MODEL
*NODE
 1, -0.05, 0.0, 0.0
 2, -0.05, 2.0, 0.0
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, {diameter}, {inner}, 7850.0
"""
_SUCTION = """\
*SEABED SUCTION
 SET=ALL
 COHESION={cohesion}
"""


def linear_deck(stiffness: str, diameter: str = DIAMETER) -> str:
    """A linear seabed."""
    return _line(diameter) + _on(stiffness)


def curve_deck(points: Pairs, diameter: str = DIAMETER) -> str:
    """A force-embedment curve; numbers as they are to stand in the deck."""
    rows = "".join(f" {ratio}, {force}\n" for ratio, force in points)
    return _line(diameter) + _on("Extreme") + "*SEABED STIFFNESS\n CURVE=Extreme\n" + rows


def suction_deck(cohesion: str) -> str:
    """A linear seabed with suction."""
    return linear_deck("50000.0") + _SUCTION.format(cohesion=cohesion)


def _line(diameter: str) -> str:
    """A pipe of half the diameter inside."""
    return _LINE.format(diameter=diameter, inner=repr(0.5 * float(diameter)))


def _on(stiffness: str) -> str:
    return f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={stiffness}\n"
