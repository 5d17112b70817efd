"""The largest stiffness and the largest damping of each law on each element: what an explicit time step must resolve.

Both are facts of the laws. Without positions they are the largest that a law can reach:

* normal laws: the steepest slope at any penetration; unloading lines: their own stiffness, or the steepest slope of the
  virgin path where that is steeper;
* friction: the spring of a node that sticks; one with a mobilisation length has mu N / length under the static normal
  force, the submerged weight of half of each of the node's elements;
* breakout: the fall to the residual under that normal force, as an amount: it softens;
* lateral springs and springs against uplift: their stiffness;
* suction: F_max / (xc1 Delta_B) while it is mobilised, and dF_max/dv, both at the pull-out velocity that makes them
  largest: with the exponents of Bridge et al. v_r for the stiffness and rest for the damping. Infinite where a law has
  no largest value: without a regularisation, or with exponents that grow with the velocity.

With positions they are those that occur there.
"""

from __future__ import annotations

import math
from decimal import ROUND_DOWN, Context
from typing import Literal, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.laws.suction import SuctionLaw, breakout_uplift, maximum_force
from mudline.contact.result import ContactResult
from mudline.contact.tables import ElementRows, FrictionRows, NormalRows, Tables, steepest_anywhere
from mudline.short_repr import UnknownNameError, outline, short_repr


