"""The largest stiffness and damping of each law on each element, which a time step must resolve.

Without positions they are the largest that a law can reach:

* normal laws: the steepest slope at any penetration; unloading lines: their own stiffness, or the steepest slope of the
  virgin path if larger;
* friction: the spring of a node that sticks; a spring with a mobilisation length has mu N / length under the static
  normal force, the submerged weight of half of each of the node's elements;
* breakout: the fall to the residual under the static normal force, as an amount: it softens;
* lateral springs and springs against uplift: their stiffness;
* suction: F_max / (xc1 Delta_B) while it is mobilised, and dF_max/dv, both at the pull-out velocity that makes them
  largest: with the exponents of Bridge et al. v_r for the stiffness and rest for the damping. Infinite where a law has
  no largest value: without a regularisation, or with exponents that grow with the velocity.

With positions they are the largest that occur there.
"""

from __future__ import annotations

from decimal import ROUND_DOWN, Context
from typing import Literal, NamedTuple

import numpy as np

from mudline.basics.short_repr import UnknownNameError, outline, short_repr
from mudline.model.contact.arrays import FloatArray, IndexArray, summed
from mudline.model.contact.laws import Law, Reached, known_laws
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import LawTables, NormalRows, steepest_anywhere


class LawStiffness(NamedTuple):
    """One law on the elements (m,) of a model; NaN for elements without the law, and for unknown values.

    Attributes:
        law: name of the law.
        stiffness: largest force per displacement.
        damping: largest force per velocity; 0 for laws without damping.
        per: reference of both: unit "length" of the element, or its stiffer "node".
        at_nodes: stiffness of the nodes (n,), NaN for nodes without the law; None for laws of elements.
    """

    law: str
    stiffness: FloatArray
    damping: FloatArray
    per: Literal["length", "node"]
    at_nodes: FloatArray | None = None

    def __repr__(self) -> str:
        return short_repr(self)


class Stiffest(NamedTuple):
    """The largest stiffness and damping of all laws of a model."""

    laws: tuple[LawStiffness, ...]

    def __repr__(self) -> str:
        return outline("Stiffest", ", ".join(law.law for law in self.laws) or "no laws")

    def __getitem__(self, law: str | int | slice) -> LawStiffness:  # type: ignore[override]
        """Return a law by its name; UnknownNameError, a KeyError, if the model does not have it."""
        for entry in self.laws:
            if entry.law == law:
                return entry
        raise UnknownNameError.among("law", law, [entry.law for entry in self.laws])

    def per_length(self, tables_length: FloatArray) -> FloatArray:
        """Return the largest stiffness (m,) of laws per unit length and of nodes over `tables_length` (m,)."""
        columns = [law.stiffness / tables_length if law.per == "node" else law.stiffness for law in self.laws]
        return np.fmax.reduce(columns) if columns else np.full(len(tables_length), np.nan)


def stiffest(tables: LawTables, result: ContactResult | None, speed: FloatArray | None) -> Stiffest:
    """Return the largest stiffness and damping of each law.

    `result` has the forces at some positions, and `speed` (..., n) the velocities along the normals there; None for the
    largest values that the laws can reach.
    """
    laws = []
    with np.errstate(all="ignore"):
        normal = [*tables.normal, *tables.nodal]
        for name in dict.fromkeys(rows.law.name for rows in sorted(normal, key=lambda rows: rows.curve is not None)):
            same = [rows for rows in normal if rows.law.name == name]
            slopes = np.concatenate([_slope(tables, rows, result) for rows in same])
            laws.append(_of_law(tables, same[0].law, np.concatenate([rows.rows for rows in same]), slopes))
        reached = _reached(tables, result, speed)
        for name in known_laws():
            entry = tables.given.assigned.get(name)
            if entry is not None and entry.law.largest is not None:
                own = reached.of_rows(entry.rows, entry.law.acts_on)
                laws.append(_of_law(tables, entry.law, entry.rows, *entry.law.largest(own, entry.parameters)))
    return Stiffest(tuple(laws))


def _of_law(
    tables: LawTables, law: Law, rows: IndexArray, stiffness: FloatArray, damping: FloatArray | None = None
) -> LawStiffness:
    """Return the values of a law on some rows; for rows of nodes an element has the larger value of its two nodes."""
    ends, of_nodes = tables.given.element_nodes, law.acts_on == "nodes"
    values = np.full((2, len(tables.given.node_ids) if of_nodes else len(ends)), np.nan)
    values[0, rows] = stiffness
    values[1, rows] = np.where(np.isnan(stiffness), np.nan, 0.0) if damping is None else damping
    if not of_nodes:
        return LawStiffness(law.name, values[0], values[1], "length")
    of_elements = np.fmax(values[:, ends[:, 0]], values[:, ends[:, 1]])
    return LawStiffness(law.name, of_elements[0], of_elements[1], "node", values[0])


def _largest(values: FloatArray) -> FloatArray:
    """Return the largest value over all steps."""
    return values if values.ndim == 1 else np.fmax.reduce(values, axis=0)


def _slope(tables: LawTables, rows: NormalRows, result: ContactResult | None) -> FloatArray:
    """Return the largest stiffness (k,) of a normal law, with a result that of its own path at the positions."""
    if result is None:
        return steepest_anywhere(tables, rows)
    at: FloatArray | float = 0.0
    if rows.law.acts_on == "nodes":
        z = 0.0 - result.gap[..., rows.rows]
        touches = z > rows.law.onset(*rows.columns)
    else:
        z, at, touches = result.depth[..., rows.rows], tables.diameter[rows.rows], result.contact[..., rows.rows]
    values = np.empty((3, *z.shape))
    if rows.path >= 0:  # the stiffness of a reversal there, after any path
        values[2] = rows.steepest(z, at)
    else:
        rows.write_reaction(z, at, values)
    return _largest(np.where(touches, values[2], 0.0))


def _reached(tables: LawTables, result: ContactResult | None, speed: FloatArray | None) -> Reached:
    """Return the extremes of all elements and nodes that the laws' largest stiffness and damping depend on."""
    virgin, ends = np.zeros(len(tables.half)), tables.given.element_nodes
    for rows in tables.normal:
        virgin[rows.rows] = steepest_anywhere(tables, rows)
    pull_out = None if speed is None else np.maximum(0.5 * speed[..., ends[:, 0]] + 0.5 * speed[..., ends[:, 1]], 0.0)
    lateral = np.zeros(len(tables.given.node_ids)) if tables.friction is None else tables.friction.coefficients[:, 1]
    pressing = _static_normal_force(tables) if result is None else np.fmax(_largest(result.normal_force), 0.0)
    return Reached(virgin, pull_out, pressing, lateral, walls=tables.trench is not None)


def _static_normal_force(tables: LawTables) -> FloatArray:
    """Return the normal force (n,) of each node under the submerged weight; NaN where that is unknown or not > 0."""
    weight, nodes = tables.given.weight, len(tables.given.node_ids)
    if weight is None:
        return np.full(nodes, np.nan)
    return summed(np.where(weight > 0.0, weight, np.nan) * tables.half, tables.given.element_nodes, nodes)


_THREE_DIGITS = Context(prec=3, rounding=ROUND_DOWN)

ADVISED_OMEGA_DT = 0.5
"""Largest advised product of frequency and step: a landing gains up to 3 % of its speed, or loses 3.5 %."""


def rounded_down(step: float) -> float:
    """Return a step > 0 rounded down to three significant digits."""
    return float(_THREE_DIGITS.create_decimal_from_float(step))
