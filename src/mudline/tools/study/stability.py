"""Which steps are stable on the contacts of a deck, and with which of them landings keep their speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mudline.language.diagnostics import Where
from mudline.model.contact.arrays import BoolArray, FloatArray
from mudline.model.contact.input import ContactInput, LawKind
from mudline.model.scene.model import Scene
from mudline.model.scene.oscillation import Oscillation, line_of, oscillations, softening_needs
from mudline.tools.study.drops import ALLOWED, CurveLaw, Drop, Landing, Law, LinearLaw, landings
from mudline.tools.study.schemes import HHT, MOST_STEPS, SCHEMES

LANDED = 6
"""Seabeds, those with the smallest critical steps, on which landings are tried."""
SMALLEST, LARGEST = 0.01, 3.0
"""omega dt between which the largest step of landings is looked for."""
_COARSE, _FINE = 1.12, 1.01
"""Factors between steps that are tried; those just below the first one that is too large are closer."""
_BACK = 6
_HALVES = 2.0
_SHALLOW = 0.05
"""Of the diameter: depth of a landing where the static penetration is not known."""
_SMALL_JUMP = 1e-6
"""Of the force of a landing: smaller forces at the mudline are none."""
_TWO_KINDS = {"suction mobilisation": "suction", "suction damping": "suction"}
_TWICE = 2.0
STABLE, FAST, DIVERGES = "stable", "lands fast", "diverges"


class WithoutJump(NamedTuple):
    """The largest step of landings if the force began at 0, and the line that makes it jump."""

    step: float | None
    deck_line: int


class StabilityRow(NamedTuple):
    """A contact; values in the deck's units, per unit length, None where there is none.

    elements: that have it; of laws of nodes how many nodes.
    file, deck_line: where the numbers stand that make it as stiff.
    explicit_step: critical step of velocity Verlet, damping included.
    landing_step: the largest step at which HHT (-0.3) keeps the speed of landings within 1 %, as all smaller ones do.
    jump: whether the force jumps where contact begins.
    at_own_step: what the step of the deck does: "stable", "lands fast", or "diverges" with an explicit scheme.
    """

    contact: str
    kind: str
    elements: int
    file: str
    deck_line: int
    stiffness: float
    damping: float
    mass: float
    omega: float
    explicit_step: float
    landing_step: float | None
    jump: bool
    without_jump: WithoutJump | None
    at_own_step: str | None


class Contact(NamedTuple):
    """A contact of the scene: what oscillates, the law that a mass lands on (None for others), and its row."""

    oscillation: Oscillation
    law: Law | None
    row: StabilityRow


class OwnStep(NamedTuple):
    """The fixed time step of a deck, and its line."""

    step: float
    deck_line: int


def own_step(scene: Scene) -> OwnStep | None:
    """Return the step of the last *TIME with a fixed step; None without one."""
    found = None
    for where, block in scene.deck.blocks("TIME", "LOAD CASE"):
        step = getattr(getattr(block, "fixed", None), "increment", None)
        if isinstance(step, int | float) and math.isfinite(step) and step > 0.0:
            found = OwnStep(float(step), line_of(scene, where.inside("fixed", "increment")))
    return found


def file_of(scene: Scene, where: Where | None) -> str:
    """Return the name of the file of a place: that of the deck, or of one that it continues."""
    base = scene.deck.base_of(where)
    return Path(base[0].file if base else scene.deck.file).name


def contacts_of(scene: Scene, given: ContactInput) -> tuple[list[Contact], list[str], list[str]]:
    """Return the contacts of a scene, the smallest critical step first, what is not known of others, and what softens.

    Contacts with the same numbers from the same line share a row.
    """
    found, unknown, softening = oscillations(scene, given)
    rows: dict[tuple[object, ...], Contact] = {}
    for one in found:
        row = _row(scene, one)
        key = (*row[1:2], *row[3:9])
        if known := rows.get(key):
            rows[key] = known._replace(row=known.row._replace(elements=known.row.elements + row.elements))
        else:
            rows[key] = Contact(one, _law_of(scene, given, one), row)
    ordered = sorted(rows.values(), key=lambda contact: contact.row.explicit_step)
    falls = [
        f"Behind its peak the lateral resistance falls, {_line(scene, one)}: equilibrium needs a structural stiffness "
        f"per unit length above{softening_needs(scene, one).removeprefix(' =')}."
        for one in softening
    ]
    return ordered, [f"{name}: {reason}" for name, reason in unknown], falls


def _line(scene: Scene, one: Oscillation) -> str:
    line = line_of(scene, one.where)
    return f"line {line} ({one.name})" if line else one.name


def _row(scene: Scene, one: Oscillation) -> StabilityRow:
    kind = _TWO_KINDS.get(one.kind, one.kind)
    if kind == "normal":
        kind = LawKind(scene.law[one.element]).name.lower()
    return StabilityRow(
        one.name,
        kind,
        one.shared,
        file_of(scene, one.where),
        line_of(scene, one.where),
        one.stiffness,
        one.damping,
        one.mass,
        one.omega,
        one.critical_step("velocity-verlet"),
        None,
        jump=False,
        without_jump=None,
        at_own_step=None,
    )


def _law_of(scene: Scene, given: ContactInput, one: Oscillation) -> Law | None:
    """The elastic law of a contact, None for those that nothing lands on."""
    if one.kind == "nodal":
        nodal = given.assigned["nodal"]
        at = int(np.searchsorted(nodal.rows, one.node))
        return LinearLaw(one.stiffness, float(nodal["half_width"][at]))
    if one.kind != "normal":
        return None
    arrays, element = scene.law_arrays(), one.element
    if scene.law[element] not in {LawKind.CURVE, LawKind.LINEAR}:  # its force depends on its path
        return None
    index = int(arrays.curve_index[element])
    if index >= 0:
        return CurveLaw(arrays.curves[index], float(scene.diameter[element]))
    smoothed = given.assigned.get("smoothed")
    width = 0.0 if smoothed is None else smoothed.spread("half_width", len(given.element_ids), 0.0)[element]
    return LinearLaw(float(arrays.linear_stiffness[element]), float(width))


# ------------------------------------------------------------------------------------------------------------- landings


class Judged(NamedTuple):
    """A contact's row, and what the deck's own step does there in words; "" without one."""

    row: StabilityRow
    words: str


def judged(scene: Scene, contacts: Sequence[Contact], own: OwnStep | None) -> list[Judged]:
    """Return the rows of all contacts, with landings on the first `LANDED` that a mass lands on."""
    rows, left = [], LANDED
    for contact in contacts:
        row, landing = contact.row, None
        if contact.law is not None and left:
            left -= 1
            try:
                drop = landing_on(scene, contact, contact.law)
                row = _landed(scene, contact, contact.law, drop)
                landing = None if own is None else landing_at(drop, own.step)
            except (ValueError, ArithmeticError):  # a law that pulls, or whose forces overflow, has no landing
                row, landing = contact.row, None
        if own is None:
            rows.append(Judged(row, ""))
            continue
        grows, fast = own.step > row.explicit_step, landing is not None and landing.largest[0] > 1.0 + ALLOWED
        outcome = DIVERGES if grows else FAST if fast else STABLE
        words = ["explicit diverges"] if grows else []
        if landing is not None:
            words += _landing_words(landing)
        rows.append(Judged(row._replace(at_own_step=outcome), ", ".join(words) or STABLE))
    return rows


def _landing_words(landing: Landing) -> list[str]:
    """What landings with one step of HHT (-0.3) do; nothing where all keep their speed."""
    least, largest = float(landing.least[0]), float(landing.largest[0])
    if math.isnan(largest):
        return ["does not lift off"]
    if largest >= _TWICE:
        return [f"lands {largest:.1f} times too fast"]
    if largest > 1.0 + ALLOWED:
        return [f"lands {100.0 * (largest - 1.0):.2g} % too fast"]
    return [f"loses {100.0 * (1.0 - least):.2g} % of speed"] if least < 1.0 - ALLOWED else []


def _landed(scene: Scene, contact: Contact, law: Law, drop: Drop) -> StabilityRow:
    """The row of a contact with its landings, and with a jump at the mudline."""
    row, carried = contact.row, abs(float(law.force(np.array([drop.deepest]))[0][0]))
    row = row._replace(landing_step=landing_step(drop, row.omega))
    if isinstance(law, CurveLaw) and abs(law.jump) > _SMALL_JUMP * carried:
        row = row._replace(jump=True, without_jump=_without_jump(scene, contact, law))
    return row


def _without_jump(scene: Scene, contact: Contact, law: CurveLaw) -> WithoutJump:
    """The step of landings on the curve with the force 0 at the mudline, and the line of the point next to it."""
    smooth = law.without_jump()
    omega = math.sqrt(float(np.abs(smooth.curve.slopes).max()) / smooth.diameter / contact.row.mass)
    step = landing_step(landing_on(scene, contact, smooth), omega)
    entry = scene.laws.curves[scene.set_law(contact.oscillation.element).curve]  # type: ignore[union-attr]
    first = int(np.argmin(np.abs(entry.points[:, 0])))
    return WithoutJump(step, line_of(scene, entry.point(first)))


def landing_on(scene: Scene, contact: Contact, law: Law) -> Drop:
    """Return a landing without weight, fast enough to reach the static penetration."""
    element = contact.oscillation.element
    weight, diameter = float(scene.submerged_weight[element]), float(scene.diameter[element])
    depth = _SHALLOW * (diameter if math.isfinite(diameter) else 1.0)
    if weight > 0.0 and isinstance(law, CurveLaw):
        depth = min((r for r in law.curve.ratios_at_force(weight) if r > 0.0), default=_SHALLOW) * law.diameter
    elif weight > 0.0 and isinstance(law, LinearLaw):
        depth = weight / law.stiffness + 4.0 * law.half_width
    mass = contact.row.mass
    return Drop(law, mass, 0.0, math.sqrt(2.0 * float(law.work(np.array([depth]))[0]) / mass), depth)


def landing_at(drop: Drop, step: float) -> Landing:
    """Return the landings of HHT (-0.3) at one step, or at a larger one where it is too small to be tried."""
    return landings(drop, SCHEMES[HHT], np.array([max(step, drop.duration / MOST_STEPS)]))


def landing_step(drop: Drop, omega: float) -> float | None:
    """Return the largest step up to which no landing of HHT (-0.3) gains or loses 1 %; None for none that is tried."""
    smallest, largest = max(SMALLEST / omega, drop.duration / MOST_STEPS), LARGEST / omega
    if not smallest < largest:
        return None
    return largest_step(lambda dt: landings(drop, SCHEMES[HHT], dt).kept, smallest, largest)


def largest_step(meets: Callable[[FloatArray], BoolArray], smallest: float, largest: float) -> float | None:
    """Return the largest step between two that meets a goal, as all smaller ones do that are tried; None for none.

    Steps are tried in groups up to twice as large, from the largest on: small ones take as many more steps.
    """
    steps = np.geomspace(smallest, largest, math.ceil(math.log(largest / smallest) / math.log(_COARSE)) + 1)
    good = np.concatenate([meets(group) for group in _groups(steps)])
    first = len(steps) if good.all() else int(np.argmin(good))
    if first in {0, len(steps)}:
        return float(steps[-1]) if first else None
    low, high = steps[max(first - _BACK, 0)], steps[first]
    steps = np.geomspace(low, high, math.ceil(math.log(high / low) / math.log(_FINE)) + 1)
    good = np.concatenate([meets(group) for group in _groups(steps)])
    first = int(np.argmin(good))
    return float(steps[max(first - 1, 0)])


def _groups(steps: FloatArray) -> list[FloatArray]:
    """Ascending steps in groups in which the largest is twice the smallest at most."""
    octave = np.floor(np.log(steps / steps[0]) / math.log(_HALVES))
    return np.split(steps, np.flatnonzero(np.diff(octave)) + 1)
