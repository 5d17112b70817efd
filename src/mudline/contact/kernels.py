"""Loops over elements and over nodes that call the laws for one of them at a time; `compiled_driver` compiles them.

Each function that makes a loop takes flags and laws, which are constants of the compiled loop: what a scene does not
have is not even compiled. A loop goes over a range of rows and all steps of a batch, writes its part of a result, moves
the states on, and returns how many values came out that are not finite.

All arrays of a result are (steps, m) for elements and (steps, n) for nodes. The numpy driver does the same operations
in the same order, so both give the same bits.
"""

from __future__ import annotations

import hashlib
import inspect
import math
import sys
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from mudline.contact import vectors
from mudline.contact.laws import NormalLaw
from mudline.contact.laws.curve import on_segment
from mudline.contact.laws.friction import in_box, in_ellipse, norm, on_ellipse, slip_distance
from mudline.contact.laws.lateral import lateral_force
from mudline.contact.laws.suction import (
    BROKEN,
    COMPRESSION,
    SUCTION,
    after_cycle,
    breakout_uplift,
    maximum_force,
    next_state,
    suction_force,
    trapezoid,
)
from mudline.contact.laws.suction_spring import spring_suction
from mudline.contact.laws.trench import PEAK, WALL, in_table, on_wall, peak_share, share_of_piece
from mudline.contact.laws.unloading import line_stiffness, on_line, trench_bottom
from mudline.contact.tables import Tables, steepest_anywhere

_LAW_MODULES = ("base", "curve", "friction", "lateral", "suction", "suction_spring", "trench", "unloading")

Loop = Callable[..., int]
Wrap = Callable[[Any], Any]
"""Makes a function one that loops can call, and returns it."""
Array = Any
"""An array; the loops are typed when they are compiled."""
Point = tuple[float, float, float]

# Columns of the table of numbers of elements, before the parameters of their normal laws.
DIAMETER, ONSET, LINE, SPRING, EXTENT, LATERAL, LAW = range(7)
# Columns of the table of indices of elements.
FIRST, SECOND, KIND, CURVE_START, CURVE_END, UNLOADS, PULLS, SPRINGS_BACK, INDICES = range(9)
# Columns of the table of suction laws: the parameters of `SuctionLaw`, then these.
PER_CYCLE, FLOOR, LEAST_DEPTH, SUCTION_COLUMNS = 9, 10, 11, 12
# Columns of the table of numbers of nodes, before the parameters of their normal laws.
MU_1, MU_2, CONSTANT_1, CONSTANT_2, RISING_1, RISING_2, COSINE, SINE, NODE_ONSET, NODE_LAW = range(10)
# Columns of the table of indices of nodes.
ACTIVE, ELLIPTIC, NODE_KIND, NODE_INDICES = range(4)
# Columns of the tables of trenches.
INNER, OUTER, STEEPNESS, AMOUNT, TRENCH_NUMBERS = range(5)
TRENCH_KIND, TABLE_START, TABLE_END, CENTRELINE, TRENCH_INDICES = range(5)

NO_LAW, ON_CURVE, FIRST_LAW = 0, 1, 2
"""Kinds of normal laws of elements; those with an equation are numbered from the last on."""


class Has(NamedTuple):
    """What a scene has, as far as loops differ by it."""

    flat: bool
    curves: bool
    cuts: bool
    unloading: bool
    steepens: bool
    springs: bool
    suction: bool
    slides: bool
    lateral: bool
    nodal: bool
    friction: bool
    elliptic: bool
    turned: bool
    trench: bool
    tables: bool


def what_there_is(tables: Tables, *, flat: bool) -> Has:
    """Return what a scene has, as far as the loops differ by it."""
    friction, trench, suction = tables.friction, tables.trench, tables.suction
    return Has(
        flat=flat,
        curves=any(rows.curve >= 0 for rows in tables.normal),
        cuts=tables.cuts,
        unloading=tables.unloading is not None,
        steepens=_steepens(tables),
        springs=tables.springs is not None,
        suction=suction is not None,
        slides=friction is not None or tables.lateral is not None,
        lateral=tables.lateral is not None,
        nodal=bool(tables.nodal),
        friction=friction is not None,
        elliptic=friction is not None and bool(friction.elliptic.any()),
        turned=friction is not None and bool(friction.turned.size),
        trench=trench is not None,
        tables=trench is not None and bool((trench.table >= 0).any()),
    )


