"""The contacts of a scene as a time step sees them: stiffness, damping and mass of each kind, with its deck line.

The stiffness and damping are facts of the laws (`mudline.model.contact.stiffest`), the largest that they can reach. The
mass is the one that a node carries: of half of each of its elements, without contents or added water. Elements give a
node half of their stiffness and damping each, laws of nodes their own. The rules about time steps and the study of
stability share these numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.basics.quantities import time_unit, unit_names
from mudline.language.codes import RUN001
from mudline.language.diagnostics import Problem, Where
from mudline.model.contact.input import LawKind
from mudline.model.scene.numbering import Floats, Indices, Mask, at_nodes, summed
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.model.contact.input import ContactInput
    from mudline.model.contact.stiffest import Stiffest

_RISES = np.linspace(0.02, 1.0, 50)
"""Pull-out velocities over v_r at which the mobilisation of suction is looked at."""
_NEARLY = 0.999
SOFTENING = "softening"
"""Kind of what falls as it moves on."""


class Oscillation(NamedTuple):
    """One kind of contact, at its node that asks for the smallest step.

    kind: "normal", "nodal", "unloading", "friction", "softening", "lateral", "suction spring", "suction mobilisation"
        or "suction damping".
    name: its law, and the set through which its elements have it.
    element: index of its element, or of one element of its node.
    node: index of its node.
    shared: how many elements have it; of laws of nodes how many nodes.
    stiffness, damping, mass: per unit length of the node.
    speed: pull-out velocity at which suction has them, else 0.
    where: place in the deck that sets it.
    """

    kind: str
    name: str
    element: int
    node: int
    shared: int
    stiffness: float
    damping: float
    mass: float
    speed: float
    where: Where | None

    @property
    def omega(self) -> float:
        """Root of stiffness over mass, radians per unit of time; 0 for damping alone."""
        return math.sqrt(self.stiffness) / math.sqrt(self.mass)

    @property
    def rate(self) -> float:
        """Damping over mass, per unit of time."""
        return self.damping / self.mass

    def critical_step(self, scheme: str) -> float:
        """The largest time step of a scheme by its name; see `mudline.model.contact.stiffest.critical_step`."""
        from mudline.model.contact.stiffest import critical_step  # noqa: PLC0415 - loaded when it is needed

        return critical_step(scheme, self.omega, self.rate)


class Oscillations(NamedTuple):
    """What oscillates, the fastest first, and (name, reason) of contacts of which nothing is known.

    softening: what falls as it moves on: its `omega` is the rate at which a motion grows.
    """

    found: list[Oscillation]
    unknown: list[tuple[str, str]]
    softening: list[Oscillation]


def oscillations(scene: ResolvedDeck, given: ContactInput) -> Oscillations:
    """The contacts of a scene whose evaluator has the input `given`."""
    from mudline.model.contact import ContactModel  # noqa: PLC0415 - loaded when it is needed

    carried = _Carried(scene)
    every = [*_of_elements(scene, given, ContactModel(given).stiffest(), carried)]
    found = [one for one in every if isinstance(one, Oscillation)]
    unknown = [one for one in every if not isinstance(one, Oscillation)]
    softening = [one for one in found if one.kind == SOFTENING]
    springs = [one for one in found if one.kind != SOFTENING]
    springs.sort(key=lambda one: one.critical_step("central-difference"))
    return Oscillations(springs, unknown, softening)


def line_of(scene: ResolvedDeck, where: Where | None) -> int:
    """Line of a place in the file that it stands in; 0 for none."""
    return 0 if where is None else scene.deck.place(Problem(RUN001, "", where=where)).line


def softening_needs(scene: ResolvedDeck, one: Oscillation) -> str:
    """What a structure and time steps need where a resistance falls: " = stiffness; steps"."""
    from mudline.model.contact.stiffest import ADVISED_OMEGA_DT, rounded_down  # noqa: PLC0415 - loaded when it is needed

    unit, time = unit_names(scene.units).behind("stiffness"), f" {time_unit(scene.units)}".rstrip()
    place, step = f"node {scene.node_ids[one.node]}", rounded_down(ADVISED_OMEGA_DT / one.omega)
    return f" = {one.stiffness:.6g}{unit} ({place}); in time, the fall needs steps of {step:.3g}{time} or less"


class _Carried:
    """Length (n,) and mass per unit length (n,) of the nodes, and what they have of values of their elements."""

    def __init__(self, scene: ResolvedDeck) -> None:
        self.ends, self.nodes = scene.element_nodes, len(scene.node_ids)
        length = np.where(np.isfinite(scene.length), scene.length, 0.0)
        with np.errstate(all="ignore"):
            self.length = summed(0.5 * length, self.ends, self.nodes)
            self._shares = [0.5 * length / self.length[end] for end in self.ends.T]
            self.mass = self.spread(scene.mass_per_length)

    def spread(self, values: Floats) -> Floats:
        """Values per unit length of elements (m,) as those of their nodes (n,)."""
        found = np.zeros(self.nodes)
        for end, share in zip(self.ends.T, self._shares, strict=True):
            np.add.at(found, end, share * values)
        return found

    def leading(self, values: Floats) -> Mask:
        """Which elements (m,) give the most to each of their two nodes (m, 2)."""
        parts = np.column_stack([share * values for share in self._shares])
        largest = np.zeros(self.nodes)
        np.maximum.at(largest, self.ends, parts)
        return parts >= largest[self.ends]


def _of_elements(
    scene: ResolvedDeck, given: ContactInput, facts: Stiffest, carried: _Carried
) -> Iterator[Oscillation | tuple[str, str]]:
    """Every kind of contact, or its name and why its frequency is not known."""
    from mudline.model.contact.laws import is_normal  # noqa: PLC0415 - loaded when it is needed

    by_law = {law.law: law for law in facts.laws}
    springs_of = {law.law: law.at_nodes for law in facts.laws if law.at_nodes is not None}
    none = np.zeros(len(given.element_ids))
    inward = np.nan_to_num(by_law["damping"].damping) if "damping" in by_law else none
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
        yield _of_group("normal", name, group, (normal, inward), carried, place)
        if back is not None and steeper[group].any():
            place = back.places[int(back.of_element[group[0]])].inside("stiffness")
            yield _of_group("unloading", f"unloading of {name}", group, (returns, inward), carried, place)
    damped = given.assigned.get("nodal damping")
    own = np.zeros(carried.nodes) if damped is None else damped.spread("damping", carried.nodes, 0.0)
    if "nodal" in springs_of:
        yield from _of_nodes(scene, springs_of["nodal"], own, carried)
    for law, field in (("suction spring", "suction"), ("lateral", "lateral")):
        if law in by_law:
            for group in _groups(~np.isnan(by_law[law].stiffness), scene.resistance.of_element, sections):
                place = scene.resistance.places[int(scene.resistance.of_element[group[0]])].inside(field)
                name = f"{law} on {_set_of_resistance(scene, int(group[0]))}"
                yield _of_group(law, name, group, (by_law[law].stiffness, none), carried, place)
    if "suction" in by_law:
        yield from _of_suction(scene, given, carried)
    if "friction" in springs_of:
        yield from _of_friction(scene, given, springs_of["friction"], carried)
    if "breakout" in springs_of:
        yield from _of_springs(scene, SOFTENING, "peak", springs_of["breakout"], carried)


def _groups(having: Mask, *keys: Indices) -> list[Indices]:
    """Indices of the elements that have something, in groups of the same keys, in the order of the keys."""
    rows = np.flatnonzero(having)
    if not rows.size:
        return []
    _, group, counts = np.unique(
        np.column_stack([key[rows] for key in keys]), axis=0, return_inverse=True, return_counts=True
    )
    return np.split(rows[np.argsort(group.ravel(), kind="stable")], np.cumsum(counts)[:-1])


def _of_group(  # noqa: PLR0913, PLR0917 - what a contact is made of
    kind: str,
    name: str,
    group: Indices,
    values: tuple[Floats, Floats],
    carried: _Carried,
    where: Where | None,
    speed: float = 0.0,
) -> Oscillation | tuple[str, str]:
    """The node of some elements with the largest stiffness, or damping, over its mass.

    `values` are the stiffness and the damping (m,) of all elements of this kind. A node between two laws belongs to the
    one that gives it more.
    """
    stiffness, damping = (np.where(np.isnan(part), 0.0, part) for part in values)
    leads = stiffness if stiffness[group].any() else damping
    if not np.isfinite(leads[group]).all():
        return name, "no frequency: its law has no largest stiffness or damping"
    if not (leads[group] > 0.0).any():
        return name, "no frequency: its law never stiffens"
    with np.errstate(all="ignore"):
        of_nodes = carried.spread(leads)
        ends = carried.ends[group]
        weight = np.where(carried.leading(leads)[group], of_nodes[ends] / carried.mass[ends], np.nan)
        if np.isnan(weight).all():
            weight = of_nodes[ends] / carried.mass[ends]
    if np.isnan(weight).all():
        return name, "no frequency: the mass per unit length is not known"
    at, end = np.unravel_index(int(np.nanargmax(weight)), weight.shape)
    node = int(ends[at, end])
    rigid, damped = (float(carried.spread(part)[node]) for part in (stiffness, damping))
    mass = float(carried.mass[node])
    return _checked(Oscillation(kind, name, int(group[at]), node, len(group), rigid, damped, mass, speed, where))


def _checked(one: Oscillation) -> Oscillation | tuple[str, str]:
    usable = one.mass > 0.0 and math.isfinite(one.mass)
    if not usable:
        return one.name, "no frequency: the mass per unit length is not known"
    finite = math.isfinite(one.stiffness) and math.isfinite(one.damping)
    if not finite or not (one.omega > 0.0 or one.rate > 0.0):
        return one.name, "no frequency: its law has no largest stiffness or damping"
    return one


def _of_nodes(
    scene: ResolvedDeck, stiffness: Floats, damping: Floats, carried: _Carried
) -> Iterator[Oscillation | tuple[str, str]]:
    """Nodes with a stiffness of their own, and maybe a damping: of each stiffness the fastest node."""
    contact = scene.extensions["SEABED CONTACT"]
    blocks = at_nodes(np.where(scene.nodal, contact.of_element, -1), carried.ends, carried.nodes)
    for value in np.unique(stiffness[stiffness > 0.0]).tolist():
        nodes = np.flatnonzero(stiffness == value)
        found = _of_node("nodal", f"nodal {value:.6g}", nodes, stiffness, carried)
        if isinstance(found, Oscillation):
            place = contact.places[int(blocks[found.node])].inside("nodal_stiffness")
            name, rate = f"{found.name} at node {scene.node_ids[found.node]}", damping[found.node]
            yield found._replace(name=name, where=place, damping=float(rate / carried.length[found.node]))
        else:
            yield (f"nodal stiffness {value:.6g}", "no frequency: the mass of its nodes is not known")


def _of_node(
    kind: str, name: str, nodes: Indices, stiffness: Floats, carried: _Carried
) -> Oscillation | tuple[str, str]:
    """The node of some with the largest stiffness, force per length, over the mass that it carries."""
    with np.errstate(all="ignore"):
        per_length = stiffness / carried.length
        weight = per_length[nodes] / carried.mass[nodes]
    if np.isnan(weight).all():
        return name, "no frequency: the mass or the weight of its nodes is not known"
    node = int(nodes[np.nanargmax(weight)])
    element = int(np.flatnonzero((carried.ends == node).any(axis=1))[0])
    mass = float(carried.mass[node])
    return _checked(Oscillation(kind, name, element, node, len(nodes), float(per_length[node]), 0.0, mass, 0.0, None))


def _of_friction(
    scene: ResolvedDeck, given: ContactInput, stiffness: Floats, carried: _Carried
) -> Iterator[Oscillation | tuple[str, str]]:
    """Nodes that stick, and why some have no springs."""
    yield from _of_springs(scene, "friction", "stiffness", stiffness, carried)
    ends, sliding = carried.ends, given.assigned["friction"].rows
    unknown = sliding[np.isnan(stiffness[sliding])]
    if unknown.size:
        around = scene.submerged_weight[np.isin(ends, unknown).any(axis=1)]
        why = "which is not known" if np.isnan(around).any() else "and the pipe floats"
        yield "friction", f"no springs at {len(unknown)} nodes: they follow the submerged weight, {why}"


def _of_springs(
    scene: ResolvedDeck, kind: str, field: str, stiffness: Floats, carried: _Carried
) -> Iterator[Oscillation | tuple[str, str]]:
    """Nodes (n,) with a spring of friction, by the place that gives it: `field` of its block, or FRICTION=."""
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
        found = _of_node(kind, name, group, stiffness, carried)
        yield found._replace(where=place) if isinstance(found, Oscillation) else found


def _of_suction(scene: ResolvedDeck, given: ContactInput, carried: _Carried) -> Iterator[Oscillation | tuple[str, str]]:
    """Suction that is mobilised, and its damping at rest, by the place that gives it."""
    from mudline.model.contact.laws.suction import SuctionLaw, suction_rates  # noqa: PLC0415 - only now is it needed

    own = scene.extensions["SEABED SUCTION"]
    assigned = given.assigned["suction"]
    law = SuctionLaw(*assigned.columns)
    having = np.zeros(len(given.element_ids), np.bool_)
    having[assigned.rows] = True

    def at(velocity: Floats) -> tuple[Floats, Floats]:
        rates = np.full((2, len(having)), np.nan)
        rates[:, assigned.rows] = suction_rates(law, velocity)
        return rates[0], rates[1]

    for group in _groups(having, own.of_element, scene.section_table.of_element):
        index = int(own.of_element[group[0]])
        holder = own.sets[index]
        name = f"on {'ALL' if holder is None else holder.name}"
        row = int(np.flatnonzero(assigned.rows == group[0])[0])
        slow = float(law.regularisation[row])
        if law.force_factor[row] * law.largest_factor[row] == 0.0:
            continue
        if not slow > 0.0 or law.force_exponent[row] > 1.0:
            reason = "no frequency: its damping has no largest value (REGULARISATION=, exponent)"
            yield f"suction damping {name}", reason
            continue
        rest = at(0.0 * law.regularisation)[1]
        damping = np.fmax(rest, at(law.regularisation)[1])
        none = np.zeros(len(having))
        place = own.places[index].inside("cohesion" if getattr(own.entries[index], "force", None) is None else "force")
        at_rest = _of_group("suction damping", f"suction damping {name}", group, (none, damping), carried, place)
        yield at_rest
        if law.force_exponent[row] > law.depth_exponent[row]:
            yield (f"suction mobilisation {name}", "no frequency: its stiffness grows with the pull-out velocity")
            continue
        tried = [
            _of_group(
                "suction mobilisation",
                f"suction mobilisation {name}",
                group,
                at(share * law.regularisation),
                carried,
                place,
                share * slow,
            )
            for share in _RISES.tolist()
        ]
        known = [one for one in tried if isinstance(one, Oscillation)]
        yield known[-1] if known else tried[-1]
        worst = min(known, key=lambda one: one.critical_step("central-difference"), default=None)
        limits = [one for one in (*known[-1:], at_rest) if isinstance(one, Oscillation)]
        if worst is not None and worst.critical_step("central-difference") < _NEARLY * min(
            one.critical_step("central-difference") for one in limits
        ):
            yield worst._replace(name=f"{worst.name} at {worst.speed:.3g}")


def _set_of_resistance(scene: ResolvedDeck, element: int) -> str:
    """Name of the set through which an element has its resistance; ALL for a surface."""
    index = int(scene.laws.covered[element])
    return scene.laws.set_laws[index].set_.name if index >= 0 else "ALL"


def _place_of_law(scene: ResolvedDeck, element: int) -> Where | None:
    """Where the stiffness of an element stands: the end of the steepest segment of its curve."""
    for _, field, extension, elements in reversed(scene.replaced):
        if elements[element]:
            return extension.places[int(extension.of_element[element])].inside(field)
    law = scene.set_law(element)
    if law is None:
        return None
    if law.kind is not LawKind.CURVE or law.curve < 0:
        return law.where
    entry = scene.laws.curves[law.curve]
    curve = entry.curve
    if curve is None or not entry.usable:
        return law.where
    slopes = np.append(curve.slopes, curve.slopes[-1])
    steepest = int(np.argmax(np.where(np.append(curve.ratios[1:], np.inf) > 0.0, slopes, -np.inf)))
    deeper = curve.ratios[min(steepest + 1, len(curve.ratios) - 1)]
    return entry.point(int(np.flatnonzero(entry.points[:, 0] == deeper)[0]))