class LawStiffness(NamedTuple):
    """One law on the elements (m,) of a model; NaN for elements without it, or where something is not known.

    law: its name. stiffness: force per length, largest. damping: force per velocity, largest; 0 for laws without.
    per: what both are for: a "length" of the element, or its stiffer "node".
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
    """All laws of a model."""

    laws: tuple[LawStiffness, ...]

    def __repr__(self) -> str:
        return outline("Stiffest", ", ".join(law.law for law in self.laws) or "no laws")

    def __getitem__(self, law: str | int | slice) -> LawStiffness:  # type: ignore[override]
        """Return a law by its name; UnknownNameError, a KeyError, when the model does not have it."""
        for found in self.laws:
            if found.law == law:
                return found
        raise UnknownNameError.among("law", law, [found.law for found in self.laws])

    def per_length(self, tables_length: FloatArray) -> FloatArray:
        """Return the largest stiffness (m,) of laws per unit length and of nodes over `tables_length` (m,)."""
        columns = [law.stiffness / tables_length if law.per == "node" else law.stiffness for law in self.laws]
        return np.fmax.reduce(columns) if columns else np.full(len(tables_length), np.nan)


def stiffest(tables: Tables, result: ContactResult | None, speed: FloatArray | None) -> Stiffest:
    """Return the largest stiffness and damping of each law.

    `result` has the forces at some positions, and `speed` (..., n) the velocities along the normals there; None for the
    largest values that the laws can reach.
    """
    with np.errstate(all="ignore"):
        found = [_normal(tables, rows, result) for rows in tables.normal if rows.curve < 0]
        curves = [rows for rows in tables.normal if rows.curve >= 0]
        if curves:
            parts = [_normal(tables, rows, result).stiffness for rows in curves]
            found.append(_law("curve", np.fmax.reduce(parts)))
        found += [_nodal(tables, rows, result) for rows in tables.nodal]
        found += _damping(tables)
        if tables.unloading is not None:
            found.append(_unloading(tables, tables.unloading))
        if tables.springs is not None:
            found.append(_law("suction spring", _spread(tables, tables.springs.rows, tables.springs.columns[0])))
        if tables.suction is not None:
            found.append(_suction(tables, speed))
        if tables.friction is not None:
            found.append(_friction(tables, tables.friction, result))
            found += _breakout(tables, tables.friction, result)
        if tables.lateral is not None:
            given = tables.given.assigned["lateral"]
            found.append(_law("lateral", _spread(tables, given.rows, given["stiffness"])))
    return Stiffest(tuple(found))


def _damping(tables: Tables) -> list[LawStiffness]:
    """Damping of inward motion, of elements and of the nodes of elements, without a stiffness."""
    found = []
    if (own := tables.damping) is not None:
        damping = np.where(own > 0.0, own, np.nan)
        found.append(LawStiffness("damping", 0.0 * damping, damping, "length"))
    if (at_nodes := tables.nodal_damping) is not None:
        ends = tables.given.element_nodes
        damping = np.maximum(at_nodes[ends[:, 0]], at_nodes[ends[:, 1]])
        damping = np.where(damping > 0.0, damping, np.nan)
        found.append(LawStiffness("nodal damping", 0.0 * damping, damping, "node"))
    return found


def _law(name: str, stiffness: FloatArray) -> LawStiffness:
    return LawStiffness(name, stiffness, np.where(np.isnan(stiffness), np.nan, 0.0), "length")


def _law_of_nodes(name: str, tables: Tables, at_nodes: FloatArray) -> LawStiffness:
    """A law of nodes: an element has the stiffness of the stiffer of its two."""
    ends = tables.given.element_nodes
    stiffness = np.fmax(at_nodes[ends[:, 0]], at_nodes[ends[:, 1]])
    return _law(name, stiffness)._replace(per="node", at_nodes=at_nodes)


def _spread(tables: Tables, rows: IndexArray, values: FloatArray) -> FloatArray:
    found = np.full(len(tables.half), np.nan)
    found[rows] = values
    return found


def _largest(values: FloatArray) -> FloatArray:
    """The largest over all steps."""
    return values if values.ndim == 1 else np.fmax.reduce(values, axis=0)


def _normal(tables: Tables, rows: NormalRows, result: ContactResult | None) -> LawStiffness:
    """A normal law; at positions the slope of its own path, whatever else acts on the element."""
    if result is None:
        return _law(rows.law.name, _spread(tables, rows.rows, steepest_anywhere(tables, rows)))
    depth, diameter = result.depth[..., rows.rows], tables.diameter[rows.rows]
    if rows.curve >= 0:
        curve = tables.given.curves[rows.curve]
        slope = curve.evaluate(np.nan_to_num(depth / diameter))[1] / diameter
    elif rows.path >= 0:  # that of turning round there, whatever came before
        slope = np.broadcast_to(rows.steepest(depth, diameter, *rows.columns), depth.shape)
    else:
        slope = np.broadcast_to(rows.reaction(depth, diameter, *rows.columns)[1], depth.shape)
    return _law(
        rows.law.name, _spread(tables, rows.rows, _largest(np.where(result.contact[..., rows.rows], slope, 0.0)))
    )


def _nodal(tables: Tables, rows: NormalRows, result: ContactResult | None) -> LawStiffness:
    """A normal law of nodes: of each element that of its stiffer node."""
    own = np.full(len(tables.given.node_ids), np.nan)
    own[rows.rows] = steepest_anywhere(tables, rows)
    if result is not None:
        z = 0.0 - result.gap[..., rows.rows]
        slope = np.broadcast_to(rows.reaction(z, 0.0, *rows.columns)[1], z.shape)
        own[rows.rows] = _largest(np.where(z > rows.law.onset(*rows.columns), slope, 0.0))
    return _law_of_nodes(rows.law.name, tables, own)


def _unloading(tables: Tables, unloading: ElementRows) -> LawStiffness:
    """Unloading lines: ku, or the steepest slope of the virgin path where that is steeper."""
    virgin = np.zeros(len(tables.half))
    for rows in tables.normal:
        virgin[rows.rows] = steepest_anywhere(tables, rows)
    steepest = np.maximum(unloading.columns[0], virgin[unloading.rows])
    return _law("unloading", _spread(tables, unloading.rows, steepest))


def _suction(tables: Tables, speed: FloatArray | None) -> LawStiffness:
    rows = tables.given.assigned["suction"].rows
    law = SuctionLaw(*tables.given.assigned["suction"].columns)
    factor = law.force_factor * law.largest_factor
    n, slow = law.force_exponent, law.regularisation
    if speed is None:
        rise = suction_rates(law, slow)[0]
        rise = np.where((n > law.depth_exponent) & (factor > 0.0), np.inf, np.where(slow > 0.0, rise, np.inf))
        at_rest, at_slow = maximum_force(0.0 * slow, factor, n, slow)[1], maximum_force(slow, factor, n, slow)[1]
        damping = np.where((n > 1.0) & (factor > 0.0), np.inf, np.maximum(at_rest, at_slow))
        damping = np.where((slow > 0.0) | (n >= 1.0), damping, np.inf)
        rise, damping = np.where(factor > 0.0, rise, 0.0), np.where(factor > 0.0, damping, 0.0)
    else:
        ends = tables.given.element_nodes[rows]
        v = np.maximum(0.5 * speed[..., ends[:, 0]] + 0.5 * speed[..., ends[:, 1]], 0.0)
        rise, damping = map(_largest, suction_rates(law, v))
    return LawStiffness("suction", _spread(tables, rows, rise), _spread(tables, rows, damping), "length")


def suction_rates(law: SuctionLaw, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return F_max / (xc1 Delta_B) and dF_max / dv per unit length, at the end of the rise, at velocities v."""
    factor = law.force_factor * law.largest_factor
    with np.errstate(all="ignore"):
        force, by_velocity = maximum_force(v, factor, law.force_exponent, law.regularisation)
        uplift = breakout_uplift(v, law.depth_factor, law.depth_exponent, law.regularisation)
        rise: FloatArray = force / (law.first_corner * uplift)
    return rise, by_velocity


def _friction(tables: Tables, friction: FrictionRows, result: ContactResult | None) -> LawStiffness:
    """Springs of nodes that stick, the stiffer of both directions and of the two nodes of an element."""
    normal_force = _pressing(tables, result)
    springs = np.where(friction.rising > 0.0, friction.rising * normal_force, 0.0) + friction.constant
    if tables.trench is None:  # a direction without a coefficient has no limit to stick below; trench walls add one
        springs = np.where(friction.coefficients > 0.0, springs, 0.0)
    own = np.where(friction.active, springs.max(axis=0), np.nan)
    return _law_of_nodes("friction", tables, own)


def _pressing(tables: Tables, result: ContactResult | None) -> FloatArray:
    """The largest normal force (n,) of each node, the static one where no positions are given."""
    return static_normal_force(tables) if result is None else np.fmax(_largest(result.normal_force), 0.0)


