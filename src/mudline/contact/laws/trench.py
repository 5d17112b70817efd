"""Trenches of `*SEABED TRENCH`: resistance against sideways motion towards their walls (a phenomenological reading).

y is the offset of a node from the centreline along u2. The lateral limit of its friction is raised, against outward
motion only, by the share of each of its elements that lies in a trench, so that at the node between two blocks each
block counts with half of the length of its own elements:

* PEAK, a number: half length * PEAK * s(|y|), where s is 0 up to half of the bottom width, rises linearly to 1 at the
  middle of the wall and falls linearly to 0 at half of the upper width;
* PEAK, a table: half length * p(|y|), p linear between the rows of the table, that of its first row below it and 0
  beyond its last;
* WALL: N (tan theta + mu2) / (1 - mu2 tan theta) in place of mu2 N between the two widths, the sloped wall of a trench
  with tan theta = depth / ((upper - bottom) / 2); at a node whose elements are not all in it, by their share of the
  length.

The seabed level is the trench bottom: the seabed is not lowered.
"""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.laws import Law, Parameter, Value, where

PEAK, WALL, TABLE = 0, 1, 2
"""Kinds of resistance, in tables of the drivers."""


def peak_share(distance: Value, inner: Value, outer: Value, steepness: Value) -> Value:
    """Return s, 0 to 1, at a distance from the centreline.

    `inner` and `outer` are the half widths, `steepness` is 1 over half of their difference.
    """
    return np.minimum(np.maximum(np.minimum(distance - inner, outer - distance) * steepness, 0.0), 1.0)


def peak_slope(distance: Value, inner: Value, outer: Value) -> Value:
    """Return d s / d distance; at the middle of the wall that of the inner half."""
    half = 0.5 * (outer - inner)
    rising = (distance > inner) & (distance <= inner + half)
    falling = (distance > inner + half) & (distance < outer)
    return where(rising, 1.0 / half, where(falling, -1.0 / half, 0.0))


def on_wall(distance: Value, inner: Value, outer: Value) -> Value:
    """Return 1 between the two half widths, else 0."""
    return where((distance > inner) & (distance < outer), 1.0, 0.0)


def wall_coefficient(depth: FloatArray, bottom: FloatArray, upper: FloatArray, friction: FloatArray) -> FloatArray:
    """Return (tan theta + mu2) / (1 - mu2 tan theta) - mu2; negative or infinite where the wall locks itself."""
    with np.errstate(all="ignore"):
        tangent = depth / (0.5 * (upper - bottom))
        found: FloatArray = (tangent + friction) / (1.0 - friction * tangent) - friction
    return found


def in_table(distance: Value, offset: Value, resistance: Value, slope: Value) -> Value:
    """Return the resistance per unit length behind the row of a table with this offset, resistance and slope.

    A distance below the first offset, or beyond the last, is taken as that offset.
    """
    return resistance + slope * (distance - offset)


def table_rows(table: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return offsets, resistances and slopes behind each row of a table (k, 2), with a row of zeros behind its last."""
    offset, resistance = table[:, 0], table[:, 1]
    slope = np.append(np.diff(resistance) / np.diff(offset), 0.0)
    return np.append(offset, offset[-1]), np.append(resistance, 0.0), np.append(slope, 0.0)


def table_row(table: tuple[FloatArray, FloatArray, FloatArray], distance: FloatArray) -> IndexArray:
    """Return the row (...,) that holds at each distance; see `in_table`."""
    offset = table[0]
    inside = np.searchsorted(offset[1:-1], distance, side="right")
    found: IndexArray = np.where(distance > offset[-1], len(offset) - 1, inside)
    return found


def share_of_piece(away: tuple[Value, Value, Value], span: tuple[Value, Value, Value], inverse: Value) -> Value:
    """Return the share of a straight piece at which its nearest point lies, below 0 and above 1 beyond its ends.

    `away` is the vector from its start to the point, `span` that to its end, `inverse` 1 over the square of that; 0 for
    a piece without length, whose nearest point is its start. Nearest points at one end of a piece go on to the next.
    """
    return (away[0] * span[0] + away[1] * span[1] + away[2] * span[2]) * inverse


_WIDTHS = (
    Parameter("bottom", "L", "bottom width", above=True),
    Parameter("upper", "L", "upper width", above=True),
)
_CENTRELINE = tuple(
    Parameter(name, "L", "of a straight centreline; NaN for the line as laid", -np.inf, default=np.nan, optional=True)
    for name in ("start_y", "start_z", "end_y", "end_z")
)


def _widths(given: dict[str, FloatArray]) -> tuple[BoolArray, str]:
    return ~(given["upper"] > given["bottom"]), "the upper width of its trench is not above the bottom width"


def _trench(name: str, summary: str, own: Parameter, equation: str, *, tables: bool = False) -> Law:
    """A law of a trench with a parameter of its own."""
    return Law(
        name=name,
        summary=summary,
        stage="trench",
        acts_on="elements",
        parameters=(*_WIDTHS, own, *_CENTRELINE),
        tables=tables,
        check=_widths,
        equation=f"{equation} against outward motion",
        source="trench of DeepLines as publicly described, read as a lateral limit (INFERRED)",
    )


TRENCH_PEAK = _trench(
    "trench peak",
    "trench with a peak lateral resistance",
    Parameter("peak", "F/L", "peak lateral resistance per unit length"),
    "limit = mu2 N + PEAK s(|y|) L / 2",
)
TRENCH_TABLE = _trench(
    "trench table",
    "trench with a tabulated lateral resistance",
    Parameter("table", "1", "index of the table"),
    "limit = mu2 N + p(|y|) L / 2",
    tables=True,
)
TRENCH_WALL = _trench(
    "trench wall",
    "trench with sloped walls",
    Parameter("depth", "L", "depth of the trench", above=True),
    "limit = N (tan theta + mu2) / (1 - mu2 tan theta) on the wall,",
)
