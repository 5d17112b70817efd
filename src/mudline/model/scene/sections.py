"""Sections: the entry of `*GEOMETRIC SETS` or `*TAPER` of each element; its diameter, mass and submerged weight."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Where
from mudline.language.keywords.values import known_name
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import DEFAULT_DENSITY, DEFAULT_GRAVITY, number
from mudline.model.scene.numbering import Floats, Indices, Mask, Numbered, looked_up, picked
from mudline.model.scene.sets import NamedSet, Sets, later_wins

if TYPE_CHECKING:
    from mudline.language.keywords.library.geometric_sets import GeometricSet
    from mudline.language.keywords.library.tapered_joints import TaperedJoint
    from mudline.model.scene.csv_file import ExternalElements


class Section(NamedTuple):
    """Entry of `*GEOMETRIC SETS`, or the part of a tapered joint that an element is.

    name: name of its set.
    diameter: external diameter, NaN if there is none, or none that can be used.
    source: "Do" or "Dd".
    where: place of the entry.
    faulty: the diameter could not be read or is out of range, which is reported.
    entry: the entry itself; of a joint, one with the diameters at the middle of its element.
    """

    name: str
    diameter: float
    source: str
    where: Where
    faulty: bool
    entry: GeometricSet


class SectionTable(NamedTuple):
    """Sections in the order of the file, and the section of each element.

    sections: the sections.
    of_element: index (m,) of each element's section, -1 for none.
    diameter: external diameter (m,), NaN if there is none.
    faulty: elements (m,) whose section could not be read: nothing more is reported about them.
    open: a section's set has elements that the deck does not show, or could not be read, so any element may have it.
    """

    sections: tuple[Section, ...]
    of_element: Indices
    diameter: Floats
    faulty: Mask
    open: bool

    def values(self, *names: str, default: float = math.nan) -> Floats:
        """Return a field (m,) of each element's section: the first of `names` that it gives, else `default`.

        NaN without a section.
        """

        def first(row: object) -> float:
            given = (name for name in names if isinstance(getattr(row, name, None), float | int))
            return number(row, next(given, ""), default)

        return picked((first(section.entry.section) for section in self.sections), self.of_element)

    def mass_per_length(self) -> Floats:
        """Return mass per length (m,), in the deck's units; NaN where it is not known, or not above 0."""
        mass = picked((_mass(section.entry) for section in self.sections), self.of_element)
        return np.where(mass > 0.0, mass, np.nan)

    def submerged_weight(self, around: Surroundings, on_land: Floats | None) -> Floats:
        """Return weight less buoyancy per length (m,), in the deck's units; NaN where it is not known or overflows.

        The share `on_land` (m,) of an element has no buoyancy; None stands for 0. Contents do not count. Elements whose
        diameter comes from a file of elements have the weight of their section, if they have one.
        """
        entries = [section.entry for section in self.sections]
        found = picked((weights(entry, around)[1] for entry in entries), self.of_element)
        if on_land is not None:
            lifts = (around.density * _displaced(entry) * around.gravity for entry in entries)
            found = found + on_land * picked(lifts, self.of_element)
        return np.where(np.isfinite(found), found, np.nan)


def read_sections(
    context: Context, sets: Sets, elements: Numbered, length: Floats, external: ExternalElements | None = None
) -> SectionTable:
    """Return the sections, and that of each element: the later entry wins, a diameter from a file over all.

    `length` (m,) are the lengths of the elements, along which joints taper. A joint wins over `*GEOMETRIC SETS`.
    """
    sections: list[Section] = []
    holders: list[NamedSet | None] = []
    undefined = False
    for where, entry, name, holder in sets.entries(context.blocks("GEOMETRIC SETS")):
        undefined |= name is not None and holder is None
        sections.append(_section(entry, where))
        holders.append(holder)
    for where, joint, name, holder in sets.entries(context.blocks("TAPER")):
        undefined |= name is not None and holder is None
        ordered = np.zeros(0, np.intp) if holder is None else holder.in_order
        parts = _parts(joint, length[ordered]) if len(ordered) else [_part(joint, 0.5)]
        sections += [_section(part, where) for part in parts]
        holders += [NamedSet(joint.set_name, ordered[at : at + 1], None) for at in range(len(ordered))] or [holder]
    elsewhere = undefined and bool(context.possible_definition("ELEMENT SETS"))
    of_element = later_wins(holders, len(elements))
    diameter = looked_up(np.array([*(section.diameter for section in sections), math.nan]), of_element)
    lost = not context.unread.isdisjoint(("GEOMETRIC SETS", "TAPER"))
    unread = (None in holders and not elsewhere) or lost
    faulty = looked_up(np.array([*(section.faulty for section in sections), unread]), of_element)
    if external is not None:
        diameter, faulty = diameter.copy(), faulty.copy()
        at = elements.indices(external.ids)
        given = ~np.isnan(external.diameter)
        diameter[at[given]] = external.diameter[given]
        faulty[at[given]] = False
    is_open = elsewhere or lost or any(holder.open for holder in holders if holder)
    return SectionTable(tuple(sections), of_element, diameter, faulty, is_open)


