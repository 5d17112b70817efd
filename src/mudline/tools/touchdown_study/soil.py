"""Seabed under a stretch of a line, cut out of a deck: its laws normal to the mudline, with their tangents."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.laws import PathLaw
from mudline.model.contact.tables import LawTables, NormalRows
from mudline.model.contact.tangent import Triples

ElementMatrix = Literal["mean", "consistent"]
"""Law at the mean depth of an element with half of the force on each node, or law integrated along the element."""

_STEPPED = ("unloading", "suction", "suction spring", "damping", "nodal damping")
"""Laws normal to the mudline with memory, or that need velocities or heights above the mudline."""
_GAUSS = np.polynomial.legendre.leggauss(3)


class Reaction(NamedTuple):
    """Seabed reaction.

    Attributes:
        nodal: forces (n,) on the nodes.
        diagonal: derivatives (n,) to the w of the same node.
        beside: derivatives (n - 1,) to the w of the right neighbour.
        per_length: force per length (m,) of the elements; springs of nodes count half to each neighbour.
        damping: minus the derivatives to velocities, as (diagonal, beside); None without damping.
    """

    nodal: FloatArray
    diagonal: FloatArray
    beside: FloatArray
    per_length: FloatArray
    damping: tuple[FloatArray, FloatArray] | None = None


class _Curves:
    """Force-embedment curves of several elements, evaluated together like `ForceCurve`, a table row for each."""

    def __init__(self, groups: list[NormalRows], diameter: FloatArray) -> None:
        of_row = {row: each.curve for each in groups if each.curve for row in each.rows.tolist()}
        self.rows: IndexArray = np.array(sorted(of_row), np.intp)
        used = [of_row[row] for row in self.rows.tolist()]
        width = max((len(curve.slopes) for curve in used), default=1) + 1
        size = diameter[self.rows]
        self._starts, self._forces, self._slopes = (np.full((len(used), width), fill) for fill in (np.inf, 0.0, 0.0))
        for at, curve in enumerate(used):  # no force above the mudline, then the segments below it
            first = int(curve.segment(0.0))
            count = len(curve.slopes) - first + 1
            self._starts[at, :count] = np.append(0.0, curve.ratios[first:-1] * size[at])
            self._forces[at, 1:count] = curve.forces[first:-1]
            self._slopes[at, 1:count] = curve.slopes[first:] / size[at]
        self._each, self._borders = np.arange(len(used)), self._starts[:, 1:].copy()
        self._borders[:, 0] = 0.0

    def evaluate(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return forces per length and their derivatives to the depths (k,)."""
        at = self._each, (z[:, None] > self._borders).sum(axis=1)
        slope = self._slopes[at]
        return self._forces[at] + slope * (z - self._starts[at]), slope


