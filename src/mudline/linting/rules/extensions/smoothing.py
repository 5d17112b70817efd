"""Which elements `*SEABED CONTACT` gives a stiffness of the nodes, and which ones a smoothed law."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.inputs import LawKind
from mudline.diagnostics import Where
from mudline.scene.model import Scene
from mudline.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSets
    from mudline.keywords.model import Part


def number(part: object, name: str) -> float:
    """A value that is given and is a number, else NaN."""
    value = getattr(part, name, None)
    return float(value) if isinstance(value, float | int) else math.nan


def nodal(scene: Scene) -> Mask:
    """Elements whose law is a stiffness of their nodes."""
    return _of_elements(scene, [number(entry, "nodal_stiffness") >= 0.0 for entry in _entries(scene)])


def smoothed(scene: Scene) -> Mask:
    """Elements with a linear or nodal law that is smoothed; AUTO smooths under a known submerged weight only."""
    chosen = [getattr(entry, "smoothing", None) for entry in _entries(scene)]
    fixed = _of_elements(scene, [isinstance(value, float | int) and value > 0.0 for value in chosen])
    auto = _of_elements(scene, [value in (None, "AUTO") for value in chosen])
    if auto.any():
        auto &= _heavy(scene)
    law: Mask = (scene.law == LawKind.LINEAR) | nodal(scene)
    return (fixed | auto) & law


def _entries(scene: Scene) -> list[object]:
    contact = scene.extensions.get("SEABED CONTACT")
    return list(contact.entries) if contact else []


def _of_elements(scene: Scene, flags: list[bool]) -> Mask:
    contact = scene.extensions.get("SEABED CONTACT")
    if contact is None:
        return np.zeros(len(scene.element_ids), dtype=np.bool_)
    found: Mask = np.array([*flags, False])[contact.of_element]
    return found


def _heavy(scene: Scene) -> Mask:
    """Elements whose submerged weight is known and above 0; contents do not count."""
    oceans = [block for _, block in scene.deck.blocks("OCEAN")]
    water = number(oceans[-1], "density") if oceans else math.nan
    heavy = [_mass(scene, section.where, water) > 0.0 for section in scene.section_table.sections]
    found: Mask = np.array([*heavy, False])[scene.section_table.of_element]
    return found


def _mass(scene: Scene, where: Where, water: float) -> float:
    """Mass per length of a section, less that of the water it displaces; NaN where it is not known."""
    block = cast("GeometricSets", scene.deck.sections[where.section].blocks[where.block])
    entry = block.sets[cast("int", where.path[1])]
    section = entry.section
    buoyancy = number(section, "db")
    if math.isnan(buoyancy) and entry.flexible is None:
        buoyancy = number(section, "do")
    mass = number(section, "mass") if entry.rigid is None else _wall(entry.rigid)
    return mass - water * math.pi / 4 * buoyancy * buoyancy


def _wall(section: Part) -> float:
    area = number(section, "area")
    if math.isnan(area):
        outer, inner = number(section, "do"), number(section, "di")
        area = math.pi / 4 * (outer * outer - inner * inner)
    return area * number(section, "density")
