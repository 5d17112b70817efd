"""The loops over elements (normal laws, unloading, suction, lateral springs) and over nodes (sums, friction)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from mudline.model.contact import compiled as col
from mudline.model.contact import vectors
from mudline.model.contact.compiled import FIRST_LAW, NOTHING, ON_CURVE, Features
from mudline.model.contact.compiled.functions import (
    ONE,
    Array,
    Index,
    Loop,
    Numbers,
    Point,
    Wrap,
    direction_of,
    followed,
    from_laid,
    from_straight,
    in_limits,
    last_at_or_below,
    next_suction,
    next_unloading,
    one_of,
    point_of,
    row_of,
    table_resistance,
)
from mudline.model.contact.laws import PathLaw
from mudline.model.contact.laws.breakout import reached, shares
from mudline.model.contact.laws.friction import slip_distance
from mudline.model.contact.laws.linear import damping_force, lateral_force, on_segment, spring_suction
from mudline.model.contact.laws.suction import SUCTION
from mudline.model.contact.laws.trench import PEAK, WALL, on_wall, peak_share


def _components(wrap: Wrap, has: Features) -> tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]:
    """Return functions that take, read and write the components of a vector in the plane of the seabed."""
    flat, axes = has.flat, 2 if has.flat else 3

    def in_plane(vector: Point) -> Numbers:
        return vector[1:] if flat else vector

    def read(values: Array, step: Index, row: Index) -> Numbers:
        return (values[step, row, 0], values[step, row, 1]) if flat else point_of(values, step, row)

    def write(values: Array, step: Index, row: Index, vector: Numbers) -> None:
        for axis in range(axes):
            values[step, row, axis] = vector[axis]

    return wrap(in_plane), wrap(read), wrap(write)


def elements_loop(
    wrap: Wrap,
    has: Features,
    laws: tuple[tuple[Callable[..., Any], int], ...],
    paths: tuple[PathLaw, ...],
    slopes: tuple[tuple[Callable[..., Any], int], ...],
    edition: int,
) -> Loop:
    """Return the loop over elements.

    `laws` are the normal laws with equations, `paths` the first of them, which follow a path. `slopes` are their
    steepest slopes in the form of reactions, if an unloading line may be less steep than the virgin path.
    """
    curves, cuts, unloading, steepens, springs = has.curves, has.cuts, has.unloading, has.steepens, has.springs
    suction, slides, lateral, flat, damps = has.suction, has.slides, has.lateral, has.flat, has.damping
    plane = vectors.PLANES[2 if has.flat else 3]
    project, default, cross, dot, blend = plane.project, plane.default, plane.across, plane.dot, plane.blend
    in_plane, _, write = _components(wrap, has)
    nothing = (0.0, 0.0) if has.flat else (0.0, 0.0, 0.0)
    suction_law = row_of(wrap, col.SUCTION_COLUMNS)
    normal_law, steepest = one_of(wrap, laws, col.LAW), one_of(wrap, slopes, col.LAW)
    follow, follows = followed(wrap, paths, col.LAW), has.paths

    def loop(
        begin: Index, end: Index, tables: Array, points: Array, speed: Array, work: Array, part: Array, before: Array,
        states: Array,
    ) -> int:  # fmt: skip
        index, table, knots, pulls, damping = tables
        gap, normals, (out, cut, state, regularised), _ = part
        depth, ratio, contact, force, slope, stiffness = out
        tangent, sideways = work
        lines, episodes, touchdown, ways = states
        past_lines, past_episodes, places, _ = before
        wrong = min(edition, 0)
        for step in range(np.uint64(len(gap))):
            if step > 0:
                past_lines, past_episodes, places = lines, episodes, touchdown
            for e in range(begin, end):
                a, b, kind = index[e, col.FIRST], index[e, col.SECOND], np.int64(index[e, col.KIND])
                diameter, onset = table[e, col.DIAMETER], table[e, col.ONSET]
                deep = 0.0 - (0.5 * gap[step, a] + 0.5 * gap[step, b])
                share = deep / diameter
                touches = deep > onset
                wrong += math.isinf(share) | math.isinf(deep)

                f = k = 0.0
                s = 0.0 * diameter  # NaN without a diameter
                segment: Index = np.uint64(0)
                if follows and index[e, col.PATH] != NOTHING:
                    z = max(0.0, deep)  # of NaN 0
                    f, k = follow(kind - FIRST_LAW, z, diameter, table, e, ways, index[e, col.PATH])
                    f, k = (f, k) if touches else (0.0, 0.0)
                    s = k * diameter
                elif touches and curves and kind == ON_CURVE:
                    segment = last_at_or_below(knots[0], index[e, col.CURVE_START], index[e, col.CURVE_END], share)
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
                if unloading and index[e, col.UNLOADS] != NOTHING:
                    u, z, steep = index[e, col.UNLOADS], max(0.0, deep), table[e, col.LINE]
                    if steepens and curves and kind == ON_CURVE and touches:
                        # at a point the segment to its right is not included
                        back = share == knots[0, segment] and segment > index[e, col.CURVE_START]
                        steep = np.maximum(steep, knots[3, segment - ONE if back else segment] / diameter)
                    elif steepens and kind >= FIRST_LAW and touches:
                        steep = np.maximum(steep, steepest(kind - FIRST_LAW, z, diameter, table, e)[0])
                    line: Numbers = (past_lines[0][u], past_lines[1][u], past_lines[2][u], past_lines[3][u])
                    if curves and cuts:
                        cut[step, e] &= z > line[0]
                    line, (f, s, k) = next_unloading(z, line, (f, s, k), diameter, steep)
                    lines[0][u], lines[1][u], lines[2][u], lines[3][u] = line
                    uplift, pressed = line[3] - deep, z > line[3]

                if springs and table[e, col.SPRING] > 0.0:
                    g, h = spring_suction(onset - deep, table[e, col.SPRING], table[e, col.EXTENT])
                    f, s, k = f + g, s + h * diameter, k + h

                if damps:
                    f = f + damping_force(deep, 0.5 * speed[step, a] + 0.5 * speed[step, b], damping[e])

                if suction and index[e, col.PULLS] != NOTHING:
                    held, v = index[e, col.PULLS], 0.5 * speed[step, a] + 0.5 * speed[step, b]
                    state[step, e], regularised[step, e] = 0, False
                    if step == 0 or pressed or past_episodes[0][held] or past_episodes[1][held] != 0:  # else idle
                        known = (past_episodes[2][held], past_episodes[3][held], past_episodes[4][held])
                        was = (past_episodes[0][held], past_episodes[1][held], known)
                        now, g, h, slow = next_suction(was, uplift, pressed, v, suction_law(pulls, held, 0))
                        if now[1] == SUCTION:
                            f, s, k = f + g, s + h * diameter, k + h
                        episodes[0][held], episodes[1][held] = now[0], now[1]
                        episodes[2][held], episodes[3][held], episodes[4][held] = now[2]
                        state[step, e], regularised[step, e] = now[1], slow

                wrong += (not math.isfinite(f + k)) | math.isinf(s)
                depth[step, e], ratio[step, e], contact[step, e] = deep, share, touches
                force[step, e], slope[step, e], stiffness[step, e] = f, s, k
                if not slides:
                    continue

                # only nodes with a normal force use a direction: NaN marks an element that wrote none
                unit = nothing
                if touches:
                    unit = in_plane(direction_of(points, step, a, b))
                    write(tangent, step, e, unit)
                else:
                    tangent[step, e, 0] = np.nan
                if lateral:
                    push = nothing
                    if index[e, col.SPRINGS_BACK] != NOTHING:
                        held, place = index[e, col.SPRINGS_BACK], (np.nan, np.nan, np.nan)
                        if touches:
                            p, q = point_of(points, step, a), point_of(points, step, b)
                            x, y, z = 0.5 * p[0] + 0.5 * q[0], 0.5 * p[1] + 0.5 * q[1], 0.5 * p[2] + 0.5 * q[2]
                            place = (places[0, held], places[1, held], places[2, held])
                            if math.isnan(place[0]):
                                place = (x, y, z)
                            n = point_of(normals, 0, 0)
                            if not flat and normals.shape[1] > 1:
                                n = vectors.mean_normal(point_of(normals, step, a), point_of(normals, step, b))
                            along, exists = project(unit, n)
                            if not exists:
                                along = default(n)
                            across = cross(along, n)
                            arm = in_plane((x - place[0], y - place[1], z - place[2]))
                            size = lateral_force(table[e, col.LATERAL], dot(across, arm))
                            push = blend(across, nothing, size, 0.0)
                        touchdown[0, held], touchdown[1, held], touchdown[2, held] = place
                    write(sideways, step, e, push)
        return wrong

    return loop


def _trench_limit(has: Features) -> Callable[..., Any]:
    """Return a function for the resistance of trenches against the lateral motion of a node to one side."""
    flat, tables = has.flat, has.tables
    dot = vectors.PLANES[2 if has.flat else 3].dot

    def walls(i: int, total: float, p: Point, across: Array, forward: bool, trenches: Array) -> float:  # noqa: FBT001
        ((first, behind), index, table, lines, rows), (laid, beside) = trenches
        added = 0.0
        for at in range(first[i], behind[i]):
            line, kind, amount = index[at, col.CENTRELINE], index[at, col.TRENCH_KIND], table[at, col.AMOUNT]
            x, y, z = from_laid(laid, beside, i, p) if line == NOTHING else from_straight(lines, line, p)
            offset = dot(across, (y, z)) if flat else dot(across, (x, y, z))
            if (offset > 0.0) if forward else (offset < 0.0):
                distance = np.abs(offset)
                if kind == PEAK:
                    added += amount * peak_share(
                        distance, table[at, col.INNER], table[at, col.OUTER], table[at, col.STEEPNESS]
                    )
                elif kind == WALL:
                    added += amount * total * on_wall(distance, table[at, col.INNER], table[at, col.OUTER])
                elif tables:
                    added += amount * table_resistance(
                        rows, index[at, col.TABLE_START], index[at, col.TABLE_END], distance
                    )
        return added

    return walls


def _softened(has: Features) -> Callable[..., Any]:
    """Return a function that updates a node with a breakout, and returns the remaining spring and limit."""
    flat, embeds = has.flat, has.embeds
    dot = vectors.PLANES[2 if has.flat else 3].dot

    def soften(at: int, p: Point, across: Array, deep: float, table: Array, held: Array) -> tuple[float, float]:
        x, y, z = p[0] - held[0, at], p[1] - held[1, at], p[2] - held[2, at]
        distance = dot(across, (y, z)) if flat else dot(across, (x, y, z))
        law: Numbers = (table[at, 0], table[at, 1], table[at, 2], table[at, 3], table[at, 4])
        held[3, at], held[4, at] = reached(
            (held[3, at], held[4, at]), distance, deep * table[at, 5] if embeds else 0.0, law
        )
        share, _, softer = shares(held[3, at], held[4, at], law)
        return softer, share

    return soften


def nodes_loop(wrap: Wrap, has: Features, laws: tuple[tuple[Callable[..., Any], int], ...], edition: int) -> Loop:
    """Return the loop over nodes: sums of element forces, nodal springs, friction, lateral springs and reactions."""
    friction, turned, lateral, nodal, slides = has.friction, has.turned, has.lateral, has.nodal, has.slides
    turns, moves = has.turns, has.velocities
    flat, elliptic, trench, breakout, damps = has.flat, has.elliptic, has.trench, has.breakout, has.nodal_damping
    plane = vectors.PLANES[2 if has.flat else 3]
    project, default, cross, dot, turn = plane.project, plane.default, plane.across, plane.dot, plane.turned
    blend, added, reacts = plane.blend, plane.added, plane.reaction
    normal_law = one_of(wrap, laws, col.NODE_LAW)
    walls, soften = wrap(_trench_limit(has)), wrap(_softened(has))
    in_plane, read, _ = _components(wrap, has)
    nothing = (0.0, 0.0) if has.flat else (0.0, 0.0, 0.0)

    def loop(
        begin: Index, end: Index, tables: Array, points: Array, speed: Array, laid: Array, work: Array, part: Array,
        before: Array, states: Array,
    ) -> int:  # fmt: skip
        (first, behind), elements, senses, half, ends, index, table, damping, trenches, breaks = tables
        gap, normals, ((_, ratio, _, force, _, _), _, _, _), (totals, reaction, friction_force, slipping) = part
        tangent, sideways = work
        sticks, sticking, moved_so_far = states
        past_sticks, past_sticking, _ = before
        wrong = min(edition, 0)
        for step in range(np.uint64(len(gap))):
            if step > 0:
                past_sticks, past_sticking = sticks, sticking
            for i in range(begin, end):
                total = 0.0
                direction = push = sideward = nothing
                for at in range(first[i], behind[i]):
                    e = elements[at]
                    total += force[step, e] * half[e]
                    if lateral:
                        push = added(push, read(sideways, step, e))
                if nodal and index[i, col.NODE_KIND] != NOTHING:
                    z = 0.0 - gap[step, i]
                    if z > table[i, col.NODE_ONSET]:
                        f, k = normal_law(np.int64(index[i, col.NODE_KIND]), z, 0.0, table, i)
                        wrong += not math.isfinite(f + k)
                        total += f
                if damps:
                    total += damping_force(0.0 - gap[step, i], speed[step, i], damping[i])
                if moves:
                    wrong += not (math.isfinite(speed[step, i]) or math.isnan(gap[step, i]))
                totals[step, i] = total
                n = point_of(normals, 0, 0)
                if normals.shape[1] > 1:
                    n = point_of(normals, step, i)

                if slides:
                    f1 = f2 = 0.0
                    along = across = nothing
                    slides_here = friction and index[i, col.ACTIVE] > 0 and total > 0.0
                    if slides_here or (lateral and push != nothing):  # else there is no force along any direction
                        for at in range(first[i], behind[i]):
                            e = elements[at]
                            unit = read(tangent, step, e)
                            if math.isnan(unit[0]):
                                unit = in_plane(direction_of(points, step, ends[e, col.FIRST], ends[e, col.SECOND]))
                            direction = blend(direction, unit, 1.0, senses[at] if turns else 1.0)
                        along, exists = project(direction, n)
                        if not exists:
                            along = default(n)
                        if friction and turned and not math.isnan(table[i, col.COSINE]):
                            along = turn(table[i, col.COSINE], table[i, col.SINE], n)
                        across = cross(along, n)
                    if friction:
                        state_1: Index = np.int64(index[i, col.ACTIVE]) - 1
                        state_2 = state_1
                        if slides_here:
                            p = point_of(points, step, i)
                            held = past_sticking[0, i] > 0
                            stick = (past_sticks[0, i], past_sticks[1, i], past_sticks[2, i])
                            # no branch: its prediction would often fail
                            stick = (
                                stick[0] if held else p[0],
                                stick[1] if held else p[1],
                                stick[2] if held else p[2],
                            )
                            away = in_plane((p[0] - stick[0], p[1] - stick[1], p[2] - stick[2]))
                            e1, e2 = dot(along, away), dot(across, away)
                            k1 = table[i, col.CONSTANT_1] + table[i, col.RISING_1] * total
                            k2 = table[i, col.CONSTANT_2] + table[i, col.RISING_2] * total
                            t1, t2, l1, l2 = k1 * e1, k2 * e2, table[i, col.MU_1] * total, table[i, col.MU_2] * total
                            if breakout and index[i, col.BREAKS_OUT] != NOTHING:
                                if not held:
                                    moved_so_far[3:, index[i, col.BREAKS_OUT]] = 0.0
                                    for axis in range(3):
                                        moved_so_far[axis, index[i, col.BREAKS_OUT]] = p[axis]
                                deep = 0.0
                                for at in range(first[i], behind[i]):
                                    deep += ratio[step, elements[at]]
                                soft, share = soften(index[i, col.BREAKS_OUT], p, across, deep, breaks, moved_so_far)
                                k2, l2 = k2 * soft, l2 * share
                                t2 = k2 * e2
                            curved = elliptic and index[i, col.ELLIPTIC] > 0
                            f1, f2, slip_1, slip_2 = in_limits(t1, t2, l1, l2, curved)
                            if trench and (slip_2 or (curved and slip_1)):  # sticking without a trench: sticking in it
                                l2 = l2 + walls(i, total, p, across, t2 > 0.0, (trenches, laid))
                                f1, f2, slip_1, slip_2 = in_limits(t1, t2, l1, l2, curved)
                            m1 = m2 = 0.0
                            if slip_1 or slip_2:
                                m1, m2 = slip_distance(slip_1, e1, f1, k1), slip_distance(slip_2, e2, f2, k2)
                            moved = blend(along, across, m1, m2)
                            if flat:
                                stick = (stick[0], stick[1] + moved[0], stick[2] + moved[1])
                            else:
                                stick = (stick[0] + moved[0], stick[1] + moved[1], stick[2] + moved[2])
                            sticks[0, i], sticks[1, i], sticks[2, i] = stick
                            f1, f2, state_1, state_2 = 0.0 - f1, 0.0 - f2, 1 + slip_1, 1 + slip_2
                        else:
                            sticks[0, i] = sticks[1, i] = sticks[2, i] = np.nan
                            if breakout and index[i, col.BREAKS_OUT] != NOTHING:
                                moved_so_far[:3, index[i, col.BREAKS_OUT]] = np.nan
                                moved_so_far[3:, index[i, col.BREAKS_OUT]] = 0.0
                        sticking[0, i], sticking[1, i] = state_1, state_2
                        slipping[step, i, 0], slipping[step, i, 1] = state_1, state_2
                        sideward = blend(along, across, f1, f2)
                    if lateral:
                        sideward, f1, f2 = added(sideward, push), f1 + dot(along, push), f2 + dot(across, push)
                    friction_force[step, i, 0], friction_force[step, i, 1] = f1, f2

                total_force = reacts(total, n, sideward)
                reaction[step, i, 0], reaction[step, i, 1], reaction[step, i, 2] = total_force
                if not math.isfinite(total_force[0] + total_force[1] + total_force[2]):
                    wrong += not math.isnan(points[step, i, 0])
        return wrong

    return loop


def whole_loop(wrap: Wrap, of_elements: tuple[Any, ...], of_nodes: tuple[Any, ...]) -> Loop:
    """Return the loop over a range of elements and then over a range of nodes: begin, end, begin, end.

    After the ranges it takes tables of elements and of nodes, positions, velocities, the line as laid, element values
    for the nodes, the results, and the states before and after.
    """
    elements, nodes = wrap(elements_loop(wrap, *of_elements)), wrap(nodes_loop(wrap, *of_nodes))

    def loop(
        ranges: Array, element_tables: Array, node_tables: Array, points: Array, speed: Array, laid: Array,
        work: Array, part: Array, before: Array, after: Array,
    ) -> int:  # fmt: skip
        wrong: int = elements(ranges[0], ranges[1], element_tables, points, speed, work, part, before[0], after[0])
        wrong += nodes(ranges[2], ranges[3], node_tables, points, speed, laid, work, part, before[1], after[1])
        return wrong

    return loop
