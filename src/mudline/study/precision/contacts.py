"""The contacts of a scene that masses are moved on: its stiffest laws with mass, suction and friction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.contact import ContactInput, LawKind
from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import from_cohesion
from mudline.diagnostics import Where
from mudline.results.laws_in_use import line_of
from mudline.scene.deck_values import DEFAULT_GRAVITY, FOOT, POUND
from mudline.scene.model import Scene
from mudline.scene.oscillation import Oscillation, oscillations, place_of_suction, steepest_segment
from mudline.scene.resolved import LawArrays
from mudline.scene.sections import surroundings
from mudline.study import file_of, without_springs
from mudline.study.laws import CurveLaw, ElasticContact, Law, LinearLaw, SuctionNumbers
from mudline.study.precision.exact_motions import Drag, Pull, drag_case, drop_case, drop_to, pull_case, reference_drop
from mudline.study.precision.integration import Case
from mudline.study.report import Omission, StudyError

_DIAMETER = 0.3
_MASS = 150.0
_COHESION = 5000.0
_FRICTION = 0.5
_MOBILISATION = 0.01
_UNITS = {"imperial": (FOOT, POUND)}
"""Units of length and force of a deck, in m and N."""
_REACH = 0.25
"""Of the diameter: how deep the masses fall."""


class StudiedContacts(NamedTuple):
    """A scene and its contacts that are studied; each value that is assumed adds a note."""

    scene: Scene
    inputs: ContactInput
    contacts: list[ElasticContact]
    notes: list[str]


def contacts_of(scene: Scene) -> StudiedContacts:
    """The stiffest curve and the stiffest linear law of a scene; raises DeckError where it cannot be evaluated."""
    studied = StudiedContacts(scene, scene.contact_input(), [], [])
    masses, weights = scene.mass_per_length, scene.submerged_weight
    for kind in (LawKind.CURVE, LawKind.LINEAR):
        elements = _distinct(scene.law_arrays(), scene.diameter, kind)
        found = [_contact(studied, element, float(masses[element]), float(weights[element])) for element in elements]
        stiff = [contact for contact in found if contact.stiffness > 0.0]
        studied.contacts.extend(sorted(stiff, key=_fastest_first)[:1])
    if not studied.contacts:
        studied.notes.append(f"Only the reference case was run: {without_springs(scene)}.")
    return studied


def _fastest_first(contact: ElasticContact) -> float:
    return -contact.law.steepest(_REACH * contact.diameter) / contact.mass


def _distinct(arrays: LawArrays, diameter: FloatArray, kind: LawKind) -> list[int]:
    """One element of each law and diameter."""
    elements = np.flatnonzero(arrays.law == kind)
    what = arrays.curve_index if kind is LawKind.CURVE else arrays.linear_stiffness
    keys = np.column_stack([what[elements], np.nan_to_num(diameter[elements])])
    found: list[int] = elements[np.unique(keys, axis=0, return_index=True)[1]].tolist()
    return found


def _contact(studied: StudiedContacts, element: int, mass: float, weight: float) -> ElasticContact:
    scene, arrays = studied.scene, studied.scene.law_arrays()
    diameter = float(scene.diameter[element])
    if math.isnan(diameter):
        diameter = _DIAMETER
    if math.isnan(mass):
        mass = _MASS
        studied.notes.append(f"The mass of the pipe is not known: {_MASS:g} per unit length is used.")
    if not weight > 0.0:
        known = surroundings(scene.deck).gravity
        gravity = DEFAULT_GRAVITY.get(scene.units, DEFAULT_GRAVITY["metric"]) if math.isnan(known) else known
        why = "The submerged weight of the pipe is not known" if math.isnan(weight) else "The pipe floats"
        weight = 0.5 * mass * gravity
        note = f"{why}: half of its weight in air is used as submerged weight."
        studied.notes.extend([note] if note not in studied.notes else [])
    name = scene.law_names[element].removeprefix("curve:")
    law: Law
    if arrays.law[element] == LawKind.CURVE:
        law = CurveLaw(name, arrays.curves[int(arrays.curve_index[element])], diameter)
    else:
        law = LinearLaw(name, float(arrays.linear_stiffness[element]))
    return ElasticContact(law, diameter, mass, weight, element)


def static_depth(contact: ElasticContact) -> float:
    """Penetration under the weight; a twentieth of the diameter where there is none."""
    if isinstance(contact.law, CurveLaw):
        depths = [
            ratio * contact.diameter for ratio in contact.law.curve.ratios_at_force(contact.weight) if ratio > 0.0
        ]
        return min(depths, default=0.05 * contact.diameter)
    return contact.weight / contact.stiffness


def suction_of(studied: StudiedContacts, contact: ElasticContact) -> SuctionNumbers:
    """The suction law of the contact's element, else of another, else of Bridge et al. with 5 kPa."""
    given = studied.inputs.assigned.get("suction")
    if given is not None:
        index = int((given.rows == contact.element).argmax())  # the first where it has none
        return SuctionNumbers(**{name: float(values[index]) for name, values in given.parameters.items()})
    length, force = _UNITS.get(studied.scene.units, (1.0, 1.0))
    studied.notes.append("The deck has no suction with a history: that of Bridge et al. (2004) with 5 kPa is used.")
    cohesion = np.array([_COHESION / force * length**2])
    factors = from_cohesion(cohesion, np.array([contact.diameter]), length, force)
    powers = {name: float(values[0]) for name, values in factors._asdict().items()}
    return SuctionNumbers(**powers, first_corner=0.2, second_corner=0.8, cyclic=1.0, regularisation=1e-3 / length)