def _section(entry: GeometricSet, where: Where) -> Section:
    source, value = entry.diameter
    diameter = float(value) if isinstance(value, int | float) else math.nan
    bad = diameter < 0 or math.isnan(diameter) or (source == "Do" and diameter == 0)
    return Section(known_name(entry.set_name) or "", diameter if diameter > 0 else math.nan, source, where, bad, entry)


def _parts(joint: TaperedJoint, length: Floats) -> list[GeometricSet]:
    """Return the entries of the elements of a joint, whose lengths are given from its start to its end.

    An element has the diameters at its middle, which are the mean of those at its ends. If a length is not known, all
    elements are taken to be equally long.
    """
    with np.errstate(all="ignore"):
        ends = np.cumsum(length)
        middles = (ends - 0.5 * length) / ends[-1]
    if not np.isfinite(middles).all():
        middles = (np.arange(len(length)) + 0.5) / len(length)
    return [_part(joint, share) for share in middles.tolist()]


def _part(joint: TaperedJoint, share: float) -> GeometricSet:
    """Return a joint at a share of its length as an entry of the rigid format."""
    from mudline.language.keywords.library import geometric_sets  # noqa: PLC0415 - only decks with joints need it

    row = joint.section
    start, end = number(row, "do"), number(row, "do_end")
    bore = number(row, "di")
    diameters = {
        "do": (start, end),
        "di": (bore, number(row, "di_end", bore)),
        "dd": (number(row, "dd", start), number(row, "dd_end", end)),
        "db": (number(row, "db", start), number(row, "db_end", end)),
    }
    values: dict[str, Any] = {name: number(row, name) for name in ("e", "g", "density")}
    values |= {name: first + share * (last - first) for name, (first, last) in diameters.items()}
    rigid = geometric_sets.RigidSection.model_construct(**values)
    return geometric_sets.GeometricSet.model_construct(option="RIGID", set_name=joint.set_name, rigid=rigid)


def format_of(entry: GeometricSet) -> str:
    """Return the format of the property line, "" without one."""
    return next((name for name in ("flexible", "rigid", "mooring", "truss") if getattr(entry, name) is not None), "")


class Surroundings(NamedTuple):
    """Density of the water, gravity, and depth, which is also the height of the water's surface, in the deck's units.

    NaN where they are not known.
    """

    density: float
    gravity: float
    depth: float


def read_surroundings(deck: Deck) -> Surroundings:
    """Return the surroundings of the last `*OCEAN`, with defaults in metric and imperial units; NaN without one."""
    oceans = [block for _, block in deck.blocks("OCEAN")]
    if not oceans:
        return Surroundings(math.nan, math.nan, math.nan)
    return Surroundings(
        number(oceans[-1], "density", DEFAULT_DENSITY.get(deck.units, math.nan)),
        number(oceans[-1], "gravity", DEFAULT_GRAVITY.get(deck.units, math.nan)),
        number(oceans[-1], "depth"),
    )


def weights(entry: GeometricSet, around: Surroundings) -> tuple[float, float]:
    """Return weight in air and submerged weight of a section per length, in the deck's units; NaN if not known."""
    mass = _mass(entry)
    return mass * around.gravity, (mass - around.density * _displaced(entry)) * around.gravity


def _mass(entry: GeometricSet) -> float:
    """Return mass per length of a section, NaN if it is not known."""
    if entry.rigid is None:
        return number(entry.section, "mass")
    area, outer, inner = (number(entry.rigid, name) for name in ("area", "do", "di"))
    area = math.pi / 4 * (outer * outer - inner * inner) if math.isnan(area) else area
    return area * number(entry.rigid, "density")


def _displaced(entry: GeometricSet) -> float:
    """Return the area of the water that a section displaces, NaN if it is not known."""
    buoyancy = number(entry.section, "db")
    if math.isnan(buoyancy) and entry.flexible is None:
        buoyancy = number(entry.section, "do")
    return math.pi / 4 * buoyancy * buoyancy