def _steepens(tables: Tables) -> bool:
    """Whether an unloading line may be less steep than the virgin path that led to it."""
    if tables.unloading is None:
        return False
    stiffness = np.full(len(tables.half), np.inf)
    stiffness[tables.unloading.rows] = tables.unloading.columns[0]
    return any(bool((steepest_anywhere(tables, rows) > stiffness[rows.rows]).any()) for rows in tables.normal)


@cache
def edition(laws: tuple[NormalLaw, ...]) -> int:
    """Return a number that changes with the source of the loops and laws, so that no cached loop outlives them."""
    texts = [inspect.getsource(sys.modules[name]) for name in _SOURCES]
    for law in laws:
        texts += [inspect.getsource(function) for function in (law.reaction, law.steepest) if function is not None]
    return int.from_bytes(hashlib.sha256("".join(texts).encode()).digest()[:4], "big")


_SOURCES = (
    "mudline.contact.compiled_driver",
    "mudline.contact.kernels",
    "mudline.contact.vectors",
    *(f"mudline.contact.laws.{name}" for name in _LAW_MODULES),
)


def row_of_0(_table: Array, _row: int, _first: int) -> tuple[()]:
    """Return no parameter."""
    return ()


def row_of_1(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return one parameter of a row of a table, from a first column on."""
    return (table[row, first],)


def row_of_2(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return two parameters."""
    return table[row, first], table[row, first + 1]


def row_of_3(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return three parameters."""
    return table[row, first], table[row, first + 1], table[row, first + 2]


def row_of_4(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return four parameters."""
    return table[row, first], table[row, first + 1], table[row, first + 2], table[row, first + 3]


def row_of_5(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return five parameters."""
    return (*row_of_4(table, row, first), table[row, first + 4])


def row_of_6(table: Array, row: int, first: int) -> tuple[float, ...]:
    """Return six parameters."""
    return (*row_of_4(table, row, first), table[row, first + 4], table[row, first + 5])


ROWS = (row_of_0, row_of_1, row_of_2, row_of_3, row_of_4, row_of_5, row_of_6)
"""By how many parameters a law has; a law with more runs with numpy."""


def one_of(wrap: Wrap, laws: tuple[tuple[Callable[..., Any], int], ...], first: int) -> Callable[..., Any]:
    """Return a function that evaluates the law of a kind, from 0: (kind, z, diameter, table, row).

    `laws` are reactions and their numbers of parameters, which stand in a table from the column `first` on.
    """
    if not laws:

        def nothing(_kind: int, _z: float, _diameter: float, _table: Array, _row: int) -> tuple[float, float]:
            return 0.0, 0.0

        return wrap(nothing)  # type: ignore[no-any-return]
    (reaction, count), others = laws[0], one_of(wrap, laws[1:], first)
    reaction, parameters = wrap(reaction), wrap(ROWS[count])
    if len(laws) == 1:

        def only(_kind: int, z: float, diameter: float, table: Array, row: int) -> tuple[float, float]:
            f, k = reaction(z, diameter, *parameters(table, row, first))
            return f, k

        return wrap(only)  # type: ignore[no-any-return]

    def one(kind: int, z: float, diameter: float, table: Array, row: int) -> tuple[float, float]:
        if kind > 0:
            f, k = others(kind - 1, z, diameter, table, row)
        else:
            f, k = reaction(z, diameter, *parameters(table, row, first))
        return f, k

    return wrap(one)  # type: ignore[no-any-return]


def passed(points: Array, begin: int, end: int, value: float) -> int:
    """Return the last of ascending points begin <= i < end that lies at or below a value; the first if none does."""
    count = end - begin - 1
    while count > 0:
        half = (count + 1) // 2
        begin += half * (value >= points[begin + half])  # no branch: which way it goes cannot be guessed
        count -= half
    return begin


def unit_of_span(dx: float, dy: float, dz: float) -> tuple[float, float, float]:
    """Return the direction of a span; 0 for one without length, or with an end that is not there."""
    square = dx * dx + dy * dy + dz * dz
    if not vectors.LEAST_SQUARE < square < vectors.LARGEST_SQUARE:
        scale = vectors.span_scale(dx, dy, dz)
        dx = dx / scale if math.isfinite(dx) else 0.0
        dy = dy / scale if math.isfinite(dy) else 0.0
        dz = dz / scale if math.isfinite(dz) else 0.0
        square = dx * dx + dy * dy + dz * dz
        square = square if square > 0.0 else math.inf
    share = vectors.tangent_share(square)
    return dx * share, dy * share, dz * share


Numbers = tuple[float, ...]


def moved_line(
    z: float, before: Numbers, virgin: tuple[float, float, float], diameter: float, stiffness: float
) -> tuple[Numbers, tuple[float, float, float]]:
    """Return the unloading history of an element at a penetration, and its force, slope and stiffness.

    `before` are z_max, F_max, ku' and z_p; `virgin` force, slope and stiffness of the virgin path, and `stiffness` ku,
    already as steep as that.
    """
    after, reaction = before, virgin
    if z > before[0]:
        top = np.maximum(virgin[0], 0.0)
        line = line_stiffness(stiffness, z, top)
        after = (z, top, line, trench_bottom(line, z, top))
    else:
        f, k = on_line(z, before[0], before[1], before[2], before[3])
        reaction = (f, k * diameter, k)
    return after, reaction


def moved_suction(
    before: tuple[bool, int, Numbers],
    uplift: float,
    pressed: bool,  # noqa: FBT001 - loops pass arguments by place
    v: float,
    law: Numbers,
) -> tuple[tuple[bool, int, Numbers], float, float, bool]:
    """Return the suction history of an element: armed, state, numbers; force, stiffness, and whether v < v_r.

    `law` are the columns of the table of suction laws.
    """
    armed, state, (v_max, factor, depth) = before
    g = h = 0.0
    slow, completed, now, largest, reach = False, False, 0, 0.0, law[LEAST_DEPTH]
    if pressed:
        completed = armed and v_max > 0.0
        armed, now = True, COMPRESSION
    elif (armed or state == BROKEN) and not math.isnan(uplift):
        largest, reach = np.maximum(v_max, v) if armed else v_max, depth
        if largest > v_max:
            reach = breakout_uplift(largest, law[2], law[3], law[7])
        was = armed
        armed, largest, now = next_state(armed, largest, state, reach, uplift, v)
        completed = was and now == BROKEN
        if now == SUCTION:
            g, h = suction_force(uplift, v, reach, (law[0] * factor, law[1], law[7], law[4], law[5]))
            slow = v < law[7] and law[1] < 2.0
        elif now == 0:
            reach = law[LEAST_DEPTH]
    else:
        armed = False
    if completed:
        factor = after_cycle(factor, law[PER_CYCLE], law[FLOOR])
    return (armed, now, (largest, factor, reach)), g, h, slow


def elements_loop(
    wrap: Wrap, has: Has, laws: tuple[tuple[Callable[..., Any], int], ...], steepest: Callable[..., Any], edition: int
) -> Loop:
    """Make the loop over elements.

    `laws` are the normal laws with equations; `steepest` is asked for (kind, z, diameter, table, e), where an
    unloading line may be less steep than the virgin path.
    """
    curves, cuts, unloading, steepens, springs = has.curves, has.cuts, has.unloading, has.steepens, has.springs
    suction, slides, lateral, flat = has.suction, has.slides, has.lateral, has.flat
    plane = vectors.PLANES[2 if has.flat else 3]
    project, default, cross, dot = plane.project, plane.default, plane.across, plane.dot
    normal_law = one_of(wrap, laws, LAW)

    def loop(
        begin: int, end: int, index: Array, table: Array, pulls: Array, points: Array, gap: Array, speed: Array,
        normals: Array, knots: Array, states: Array, out: Array, extra: Array, work: Array,
    ) -> int:  # fmt: skip
        depth, ratio, contact, force, slope, stiffness = out
        cut, state, regularised = extra
        tangent, sideways = work
        lines, flags, numbers, touchdown = states
        wrong = min(edition, 0)
        for step in range(len(gap)):
            for e in range(begin, end):
                a, b, kind = index[e, FIRST], index[e, SECOND], index[e, KIND]
                diameter, onset = table[e, DIAMETER], table[e, ONSET]
                deep = 0.0 - (0.5 * gap[step, a] + 0.5 * gap[step, b])
                share = deep / diameter
                touches = deep > onset
                wrong += math.isinf(share) | math.isinf(deep)

                f = k = 0.0
                s = 0.0 * diameter  # NaN without a diameter
                segment = 0
                if touches and curves and kind == ON_CURVE:
                    segment = passed(knots[0], index[e, CURVE_START], index[e, CURVE_END], share)
                    s = knots[2, segment]
                    f = on_segment(share, knots[0, segment], knots[1, segment], s)
                    k = s / diameter
                    wrong += (cuts or unloading) and not math.isfinite(f + k)
                    if cuts and f < 0.0:
                        f = s = k = 0.0
                        cut[step, e] = True
                elif touches and kind >= FIRST_LAW:
                    f, k = normal_law(kind - FIRST_LAW, deep, diameter, table, e)
                    s = k * diameter
                    wrong += unloading and not math.isfinite(f + k)

                uplift, pressed = onset - deep, touches
                if unloading and index[e, UNLOADS] >= 0:
                    u, z, steep = index[e, UNLOADS], deep if deep > 0.0 else 0.0, table[e, LINE]
                    if steepens and curves and kind == ON_CURVE and touches:
                        # at a point the segment to its right does not count yet
                        back = share == knots[0, segment] and segment > index[e, CURVE_START]
                        steep = np.maximum(steep, knots[3, segment - 1 if back else segment] / diameter)
                    elif steepens and kind >= FIRST_LAW and touches:
                        steep = np.maximum(steep, steepest(kind - FIRST_LAW, z, diameter, table, e)[0])
                    line: Numbers = (lines[0, u], lines[1, u], lines[2, u], lines[3, u])
                    if curves and cuts:
                        cut[step, e] &= z > line[0]
                    line, (f, s, k) = moved_line(z, line, (f, s, k), diameter, steep)
                    lines[0, u], lines[1, u], lines[2, u], lines[3, u] = line
                    uplift, pressed = line[3] - deep, z > line[3]

                if springs and table[e, SPRING] > 0.0:
                    g, h = spring_suction(onset - deep, table[e, SPRING], table[e, EXTENT])
                    f, s, k = f + g, s + h * diameter, k + h

                if suction and index[e, PULLS] >= 0:
                    held, v = index[e, PULLS], 0.5 * speed[step, a] + 0.5 * speed[step, b]
                    was = (flags[0, held] > 0, flags[1, held], (numbers[0, held], numbers[1, held], numbers[2, held]))
                    now, g, h, slow = moved_suction(was, uplift, pressed, v, suction_law(pulls, held))
                    if now[1] == SUCTION:
                        f, s, k = f + g, s + h * diameter, k + h
                    flags[0, held], flags[1, held] = now[0], now[1]
                    numbers[0, held], numbers[1, held], numbers[2, held] = now[2]
                    state[step, e], regularised[step, e] = now[1], slow

                wrong += (not math.isfinite(f + k)) | math.isinf(s)
                depth[step, e], ratio[step, e], contact[step, e] = deep, share, touches
                force[step, e], slope[step, e], stiffness[step, e] = f, s, k
                if not slides:
                    continue

                p = (points[step, a, 0], points[step, a, 1], points[step, a, 2])
                q = (points[step, b, 0], points[step, b, 1], points[step, b, 2])
                unit = unit_of_span(q[0] - p[0], q[1] - p[1], q[2] - p[2])
                if flat:
                    tangent[step, e, 0], tangent[step, e, 1] = unit[1], unit[2]
                else:
                    tangent[step, e, 0], tangent[step, e, 1], tangent[step, e, 2] = unit
                if lateral and index[e, SPRINGS_BACK] >= 0:
                    held = index[e, SPRINGS_BACK]
                    x, y, z = 0.5 * p[0] + 0.5 * q[0], 0.5 * p[1] + 0.5 * q[1], 0.5 * p[2] + 0.5 * q[2]
                    if not touches:
                        touchdown[held, 0] = touchdown[held, 1] = touchdown[held, 2] = np.nan
                    elif math.isnan(touchdown[held, 0]):
                        touchdown[held, 0], touchdown[held, 1], touchdown[held, 2] = x, y, z
                    n = (normals[0, 0, 0], normals[0, 0, 1], normals[0, 0, 2])
                    wanted: Numbers = unit[1:] if flat else unit
                    x, y, z = x - touchdown[held, 0], y - touchdown[held, 1], z - touchdown[held, 2]
                    arm: Numbers = (y, z) if flat else (x, y, z)
                    if not flat and normals.shape[1] > 1:
                        n = mean_normal(normals, step, a, b)
                    along, able = project(wanted, n)
                    if not able:
                        along = default(n)
                    across = cross(along, n)
                    push = lateral_force(table[e, LATERAL], dot(across, arm)) if touches else 0.0
                    for axis in range(sideways.shape[2]):
                        sideways[step, e, axis] = across[axis] * push
                elif lateral:
                    for axis in range(sideways.shape[2]):
                        sideways[step, e, axis] = 0.0
        return wrong

    return loop


def suction_law(pulls: Array, row: int) -> Numbers:
    """Return the columns of a row of the table of suction laws."""
    return (
        pulls[row, 0], pulls[row, 1], pulls[row, 2], pulls[row, 3], pulls[row, 4], pulls[row, 5], pulls[row, 6],
        pulls[row, 7], pulls[row, 8], pulls[row, PER_CYCLE], pulls[row, FLOOR], pulls[row, LEAST_DEPTH],
    )  # fmt: skip


def mean_normal(normals: Array, step: int, one: int, other: int) -> tuple[float, float, float]:
    """Return the mean of the unit normals at two nodes, as a unit vector."""
    x = normals[step, one, 0] + normals[step, other, 0]
    y = normals[step, one, 1] + normals[step, other, 1]
    z = normals[step, one, 2] + normals[step, other, 2]
    size = np.sqrt(vectors.dot_3((x, y, z), (x, y, z)))
    return x / size, y / size, z / size


def on_piece(laid: Array, element: int, point: Point) -> tuple[float, float, float, float, float]:
    """Return the share of the nearest point of a piece as laid, the vector from there, and its square."""
    x, y, z = point[0] - laid[0, element], point[1] - laid[1, element], point[2] - laid[2, element]
    span = (laid[3, element], laid[4, element], laid[5, element])
    share = np.minimum(np.maximum(share_of_piece((x, y, z), span, laid[6, element]), 0.0), 1.0)
    x, y, z = x - share * span[0], y - share * span[1], z - share * span[2]
    return share, x, y, z, x * x + y * y + z * z


def from_laid(laid: Array, beside: Array, node: int, point: Point) -> Point:
    """Return the vector from the nearest point of the line as laid, sought from the node's own place.

    `beside` has the first two elements at each node, then the nodes of each element.
    """
    ends, elements_at = beside
    current = elements_at[node, 0]
    if current < 0:
        return 0.0, 0.0, 0.0
    share, x, y, z, square = on_piece(laid, current, point)
    following = elements_at[node, 1]
    if following >= 0:
        second = on_piece(laid, following, point)
        if second[4] < square:
            current, share, x, y, z, square = following, second[0], second[1], second[2], second[3], second[4]
    walks = share == (0.0 if ends[current, 1] == node else 1.0) and square > 0.0
    while walks:
        at = ends[current, 0] if share <= 0.0 else ends[current, 1]
        following = elements_at[at, 1] if elements_at[at, 0] == current else elements_at[at, 0]
        walks = False
        if following >= 0:
            second = on_piece(laid, following, point)
            if second[4] < square:
                current, share, x, y, z, square = following, second[0], second[1], second[2], second[3], second[4]
                walks = share <= 0.0 or share >= 1.0
    return x, y, z


def table_resistance(rows: Array, begin: int, end: int, distance: float) -> float:
    """Return the resistance per unit length of the rows begin to end of tables at a distance."""
    row = passed(rows[0], begin, end - 1, distance)
    if distance > rows[0, end - 1]:
        row = end - 1
    value: float = in_table(np.maximum(distance, rows[0, begin]), rows[0, row], rows[1, row], rows[2, row])
    return value


def in_limits(t1: float, t2: float, l1: float, l2: float, elliptic: bool) -> tuple[float, float, bool, bool]:  # noqa: FBT001
    """Return forces in the springs and whether they slip, in the ellipse or in the box."""
    if elliptic:
        f1, f2, slip_1, slip_2 = in_ellipse(t1, t2, l1, l2)
    else:
        f1, slip_1 = in_box(t1, l1)
        f2, slip_2 = in_box(t2, l2)
    return f1, f2, slip_1, slip_2


def from_straight(lines: Array, line: int, p: Point) -> Point:
    """Return the vector from a straight centreline, at the point's own elevation."""
    y, z, span = p[1] - lines[line, 0], p[2] - lines[line, 1], (0.0, lines[line, 2], lines[line, 3])
    share = share_of_piece((p[0], y, z), span, 1.0)
    return 0.0, y - share * span[1], z - share * span[2]


def _trench_limit(has: Has) -> Callable[..., Any]:
    """Make the function that gives what trenches add to the lateral limit of a node that is pulled to one side."""
    flat, tables = has.flat, has.tables
    dot = vectors.PLANES[2 if has.flat else 3].dot

    def walls(i: int, total: float, p: Point, across: Array, forward: bool, ditch: Array) -> float:  # noqa: FBT001
        start, index, table, lines, rows, laid, beside = ditch
        added = 0.0
        for at in range(start[i], start[i + 1]):
            line, kind, amount = index[at, CENTRELINE], index[at, TRENCH_KIND], table[at, AMOUNT]
            x, y, z = from_laid(laid, beside, i, p) if line < 0 else from_straight(lines, line, p)
            offset = dot(across, (y, z)) if flat else dot(across, (x, y, z))
            if (offset > 0.0) if forward else (offset < 0.0):
                distance = np.abs(offset)
                if kind == PEAK:
                    added += amount * peak_share(distance, table[at, INNER], table[at, OUTER], table[at, STEEPNESS])
                elif kind == WALL:
                    added += amount * total * on_wall(distance, table[at, INNER], table[at, OUTER])
                elif tables:
                    added += amount * table_resistance(rows, index[at, TABLE_START], index[at, TABLE_END], distance)
        return added

    return walls


def nodes_loop(wrap: Wrap, has: Has, laws: tuple[tuple[Callable[..., Any], int], ...], edition: int) -> Loop:
    """Make the loop over nodes: sums of element forces, nodal springs, friction, lateral springs and reactions."""
    friction, turned, lateral, nodal, slides = has.friction, has.turned, has.lateral, has.nodal, has.slides
    flat, elliptic, trench = has.flat, has.elliptic, has.trench
    plane = vectors.PLANES[2 if has.flat else 3]
    project, default, cross, dot, turn = plane.project, plane.default, plane.across, plane.dot, plane.turned
    blend, added, reacts = plane.blend, plane.added, plane.reaction
    normal_law = one_of(wrap, laws, NODE_LAW)
    walls = wrap(_trench_limit(has))

    def loop(
        begin: int, end: int, start: Array, elements: Array, senses: Array, half: Array, index: Array, table: Array,
        points: Array, gap: Array, normals: Array, force: Array, work: Array, ditch: Array, states: Array, out: Array,
        extra: Array,
    ) -> int:  # fmt: skip
        totals, reaction = out
        rubbing, slipping = extra
        tangent, sideways = work
        sticks, sticking = states
        wrong = min(edition, 0)
        for step in range(len(gap)):
            for i in range(begin, end):
                total = 0.0
                tx = ty = tz = gx = gy = gz = 0.0
                for at in range(start[i], start[i + 1]):
                    e = elements[at]
                    total += force[step, e] * half[e]
                    if slides:
                        tx += tangent[step, e, 0] * senses[at]
                        ty += tangent[step, e, 1] * senses[at]
                        if not flat:
                            tz += tangent[step, e, 2] * senses[at]
                    if lateral:
                        gx += sideways[step, e, 0]
                        gy += sideways[step, e, 1]
                        if not flat:
                            gz += sideways[step, e, 2]
                if nodal and index[i, NODE_KIND] >= 0:
                    z = 0.0 - gap[step, i]
                    if z > table[i, NODE_ONSET]:
                        f, k = normal_law(index[i, NODE_KIND], z, 0.0, table, i)
                        wrong += not math.isfinite(f + k)
                        total += f
                totals[step, i] = total
                n = (normals[0, 0, 0], normals[0, 0, 1], normals[0, 0, 2])
                if normals.shape[1] > 1:
                    n = (normals[step, i, 0], normals[step, i, 1], normals[step, i, 2])
                wanted: Numbers = (tx, ty) if flat else (tx, ty, tz)
                push: Numbers = (gx, gy) if flat else (gx, gy, gz)
                sideward: Numbers = (0.0, 0.0) if flat else (0.0, 0.0, 0.0)

                if slides:
                    along, able = project(wanted, n)
                    if not able:
                        along = default(n)
                    if friction and turned and not math.isnan(table[i, COSINE]):
                        along = turn(table[i, COSINE], table[i, SINE], n)
                    across = cross(along, n)
                    f1 = f2 = 0.0
                    if friction:
                        one = other = index[i, ACTIVE] - 1
                        if index[i, ACTIVE] > 0 and total > 0.0:
                            p = (points[step, i, 0], points[step, i, 1], points[step, i, 2])
                            held = sticking[i, 0] > 0
                            if not held:
                                sticks[i, 0], sticks[i, 1], sticks[i, 2] = p
                            x, y, z = p[0] - sticks[i, 0], p[1] - sticks[i, 1], p[2] - sticks[i, 2]
                            if not held:
                                x = y = z = 0.0
                            away = (y, z) if flat else (x, y, z)
                            e1, e2 = dot(along, away), dot(across, away)
                            k1 = table[i, CONSTANT_1] + table[i, RISING_1] * total
                            k2 = table[i, CONSTANT_2] + table[i, RISING_2] * total
                            t1, t2, l1, l2 = k1 * e1, k2 * e2, table[i, MU_1] * total, table[i, MU_2] * total
                            curved = elliptic and index[i, ELLIPTIC] > 0
                            f1, f2, slip_1, slip_2 = in_limits(t1, t2, l1, l2, curved)
                            if trench and (slip_2 or (curved and slip_1)):  # what sticks without a trench sticks in it
                                l2 = l2 + walls(i, total, p, across, t2 > 0.0, ditch)
                                f1, f2, slip_1, slip_2 = in_limits(t1, t2, l1, l2, curved)
                            m1, m2 = slip_distance(slip_1, e1, f1, k1), slip_distance(slip_2, e2, f2, k2)
                            moved = blend(along, across, m1, m2)
                            if flat:
                                sticks[i, 1], sticks[i, 2] = sticks[i, 1] + moved[0], sticks[i, 2] + moved[1]
                            else:
                                sticks[i, 0], sticks[i, 1] = sticks[i, 0] + moved[0], sticks[i, 1] + moved[1]
                                sticks[i, 2] = sticks[i, 2] + moved[2]
                            f1, f2, one, other = 0.0 - f1, 0.0 - f2, 1 + slip_1, 1 + slip_2
                        else:
                            sticks[i, 0] = sticks[i, 1] = sticks[i, 2] = np.nan
                        sticking[i, 0], sticking[i, 1] = one, other
                        slipping[step, i, 0], slipping[step, i, 1] = one, other
                        sideward = blend(along, across, f1, f2)
                    if lateral:
                        sideward, f1, f2 = added(sideward, push), f1 + dot(along, push), f2 + dot(across, push)
                    rubbing[step, i, 0], rubbing[step, i, 1] = f1, f2

                total_force = reacts(total, n, sideward)
                reaction[step, i, 0], reaction[step, i, 1], reaction[step, i, 2] = total_force
                if not math.isfinite(total_force[0] + total_force[1] + total_force[2]):
                    wrong += not math.isnan(points[step, i, 0])
        return wrong

    return loop


SHARED = (
    passed, unit_of_span, mean_normal, on_piece, from_laid, from_straight, table_resistance, row_of_4, moved_line,
    moved_suction, suction_law, in_limits, *(function for plane in vectors.PLANES.values() for function in plane),
    vectors.tangent_share, vectors.span_scale, on_segment, norm, on_ellipse, in_box, in_ellipse, slip_distance,
    lateral_force, maximum_force, trapezoid, after_cycle, breakout_uplift, next_state, suction_force, spring_suction,
    in_table, on_wall, peak_share, share_of_piece, line_stiffness, on_line, trench_bottom,
)  # fmt: skip
"""Functions that loops call by name."""
