"""Decks for the study: a short pipe of 170 kg/m on a seabed, with a time step of 50 ms."""

from __future__ import annotations

MASS = 7850.0 * 3.141592653589793 / 4.0 * (0.3**2 - 0.25**2)
"""Of the pipe, per unit length."""

_MODEL = """\
$MODEL
*OCEAN
 1000.0, 1025.0, 9.81
*NODE
  1, -0.010,   0.0, 0.0
 11, -0.010,  20.0, 0.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=Clay
 GEN=1, 7
 SET=Sand
 GEN=8, 10
"""
_SECTION = """\
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.25, 7850.0
"""
_TIME = """\
$LOAD CASE
*TIME
 STEP=FIXED
 0.0, 120.0, 0.05, 24.0
"""
CURVE = """\
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=Crust
*SEABED STIFFNESS
 CURVE=Crust
 0.00, {first}
 0.10, 2000.0
 0.50, 9000.0
"""
EVERYTHING = """\
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Clay
 STIFFNESS=Soft Clay
 FRICTION=0.35, 0.60, 0.003, 0.150
 SET=Sand
 STIFFNESS=50.0E3
 FRICTION=0.50, 0.70, 0.003, 0.150
*SEABED STIFFNESS
 CURVE=Soft Clay
 0.00,    0.0
 0.01,  450.0
 0.02,  640.0
 0.05, 1030.0
 0.10, 1480.0
 0.50, 2450.0
*SEABED CONTACT
 SET=Sand
 SMOOTHING=AUTO
*SEABED SUCTION
 SET=Clay
 COHESION=5.0E3
"""
SPRINGS = """\
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Clay
 STIFFNESS=Soft Clay
 SUCTION=15000.0, 0.05
 LATERAL=3000.0
 SET=Sand
 STIFFNESS=50.0E3
*SEABED STIFFNESS
 CURVE=Soft Clay
 0.0,    0.0
 0.1, 1480.0
 0.5, 2450.0
*SEABED UNLOADING
 SET=Clay
 STIFFNESS=500000.0
*SEABED CONTACT
 SET=Sand
 NODAL STIFFNESS=20.0E3
 SMOOTHING=0.002
"""
LINEAR = """\
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50.0E3
"""


def deck(seabed: str = LINEAR, *, time: bool = True, mass: bool = True) -> str:
    """The text of a deck with these lines of its seabed, with or without a time step and sections."""
    return (
        _MODEL + (_SECTION if mass else "") + seabed + (_TIME if time else "$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n")
    )


def line_of(text: str, start: str) -> int:
    """Number of the first line that begins like this."""
    return next(number for number, line in enumerate(text.splitlines(), start=1) if line.strip().startswith(start))


class Ticking:
    """A clock that goes on by a millisecond whenever it is asked."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 1e-3
        return self.now
