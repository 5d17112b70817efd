"""Trenches of `*SEABED TRENCH`: resistance against lateral motion towards their walls (a phenomenological reading).

y is the offset of a node from the centreline along u2. The lateral limit of its friction is raised against outward
motion only, by the share of each of its elements in a trench. At the node between two blocks each block counts with
half of the length of its own elements:

* PEAK, a number: half length * PEAK * s(|y|), where s is 0 up to half of the bottom width, rises linearly to 1 at the
  middle of the wall and falls linearly to 0 at half of the upper width;
* PEAK, a table: half length * p(|y|), p linear between the rows of the table, equal to its first row below it and 0
  beyond its last. A third column is the curvature after a row, for corners rounded by parabolas (`rounded`). A peak
  with a residual, or with rounded corners, is such a table; an infinite last offset continues the last value;
* WALL: N (tan theta + mu2) / (1 - mu2 tan theta) in place of mu2 N between the two widths, the sloped wall of a trench
  with tan theta = depth / ((upper - bottom) / 2); at a node only some of whose elements are in the trench, by their
  share of the length.

The seabed level is the trench bottom. LOWERED increases gaps by the depth times w(|y|), w = 1 up to half of the bottom
width, falling linearly to 0 at half of the upper width; the normal stays that of the seabed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray, SmallIndexArray, StateArray
from mudline.model.contact.laws import Law, Parameter, Value, where

PEAK, WALL, TABLE, LEVEL = 0, 1, 2, 3
"""Kinds of resistance, and of a lowered seabed, in tables of the drivers."""


def peak_share(distance: Value, inner: Value, outer: Value, steepness: Value) -> Value:
    """Return s, 0 to 1, at a distance from the centreline.

    `inner` and `outer` are the half widths, `steepness` is 1 over half of their difference.
    """
    return np.minimum(np.maximum(np.minimum(distance - inner, outer - distance) * steepness, 0.0), 1.0)


def peak_slope(distance: Value, inner: Value, outer: Value) -> Value:
    """Return d s / d distance; at the middle of the wall the slope of the inner half."""
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
        increase: FloatArray = (tangent + friction) / (1.0 - friction * tangent) - friction
    return increase


def lowered(distance: Value, inner: Value, outer: Value) -> tuple[Value, Value]:
    """Return w, the share of the depth by which the seabed is lowered, and its slope."""
    part = np.minimum(np.maximum((outer - distance) / (outer - inner), 0.0), 1.0)
    return part, where((distance > inner) & (distance < outer), -1.0 / (outer - inner), 0.0)


def diagram(inner: float, outer: float, peak: float, residual: tuple[float, float] | None) -> FloatArray:
    """Return the rows (k, 2) of a peak resistance; `residual` is the resistance beyond it, and where it is reached."""
    rise = [(inner, 0.0), (0.5 * (inner + outer), peak)]
    return np.array([*rise, (outer, 0.0)] if residual is None else [*rise, residual[::-1], (np.inf, residual[0])])


def shortest_side(points: FloatArray) -> float:
    """Return the length of the shortest side of a diagram (k, 2), half of which may be rounded at each end."""
    places = points[np.isfinite(points[:, 0]), 0]
    sides = np.diff(places, prepend=-places[0])[0 if places[0] > 0.0 else 1 :]
    jumps = len(places) == len(points) and points[-1, 1] > 0.0  # to 0, a side without length
    return 0.0 if jumps else float(sides.min(initial=np.inf))


def rounded(points: FloatArray, half_width: float) -> FloatArray:
    """Return the rows (k, 3) of a diagram with parabolas of a half width in its corners; the third is the curvature."""
    offset, resistance = points.T
    slope = np.concatenate([[0.0], np.diff(resistance) / np.diff(offset), [0.0]])
    rows = []
    for at, (place, value) in enumerate(points.tolist()):
        turn = slope[at + 1] - slope[at]
        if half_width > 0.0 and turn != 0.0 and place > 0.0:
            before, behind = value - slope[at] * half_width, value + slope[at + 1] * half_width
            rows += [(place - half_width, before, turn / (4.0 * half_width)), (place + half_width, behind, 0.0)]
        else:
            rows.append((place, value, 0.0))
    return np.array(rows)


def in_table(distance: Value, offset: Value, resistance: Value, slope: Value, curvature: Value) -> Value:
    """Return the resistance per unit length after the row of a table with these numbers.

    A distance below the first offset, or beyond the last, is taken as that offset.
    """
    return resistance + (slope + curvature * (distance - offset)) * (distance - offset)


TableRows = tuple[FloatArray, FloatArray, FloatArray, FloatArray]


def table_rows(table: FloatArray) -> TableRows:
    """Return the columns for `in_table` of a table (k, 2) or (k, 3), with a row of zeros after its last."""
    offset, resistance = table[:, 0], table[:, 1]
    curvature = table[:, 2] if table.shape[1] > 2 else np.zeros(len(table))
    slope = np.append(np.diff(resistance) / np.diff(offset), 0.0)
    bent = np.flatnonzero(curvature)
    slope[bent] -= curvature[bent] * (offset[bent + 1] - offset[bent])
    return np.append(offset, offset[-1]), np.append(resistance, 0.0), np.append(slope, 0.0), np.append(curvature, 0.0)


def table_row(table: TableRows, distance: FloatArray) -> IndexArray:
    """Return the row (...,) that applies at each distance; see `in_table`."""
    offset = table[0]
    inside = np.searchsorted(offset[1:-1], distance, side="right")
    return np.where(distance > offset[-1], len(offset) - 1, inside)


class TrenchRows(NamedTuple):
    """Trenches of nodes for the lateral limits: a row (k,) for each trench that a node lies in.

    Attributes:
        nodes: (k,) indices of nodes, ascending.
        start: (n + 1,) rows start[i] to start[i + 1] belong to node i.
        kind: PEAK, WALL or TABLE.
        inner, outer: half widths.
        steepness: 1 over half of the difference of the half widths.
        amount: peak force, coefficient of the normal force on the wall, or half length for a table.
        table: index of the table, -1 for none.
        line: row in `lines` of a straight centreline; -1 for the line as laid.
        lines: (c, 4) place and direction (Y, Z) of each straight centreline.
        tables: columns of each table, for `in_table`.
    """

    nodes: IndexArray
    start: IndexArray
    kind: StateArray
    inner: FloatArray
    outer: FloatArray
    steepness: FloatArray
    amount: FloatArray
    table: SmallIndexArray
    line: SmallIndexArray
    lines: FloatArray
    tables: tuple[TableRows, ...]


def resistance(trench: TrenchRows, offset: FloatArray, normal_force: FloatArray) -> FloatArray:
    """Return the lateral resistance of each row (steps, k) at its offset under a normal force."""
    distance = np.abs(offset)
    force: FloatArray = trench.amount * peak_share(distance, trench.inner, trench.outer, trench.steepness)
    on = on_wall(distance, trench.inner, trench.outer)
    force = np.where(trench.kind == WALL, trench.amount * normal_force * on, force)
    for index, columns in enumerate(trench.tables):
        here = trench.table == index
        row = table_row(columns, distance[:, here])
        held = np.minimum(np.maximum(distance[:, here], columns[0][0]), columns[0][-1])
        force[:, here] = trench.amount[here] * in_table(held, *(column[row] for column in columns))
    return force


def slopes(trench: TrenchRows, offset: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return derivatives of `resistance` by the distance and by the normal force, (k,) each, for one step."""
    distance = np.abs(offset)
    kind, inner, outer, amount = trench.kind, trench.inner, trench.outer, trench.amount
    by_distance = np.where(kind == PEAK, amount * peak_slope(distance, inner, outer), 0.0)
    by_normal = np.where(kind == WALL, amount * on_wall(distance, inner, outer), 0.0)
    for index, columns in enumerate(trench.tables):
        here: BoolArray = trench.table == index
        row = table_row(columns, distance[here])
        bent = columns[2][row] + 2.0 * columns[3][row] * (np.minimum(distance[here], columns[0][-1]) - columns[0][row])
        by_distance[here] = amount[here] * np.where(distance[here] < columns[0][0], 0.0, bent)
    return by_distance, by_normal