class ElasticSoil:
    """Laws without memory: force and tangent follow from the depth alone."""

    def __init__(self, given: ContactInput, matrix: ElementMatrix = "mean") -> None:
        tables, self._length = LawTables(given), given.length
        self._onset, self._cut, self._diameter = given.onset(), given.tension == "cut", given.diameter
        self._curves = _Curves(tables.normal, given.diameter)
        self._others, self._nodal = [each for each in tables.normal if each.curve is None], tables.nodal
        self._carried = np.append(self._length, 0.0) + np.append(0.0, self._length)
        points, weights = (np.array([0.0]), np.array([2.0])) if matrix == "mean" else _GAUSS
        self._points = [
            (0.5 * (1.0 - at), 0.5 * (1.0 + at), 0.5 * share) for at, share in zip(points, weights, strict=True)
        ]

    def react(self, w: FloatArray, v: FloatArray, step: float) -> Reaction:  # noqa: ARG002 - as other soils
        """Return the reaction at heights (n,) of the nodes."""
        count = len(w)
        nodal, diagonal, beside = np.zeros(count), np.zeros(count), np.zeros(count - 1)
        per_length = np.zeros(count - 1)
        for left, right, share in self._points:
            force, slope = self._forces(-left * w[:-1] - right * w[1:])
            per_length += share * force
            force, slope = share * self._length * force, share * self._length * slope
            nodal[:-1] += left * force
            nodal[1:] += right * force
            diagonal[:-1] -= left * left * slope
            diagonal[1:] -= right * right * slope
            beside -= left * right * slope
        for rows in self._nodal:
            z = -w[rows.rows]
            touches = z > rows.law.onset(*rows.columns)
            force, slope = rows.law.reaction(z, 0.0, *rows.columns)
            own = np.zeros(count)
            own[rows.rows] = np.where(touches, force, 0.0)
            nodal += own
            diagonal[rows.rows] -= np.where(touches, slope, 0.0)
            own /= self._carried
            per_length += own[:-1] + own[1:]
        return Reaction(nodal, diagonal, beside, per_length)

    def keep(self) -> None:
        """Do nothing: there is no state."""

    def _forces(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return force per length of elements (m,) and its derivative to the depth."""
        rows, force, slope = self._curves.rows, np.zeros(len(z)), np.zeros(len(z))
        force[rows], slope[rows] = self._curves.evaluate(z[rows])
        if self._cut:
            force, slope = np.where(force > 0.0, force, 0.0), np.where(force > 0.0, slope, 0.0)
        for each in self._others:
            depth = z[each.rows]
            reaction = each.law.reaction(depth, self._diameter[each.rows], *each.columns)
            touches: BoolArray = depth > self._onset[each.rows]
            force[each.rows], slope[each.rows] = (np.where(touches, part, 0.0) for part in reaction)
        return force, slope


class SteppedSoil:
    """Laws with memory, or that need velocities, evaluated by `ContactModel.step`."""

    def __init__(self, given: ContactInput) -> None:
        self._model = ContactModel(given, backend="numpy")
        self._state = self._next = self._model.initial_state()
        self._with_tangent = bool(given.needs_velocities or given.nodal_laws)
        self._quarter = 0.25 * given.length
        self._points, self._rates = given.coordinates.copy(), np.zeros_like(given.coordinates)

    def react(self, w: FloatArray, v: FloatArray, step: float) -> Reaction:
        """Return the reaction of a step from the kept state."""
        self._points[:, 0], self._rates[:, 0] = w, v
        arguments = self._points, self._rates, self._state, step or None
        try:
            result, self._next = self._model.step(*arguments)
        except ValueError:  # a trial of Newton's method so far off that a force overflows
            return Reaction(w * np.nan, w * np.nan, w[1:] * np.nan, w[1:] * np.nan)
        if self._with_tangent:
            position, damping = (_tridiagonal(each, len(w)) for each in self._model.tangent(*arguments))
            return Reaction(result.normal_force, *position, result.force, (-damping[0], -damping[1]))
        beside = -self._quarter * result.stiffness
        diagonal = np.append(beside, 0.0) + np.append(0.0, beside)
        return Reaction(result.normal_force, diagonal, beside, result.force)

    def keep(self) -> None:
        """Keep the state after the last reaction."""
        self._state = self._next


def _tridiagonal(triples: Triples, nodes: int) -> tuple[FloatArray, FloatArray]:
    """Return diagonal (n,) and neighbours (n - 1,) of the vertical part of a tangent."""
    rows, columns, values, _ = triples
    upright = (rows % 3 == 0) & (columns % 3 == 0)
    rows, columns, values = rows[upright] // 3, columns[upright] // 3, values[upright]
    same, beside = rows == columns, columns == rows + 1
    diagonal = np.bincount(rows[same], values[same], nodes).astype(np.float64)
    return diagonal, np.bincount(rows[beside], values[beside], nodes - 1).astype(np.float64)


def soil_of(given: ContactInput, matrix: ElementMatrix = "mean") -> BeamSoil:
    """Return the soil of an input made by `cut_out`."""
    return ElasticSoil(given, matrix) if cost_of(given) == 1 else SteppedSoil(given)


def cost_of(given: ContactInput) -> int:
    """Return the approximate time of a step over that with laws without memory and velocities."""
    if any(isinstance(law.law, PathLaw) for law in given.normal_laws) or given.needs_velocities:
        return 12
    return 6 if given.has(*_STEPPED) else 1


class ScaledSoil:
    """Soil whose forces are multiplied by a factor."""

    def __init__(self, soil: BeamSoil, factor: float) -> None:
        self._soil, self._factor = soil, factor

    def react(self, w: FloatArray, v: FloatArray, step: float) -> Reaction:
        """Return the reaction of the soil times the factor."""
        nodal, diagonal, beside, per_length, damping = self._soil.react(w, v, step)
        factor = self._factor
        damped = None if damping is None else (factor * damping[0], factor * damping[1])
        return Reaction(factor * nodal, factor * diagonal, factor * beside, factor * per_length, damped)

    def keep(self) -> None:
        """Keep the state after the last reaction."""
        self._soil.keep()


BeamSoil = ElasticSoil | SteppedSoil | ScaledSoil
"""Seabed under a beam.

`react` returns the reaction at heights and velocities (n,) of the nodes, a step after the kept state, or at rest after
a step of 0. `keep` keeps the state of the last reaction, as its step has converged.
"""