def _breakout(tables: Tables, friction: FrictionRows, result: ContactResult | None) -> list[LawStiffness]:
    """The fall of the lateral resistance behind its peak; that of a large embedment is less steep."""
    if tables.breakout is None:
        return []
    nodes, (peak, _, residual, _, last, _) = tables.breakout.rows, tables.breakout.columns
    own = np.full(len(friction.active), np.nan)
    limit = friction.coefficients[1, nodes] * _pressing(tables, result)[nodes]
    own[nodes] = limit * np.maximum(1.0 - residual, 0.0) / (last - peak)
    return [_law_of_nodes("breakout", tables, own)]


def static_normal_force(tables: Tables) -> FloatArray:
    """Return the normal force (n,) of each node under the submerged weight; NaN where that is unknown or not > 0."""
    weight, total = tables.given.weight, np.zeros(len(tables.given.node_ids))
    if weight is None:
        return np.full(len(total), np.nan)
    carried = np.where(weight > 0.0, weight, np.nan) * tables.half
    for end in tables.given.element_nodes.T:
        np.add.at(total, end, carried)
    return total


_THREE_DIGITS = Context(prec=3, rounding=ROUND_DOWN)

CRITICAL_OMEGA_DT = {
    "central-difference": 2.0,
    "velocity-verlet": 2.0,
    "rk4": 2.0 * math.sqrt(2.0),
    "rk2": 0.0,
    "forward-euler": 0.0,
}
"""Largest omega dt at which an undamped oscillator does not grow; 0 where it grows at every step.

Implicit schemes that are not here have no such limit on linear systems, which says nothing of contact that opens.
"""

ADVISED_OMEGA_DT = 0.5
"""Up to here a landing gains up to 3 % of its speed, or loses 3.5 %, in the usual implicit schemes of second order."""


def critical_step(scheme: str, frequency: float, rate: float = 0.0) -> float:
    """Return the largest time step at which x'' = -omega^2 x - gamma x' does not grow under a scheme.

    `frequency` is omega = sqrt(k / m), `rate` gamma = c / m of the damping c, both >= 0. Infinite without both, and
    for schemes that are not explicit. The damping acts as the schemes see it:

    * central difference, which sees the velocity of the half step before: (omega dt)^2 + 2 gamma dt < 4;
    * velocity Verlet, which predicts it from the acceleration before the step: (omega dt)^2 + 4 gamma dt < 4;
    * Runge-Kutta: |1 + z + ... + z^p / p!| <= 1 for the root z / dt of the equation with the larger amount.
    """
    if scheme not in CRITICAL_OMEGA_DT or not (frequency > 0.0 or rate > 0.0):
        return math.inf
    if scheme == "central-difference":
        return 4.0 / (rate + math.hypot(rate, 2.0 * frequency))
    if scheme == "velocity-verlet":
        return 2.0 / (rate + math.hypot(rate, frequency))
    half = 0.5 * rate
    if half >= frequency:  # two real roots: this is the faster one
        return _radius(_ORDERS[scheme], -1.0) / (half + math.sqrt((half - frequency) * (half + frequency)))
    return _radius(_ORDERS[scheme], -half / frequency) / frequency


_ORDERS = {"rk4": 4, "rk2": 2, "forward-euler": 1}
_ROUNDING = 1e-14


def _radius(order: int, cosine: float) -> float:
    """How far the stability region of a Runge-Kutta scheme of order 1 to 4 reaches in a direction of the left half.

    |R(z)|^2 - 1 on the ray z = r (cosine + i sine) is a polynomial in r without a constant.
    """
    direction = complex(cosine, math.sqrt(1.0 - cosine * cosine))
    terms = np.array([direction**power / math.factorial(power) for power in range(order + 1)])
    growth = np.convolve(terms, terms.conj()).real[1:]
    growth[np.abs(growth) < _ROUNDING] = 0.0
    lowest = growth[np.flatnonzero(growth)[0]]
    if lowest > 0.0:
        return 0.0
    roots = np.roots(growth[::-1])
    return float(roots.real[(np.abs(roots.imag) < 1e-6 * np.abs(roots)) & (roots.real > 0.0)].min())


def rounded_down(step: float) -> float:
    """Return a step > 0 with three digits that are not above it: who gives them keeps to the step."""
    return float(_THREE_DIGITS.create_decimal_from_float(step))


def release_stiffness(law: SuctionLaw, velocity: FloatArray) -> FloatArray:
    """Return |d force / d uplift| on the release of suction, per unit length, at steady pull-out velocities > 0 (m,).

    F_max / ((1 - xc2) Delta_B): only a structure that is stiffer, per unit length, has one equilibrium there.
    """
    with np.errstate(all="ignore"):
        force, _ = maximum_force(
            velocity, law.force_factor * law.largest_factor, law.force_exponent, law.regularisation
        )
        uplift = breakout_uplift(velocity, law.depth_factor, law.depth_exponent, law.regularisation)
        slope: FloatArray = force / ((1.0 - law.second_corner) * uplift)
    return slope
