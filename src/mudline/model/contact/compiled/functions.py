"""Functions of single numbers that loops call: searches in tables, histories, centrelines of trenches."""

from __future__ import annotations

import hashlib
import inspect
import math
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mudline.model.contact import vectors
from mudline.model.contact.compiled import FLOOR, LEAST_DEPTH, NOTHING, PER_CYCLE
from mudline.model.contact.laws import MODULES, NormalLaw, PathLaw
from mudline.model.contact.laws.friction import in_box, in_ellipse
from mudline.model.contact.laws.suction import (
    BROKEN,
    COMPRESSION,
    SUCTION,
    after_cycle,
    breakout_uplift,
    next_state,
    suction_force,
)
from mudline.model.contact.laws.trench import in_table, share_of_piece
from mudline.model.contact.laws.unloading import line_stiffness, on_line, trench_bottom

Loop = Callable[..., int]
Wrap = Callable[[Any], Any]
"""Function that makes another function callable in loops, and returns it."""
Array = Any
"""An array; loops are typed when they are compiled."""
Index = Any
"""An unsigned index."""
Point = tuple[float, float, float]
ONE = np.uint64(1)
"""Unsigned 1: with a signed 1, sums of indices would become floats."""


@cache
def edition(laws: tuple[NormalLaw, ...]) -> int:
    """Return a number that changes with the source of loops and laws, so that no outdated loop is reused."""
    texts = [path.read_text(encoding="utf-8") for path in _SOURCES]
    for law in laws:
        of_path = (law.begin, law.pending, *law.locate, law.advance) if isinstance(law, PathLaw) else ()
        texts += [inspect.getsource(function) for function in (law.reaction, law.steepest, *of_path)]
    return int.from_bytes(hashlib.sha256("".join(texts).encode()).digest()[:4], "big")


_CONTACT = Path(__file__).parents[1]
_SOURCES = (
    *(_CONTACT / "compiled" / f"{name}.py" for name in ("__init__", "driver", "functions", "loops")),
    _CONTACT / "vectors.py",
    *(_CONTACT / "laws" / f"{name}.py" for name in ("__init__", *MODULES)),
)


def row_of(wrap: Wrap, count: int) -> Callable[..., Any]:
    """Return a function that returns `count` parameters of a row of a table, from a first column on."""
    if count == 0:
        return wrap(lambda _table, _row, _first: ())  # type: ignore[no-any-return]
    others, last = row_of(wrap, count - 1), count - 1

    def row_of_several(table: Array, row: int, first: int) -> Any:
        return (*others(table, row, first), table[row, first + last])

    return wrap(row_of_several)  # type: ignore[no-any-return]


def choice(wrap: Wrap, functions: tuple[Callable[..., Any], ...]) -> Callable[..., Any]:
    """Return a function that calls the function of a kind, from 0: (kind, *arguments)."""
    first = wrap(functions[0])
    later_functions = choice(wrap, functions[1:]) if functions[1:] else first
    last = len(functions) == 1

    def chosen(kind: int, *arguments: Any) -> Any:
        return first(*arguments) if last or kind == 0 else later_functions(kind - 1, *arguments)

    return wrap(chosen)  # type: ignore[no-any-return]


def one_of(wrap: Wrap, laws: tuple[tuple[Callable[..., Any], int], ...], first: int) -> Callable[..., Any]:
    """Return a function that evaluates the law of a kind, from 0: (kind, z, diameter, table, row).

    `laws` are reactions and their numbers of parameters, which are in a table from the column `first` on.
    """

    def of_law(law: Callable[..., Any], count: int) -> Callable[..., Any]:
        reaction, parameters = wrap(law), row_of(wrap, count)

        def at_row(z: float, diameter: float, table: Array, row: int) -> tuple[float, float]:
            f, k = reaction(z, diameter, *parameters(table, row, first))
            return float(f), float(k)

        return at_row

    def nothing(_z: float, _diameter: float, _table: Array, _row: int) -> tuple[float, float]:
        return 0.0, 0.0

    return choice(wrap, tuple(of_law(*law) for law in laws) or (nothing,))


def followed(wrap: Wrap, laws: tuple[PathLaw, ...], first: int) -> Callable[..., Any]:
    """Return a function that follows the path of a kind, from 0: (kind, z, diameter, table, row, paths, held).

    It writes the memory of the element, the row `held` of `paths`, and returns force and stiffness.
    """

    def of_law(law: PathLaw) -> Callable[..., Any]:
        begin, pending, advance = (wrap(each) for each in (law.begin, law.pending, law.advance))
        locate, last = choice(wrap, law.locate), len(law.start) - 1
        parameters, memory_of, rest_of = (row_of(wrap, count) for count in (len(law.parameters), last + 1, last))

        def follow(z: float, diameter: float, table: Array, row: int, paths: Array, held: int) -> tuple[float, float]:
            soil = parameters(table, row, first)
            memory = begin(z, memory_of(paths, held, 0))
            for column in range(last + 1):
                paths[held, column] = memory[column]
            event = pending(z, memory)
            if event > 0:
                paths[held, last] = locate(event - 1, diameter, memory, soil)
            f, k, memory = advance(z, diameter, (*rest_of(paths, held, 0), paths[held, last]), soil)
            for column in range(last + 1):
                paths[held, column] = memory[column]
            return f, k

        return follow

    def straight(
        _z: float, _diameter: float, _table: Array, _row: int, _paths: Array, _held: int
    ) -> tuple[float, float]:
        return 0.0, 0.0

    return choice(wrap, tuple(map(of_law, laws)) or (straight,))