def share_of_piece(away: tuple[Value, Value, Value], span: tuple[Value, Value, Value], inverse: Value) -> Value:
    """Return the share of a straight piece at its nearest point, below 0 and above 1 beyond its ends.

    `away` is the vector from its start to the point, `span` the vector to its end, and `inverse` 1 / length^2.
    `inverse` is 0 for a piece without length, whose nearest point is its start. A nearest point at an end continues on
    the next piece.
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


def _widths(parameters: dict[str, FloatArray]) -> tuple[BoolArray, str]:
    return ~(parameters["upper"] > parameters["bottom"]), "the upper width of its trench is not above the bottom width"


def _trench(name: str, summary: str, own: Parameter, plan: str, equation: str, *, tables: bool = False) -> Law:
    """Return a law of a trench with a parameter of its own."""
    return Law(
        name=name,
        summary=summary,
        stage="trench",
        acts_on="elements",
        parameters=(*_WIDTHS, own, *_CENTRELINE),
        tables=tables,
        check=_widths,
        plan=plan,
        equation=equation,
        source="trench of DeepLines as publicly described, read as a lateral limit (INFERRED)",
    )


TRENCH_PEAK = _trench(
    "trench peak",
    "trench with a peak lateral resistance",
    Parameter("peak", "F/L", "peak lateral resistance per unit length"),
    "with a peak resistance of the walls (inferred), where the depth has no effect (MODEL=WALL uses it)",
    "limit = mu2 N + PEAK s(|y|) L / 2 against outward motion",
)
TRENCH_TABLE = _trench(
    "trench table",
    "trench with a tabulated lateral resistance",
    Parameter("table", "1", "index of the table"),
    "with a tabulated resistance of the walls (inferred), where depth and widths have no effect",
    "limit = mu2 N + p(|y|) L / 2 against outward motion",
    tables=True,
)
TRENCH_LEVEL = _trench(
    "trench level",
    "lowered seabed in a trench",
    Parameter("depth", "L", "depth of the trench", above=True),
    "where depth and widths lower the seabed, along its normal",
    "gap + depth w(|y|)",
)
TRENCH_WALL = _trench(
    "trench wall",
    "trench with sloped walls",
    Parameter("depth", "L", "depth of the trench", above=True),
    "with sloped walls (inferred)",
    "limit = N (tan theta + mu2) / (1 - mu2 tan theta) on the wall, against outward motion",
)
