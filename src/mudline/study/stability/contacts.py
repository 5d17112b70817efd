"""The contacts of a scene: elements that share a law and a section, or nodes; their stiffness, mass and frequency."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.input import LawKind
from mudline.contact.stiffest import ADVISED_OMEGA_DT, CRITICAL_OMEGA_DT, omega, steepest_slope
from mudline.curves import ForceCurve
from mudline.scene.assignments import given_stiffness
from mudline.scene.model import Scene
from mudline.study.report import Layout, Omission


class Contact(NamedTuple):
    """One kind of contact.

    name: its law, and the set through which its elements have it.
    element: index of the first of its elements.
    elements: how many elements share it; of a nodal stiffness how many nodes.
    stiffness: the largest tangent stiffness below the mudline, per unit length.
    mass: per unit length.
    omega: root of stiffness over mass, radians per unit of time.
    depth: a penetration in the middle of where the law has this stiffness.
    reach: how far to both sides it has it.
    scale: the largest distance that the law computes with there: an oscillation below its rounding is not resolved.
    unloading: whether the stiffness is that of the unloading line.
    """

    name: str
    element: int
    elements: int
    stiffness: float
    mass: float
    omega: float
    depth: float
    reach: float
    scale: float
    unloading: bool = False


CONTACTS = Layout[Contact](
    "contacts",
    "Frequencies of the contacts, the fastest first",
    {
        "contact": lambda one: one.name,
        "elements": lambda one: one.elements,
        "largest stiffness [{force}/{length}2]": lambda one: one.stiffness,
        "mass [{mass}/{length}]": lambda one: one.mass,
        "omega [rad/s]": lambda one: one.omega,
        "advised step, implicit [s]": lambda one: ADVISED_OMEGA_DT / one.omega,
        "critical step, central-difference [s]": lambda one: CRITICAL_OMEGA_DT["central-difference"] / one.omega,
        "critical step, rk4 [s]": lambda one: CRITICAL_OMEGA_DT["rk4"] / one.omega,
    },
)
_UNITS = {"metric": ("N", "m", "kg"), "imperial": ("lbf", "ft", "slug")}


def unit_words(units: str) -> dict[str, str]:
    """What the headings of tables call force, length and mass in these units of a deck."""
    return dict(zip(("force", "length", "mass"), _UNITS.get(units, ("force", "length", "mass")), strict=True))


class _Steepest(NamedTuple):
    stiffness: float
    depth: float
    reach: float
    scale: float


def find_contacts(scene: Scene) -> tuple[list[Contact], list[Omission]]:
    """The contacts that oscillate, the fastest first, and those of which no frequency is known."""
    springs = np.flatnonzero(np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    back = scene.extensions.get("SEABED UNLOADING")
    ways = np.full(len(scene.law), -1) if back is None else back.of_element
    kinds = np.column_stack([part[springs] for part in (scene.laws.of_element, scene.section_table.of_element, ways)])
    returns = np.full(len(scene.law), np.nan) if back is None else given_stiffness(back)
    masses = scene.mass_per_length
    found, left_out = _nodal(scene, masses)
    for first, count in _groups(kinds):
        element = int(springs[first])
        name = f"{scene.law_names[element]} on {scene.law_sets[element]}"
        steepest = _steepest(scene, element)
        frequency = float(omega(np.array(steepest.stiffness), masses[element : element + 1])[0])
        if np.isnan(frequency):
            what = "the mass per unit length is not known" if np.isnan(masses[element]) else "its law never stiffens"
            left_out.append(Omission(name, f"no frequency: {what}"))
            continue
        mass = float(masses[element])
        found.append(Contact(name, element, count, steepest.stiffness, mass, frequency, *steepest[1:]))
        if (stiffness := float(returns[element])) > steepest.stiffness:
            frequency = float(omega(np.array(stiffness), masses[element : element + 1])[0])
            place = _small(scene, element)
            found.append(
                Contact(f"unloading of {name}", element, count, stiffness, mass, frequency, *place, unloading=True)
            )
    return sorted(found, key=lambda contact: -contact.omega), left_out


def _nodal(scene: Scene, masses: FloatArray) -> tuple[list[Contact], list[Omission]]:
    """Nodes with a stiffness of their own: of each stiffness the fastest node, per unit of its length."""
    springs = scene.contact_input().assigned.get("nodal")
    if springs is None:
        return [], []
    stiffness_of = springs.spread("stiffness", len(scene.node_ids))
    length, mass = np.zeros(len(scene.node_ids)), np.zeros(len(scene.node_ids))
    for end in scene.element_nodes.T:
        np.add.at(length, end, 0.5 * scene.length)
        np.add.at(mass, end, 0.5 * scene.length * masses)
    frequency = omega(stiffness_of, mass)
    found: list[Contact] = []
    left_out: list[Omission] = []
    for stiffness in np.unique(stiffness_of[stiffness_of > 0.0]).tolist():
        nodes = np.flatnonzero(stiffness_of == stiffness)
        if np.isnan(frequency[nodes]).all():
            what = f"nodal stiffness {stiffness:.6g}"
            left_out.append(Omission(what, "no frequency: the mass of its nodes is not known"))
            continue
        node = int(nodes[np.nanargmax(frequency[nodes])])
        element = int(np.flatnonzero((scene.element_nodes == node).any(axis=1))[0])
        name = f"nodal {stiffness:.6g} at node {scene.node_ids[node]}"
        per_length, own = float(stiffness / length[node]), float(frequency[node])
        load = float(mass[node] / length[node])
        found.append(Contact(name, element, len(nodes), per_length, load, own, *_small(scene, element)))
    return found, left_out


def _small(scene: Scene, element: int) -> tuple[float, float, float]:
    """A depth of a linear law, and as far to both sides: its scale too."""
    diameter = float(scene.diameter[element])
    depth = 0.01 * diameter if np.isfinite(diameter) else 0.01
    return depth, depth, depth


def _groups(kinds: IndexArray) -> list[tuple[int, int]]:
    """The first row of each kind and how many there are."""
    if not len(kinds):
        return []
    _, first, counts = np.unique(kinds, axis=0, return_index=True, return_counts=True)
    return list(zip(first.tolist(), counts.tolist(), strict=True))


def _steepest(scene: Scene, element: int) -> _Steepest:
    arrays = scene.law_arrays()
    diameter = float(scene.diameter[element])
    if scene.law[element] == LawKind.CURVE:
        return _of_curve(arrays.curves[int(arrays.curve_index[element])], diameter)
    return _Steepest(float(arrays.linear_stiffness[element]), *_small(scene, element))


def _of_curve(curve: ForceCurve, diameter: float) -> _Steepest:
    """The segment of the largest slope; the continued end counts as one as wide as the last segment."""
    slope = steepest_slope(curve.ratios, curve.slopes)
    last, width = curve.ratios[-1], curve.ratios[-1] - curve.ratios[-2]
    with np.errstate(over="ignore"):
        end = max(last + width, 0.1 + max(last, 0.0))
    ratios: FloatArray = np.append(curve.ratios, min(end, np.finfo(np.float64).max))
    slopes = np.append(curve.slopes, curve.slopes[-1])
    at = int(np.argmax(np.where(ratios[1:] > 0.0, slopes, -np.inf)))
    low, high = max(float(ratios[at]), 0.0), float(ratios[at + 1])
    middle, half, far = 0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low, max(abs(float(ratios[at])), high)
    return _Steepest(slope / diameter, middle * diameter, half * diameter, far * diameter)