def last_at_or_below(points: Array, begin: Index, end: Index, value: float) -> Index:
    """Return the last of ascending points begin <= i < end that lies at or below a value; the first if none does."""
    at: Index = np.uint64(begin)
    left = np.uint64(end) - at
    while left > ONE:
        half = left >> ONE
        at += half * np.uint64(value >= points[at + half])  # no branch: its prediction would often fail
        left -= half
    return at


def point_of(values: Array, step: Index, row: Index) -> Point:
    """Return three components of an array (steps, k, 3)."""
    return values[step, row, 0], values[step, row, 1], values[step, row, 2]


def direction_of(points: Array, step: Index, a: Index, b: Index) -> Point:
    """Return the direction from a node to another; 0 if they coincide or one of them is absent."""
    p, q = point_of(points, step, a), point_of(points, step, b)
    dx, dy, dz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
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


def next_unloading(
    z: float, before: Numbers, virgin: tuple[float, float, float], diameter: float, stiffness: float
) -> tuple[Numbers, tuple[float, float, float]]:
    """Return the unloading history of an element at a penetration, and its force, slope and stiffness.

    `before` are z_max, F_max, ku' and z_p; `virgin` force, slope and stiffness of the virgin path; `stiffness` the
    larger of ku and the steepest slope of the virgin path.
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


def next_suction(
    before: tuple[bool, int, Numbers],
    uplift: float,
    pressed: bool,  # noqa: FBT001 - loops pass arguments by place
    v: float,
    law: Numbers,
) -> tuple[tuple[bool, int, Numbers], float, float, bool]:
    """Return the suction history of an element: armed, state, numbers; force, stiffness, and whether v < v_r.

    `law` is a row of the table of suction laws.
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


def on_piece(laid: Array, ends: Array, element: Index, point: Point) -> tuple[float, float, float, float, float]:
    """Return the share of the nearest point of an element as laid, the vector from that point, and its square."""
    a, b = ends[element, 0], ends[element, 1]
    x, y, z = laid[a, 0], laid[a, 1], laid[a, 2]
    span = (laid[b, 0] - x, laid[b, 1] - y, laid[b, 2] - z)
    square = vectors.dot_3(span, span)
    inverse = 1.0 / square if square > vectors.LEAST_SQUARE else 0.0
    x, y, z = point[0] - x, point[1] - y, point[2] - z
    share = np.minimum(np.maximum(share_of_piece((x, y, z), span, inverse), 0.0), 1.0)
    x, y, z = x - share * span[0], y - share * span[1], z - share * span[2]
    return share, x, y, z, x * x + y * y + z * z


def from_laid(laid: Array, beside: Array, node: Index, point: Point) -> Point:
    """Return the vector from the nearest point of the line as `laid` (n, 3), found from the node's place along it.

    `beside` has the nodes of each element, then the first two elements at each node.
    """
    ends, elements_at = beside
    current = elements_at[node, 0]
    if current == NOTHING:
        return 0.0, 0.0, 0.0
    share, x, y, z, square = on_piece(laid, ends, current, point)
    following = elements_at[node, 1]
    if following != NOTHING:
        second = on_piece(laid, ends, following, point)
        if second[4] < square:
            current, share, x, y, z, square = following, second[0], second[1], second[2], second[3], second[4]
    walks = share == (0.0 if ends[current, 1] == node else 1.0) and square > 0.0
    while walks:
        at = ends[current, 0] if share <= 0.0 else ends[current, 1]
        following = elements_at[at, 1] if elements_at[at, 0] == current else elements_at[at, 0]
        walks = False
        if following != NOTHING:
            second = on_piece(laid, ends, following, point)
            if second[4] < square:
                current, share, x, y, z, square = following, second[0], second[1], second[2], second[3], second[4]
                walks = share <= 0.0 or share >= 1.0
    return x, y, z


def table_resistance(rows: Array, begin: Index, end: Index, distance: float) -> float:
    """Return the resistance per unit length, at a distance, of the table in rows `begin` to `end`."""
    last = np.uint64(end) - ONE
    row = last_at_or_below(rows[0], begin, last, distance)
    if distance > rows[0, last]:
        row = last
    held = np.minimum(np.maximum(distance, rows[0, begin]), rows[0, last])
    value: float = in_table(held, rows[0, row], rows[1, row], rows[2, row], rows[3, row])
    return value


def in_limits(t1: float, t2: float, l1: float, l2: float, elliptic: bool) -> tuple[float, float, bool, bool]:  # noqa: FBT001
    """Return forces in the springs and whether they slip, with the ellipse or the box."""
    if not elliptic:
        f1, slip_1 = in_box(t1, l1)
        f2, slip_2 = in_box(t2, l2)
    elif np.abs(t1) < 0.5 * l1 and np.abs(t2) < 0.5 * l2 and l1 + l2 < math.inf:
        f1, f2, slip_1, slip_2 = t1, t2, False, False  # well within
    else:
        f1, f2, slip_1, slip_2 = in_ellipse(t1, t2, l1, l2)
    return f1, f2, slip_1, slip_2


def from_straight(lines: Array, line: int, p: Point) -> Point:
    """Return the vector from a straight centreline, at the point's own elevation."""
    y, z, span = p[1] - lines[line, 0], p[2] - lines[line, 1], (0.0, lines[line, 2], lines[line, 3])
    share = share_of_piece((p[0], y, z), span, 1.0)
    return 0.0, y - share * span[1], z - share * span[2]
