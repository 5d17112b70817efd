"""The laws driven by compiled loops, for the extra `mudline[fast]`.

`loops` makes the loops over elements and over nodes. Each takes flags and laws, which are constants of the compiled
loop: features that a scene lacks are not compiled. A loop runs over a range of rows and all steps of a batch, writes
its part of a result, updates the states, and returns the number of values that are not finite.

All arrays of a result are (steps, m) for elements and (steps, n) for nodes. The numpy driver does the same operations
in the same order, so both give the same bits.

This module makes the input of the loops: tables with a row for each element or node, and the features of a scene.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from mudline.basics import arguments
from mudline.model.contact.laws import law_module
from mudline.model.contact.tables import LawTables, NormalRows

# Columns of the table of numbers of elements, before the parameters of their normal laws.
DIAMETER, ONSET, LINE, SPRING, EXTENT, LATERAL, LAW = range(7)
# Columns of the table of indices of elements.
FIRST, SECOND, KIND, CURVE_START, CURVE_END, UNLOADS, PULLS, SPRINGS_BACK, PATH, INDICES = range(10)
# Columns of the table of suction laws: the parameters of `SuctionLaw`, then these.
PER_CYCLE, FLOOR, LEAST_DEPTH, SUCTION_COLUMNS = 9, 10, 11, 12
# Columns of the table of numbers of nodes, before the parameters of their normal laws.
MU_1, MU_2, CONSTANT_1, CONSTANT_2, RISING_1, RISING_2, COSINE, SINE, NODE_ONSET, NODE_LAW = range(10)
# Columns of the table of indices of nodes.
ACTIVE, ELLIPTIC, NODE_KIND, BREAKS_OUT, NODE_INDICES = range(5)
# Columns of the tables of trenches.
INNER, OUTER, STEEPNESS, AMOUNT, TRENCH_NUMBERS = range(5)
TRENCH_KIND, TABLE_START, TABLE_END, CENTRELINE, TRENCH_INDICES = range(5)

NOTHING = 2**32 - 1
""""None" in tables of indices, which are unsigned: signed ones would be checked for a count from the end."""

NO_LAW, ON_CURVE, FIRST_LAW = 0, 1, 2
"""Kinds of normal laws of elements; laws with an equation are numbered from the last kind on."""


class Features(NamedTuple):
    """Features of a scene that the compiled loops depend on."""

    flat: bool
    curves: bool
    paths: bool
    cuts: bool
    unloading: bool
    steepens: bool
    springs: bool
    damping: bool
    nodal_damping: bool
    suction: bool
    slides: bool
    turns: bool
    lateral: bool
    nodal: bool
    friction: bool
    elliptic: bool
    turned: bool
    trench: bool
    tables: bool
    breakout: bool
    embeds: bool
    velocities: bool


def features_of(tables: LawTables, *, flat: bool) -> Features:
    """Return the features of a scene."""
    friction, trench = tables.friction, tables.trench
    own = "unloading", "springs", "damping", "nodal_damping", "suction", "lateral", "friction", "trench", "breakout"
    return Features(
        **{name: getattr(tables, name) is not None for name in own},
        flat=flat,
        curves=any(rows.curve for rows in tables.normal),
        paths=any(rows.path >= 0 for rows in tables.normal),
        cuts=tables.cuts,
        steepens=tables.steepens,
        slides=friction is not None or tables.lateral is not None,
        turns=tables.line.turns,
        nodal=bool(tables.nodal),
        elliptic=friction is not None and bool(friction.ellipse.any()),
        turned=friction is not None and bool(friction.turned.size),
        tables=trench is not None and bool((trench.table >= 0).any()),
        embeds=tables.embeds,
        velocities=tables.velocities,
    )


def formulas(tables: LawTables) -> list[NormalRows]:
    """Return the normal laws of elements with an equation in the order of their kinds, those with a path first."""
    return sorted((rows for rows in tables.normal if rows.curve is None), key=lambda rows: rows.path < 0)


def element_tables(tables: LawTables) -> tuple[Any, Any, Any]:
    """Return indices (m, c) and numbers (m, c) of the elements, and all curves.

    Curves are (4, k): ratios, forces, slopes after the points, and the steepest slopes up to there.
    """
    given, count = tables.given, len(tables.half)
    most = max((len(rows.columns) for rows in formulas(tables)), default=0)
    index, numbers = np.full((count, INDICES), NOTHING, np.uint32), np.zeros((count, LAW + most))
    index[:, FIRST], index[:, SECOND] = tables.line.first, tables.line.second
    index[:, KIND] = NO_LAW
    numbers[:, DIAMETER] = given.diameter
    numbers[:, ONSET] = 0.0 if tables.onset is None else tables.onset
    for kind, rows in enumerate(formulas(tables), FIRST_LAW):
        index[rows.rows, KIND] = kind
        index[rows.rows, PATH] = np.arange(len(rows.rows)) + rows.path if rows.path >= 0 else NOTHING
        for column, values in enumerate(rows.columns, LAW):
            numbers[rows.rows, column] = values
    knots = [np.empty((4, 0))]
    start = 0
    for rows in tables.normal:
        if (curve := rows.curve) is not None:
            each, steepest = curve.slopes, law_module("linear").steepest_slopes(curve)
            knots.append(
                np.stack([curve.ratios, curve.forces, np.append(each, each[-1]), np.append(steepest, steepest[-1])])
            )
            index[rows.rows, KIND] = ON_CURVE
            index[rows.rows, CURVE_START] = start
            start += len(curve.ratios)
            index[rows.rows, CURVE_END] = start
    places = ((tables.unloading, UNLOADS), (tables.suction, PULLS), (tables.lateral, SPRINGS_BACK))
    for law, column in places:
        if law is not None:
            index[law.rows, column] = np.arange(len(law.rows))
    columns = ((tables.unloading, (LINE,)), (tables.springs, (SPRING, EXTENT)), (tables.lateral, (LATERAL,)))
    for law, names in columns:
        if law is not None:
            for column, values in zip(names, law.columns, strict=True):
                numbers[law.rows, column] = values
    return read_only(index), read_only(numbers), read_only(np.concatenate(knots, axis=1))


def suction_table(tables: LawTables) -> Any:
    """Return the suction laws (k, c)."""
    if tables.suction is None:
        return read_only(np.empty((0, SUCTION_COLUMNS)))
    law = law_module("suction").SuctionLaw(*tables.suction.columns)
    return read_only(np.column_stack([*law, law.factor_per_cycle, np.nan_to_num(law.cyclic_floor), law.least_depth]))


def node_tables(tables: LawTables) -> tuple[Any, Any]:
    """Return indices (n, c) and numbers (n, c) of the nodes."""
    count = len(tables.given.node_ids)
    most = max((len(rows.columns) for rows in tables.nodal), default=0)
    index, numbers = np.full((count, NODE_INDICES), NOTHING, np.uint32), np.zeros((count, NODE_LAW + most))
    numbers[:, COSINE] = np.nan
    for kind, rows in enumerate(tables.nodal):
        index[rows.rows, NODE_KIND] = kind
        numbers[rows.rows, NODE_ONSET] = rows.law.onset(*rows.columns)
        for column, values in enumerate(rows.columns, NODE_LAW):
            numbers[rows.rows, column] = values
    friction = tables.friction
    if friction is not None:
        index[:, ACTIVE], index[:, ELLIPTIC] = friction.active, friction.ellipse
        pairs = ((MU_1, friction.coefficients), (CONSTANT_1, friction.fixed), (RISING_1, friction.rising))
        for column, values in pairs:
            numbers[:, column : column + 2] = values
        numbers[friction.turned, COSINE], numbers[friction.turned, SINE] = friction.cosine, friction.sine
    if tables.breakout is not None:
        index[tables.breakout.rows, BREAKS_OUT] = np.arange(len(tables.breakout.rows))
    return read_only(index), read_only(numbers)


def breakout_table(tables: LawTables) -> Any:
    """Return the breakout laws (k, 6): the parameters, and 1 over the number of elements at the node."""
    rows = tables.breakout
    return read_only(np.empty((0, 6)) if rows is None else np.column_stack((*rows.columns, tables.shares)))


def trench_tables(tables: LawTables) -> tuple[Any, ...]:
    """Return the trenches: start for each node, indices, numbers, straight centrelines, rows of all tables."""
    trench = tables.trench
    if trench is None:
        none = (np.empty((0, TRENCH_NUMBERS)), np.empty((0, 4)), np.empty((4, 0)))
        return between(np.zeros(1)), read_only(np.zeros((0, TRENCH_INDICES), np.uint32)), *map(read_only, none)
    rows = [np.stack(table) for table in trench.tables]
    starts = np.append(0, np.cumsum([table.shape[1] for table in rows]))
    index = np.full((len(trench.nodes), TRENCH_INDICES), NOTHING, np.uint32)
    index[:, TRENCH_KIND] = trench.kind
    index[:, CENTRELINE] = np.where(trench.line < 0, np.uint32(NOTHING), trench.line)
    tabled = trench.table >= 0
    index[tabled, TABLE_START] = starts[trench.table[tabled]]
    index[tabled, TABLE_END] = starts[trench.table[tabled] + 1]
    numbers = np.column_stack([trench.inner, trench.outer, trench.steepness, trench.amount])
    every = np.concatenate([np.empty((4, 0)), *rows], axis=1)
    return between(trench.start), *map(read_only, (index, numbers, trench.lines, every))


def read_only(array: Any) -> Any:
    """Return a read-only contiguous view or copy: a single type to compile for."""
    return arguments.read_only(np.ascontiguousarray(array))


def plain(array: Any) -> Any:
    """Return the array, or a contiguous writeable copy: a single type to compile for."""
    return array if array.flags.c_contiguous and array.flags.writeable else np.array(array, order="C")


def between(start: Any) -> tuple[Any, Any]:
    """Return the begin and the end of the rows of each node, from `start` (n + 1,)."""
    return read_only(start[:-1].astype(np.uint32)), read_only(start[1:].astype(np.uint32))


def beside(ends: Any, elements_at: Any) -> tuple[Any, Any]:
    """Return the nodes of elements (m, 2) and the first two elements at each node (n, 2)."""
    first_two = np.where(elements_at < 0, NOTHING, elements_at)
    return read_only(ends.astype(np.uint32)), read_only(first_two.astype(np.uint32))
