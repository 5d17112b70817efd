"""The contacts of a scene with their frequencies, and each of them under load as an oscillator of the real evaluator.

The contacts are those of `mudline.scene.oscillation`: normal laws, unloading, friction that sticks, lateral springs,
and suction with its damping, each with the mass that its node carries.

A load holds a contact where its law is steepest, and it oscillates there. The evaluator has copies of the element of
the contact, one unit of length each, with the law that is studied. Friction, lateral springs and suction need a seabed
besides: a linear one that gives the static normal force. The state of the laws is that after an earlier step: a node
that sticks, the deepest penetration, suction that is armed.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np

from mudline.contact import ContactInput, ContactModel, LawAssignment
from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import SuctionLaw
from mudline.contact.stiffest import ADVISED_OMEGA_DT, critical_step, static_normal_force, suction_rates
from mudline.contact.tables import Tables
from mudline.scene.model import Scene
from mudline.scene.oscillation import Oscillation, line_of, oscillations, steepest_segment
from mudline.study import file_of
from mudline.study.motion import Forces, History
from mudline.study.report import Layout, Omission, columns_of

_BEYOND = 10.0
"""Times the reach of a contact: a motion that gets this far has grown, and has no force."""
_SLOW = 1e-3
"""Of v_r: at rest suction has no derivative, so its damping is evaluated in a motion this slow."""
_BELOW = 1e-4
"""How far below the end of the rise of suction, and below v_r, its mobilisation is evaluated."""
_PRESSED = 0.01
"""Depth on the seabed below friction, lateral springs and suction."""
_NARROWEST = 1e-5
"""Of the scale of a contact: the least reach of an oscillation that rounding leaves visible."""
_SOFTEST = 1e-280
_SLOWEST = 1e-140
"""And the fastest the other way round: the square of a step must be a number."""
_X, _Y, _Z = range(3)

Parameters = dict[str, float]


class Setting(NamedTuple):
    """The copies of a contact, and the small motion that is studied.

    laws: name and parameters of the laws of each copy, of its element or its two nodes.
    direction: of the motion: 0 up, 1 along the element, 2 across it.
    depth: of the motion's centre; below 0 it is above the mudline.
    before: depth of the step before, where the laws have a history.
    speed: upwards, of the motion's centre.
    reach: how far to both sides the law has this stiffness, or damping.
    scale: the largest distance that the law computes with there; an oscillation below its rounding is not resolved.
    factor: stiffness and mass of a copy over those per unit length.
    """

    laws: dict[str, Parameters]
    direction: int
    depth: float
    before: float | None
    speed: float
    reach: float
    scale: float
    factor: float = 1.0


class Contact(NamedTuple):
    """One kind of contact.

    name: its law, and the set through which its elements have it.
    element: index of an element at the node that asks for the smallest step.
    elements: how many elements share it; of laws of nodes how many nodes.
    stiffness: the largest tangent stiffness that its law can reach, per unit length.
    mass: that the node carries, per unit length.
    omega: root of stiffness over mass, radians per unit of time.
    damping: the largest derivative of its force by velocity, per unit length.
    rate: damping over mass.
    node: number of the node.
    line: of the deck, that sets it; 0 for none.
    file: of that line, where it is in a deck that this one continues; "" for this deck.
    oscillation: the same as the scene has it.
    setting: how copies of it are set up.
    """

    name: Annotated[str, "contact"]
    element: int
    elements: Annotated[int, "elements"]
    stiffness: Annotated[float, "largest stiffness [{force}/{length}2]"]
    mass: Annotated[float, "mass [{mass}/{length}]"]
    omega: Annotated[float, "omega [rad/s]"]
    damping: float
    rate: float
    node: int
    line: int
    file: str
    oscillation: Oscillation
    setting: Setting

    @property
    def depth(self) -> float:
        """A penetration in the middle of where the law has this stiffness."""
        return self.setting.depth

    @property
    def reach(self) -> float:
        """How far to both sides it has it."""
        return self.setting.reach

    def critical_step(self, scheme: str) -> float:
        """The largest step of a scheme, by its name, at which a small motion does not grow."""
        return critical_step(scheme, self.omega, self.rate)

    @property
    def advised_step(self) -> float:
        """The step at which omega dt is `ADVISED_OMEGA_DT`; infinite for damping alone."""
        return ADVISED_OMEGA_DT / self.omega if self.omega > 0.0 else np.inf


CONTACTS = Layout[Contact](
    "contacts",
    "Frequencies of the contacts, the smallest step first",
    {
        **columns_of(Contact),
        "advised step, implicit [s]": lambda one: one.advised_step,
        "critical step, central-difference [s]": lambda one: one.critical_step("central-difference"),
        "critical step, rk4 [s]": lambda one: one.critical_step("rk4"),
        "critical step, velocity-verlet [s]": lambda one: one.critical_step("velocity-verlet"),
        "damping [{force} s/{length}2]": lambda one: one.damping,
        "damping rate [1/s]": lambda one: one.rate,
        "kind": lambda one: one.oscillation.kind,
        "node": lambda one: one.node,
        "deck line": lambda one: one.line,
        "deck file": lambda one: one.file,
    },
)


def find_contacts(scene: Scene) -> tuple[list[Contact], list[Omission]]:
    """The contacts that oscillate, the smallest step first, and those of which no frequency is known."""
    given = scene.contact_input("cut")
    found, unknown = oscillations(scene, given)
    return [_contact(scene, given, one) for one in found], [Omission(*each) for each in unknown]


def _contact(scene: Scene, given: ContactInput, one: Oscillation) -> Contact:
    return Contact(
        one.name,
        one.element,
        one.shared,
        one.stiffness,
        one.mass,
        one.omega,
        one.damping,
        one.rate,
        int(scene.node_ids[one.node]),
        line_of(scene, one.where),
        file_of(scene, one.where),
        one,
        setting_of(scene, given, one),
    )


def can_oscillate(contact: Contact) -> bool:
    """Whether a small oscillation is more than the rounding of depths and forces."""
    setting = contact.setting
    wide = _NARROWEST * setting.scale < setting.reach < np.inf
    felt = contact.omega == 0.0 or (
        _SOFTEST < contact.stiffness * setting.reach < np.inf and _SLOWEST < contact.omega < 1.0 / _SLOWEST
    )
    return wide and felt and contact.rate < 1.0 / _SLOWEST


# ----------------------------------------------------------------------------------------------------------- under load


def setting_of(scene: Scene, given: ContactInput, one: Oscillation) -> Setting:
    """How a contact of the scene, whose evaluator has the input `given`, is set up."""
    if one.kind == "nodal":
        return _nodal(scene, given, one)
    if one.kind in {"normal", "unloading"}:
        return _normal(scene, given, one)
    if one.kind in {"lateral", "suction spring"}:
        return _spring(scene, given, one)
    return _friction(given, one) if one.kind == "friction" else _suction(given, one)


def _nodal(scene: Scene, given: ContactInput, one: Oscillation) -> Setting:
    nodal, small = _parameters(given, "nodal", one.node), _small(scene, one.element)
    depth = small + nodal["half_width"]
    return Setting({"nodal": nodal}, _X, depth, None, 0.0, small, depth, 2.0 * nodal["stiffness"] / one.stiffness)


def _normal(scene: Scene, given: ContactInput, one: Oscillation) -> Setting:
    """In the middle of the steepest segment, or below the zone; for unloading half way up the line from there."""
    laws = [name for name in ("curve", "linear", "smoothed") if _has(given, name, one.element)]
    normal = {name: _parameters(given, name, one.element) for name in laws}
    if "curve" in normal:
        depth, reach, scale, own = _on_segment(scene, one.element)
    else:
        (parameters,) = normal.values()
        reach, own = _small(scene, one.element), parameters["stiffness"]
        scale = depth = reach + parameters.get("half_width", 0.0)
    if one.kind == "normal":
        return Setting(normal, _X, depth, None, 0.0, reach, scale, own / one.stiffness)
    unloading = _parameters(given, "unloading", one.element)
    deepest = depth + reach if "curve" in normal else depth
    force = float(ContactModel(_copies(given, one.element, normal, 1)).evaluate(_points(1, deepest)).force[0])
    half = 0.5 * force / unloading["stiffness"]
    laws_too = {**normal, "unloading": unloading}
    factor = unloading["stiffness"] / one.stiffness
    return Setting(laws_too, _X, deepest - half, deepest, 0.0, half, deepest, factor)


def _spring(scene: Scene, given: ContactInput, one: Oscillation) -> Setting:
    """Lateral springs, moved across from the touchdown point, and those against uplift, half way up their extent."""
    parameters = _parameters(given, one.kind, one.element)
    factor = parameters["stiffness"] / one.stiffness
    if one.kind == "lateral":
        laws = {"linear": {"stiffness": 1.0}, "lateral": parameters}
        return Setting(laws, _Z, _PRESSED, _PRESSED, 0.0, _small(scene, one.element), 1.0, factor)
    half = 0.5 * parameters["extent"]
    laws = {"linear": {"stiffness": parameters["stiffness"]}, "suction spring": parameters}
    return Setting(laws, _X, -half, None, 0.0, half, half, factor)


def _has(given: ContactInput, law: str, row: int) -> bool:
    return law in given.assigned and bool((given.assigned[law].rows == row).any())


def _parameters(given: ContactInput, law: str, row: int) -> Parameters:
    """The parameters that an element, or a node, has of a law."""
    assigned = given.assigned[law]
    at = int(np.searchsorted(assigned.rows, row))
    return {name: float(values[at]) for name, values in assigned.parameters.items()}


def _small(scene: Scene, element: int) -> float:
    """A small distance for a linear law."""
    diameter = float(scene.diameter[element])
    return 0.01 * diameter if np.isfinite(diameter) else 0.01


def _on_segment(scene: Scene, element: int) -> tuple[float, float, float, float]:
    """Depth, reach, scale and stiffness of the steepest segment of an element's curve.

    The continued end of a curve counts as a segment as wide as the last one.
    """
    law, diameter = scene.set_law(element), float(scene.diameter[element])
    segment = None if law is None else steepest_segment(scene.laws.curves[law.curve])
    if segment is None:
        return (math.nan,) * 4
    low, high = max(segment.low, 0.0), segment.high
    if high <= 0.0:  # only the continued end lies below the mudline
        high = min(max(high + (high - segment.low), 0.1), np.finfo(np.float64).max)
    middle, half, far = 0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low, max(abs(segment.low), high)
    return middle * diameter, half * diameter, far * diameter, segment.slope / diameter


def _friction(given: ContactInput, one: Oscillation) -> Setting:
    """A node that sticks under its static normal force, pulled along its stiffer direction."""
    friction = {**_parameters(given, "friction", one.node), "angle": math.nan}
    tables = Tables(given)
    rows = tables.friction
    if rows is None:
        raise TypeError("a contact with friction is set up without friction")
    normal_force = float(static_normal_force(tables)[one.node])
    coefficients = rows.coefficients[:, one.node]
    if not normal_force > 0.0:  # all springs are constant: any force does that lets them move a little
        normal_force = float(rows.constant[:, one.node].max() * 1e-3 / coefficients.max())
    springs = np.where(coefficients > 0.0, rows.constant[:, one.node] + rows.rising[:, one.node] * normal_force, 0.0)
    side = int(springs.argmax())
    reach = float(coefficients[side] * normal_force / springs[side])
    laws = {"linear": {"stiffness": 2.0 * normal_force / _PRESSED}, "friction": friction}
    factor = 2.0 * float(springs[side]) / one.stiffness
    return Setting(laws, _Y + side, _PRESSED, _PRESSED, 0.0, reach, 1.0, factor)


def _suction(given: ContactInput, one: Oscillation) -> Setting:
    """At the end of the rise at a pull-out velocity, or, without one, on the plateau close to rest."""
    parameters = _parameters(given, "suction", one.element)
    law = SuctionLaw(*(np.array([value]) for value in parameters.values()))
    breakout = float(law.least_depth[0])
    seabed = {"linear": {"stiffness": 1.0}, "suction": parameters}
    if one.speed > 0.0:
        rise = parameters["first_corner"] * breakout
        factor = float(suction_rates(law, np.array([one.speed]))[0][0]) / one.stiffness
        reach, speed = _BELOW * rise, one.speed * (1.0 - _BELOW)
        return Setting(seabed, _X, -rise + reach, _PRESSED, speed, reach, rise, factor)
    corners = parameters["first_corner"], parameters["second_corner"]
    middle, half = 0.5 * sum(corners) * breakout, 0.5 * (corners[1] - corners[0]) * breakout
    factor = float(suction_rates(law, np.array([0.0]))[1][0]) / one.damping
    return Setting(seabed, _X, -middle, _PRESSED, _SLOW * parameters["regularisation"], half, breakout, factor)


def _copies(given: ContactInput, element: int, laws: dict[str, Parameters], runs: int) -> ContactInput:
    """Separate elements of one unit of length with these laws."""
    of_nodes = {name for name in laws if name in {"nodal", "friction"}}
    return ContactInput(
        node_ids=np.arange(1, 2 * runs + 1),
        coordinates=np.zeros((2 * runs, 3)),
        element_ids=np.arange(1, runs + 1),
        element_nodes=np.arange(2 * runs).reshape(runs, 2),
        length=np.ones(runs),
        diameter=np.full(runs, given.diameter[element]),
        laws=tuple(
            LawAssignment(name, np.arange(runs * (1 + (name in of_nodes))), parameters)
            for name, parameters in laws.items()
        ),
        curves=given.curves,
    )


def _points(runs: int, depth: float) -> FloatArray:
    points = np.zeros((2 * runs, 3))
    points[1::2, _Y] = 1.0
    points[:, _X] = -depth
    return points


class LoadedContact:
    """`runs` copies of a contact, under a load that holds them at the centre of the motion.

    Positions are distances from the centre, velocities are relative to that of the centre; forces are those of the
    evaluator along the motion, less the load. The history of the laws does not change.

    Attributes:
        mass: (k,) of the copies.
        load: of each copy.
    """

    def __init__(self, given: ContactInput, one: Oscillation, setting: Setting, runs: int) -> None:
        self._model = ContactModel(_copies(given, one.element, setting.laws, runs), backend="numpy")
        self._side, self._far = setting.direction, _BEYOND * setting.reach
        self._state = self._model.initial_state()
        if setting.before is not None:
            at_rest = _points(runs, setting.before)
            _, self._state = self._model.step(at_rest, np.zeros_like(at_rest), self._state)
        self._centre, self._speed = _points(runs, setting.depth), setting.speed
        self._stiffness, self._damping = (
            np.full(runs, setting.factor * value) for value in (one.stiffness, one.damping)
        )
        self.mass: FloatArray = np.full(runs, setting.factor * one.mass)
        self.load = 0.0
        self.load = float(self.forces(np.zeros(runs), np.zeros(runs), None).force[0])

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        usable = np.abs(position) < self._far
        points, rates = self._centre.copy(), np.zeros_like(self._centre)
        points[:, self._side] += np.repeat(np.where(usable, position, 0.0), 2)
        rates[:, _X] = self._speed
        rates[:, self._side] += np.repeat(np.where(np.isfinite(velocity), velocity, 0.0), 2)
        result, _ = self._model.step(points, rates, self._state)
        force = result.reaction[:, self._side].reshape(-1, 2).sum(axis=1)
        return Forces(np.where(usable, force - self.load, np.nan), -self._stiffness, -self._damping, history)