def friction_of(studied: StudiedContacts, contact: ElasticContact) -> Drag:
    """The friction of the deck that oscillates fastest, else of 0.5, mobilised over a hundredth of the diameter."""
    fastest = _fastest_friction(studied)
    if fastest is None:
        studied.notes.append("The deck has no friction: 0.5, mobilised over a hundredth of D, is used.")
        limit = _FRICTION * contact.weight
        return Drag(f"friction on {contact.law.name}", contact.mass, limit, limit / (_MOBILISATION * contact.diameter))
    given = studied.inputs.assigned["friction"]
    at = int(np.flatnonzero(given.rows == fastest.node)[0])
    coefficients, constant, mobilisation = (
        np.array([given[f"{side}_{name}"][at] for side in ("axial", "lateral")])
        for name in ("coefficient", "stiffness", "mobilisation")
    )
    springs = np.where(np.isnan(constant), coefficients / mobilisation, constant)
    side = int(np.argmax(np.where(coefficients > 0.0, springs, -1.0)))
    if math.isnan(constant[side]):
        return Drag(fastest.name, fastest.mass, fastest.stiffness * float(mobilisation[side]), fastest.stiffness)
    weight = float(studied.scene.submerged_weight[fastest.element])
    limit = (float(coefficients[side]) or _FRICTION) * (weight if weight > 0.0 else contact.weight)
    return Drag(fastest.name, fastest.mass, limit, fastest.stiffness)


def _fastest_friction(studied: StudiedContacts) -> Oscillation | None:
    """The friction of the deck that limits explicit steps most, on the node and with the mass that it has there.

    None where the deck has no friction; raises StudyError where nothing is known of the springs that it has.
    """
    found, unknown = oscillations(studied.scene, studied.inputs)
    frictions = [one for one in found if one.kind == "friction"]
    reasons = [reason for name, reason in unknown if name.startswith("friction")]
    if reasons and not frictions:
        raise StudyError(f"friction: {reasons[0]}")
    return max(frictions, key=lambda one: one.omega, default=None)


def all_cases(studied: StudiedContacts, omissions: list[Omission]) -> list[Case]:
    """The reference, then drops on every contact, a pull and a drag on the first one.

    A motion that cannot be integrated is omitted with its reason.
    """
    cases = [drop_case("drop-reference", "dropped, published case", reference_drop())]
    motions: list[tuple[str, _Motion, _Place, ElasticContact]]
    motions = [("drop on", _drop, _place_of_law, contact) for contact in studied.contacts]
    motions += [("pull off", _pull, _place_of_suction, contact) for contact in studied.contacts[:1]]
    motions += [("drag along", _drag, _place_of_friction, contact) for contact in studied.contacts[:1]]
    for words, make, place, contact in motions:
        what = f"{words} {contact.law.name}"
        try:
            case = make(studied, contact)
            if where := place(studied, contact):
                case = replace(case, line=line_of(studied.scene, where), file=file_of(studied.scene, where))
        except (StudyError, ArithmeticError, ValueError) as error:
            omissions.append(Omission(what, str(error)))
            continue
        if math.isfinite(case.omega) and math.isfinite(case.duration) and case.omega > 0.0:
            cases.append(case)
        else:
            omissions.append(Omission(what, "its stiffness or its duration overflows"))
    return cases


_Motion = Callable[[StudiedContacts, ElasticContact], Case]
_Place = Callable[[StudiedContacts, ElasticContact], Where | None]


def _place_of_law(studied: StudiedContacts, contact: ElasticContact) -> Where | None:
    """Where the stiffness of a contact stands: of a curve the steepest segment, or its name if that lies deeper."""
    laws = studied.scene.laws
    given = laws.set_laws[int(laws.of_element[contact.element])]
    if given.curve < 0:
        return given.where
    segment = steepest_segment(laws.curves[given.curve])
    return laws.curves[given.curve].title if segment is None or segment.low >= _REACH else segment.where


def _place_of_suction(studied: StudiedContacts, contact: ElasticContact) -> Where | None:
    """None where the deck has no suction."""
    given, blocks = studied.inputs.assigned.get("suction"), studied.scene.extensions.get("SEABED SUCTION")
    if given is None or blocks is None:
        return None
    element = contact.element if contact.element in given.rows else int(given.rows[0])
    return place_of_suction(blocks, int(blocks.of_element[element]))


def _place_of_friction(studied: StudiedContacts, _: ElasticContact) -> Where | None:
    """None where the deck has no friction."""
    fastest = _fastest_friction(studied)
    return None if fastest is None else fastest.where


def _drop(_: StudiedContacts, contact: ElasticContact) -> Case:
    kind = "curve" if isinstance(contact.law, CurveLaw) else "linear"
    drop = drop_to(contact.law, contact.mass, contact.weight, _REACH * contact.diameter)
    return drop_case(f"drop-{kind}", f"dropped on {contact.law.name}", drop)


def _pull(studied: StudiedContacts, contact: ElasticContact) -> Case:
    velocity = 0.1 / _UNITS.get(studied.scene.units, (1.0, 1.0))[0]  # a tenth of a metre per second
    law, suction = contact.law, suction_of(studied, contact)
    return pull_case(Pull(law.name, law, suction, contact.mass, static_depth(contact), velocity))


def _drag(studied: StudiedContacts, contact: ElasticContact) -> Case:
    return drag_case(friction_of(studied, contact))
