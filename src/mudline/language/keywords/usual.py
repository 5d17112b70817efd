"""Usual values: declared with a field, compared by one rule, shown on the page of the keyword."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial


@dataclass(frozen=True, slots=True)
class Usual:
    """Range of usual values, in SI units (angles in degrees).

    Attributes:
        low, high: limits; zero is always usual.
        why: reason for the limits.
        of: measure that is compared in place of the number. `/do` is the number divided by the field `do` of its row;
            other measures are in `mudline.checks.rules.measures`.
        when: condition, of the same module, for the comparison.
        code: code of the warning for values outside.
        remark: True if values outside are an info, since neither mechanics nor a source gives more.
        typical: typical value of the field. A unit in which a number is within a factor `within` of it explains the
            number.
        within: factor for `typical`.
        explained: True if only a number that a unit explains is reported.
        placeholder: True if powers of ten are not reported.
        also: further range of usual values.
    """

    low: float = -math.inf
    high: float = math.inf
    why: str = ""
    of: str = ""
    when: str = ""
    code: str = "UNT007"
    remark: bool = False
    typical: float = math.nan
    within: float = 1.2
    explained: bool = False
    placeholder: bool = False
    also: tuple[float, float] = (math.nan, math.nan)

    def holds(self, value: float) -> bool:
        """Return True if a quantity is usual; NaN, which is unknown, counts as usual."""
        return not (value < self.low or value > self.high) or self.also[0] <= value <= self.also[1]

    def span(self, factor: float = 1.0) -> str:
        """Return the range in words, in a unit of `factor` in SI."""
        low, high = (f"{float(f'{limit / factor:.3g}'):g}" for limit in (self.low, self.high))
        if math.isinf(self.low):
            return f"at most {high}"
        return f"at least {low}" if math.isinf(self.high) else f"{low} to {high}"


def exceeded(usuals: Sequence[Usual], quantities: Sequence[float]) -> list[Usual]:
    """Return the ranges that do not hold the quantity compared with each."""
    return [usual for usual, quantity in zip(usuals, quantities, strict=True) if not usual.holds(quantity)]


COUNT = "a count"
NUMBER = "a number that stands for a name"
NOT_KNOWN = "what it means is not known"
ANY = "no source says what is usual"
OF_THE_RUN = "the run decides"
OF_A_KIND = "a length or an angle, a force or a moment: the degree of freedom or the type decides"
COMPONENT = "a component of a direction"
LENGTH = Usual(low=1e-9, why="it gives a direction", of="as the length of the vector")
AXES = Usual(89.9, 90.1, "axes are at right angles", of="degrees between the local x and y axes")
POSITION = "a position: UNT006 compares coordinates with each other, and with the water depth"
ALONG = "a place along a line"
MODEL = "judged by rules of its keyword"
OF_ITS_CURVE = "the stiffness of the whole curve is judged"

DIRECTION = Usual(-360.0, 360.0, "a full turn")
HEEL = Usual(-45.0, 45.0, "no vessel heels farther")
VESSEL_SIZE = Usual(-500.0, 500.0, "the longest vessel, Prelude, has 488 m")

_SIZE = partial(Usual, code="UNT006")
WIDTH = _SIZE(high=60.0, why="the hull of a spar has 37 m", typical=0.3, within=8.0)
BORE = Usual(high=1.0, why="it is inside", of="/outer")
PIPE_WALL = _SIZE(high=2.0, why="with a wall above 90 mm", when="a thick steel pipe", typical=0.3, within=8.0)
STEEL_BORE = _SIZE(low=0.1, why="a smaller bore is a wall thickness", of="/do", when="a steel pipe")
MASS_WIDTH = _SIZE(
    0.18,
    3.2,
    "of the water that it displaces a chain has 27 times the mass, a float a tenth",
    of="times the diameter of as much water as its mass",
)
DENSE = Usual(low=0.28, why="lead has 0.3", of="times the diameter of as much water as its mass", remark=True)
OTHER_WIDTH = _SIZE(high=25.0, why="floats are no wider", of="/do")
DRAG_WIDTH = Usual(high=8.0, why="else one is in another unit", of="/db", remark=True)
BENDING = (
    Usual(high=1.0, why="a thin tube has 1/8", of="times EA Do2"),
    Usual(low=1e-4, why="flexible pipes have 1/100, steel 1.3", of="/gj", remark=True),
    Usual(low=1e-5, why="flexible pipes have 1E-3, ropes 1E-5", of="times EA Do2", remark=True, placeholder=True),
)
_STRETCH = partial(Usual, of="/mass", when="a mass that fits the diameter")
STRETCH = (
    _STRETCH(low=100.0, why="rubber has 1E3"),
    _STRETCH(1e4, 3e8, "chain has 4E6, steel 2.6E7, carbon 2E8", remark=True, placeholder=True),
)
"""EA over mass: the square of the speed of sound along a line."""

ROUND = Usual(0.01, 100.0, "most lines are round", of="/eiyy", remark=True)

_STIFFNESS = partial(Usual, high=2.1e11, code="UNT002", within=30.0)
LEAST_BED = _STIFFNESS(478.0, why="less carries no pipe, more is stiffer than steel", typical=5e4)
"""478 N/m2 are 10 lbf/ft2."""
BED = (
    LEAST_BED,
    Usual(1e-6, 1.0, "a pipe lies in the soil, not below it", of="diameters that the pipe sinks under its weight"),
)
LEAST_SIDE = _STIFFNESS(95.0, why="less holds no pipe, more is stiffer than steel", typical=5e3)
FRICTION = Usual(high=2.0, why="pipes on soil have 0.2 to 1", code="UNT003")
MOBILISATION = _SIZE(high=10.0, why="soil yields within a few diameters", of="times the diameter of the pipe")
CURVE_FORCE = Usual(
    low=0.1,
    why="the soil carries the pipe",
    of="times the weight of the pipe, or 100 N/m, at its largest force",
    code="UNT002",
)
ROTATION = Usual(1e-1, 1e9, remark=True)
SECANT = "columns exchanged, or another unit"
EI_CURVE = Usual(1.0, 1e14, SECANT, of="as a stiffness")
BENT = Usual(high=0.5, why="no pipe bends to its own width", of="times the inverse radius of the pipe, at its end")
EA_CURVE = Usual(1e3, 1e13, SECANT, of="as a stiffness")
E_CURVE = Usual(1e5, 1e13, SECANT, of="as a stiffness")
FORCE_CURVE = Usual(1.0, 1e13, SECANT, of="as a stiffness")
ROTATION_CURVE = Usual(1.0, 1e9, SECANT, of="as a stiffness")
SOIL_CURVES = (
    Usual(10.0, 1e12, SECANT, of="as a stiffness"),
    Usual(low=0.005, why="soft clay has 0.2 or more", of="times the weight of the soil above and the diameter"),
)

CURRENT = (
    Usual(-11.5, 11.5, "the strongest tidal stream, Saltstraumen, runs at 22 knots", typical=0.8, within=4.0),
    Usual(-2.5, 2.5, "the Gulf Stream runs at 2.5 m/s", remark=True),
)
WAVE_PERIOD = Usual(1.0, 60.0, "ocean waves have 2 to 30 s")
SEA_PERIOD = Usual(2.0, 30.0, "ocean waves have 2 to 30 s")
SEA_FREQUENCY = Usual(1.0 / 30.0, 0.5, "ocean waves have 2 to 30 s")
SEA_HEIGHT = (
    Usual(high=25.0, why="the highest of a buoy is 19 m (WMO 2016)"),
    Usual(high=0.077, why="severe seas have 1/20 to 1/16 (API RP 2MET)", of="as steepness, 2 pi H / g T2"),
)
CUTOFF = Usual(0.08, 2.0, "beyond it a sea has no energy", remark=True)
INCREMENT = Usual(high=0.1, why="a spectrum is narrower", remark=True)
HARMONICS = Usual(20.0, 10_000.0, "fewer repeat themselves", remark=True)
PEAKEDNESS = Usual(0.5, 10.0, "Jonswap seas have 1 to 7")
PHILLIPS = Usual(1e-5, 0.1, "0.0081 of a full sea", remark=True)
PROGRESSION = Usual(1.0, 1.5, "frequencies follow closely on each other", remark=True)
DIRECTIONS = Usual(low=2.0, why="one direction is not spread", when="a spreading exponent", remark=True)
EXPONENT = Usual(high=50.0, why="wind seas have 2 to 10", remark=True)
AMPLITUDE = Usual(high=20.0, why="the highest waves that were measured have 30 m")
HEIGHT = Usual(high=40.0, why="the highest waves that were measured have 30 m")
STORED = Usual(high=0.5, why="a wave between two times is lost", of="times the shortest period of the waves")
STEP = Usual(high=5.0, why="waves have periods of 2 to 30 s", when="waves in the time domain")

DRAG = Usual(high=5.0, why="bluff bodies have up to 2.5", typical=1.0, within=3.0)
ALONG_DRAG = (
    Usual(high=3.0, why="along a line there is less drag than across it", typical=0.1, within=10.0),
    Usual(high=3.0, why="along a line there is less drag than across it", of="/normal_drag"),
    Usual(high=1.0, why="along a line there is less drag than across it", of="/normal_drag", remark=True),
)
INERTIA = Usual(1.0, 6.0, "1 and the added mass: a cylinder has 2, at the seabed 3.3")
ADDED_MASS = Usual(high=5.0, why="a cylinder has 1, at the seabed 2.3")
LIFT = Usual(-5.0, 5.0, "at the seabed it stays below 5")
SHIFT_RAO = Usual(-10.0, 10.0, "metres per metre: in resonance 2 to 5", typical=0.7, within=3.0)
TURN_RAO = Usual(-30.0, 30.0, "degrees per metre: in resonance 5 to 15")
LONG_WAVE = Usual(0.5, 1.5, "a vessel rises and falls with long waves", of="as heave in a wave of 40 s and longer")
VESSEL_HEIGHT = (
    Usual(high=400.0, why="no vessel is longer; X is the vertical", of="m from the nodes that it holds"),
    Usual(-150.0, 150.0, "X is the vertical, counted from the mudline", of="m above the water"),
    Usual(high=150.0, why="lines hang nearer to its middle", of="m from the nodes that it holds", remark=True),
    Usual(-60.0, 60.0, "a vessel floats", of="m above the water", remark=True),
)
VERTICAL_OFFSET = Usual(-30.0, 30.0, "X is the vertical: tide and draught alone move a vessel along it")
OFFSET = (
    Usual(-0.5, 0.5, "risers and moorings hold no vessel farther out", of="times the water depth"),
    Usual(-0.25, 0.25, "a tenth of the depth is usual", of="times the water depth", remark=True),
)
DRIFT_PERIOD = Usual(5.0, 3600.0, "drift is slower than waves")

OUTER_WIDTH = _SIZE(high=8.0, why="one of them is in another unit", of="times the drag and buoyancy diameters")
_MODULUS = partial(Usual, code="UNT005", placeholder=True)
YOUNG = (
    _MODULUS(low=1e5, why="rubber has 1E6, steel 2.07E11", typical=2.07e11, within=1e3),
    _MODULUS(185e9, 220e9, "steel", when="a steel wall", typical=2.07e11, explained=True),
)
SHEAR = (
    _MODULUS(low=1e5, why="steel has 7.96E10", typical=7.96e10, within=1000.0),
    _MODULUS(71e9, 86e9, "steel", when="a steel wall", typical=7.96e10, explained=True),
    _MODULUS(low=-0.02, why="of E and G", of="as Poisson's ratio, E / 2G - 1"),
    _MODULUS(high=0.52, why="of a metal", of="as Poisson's ratio, E / 2G - 1", when="a metal"),
)
_DENSITY = partial(Usual, code="UNT004", placeholder=True)
_WALL = partial(_DENSITY, low=10.0, why="foam to steel with its contents; steel has 7850", typical=7850.0, within=12.0)
WALL = (
    _WALL(high=40_000.0, when="a wall without an area of its own"),
    _WALL(),
    _DENSITY(high=40_000.0, why="steel has 7850", typical=7850.0, explained=True),
    _DENSITY(low=7e3, why="steel", when="the modulus of steel", typical=7850.0, within=1.1),
    Usual(7.0, 8.4, "steel", of="times the density of the water", when="unknown units", code="UNT004", explained=True),
)
SEA_DENSITY = _DENSITY(900.0, 2500.0, "fresh water to heavy brine", typical=1025.0, within=1.08, also=(1.1, 1.31))
LIQUID = Usual(
    low=400.0,
    why="a liquid, or a gas that is not compressed",
    when="a fluid without pressure",
    remark=True,
    also=(0.0, 10.0),
)
GRAVITY = Usual(9.614, 10.006, "9.81 on earth", code="UNT001", typical=9.81, within=1.02)
