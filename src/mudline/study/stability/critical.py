"""Critical steps, predicted and measured: each scheme really steps a mass on each contact of the scene.

The contacts of a scene are elements that share a law and a section, or nodes; with their stiffness, mass and frequency.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact import ContactInput, ContactModel, LawAssignment, LawKind
from mudline.contact.arrays import FloatArray
from mudline.contact.stiffest import ADVISED_OMEGA_DT, CRITICAL_OMEGA_DT, omega, rounded_down, steepest_slope
from mudline.scene.assignments import given_stiffness
from mudline.scene.model import Scene
from mudline.study.motion import Forces, History, Motion, Scheme, march
from mudline.study.pictures import Picture, drawn, label, legend_below
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of
from mudline.study.schemes import SCHEMES, Newton, OneStep

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure


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

    name: Annotated[str, "contact"]
    element: int
    elements: Annotated[int, "elements"]
    stiffness: Annotated[float, "largest stiffness [{force}/{length}2]"]
    mass: Annotated[float, "mass [{mass}/{length}]"]
    omega: Annotated[float, "omega [rad/s]"]
    depth: float
    reach: float
    scale: float
    unloading: bool = False


CONTACTS = Layout[Contact](
    "contacts",
    "Frequencies of the contacts, the fastest first",
    {
        **columns_of(Contact),
        "advised step, implicit [s]": lambda one: ADVISED_OMEGA_DT / one.omega,
        "critical step, central-difference [s]": lambda one: CRITICAL_OMEGA_DT["central-difference"] / one.omega,
        "critical step, rk4 [s]": lambda one: CRITICAL_OMEGA_DT["rk4"] / one.omega,
    },
)


def find_contacts(scene: Scene) -> tuple[list[Contact], list[Omission]]:
    """The contacts that oscillate, the fastest first, and those of which no frequency is known."""
    springs = np.flatnonzero(np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    back = scene.extensions.get("SEABED UNLOADING")
    ways = np.full(len(scene.law), -1) if back is None else back.of_element
    kinds = np.column_stack([part[springs] for part in (scene.laws.of_element, scene.section_table.of_element, ways)])
    returns = np.full(len(scene.law), np.nan) if back is None else given_stiffness(back)
    masses = scene.mass_per_length
    found, left_out = _nodal(scene, masses)
    _, firsts, counts = np.unique(kinds, axis=0, return_index=True, return_counts=True)
    for element, count in zip(springs[firsts].tolist(), counts.tolist(), strict=True):
        name = f"{scene.law_names[element]} on {scene.law_sets[element]}"
        mass = float(masses[element])
        stiffness, depth, reach, scale = _steepest(scene, element)
        frequency = float(omega(np.array(stiffness), np.array(mass)))
        if np.isnan(frequency):
            what = "the mass per unit length is not known" if np.isnan(mass) else "its law never stiffens"
            left_out.append(Omission(name, f"no frequency: {what}"))
            continue
        found.append(Contact(name, element, count, stiffness, mass, frequency, depth, reach, scale))
        if (back_stiffness := float(returns[element])) > stiffness:
            frequency = float(omega(np.array(back_stiffness), np.array(mass)))
            numbers = back_stiffness, mass, frequency, *_small(scene, element)
            found.append(Contact(f"unloading of {name}", element, count, *numbers, unloading=True))
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


def _steepest(scene: Scene, element: int) -> tuple[float, float, float, float]:
    """Stiffness, depth, reach and scale of the segment of the largest slope.

    The continued end of a curve counts as a segment as wide as the last one.
    """
    arrays = scene.law_arrays()
    if scene.law[element] != LawKind.CURVE:
        return float(arrays.linear_stiffness[element]), *_small(scene, element)
    curve, diameter = arrays.curves[int(arrays.curve_index[element])], float(scene.diameter[element])
    slope = steepest_slope(curve.ratios, curve.slopes)
    last, width = curve.ratios[-1], curve.ratios[-1] - curve.ratios[-2]
    with np.errstate(over="ignore"):
        end = max(last + width, 0.1 + max(last, 0.0))
    ratios: FloatArray = np.append(curve.ratios, min(end, np.finfo(np.float64).max))
    slopes = np.append(curve.slopes, curve.slopes[-1])
    at = int(np.argmax(np.where(ratios[1:] > 0.0, slopes, -np.inf)))
    low, high = max(float(ratios[at]), 0.0), float(ratios[at + 1])
    middle, half, far = 0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low, max(abs(float(ratios[at])), high)
    return slope / diameter, middle * diameter, half * diameter, far * diameter


MOST_CONTACTS = 6
"""Stepped by default, the fastest; all of them in a full run."""
STEPS = 400
GROWTH = 100.0
"""A motion that leaves so many times its first amplitude behind grows."""
AMPLITUDE = 1e-6
"""Of the reach of the segment: implicit schemes guess (omega dt)^2 times as far, and still the law is linear."""
SHARES = np.array([*np.arange(180, 200), *np.arange(201, 221)]) / 200.0
"""Of the predicted critical step, from 0.9 to 1.1 and without 1: at the critical step itself growth has no rate."""
FAR = 100.0
"""omega dt at which schemes without a critical step are tried."""
ALWAYS = 1.0
"""The same for those that grow at every step."""

BOUNDED, GROWS, NO_CONVERGENCE, NOT_TRIED = "bounded", "grows", "no convergence", "-"

_BEYOND = 10.0
"""Times the reach of the segment: a motion that comes so far has grown, and has no force any more."""
_NARROWEST = 1e-5
_SOFTEST = 1e-280
_SLOWEST = 1e-140
"""And the fastest the other way round: the square of a step must be a number."""


class Measured(NamedTuple):
    """A scheme on a contact.

    predicted: critical step; inf for none, 0 for a scheme that grows at every step.
    measured: the middle between the largest step that stayed bounded and the smallest that grew; NaN where there is
        only one try.
    below: what the motion did at 0.99 of the predicted step; at omega dt = FAR where there is none.
    above: what it did at 1.01 of it; at omega dt = ALWAYS where it is 0.
    tried: what it did at each of `SHARES`; empty without a critical step above 0.
    """

    contact: Contact
    scheme: Scheme
    predicted: float
    measured: float
    below: str
    above: str
    tried: tuple[str, ...] = ()

    @property
    def as_predicted(self) -> bool:
        """Whether it stayed bounded where it should and grew where it should."""
        return self.below in {BOUNDED, NOT_TRIED} and self.above in {GROWS, NOT_TRIED}


CRITICAL_STEPS = Layout[Measured](
    "critical-steps",
    f"Critical steps (none: tried at omega dt = {FAR:g}; 0: tried at {ALWAYS:g})",
    {
        "contact": lambda one: one.contact.name,
        "scheme": lambda one: one.scheme.title,
        "predicted [s]": lambda one: one.predicted,
        "measured [s]": lambda one: one.measured,
        "at 0.99": lambda one: one.below,
        "at 1.01": lambda one: one.above,
        "as predicted": lambda one: "yes" if one.as_predicted else "NO",
    },
)


def study_steps(scene: Scene, options: StudyOptions) -> Section:
    """Every scheme on the fastest contacts of a scene, or in a full run on all of them."""
    found, omissions = find_contacts(scene)
    wide = [one for one in found if can_oscillate(one)]
    omissions += [
        Omission(one.name, "not stepped: a small oscillation there is below rounding")
        for one in found
        if one not in wide
    ]
    stepped = wide if options.full else wide[:MOST_CONTACTS]
    omissions += [
        Omission(one.name, "not stepped: slower than those that were (--full)") for one in wide[len(stepped) :]
    ]
    measured: list[Measured] = []
    for contact in stepped:
        options.progress(f"steps on {contact.name}")
        measured += [measure(scene, contact, scheme) for scheme in SCHEMES.values()]
    tables = (CONTACTS.table(found, scene.units), CRITICAL_STEPS.table(measured))
    pictures = [_picture(measured)] if measured else []
    return Section(tables, pictures, _notes(found, measured), omissions)


def _notes(found: Sequence[Contact], measured: Sequence[Measured]) -> list[str]:
    if not found:
        return ["No contact of this deck has a frequency: laws with a stiffness and sections with a mass are needed."]
    fastest = found[0]
    advised = rounded_down(ADVISED_OMEGA_DT / fastest.omega)
    step = (
        f"The fastest contact, {fastest.name}, oscillates at {fastest.omega:.4g} rad/s: use a step of "
        f"{advised:.3g} s or less in implicit schemes (omega dt = {ADVISED_OMEGA_DT:g})."
    )
    runs = (
        f"{sum(one.as_predicted for one in measured)} of {len(measured)} runs of a scheme on a contact did as "
        "predicted: bounded below the critical step, growing above it."
    )
    return [step, runs]


def _picture(measured: Sequence[Measured]) -> Picture:
    """What each scheme did on each contact, at steps around the critical one."""
    rows = [one for one in measured if one.tried]
    caption = "Each mark is a run on a contact of the deck; the predicted step should separate them."
    return Picture("critical-steps", caption, partial(_draw, rows), (10.0, 2.2 + 0.34 * max(len(rows), 2)))


def _draw(rows: Sequence[Measured], figure: Figure) -> None:
    axes = figure.subplots()
    for row, one in enumerate(rows):
        stayed = np.array([word == BOUNDED for word in one.tried])
        for which, mark, color, word in (
            (stayed, "o", "#0072b2", "stays bounded"),
            (~stayed, "x", "#d55e00", "grows"),
        ):
            name = word if not row else None
            axes.plot(SHARES[which], np.full(which.sum(), row), mark, color=color, markersize=5, label=name)
    axes.axvline(1.0, color="0.3", linewidth=1.0, label="predicted critical step")
    names = [f"{drawn(one.contact.name)}\n{one.scheme.title}, {one.predicted:.4g} s" for one in rows]
    axes.set_yticks(range(len(rows)), names, fontsize="small")
    axes.set_ylim(len(rows) - 0.4, -0.6)
    label(axes, "Steps around the critical one, really stepped", "step / predicted critical step [-]", "")
    legend_below(figure, axes, 3)


def can_oscillate(contact: Contact) -> bool:
    """Whether a small oscillation is more than the rounding of depths and forces."""
    wide = _NARROWEST * contact.scale < contact.reach < np.inf
    felt = _SOFTEST < contact.stiffness * contact.reach < np.inf
    return wide and felt and _SLOWEST < contact.omega < 1.0 / _SLOWEST


def measure(scene: Scene, contact: Contact, scheme: Scheme) -> Measured:
    """Step a scheme on a contact below and above its critical step."""
    limit = CRITICAL_OMEGA_DT.get(scheme.name, np.inf)
    if limit in {0.0, np.inf}:
        (word,) = _outcomes(scene, contact, scheme, np.array([ALWAYS if limit == 0.0 else FAR]))
        below, above = (NOT_TRIED, word) if limit == 0.0 else (word, NOT_TRIED)
        return Measured(contact, scheme, limit, np.nan, below, above)
    words = _outcomes(scene, contact, scheme, limit * SHARES)
    step = limit / contact.omega
    below, above = (words[int(np.argmin(np.abs(SHARES - share)))] for share in (0.99, 1.01))
    return Measured(contact, scheme, step, step * _change(words), below, above, tuple(words))


def _change(words: list[str]) -> float:
    """The share between the last that stayed bounded and the first that grew; NaN where there is none such."""
    first = words.index(GROWS) if GROWS in words else 0
    if not first or set(words[:first]) != {BOUNDED} or set(words[first:]) != {GROWS}:
        return float("nan")
    return float(0.5 * (SHARES[first - 1] + SHARES[first]))


def _outcomes(scene: Scene, contact: Contact, scheme: Scheme, omega_dt: FloatArray) -> list[str]:
    """What a small motion does, for values (k,) of omega dt."""
    system = LoadedContact(scene, contact, len(omega_dt))
    if isinstance(scheme, OneStep):
        enough = 64.0 * float(np.finfo(np.float64).eps) * max(abs(system.load), contact.stiffness * contact.scale)
        scheme = scheme.solved_by(replace(Newton(), tolerance=enough))
    start = AMPLITUDE * contact.reach
    motion = Motion.start(system, np.full(len(omega_dt), start), np.zeros(len(omega_dt)))
    run = march(scheme, system, motion, omega_dt / contact.omega, STEPS, bound=GROWTH * start)
    words = [BOUNDED] * len(omega_dt)
    for index, why in run.failures.items():
        words[index] = NO_CONVERGENCE if "Newton" in why else GROWS
    return words


class LoadedContact:
    """`runs` copies of an element of the scene, under a load that holds them at the depth of the contact.

    Positions are heights above there, forces are per unit length: those of the evaluator, less the load.

    Attributes:
        mass: (k,) per unit length.
        load: per unit length.
    """

    def __init__(self, scene: Scene, contact: Contact, runs: int) -> None:
        self._model = ContactModel(_copies(scene, contact, runs))
        self._depth = contact.depth
        self._far = _BEYOND * contact.reach
        self._points = np.zeros((runs, 2, 3))
        self._points[:, 1, 1] = 1.0
        self.mass: FloatArray = np.full(runs, contact.mass)
        self.load = 0.0
        self.load = float(self.forces(np.zeros(runs), np.zeros(runs), None).force[0])

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        usable = np.abs(position) < self._far
        self._points[:, :, 0] = (np.where(usable, position, 0.0) - self._depth)[:, None]
        result = self._model.evaluate(self._points.reshape(-1, 3))
        force = np.where(usable, result.force - self.load, np.nan)
        return Forces(force, -result.stiffness, np.zeros(velocity.shape), history)


def _copies(scene: Scene, contact: Contact, runs: int) -> ContactInput:
    """Elements on the curve of the contact, else with its stiffness: a node's is spread over its length.

    A small oscillation on an unloading line is one on a spring.
    """
    arrays, element = scene.law_arrays(), contact.element
    law = LawAssignment("linear", np.arange(runs), {"stiffness": contact.stiffness})
    if arrays.law[element] == LawKind.CURVE and not contact.unloading:
        law = LawAssignment("curve", np.arange(runs), {"curve": arrays.curve_index[element]})
    return ContactInput(
        node_ids=np.arange(1, 2 * runs + 1),
        coordinates=np.zeros((2 * runs, 3)),
        element_ids=np.arange(1, runs + 1),
        element_nodes=np.arange(2 * runs).reshape(runs, 2),
        length=np.ones(runs),
        diameter=np.full(runs, scene.diameter[element]),
        laws=(law,),
        curves=arrays.curves,
    )
