"""What of a scene the motions of the study take place on: its stiffest laws, a mass, suction and friction."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from mudline.contact import ContactInput, LawKind
from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import from_cohesion
from mudline.scene.deck_values import DEFAULT_GRAVITY
from mudline.scene.model import Scene
from mudline.scene.resolved import LawArrays
from mudline.scene.sections import surroundings
from mudline.study.precision.drag import Drag
from mudline.study.precision.laws import CurveLaw, Law, LinearLaw
from mudline.study.precision.pull import SuctionNumbers

_DIAMETER = 0.3
_MASS = 150.0
_COHESION = 5000.0
_FRICTION = 0.5
_MOBILISATION = 0.01
_UNITS = {"imperial": (0.3048, 4.4482216)}
"""Metres and newtons of a deck's units."""


class Bed(NamedTuple):
    """An elastic law of the scene, and what lies on it, per unit length and in the deck's units."""

    law: Law
    diameter: float
    mass: float
    weight: float
    element: int

    @property
    def stiffness(self) -> float:
        """The law's slope at the mudline."""
        return self.law.steepest(0.0)


class Seabed(NamedTuple):
    """What is studied, and what was taken for granted."""

    beds: list[Bed]
    inputs: ContactInput
    notes: list[str]


def seabed_of(scene: Scene) -> Seabed:
    """The stiffest curve and the stiffest linear law of a scene; raises DeckError where it cannot be evaluated."""
    inputs, arrays = scene.contact_input(), scene.law_arrays()
    notes: list[str] = []
    mass, weight = scene.mass_per_length, scene.submerged_weight
    beds = []
    for kind in (LawKind.CURVE, LawKind.LINEAR):
        elements = _distinct(arrays, scene.diameter, kind)
        found = [_bed(scene, arrays, (float(mass[i]), float(weight[i])), i, notes) for i in elements]
        beds += sorted((bed for bed in found if bed.stiffness > 0.0), key=lambda bed: -bed.stiffness)[:1]
    if not beds:
        notes.append("The deck has no curve and no linear law to fall on: only the reference case was run.")
    return Seabed(beds, inputs, list(dict.fromkeys(notes)))


def _distinct(arrays: LawArrays, diameter: FloatArray, kind: LawKind) -> list[int]:
    """One element of each law and diameter."""
    elements = np.flatnonzero(arrays.law == kind)
    what = arrays.curve_index if kind is LawKind.CURVE else arrays.linear_stiffness
    keys = np.column_stack([what[elements], np.nan_to_num(diameter[elements])])
    found: list[int] = elements[np.unique(keys, axis=0, return_index=True)[1]].tolist()
    return found


def _bed(scene: Scene, arrays: LawArrays, given: tuple[float, float], element: int, notes: list[str]) -> Bed:
    mass, weight = given
    diameter = float(scene.diameter[element])
    if math.isnan(diameter):
        diameter = _DIAMETER
    if math.isnan(mass):
        mass = _MASS
        notes.append(f"The mass of the pipe is not known: {_MASS:g} per unit length is taken.")
    if not weight > 0.0:
        known = surroundings(scene.deck).gravity
        gravity = DEFAULT_GRAVITY.get(scene.units, DEFAULT_GRAVITY["metric"]) if math.isnan(known) else known
        weight = 0.5 * mass * gravity
        notes.append("The pipe has no known weight in water that presses on the bed: half of its own weight is taken.")
    name = scene.law_names[element].removeprefix("curve:")
    law: Law
    if arrays.law[element] == LawKind.CURVE:
        law = CurveLaw(name, arrays.curves[int(arrays.curve_index[element])], diameter)
    else:
        law = LinearLaw(name, float(arrays.linear_stiffness[element]))
    return Bed(law, diameter, mass, weight, element)


def static_depth(bed: Bed) -> float:
    """Penetration under the weight; a twentieth of the diameter where there is none."""
    if isinstance(bed.law, CurveLaw):
        depths = [ratio * bed.diameter for ratio in bed.law.curve.ratios_at_force(bed.weight) if ratio > 0.0]
        return min(depths, default=0.05 * bed.diameter)
    return bed.weight / bed.stiffness


def suction_of(scene: Scene, inputs: ContactInput, bed: Bed, notes: list[str]) -> SuctionNumbers:
    """The suction law of the bed's element, else of another, else of Bridge et al. with 5 kPa."""
    given = inputs.assigned.get("suction")
    if given is not None:
        index = int((given.rows == bed.element).argmax())  # the first where it has none
        return SuctionNumbers(**{name: float(values[index]) for name, values in given.parameters.items()})
    length, force = _UNITS.get(scene.units, (1.0, 1.0))
    notes.append("The deck has no suction with a history: that of Bridge et al. (2004) with 5 kPa is taken.")
    cohesion = np.array([_COHESION / force * length**2])
    factors = from_cohesion(cohesion, np.array([bed.diameter]), length, force)
    powers = {name: float(values[0]) for name, values in factors._asdict().items()}
    return SuctionNumbers(**powers, first_corner=0.2, second_corner=0.8, cyclic=1.0, regularisation=1e-3 / length)


def usual_velocity(scene: Scene) -> float:
    """A tenth of a metre per second, in the deck's units."""
    return 0.1 / _UNITS.get(scene.units, (1.0, 1.0))[0]


def friction_of(inputs: ContactInput, bed: Bed, notes: list[str]) -> Drag:
    """Friction along the line at the bed's element, else of 0.5, mobilised over a hundredth of the diameter."""
    given = inputs.assigned.get("friction")
    length = float(inputs.length[bed.element])
    at = np.zeros(0, np.intp) if given is None else np.flatnonzero(given.rows == inputs.element_nodes[bed.element, 0])
    if given is None or not (at.size and given["axial_coefficient"][at[0]] > 0.0 and length > 0.0):
        notes.append("The bed has no friction along the line: 0.5, mobilised over a hundredth of D, is taken.")
        limit = _FRICTION * bed.weight
        return Drag(bed.law.name, bed.mass, limit, limit / (_MOBILISATION * bed.diameter))
    names = ("axial_coefficient", "axial_stiffness", "axial_mobilisation")
    coefficient, constant, mobilisation = (float(given[name][at[0]]) for name in names)
    limit = coefficient * bed.weight
    stiffness = limit / mobilisation if math.isnan(constant) else constant / length
    return Drag(bed.law.name, bed.mass, limit, stiffness)
