"""Deck texts: a small one whose figures can be worked out by hand, with its variants; lines of pipe; beds; studies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


def _text(name: str) -> str:
    """A deck of the folder beside this file."""
    return Path(__file__).with_name("texts").joinpath(name).read_text(encoding="utf-8")


# ---------------------------------------------------------------------------------------------- two elements, by hand

CLEAN = _text("clean.keyxm")
"""Element 1 lies 0.1 deep: ratio 0.2, force 1500 per length over 10; element 2 is 0.1 above the bed."""

CLEAN_WARNING = (
    "mudline: warning: deck.keyxm:1: RUN003 the positions are the deck's own, far from equilibrium: total reaction "
    "15000 N on 1 element in contact, their submerged weight 3481.78 N, ratio 4.31; give a solved shape with "
    "--positions, or try --rest-shape\n"
)
"""What evaluating it as deck.keyxm warns of: the steel weighs 2322.52 N/m and displaces water of 1974.34 N/m."""

STEPS_WARNING = (
    "mudline: warning: deck.keyxm:1: RUN003 the positions are in the mean of all steps far from equilibrium: total "
    "reaction 17504 N on 2 elements in contact, their submerged weight 5224.06 N, ratio 3.35; check their datum and "
    "units, and the weights\n"
)
"""The same at its own coordinates and then 0.05 deep: 15000 N on 3481.78 N, and 20008 N on 6966.33 N."""

BAD_NUMBER = CLEAN.replace(" 2, -0.1, 10.0\n", " 2, -0.1, ten\n")
"""A SYN002 at 6:11, and nothing else."""

UNSORTED = CLEAN.replace(" 0.0, 0.0\n 0.1, 1000.0\n", " 0.1, 1000.0\n 0.0, 0.0\n")
"""A CRV002 (info) at 25:2, and nothing else."""

UNUSED = CLEAN + " CURVE=Sand\n 0.0, 0.0\n 0.1, 1.0\n"
"""A REF003 and a UNT002 (warnings)."""

LINEAR = CLEAN.replace("STIFFNESS=Clay", "STIFFNESS=20000.0").partition("*SEABED STIFFNESS")[0]

PULLING = CLEAN.replace(" 0.0, 0.0\n", " 0.0, -500.0\n").replace(" 0.1, 1000.0\n", " 0.3, -100.0\n")
"""The curve pulls where element 1 lies: at ratio 0.2 it has -500 + 0.2 * 400 / 0.3."""

ILLEGAL = CLEAN.replace("SET=Pipe\n STIFFNESS", "SET=Pipework\n STIFFNESS")
"""A set that is not defined."""

# -------------------------------------------------------------------------------------------------------- lines of pipe

PIPE = """\
$MODEL
*NODE
 1, -0.05, 0.0
 11, -0.05, 100.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
"""
"""Ten elements of 10 m just below the bed."""

STEEL = """\
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.25, 0.22, 7850.0
"""

CLAY = """\
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.5, 4000.0
"""

PIPE_WITH_SETS = _text("pipe-with-sets.keyxm")
"""Twelve elements of 10 m; West and East Bank overlap, 7 lies in both; two diameters."""

LINEAR_BED = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000\n"
CURVED_BED = (
    "*SEABED STIFFNESS\n CURVE=Clay\n 0, 0\n 0.5, 4000\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
)

# -------------------------------------------------------------------------------- contact, metric or in feet and pounds

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


def line_deck(units: Units, seabed: str, span: float = 100.0) -> str:
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


def full_bed(units: Units) -> str:
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


# --------------------------------------------------------------------------------------------------------- in any order

_NODES = [" 1, -0.1, 0.0", " 2, -0.1, 10.0", " 3, 0.3, 20.0", " 4, 0.5, 30.0"]
_ELEMENTS = [" 1, 1, 2", " 2, 2, 3", " 3, 3, 4"]
_POINTS = [" 0.0, 0.0", " 0.1, 1000.0", " 0.5, 3000.0"]
_MEMBERS = ["1", "2"]
_LAWS = [" SET=Pipe\n STIFFNESS=Clay\n FRICTION=0.3, 0.5", " SET=Rest\n STIFFNESS=50000.0"]


def ordered_deck(order: Callable[[list[str]], list[str]] = list) -> str:
    """A deck with everything in another order whose order does not matter."""
    blocks = [
        "*OCEAN\n 100.0, 1025.0, 9.81",
        "\n".join(["*NODE", *order(_NODES)]),
        "\n".join(["*ELEMENT", *order(_ELEMENTS)]),
        f"*ELEMENT SETS\n SET=Pipe\n {', '.join(order(_MEMBERS))}\n SET=Rest\n 3",
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, =[od], 0.46, 7850.0",
        "\n".join(["*SEABED PROPERTIES\n TYPE=ELASTIC", *order(_LAWS)]),
        "\n".join(["*SEABED STIFFNESS\n CURVE=Clay", *order(_POINTS)]),
        "*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n 1.2, 0.05, 2.0, 1.0, 0.0",
    ]
    lines = "\n".join(order(blocks))
    return f"$PREPROCESSOR\n*PARAMETERS\n od, 0.5\n$MODEL\n{lines}\n"


# ------------------------------------------------------------------------------------------- decks that describe others

VARIED_MODEL = _text("varied-model.keyxm")

VARIED_PARAMETERS = _text("varied-parameters.keyxm")


def varied_deck(variations: str, combinations: str) -> str:
    """A deck with the lines of `*VARIATION` and `*COMBINATIONS`."""
    return f"{VARIED_PARAMETERS}*VARIATION\n{variations}*COMBINATIONS\n{combinations}C model\n{VARIED_MODEL}"
