"""Contacts of a scene as a time step sees them: stiffness and mass of each kind, with its deck line.

The stiffness is the largest that the laws can reach (`mudline.model.contact.stiffest`). The mass is that of a node:
half of each of its elements, without contents or added water. Elements give a node half of their stiffness each, laws
of nodes their own. The rules about time steps and the study's rows of friction share these numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.basics.units import UNITS
from mudline.language.diagnostics import Where
from mudline.model.contact.arrays import summed
from mudline.model.contact.input import ContactInput
from mudline.model.scene.numbering import Floats, Indices, Mask, at_nodes
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.model.contact.stiffest import Stiffest

_RISES = np.linspace(0.02, 1.0, 50)
"""Ratios of pull-out velocity to v_r at which the mobilisation of suction is evaluated."""
_NEARLY = 0.999
SOFTENING = "softening"
"""Kind of a resistance that decreases with displacement."""


class Oscillation(NamedTuple):
    """Kind of contact, at its node with the highest frequency.

    kind: "normal", "nodal", "unloading", "friction", "softening", "lateral", "suction spring" or "suction
        mobilisation".
    name: its law, and the set through which its elements have it.
    node: index of its node.
    stiffness, mass: per unit length of the node.
    where: place in the deck that sets it.
    """

    kind: str
    name: str
    node: int
    stiffness: float
    mass: float
    where: Where | None

    @property
    def omega(self) -> float:
        """Root of stiffness over mass, radians per unit of time."""
        return math.sqrt(self.stiffness) / math.sqrt(self.mass)


class Oscillations(NamedTuple):
    """Contacts that oscillate, the fastest first; contacts without a known stiffness or mass are left out.

    found: contacts with a stiffness.
    softening: contacts whose resistance decreases; their `omega` is the rate at which a motion grows.
    """

    found: list[Oscillation]
    softening: list[Oscillation]


def oscillations(scene: ResolvedDeck, given: ContactInput) -> Oscillations:
    """Return the contacts of a scene whose evaluator has the input `given`."""
    from mudline.model.contact import ContactModel  # noqa: PLC0415 - loaded when it is needed

    every = [*_of_elements(scene, given, ContactModel(given).stiffest(), _Carried(scene))]
    springs = [contact for contact in every if contact.kind != SOFTENING]
    softening = [contact for contact in every if contact.kind == SOFTENING]
    return Oscillations(sorted(springs, key=lambda contact: -contact.omega), softening)


def softening_needs(scene: ResolvedDeck, contact: Oscillation) -> str:
    """Return the requirements of a softening resistance on structure and time steps: " = stiffness; steps"."""
    from mudline.model.contact.stiffest import ADVISED_OMEGA_DT, rounded_down  # noqa: PLC0415 - loaded when it is needed

    unit, time = map(UNITS[scene.units].behind, ("F/L2", "T"))
    place, step = f"node {scene.node_ids[contact.node]}", rounded_down(ADVISED_OMEGA_DT / contact.omega)
    return f" = {contact.stiffness:.6g}{unit} ({place}); in time, the fall needs steps of {step:.3g}{time} or less"


class _Carried:
    """Length (n,) and mass per unit length (n,) of the nodes, and their shares in values of their elements."""

    def __init__(self, scene: ResolvedDeck) -> None:
        self.ends, self.nodes = scene.element_nodes, len(scene.node_ids)
        length = np.where(np.isfinite(scene.length), scene.length, 0.0)
        with np.errstate(all="ignore"):
            self.length = summed(0.5 * length, self.ends, self.nodes)
            self._shares = [0.5 * length / self.length[end] for end in self.ends.T]
            self.mass = self.spread(scene.mass_per_length)

    def spread(self, values: Floats) -> Floats:
        """Return values per unit length of elements (m,) as those of their nodes (n,)."""
        of_nodes = np.zeros(self.nodes)
        for end, share in zip(self.ends.T, self._shares, strict=True):
            np.add.at(of_nodes, end, share * values)
        return of_nodes

    def leading(self, values: Floats) -> Mask:
        """Return a mask (m, 2) of the elements that give the most to each of their two nodes."""
        parts = np.column_stack([share * values for share in self._shares])
        largest = np.zeros(self.nodes)
        np.maximum.at(largest, self.ends, parts)
        return parts >= largest[self.ends]


def _of_elements(scene: ResolvedDeck, given: ContactInput, facts: Stiffest, carried: _Carried) -> Iterator[Oscillation]:
    """Yield every kind of contact whose frequency is known."""
    from mudline.model.contact.laws import is_normal  # noqa: PLC0415 - loaded when it is needed

    by_law = {law.law: law for law in facts.laws}
    springs_of = {law.law: law.at_nodes for law in facts.laws if law.at_nodes is not None}
    sections = scene.section_table.of_element
    springs = [law.stiffness for name, law in by_law.items() if law.per == "length" and is_normal(name)]
    normal = np.fmax.reduce(springs) if springs else np.full(len(sections), np.nan)
    back = scene.extensions.get("SEABED UNLOADING")
    blocks = np.full(len(sections), -1) if back is None else back.of_element
    steeper = np.zeros(len(sections), np.bool_)
    if back is not None and "unloading" in by_law:
        returns = by_law["unloading"].stiffness
        with np.errstate(invalid="ignore"):
            steeper = returns > normal
    for group in _groups(~np.isnan(normal), scene.laws.of_element, sections, blocks, scene.replacing):
        name = f"{scene.law_names[group[0]]} on {scene.law_sets[group[0]]}"
        place = _place_of_law(scene, int(group[0]))
        yield from _of_group("normal", name, group, normal, carried, place)
        if back is not None and steeper[group].any():
            place = back.places[int(back.of_element[group[0]])].inside("stiffness")
            yield from _of_group("unloading", f"unloading of {name}", group, returns, carried, place)
    if "nodal" in springs_of:
        yield from _of_nodes(scene, springs_of["nodal"], carried)
    for law, field in (("suction spring", "suction"), ("lateral", "lateral")):
        if law in by_law:
            for group in _groups(~np.isnan(by_law[law].stiffness), scene.resistance.of_element, sections):
                place = scene.resistance.places[int(scene.resistance.of_element[group[0]])].inside(field)
                name = f"{law} on {_set_of_resistance(scene, int(group[0]))}"
                yield from _of_group(law, name, group, by_law[law].stiffness, carried, place)
    if "suction" in by_law:
        yield from _of_suction(scene, given, carried)
    if "friction" in springs_of:
        yield from _of_springs(scene, "friction", "stiffness", springs_of["friction"], carried)
    if "breakout" in springs_of:
        yield from _of_springs(scene, SOFTENING, "peak", springs_of["breakout"], carried)


def _groups(having: Mask, *keys: Indices) -> list[Indices]:
    """Return indices of the masked elements, in groups of the same keys, in the order of the keys."""
    rows = np.flatnonzero(having)
    if not rows.size:
        return []
    columns = np.column_stack([key[rows] for key in keys])
    _, group, counts = np.unique(columns, axis=0, return_inverse=True, return_counts=True)
    return np.split(rows[np.argsort(group.ravel(), kind="stable")], np.cumsum(counts)[:-1])


def _of_group(
    kind: str, name: str, group: Indices, values: Floats, carried: _Carried, where: Where | None
) -> Iterator[Oscillation]:
    """Yield the node of some elements with the largest stiffness over its mass, if both are known.

    `values` is the stiffness (m,) of all elements of this kind. A node between two laws belongs to the law that gives
    it more.
    """
    stiffness = np.where(np.isnan(values), 0.0, values)
    if not np.isfinite(stiffness[group]).all() or not (stiffness[group] > 0.0).any():
        return
    with np.errstate(all="ignore"):
        of_nodes, ends = carried.spread(stiffness), carried.ends[group]
        weight = np.where(carried.leading(stiffness)[group], of_nodes[ends] / carried.mass[ends], np.nan)
        if np.isnan(weight).all():
            weight = of_nodes[ends] / carried.mass[ends]
    found = _fastest(kind, name, ends.ravel(), weight.ravel(), of_nodes, carried.mass)
    yield from (contact._replace(where=where) for contact in found)


def _fastest(
    kind: str, name: str, nodes: Indices, weight: Floats, stiffness: Floats, mass: Floats
) -> Iterator[Oscillation]:
    """Yield the contact at the node with the largest weight, if it is known and the contact oscillates there."""
    if not np.isnan(weight).all():
        node = int(nodes[np.nanargmax(weight)])
        contact = Oscillation(kind, name, node, float(stiffness[node]), float(mass[node]), None)
        known = contact.mass > 0.0 and math.isfinite(contact.mass) and math.isfinite(contact.stiffness)
        if known and contact.omega > 0.0:
            yield contact


def _of_nodes(scene: ResolvedDeck, stiffness: Floats, carried: _Carried) -> Iterator[Oscillation]:
    """Yield nodes with nodal stiffness: for each stiffness the fastest node."""
    contact = scene.extensions["SEABED CONTACT"]
    blocks = at_nodes(np.where(scene.nodal, contact.of_element, -1), carried.ends, carried.nodes)
    for value in np.unique(stiffness[stiffness > 0.0]).tolist():
        nodes = np.flatnonzero(stiffness == value)
        for spring in _of_node("nodal", f"nodal {value:.6g}", nodes, stiffness, carried):
            place = contact.places[int(blocks[spring.node])].inside("nodal_stiffness")
            yield spring._replace(name=f"{spring.name} at node {scene.node_ids[spring.node]}", where=place)


def _of_node(kind: str, name: str, nodes: Indices, stiffness: Floats, carried: _Carried) -> Iterator[Oscillation]:
    """Yield the node with the largest stiffness, force per length, over the mass that it carries, if it is known."""
    with np.errstate(all="ignore"):
        per_length = stiffness / carried.length
        weight = per_length[nodes] / carried.mass[nodes]
    yield from _fastest(kind, name, nodes, weight, per_length, carried.mass)


def _of_springs(
    scene: ResolvedDeck, kind: str, field: str, stiffness: Floats, carried: _Carried
) -> Iterator[Oscillation]:
    """Yield nodes (n,) with a friction spring, by the place that gives it: `field` of its block, or FRICTION=."""
    own = scene.extensions.get("SEABED FRICTION")
    ends, nodes = carried.ends, carried.nodes
    of_keyword = np.full(nodes, -1) if own is None else at_nodes(own.of_element, ends, nodes)
    of_properties = np.where(of_keyword >= 0, -1, at_nodes(scene.resistance.of_element, ends, nodes))
    having = ~np.isnan(stiffness) & (stiffness != 0.0)
    for group in _groups(having, of_keyword, of_properties):
        keyword, index = int(of_keyword[group[0]]), int(of_properties[group[0]])
        if own is not None and keyword >= 0:
            holder, place = own.sets[keyword], own.places[keyword].inside(field)
            name = f"{kind} on {'?' if holder is None else holder.name}"
        else:
            place = scene.resistance.places[index].inside("friction")
            on = np.flatnonzero(scene.resistance.of_element == index)[0]
            name = f"friction on {_set_of_resistance(scene, int(on))}"
        yield from (contact._replace(where=place) for contact in _of_node(kind, name, group, stiffness, carried))


def _of_suction(scene: ResolvedDeck, given: ContactInput, carried: _Carried) -> Iterator[Oscillation]:
    """Yield mobilised suction, at the velocity up to v_r with the largest stiffness, by the place that gives it."""
    from mudline.model.contact.laws.suction import SuctionLaw, suction_rates  # noqa: PLC0415 - only now is it needed

    own = scene.extensions["SEABED SUCTION"]
    assigned = given.assigned["suction"]
    law = SuctionLaw(*assigned.columns)
    having = np.zeros(len(given.element_ids), np.bool_)
    having[assigned.rows] = True
    stiffness = np.full((len(_RISES), len(having)), np.nan)
    for at, share in enumerate(_RISES.tolist()):
        stiffness[at, assigned.rows] = suction_rates(law, share * law.regularisation)[0]
    for group in _groups(having, own.of_element, scene.section_table.of_element):
        index = int(own.of_element[group[0]])
        holder = own.sets[index]
        name = f"suction mobilisation on {'ALL' if holder is None else holder.name}"
        row = int(np.flatnonzero(assigned.rows == group[0])[0])
        slow = float(law.regularisation[row])
        if not slow > 0.0 or law.force_exponent[row] > min(1.0, law.depth_exponent[row]):
            continue  # its stiffness, or its damping, has no largest value
        place = own.places[index].inside("cohesion" if getattr(own.entries[index], "force", None) is None else "force")
        tried = [
            (contact, share * slow)
            for share, values in zip(_RISES.tolist(), stiffness, strict=True)
            for contact in _of_group("suction mobilisation", name, group, values, carried, place)
        ]
        if tried:
            at_largest, speed = max(tried, key=lambda each: each[0].omega)
            whole = tried[-1][0]
            faster = whole.omega < _NEARLY * at_largest.omega
            yield at_largest._replace(name=f"{name} at {speed:.3g}") if faster else whole


def _set_of_resistance(scene: ResolvedDeck, element: int) -> str:
    """Return the name of the set through which an element has its resistance; ALL for a surface."""
    index = int(scene.laws.covered[element])
    return scene.laws.set_laws[index].set_.name if index >= 0 else "ALL"


def _place_of_law(scene: ResolvedDeck, element: int) -> Where | None:
    """Return the place of an element's stiffness: the end of the steepest segment of its curve."""
    for _, field, extension, elements in reversed(scene.replaced):
        if elements[element]:
            return extension.places[int(extension.of_element[element])].inside(field)
    law = scene.set_law(element)
    if law is None:
        return None
    entry = scene.laws.curves[law.curve] if law.curve >= 0 else None
    if entry is None or not entry.whole or (curve := entry.curve) is None:
        return law.where
    slopes = np.append(curve.slopes, curve.slopes[-1])
    steepest = int(np.argmax(np.where(np.append(curve.ratios[1:], np.inf) > 0.0, slopes, -np.inf)))
    deeper = curve.ratios[min(steepest + 1, len(curve.ratios) - 1)]
    return entry.point(int(np.flatnonzero(entry.points[:, 0] == deeper)[0]))
