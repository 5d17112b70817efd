"""Decks of contact, of one line in steps of 10 m below the bed, and the same decks in feet and pounds."""

from __future__ import annotations

from dataclasses import dataclass

FOOT = 0.3048
POUND = 4.4482216152605


@dataclass(frozen=True)
class Units:
    """Turns SI values into those of a deck; the mass unit is force s^2 / length."""

    length: float = 1.0
    force: float = 1.0
    suffix: str = "keyxm"

    def value(self, number: float, length: int = 0, force: int = 0) -> str:
        """The text of a number of dimension length^i force^j."""
        return repr(number / (self.length**length * self.force**force))


METRIC = Units()
IMPERIAL = Units(FOOT, POUND, "keyxi")


def deck(units: Units, seabed: str, span: float = 100.0) -> str:
    """A line of ten elements over a span in m, five of them left and five right, in water; then `seabed`."""
    u = units.value
    nodes = "".join(f" {i + 1}, {u(-0.05, 1)}, {u(span * i / 10, 1)}\n" for i in range(11))
    return f"""\
$MODEL
*NODE
{nodes}*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=Left
 GEN=1, 5
 SET=Right
 GEN=6, 10
*OCEAN
 {u(500.0, 1)}, {u(1025.0, -4, 1)}, {u(9.81, 1)}
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 {u(207.0e9, -2, 1)}, {u(79.6e9, -2, 1)}, {u(0.25, 1)}, {u(0.22, 1)}, {u(7850.0, -4, 1)}
{seabed}"""


def everything(units: Units) -> str:
    """All that a bed can have, in one deck: a line of which each half has features of its own."""
    u = units.value
    return f"""\
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.2, {u(900.0, -1, 1)}
 0.5, {u(4000.0, -1, 1)}
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS={u(40000.0, -2, 1)}
 SET=Left
 STIFFNESS=Clay
 FRICTION=0.3, 0.5
 LATERAL={u(1000.0, -2, 1)}
*SEABED CONTACT
 SET=ALL
 SMOOTHING=AUTO
 SET=Right
 NODAL STIFFNESS={u(90000.0, -1, 1)}
*SEABED SUCTION
 SET=Left
 COHESION={u(5000.0, -2, 1)}
 SET=Right
 FORCE={u(300.0 * units.length**0.2, -1, 1)}, 0.2
 DEPTH={u(0.3 * units.length**0.3, 1)}, 0.3
*SEABED UNLOADING
 SET=Left
 STIFFNESS={u(500000.0, -2, 1)}
*SEABED FRICTION
 SET=Right
 COEFFICIENTS=0.2, 0.4
 STIFFNESS={u(20000.0, -1, 1)}
*SEABED TRENCH
 SET=Right
 GEOMETRY={u(0.5, 1)}, {u(0.01, 1)}, {u(1.0, 1)}
 PEAK={u(2000.0, -1, 1)}
*SEABED PLANES
 PLANE=one
 POINT={u(0.01, 1)}, 0.0, 0.0
 SLOPE=0.02
"""
