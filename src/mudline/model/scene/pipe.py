"""Pipe of a deck: weight, mass, contents, added mass, drag and stiffness."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.language.keywords.unknown import known_name
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats, Mask, picked
from mudline.model.scene.resolved import ResolvedDeck
from mudline.model.scene.sections import stiffnesses
from mudline.model.scene.weights import contents

if TYPE_CHECKING:
    from mudline.language.keywords.library.hydrodynamic_sets import HydrodynamicSets

_DRAG, _INERTIA, _ADDED_MASS = 1.0, 2.0, 1.0
"""Coefficients of an element without any in the deck, and defaults of fields that a line may omit."""


class Pipe(NamedTuple):
    """Elements (m,) of a deck, per unit length and in its units; NaN where a value is not known.

    weight: submerged weight with contents.
    mass: mass of the pipe alone.
    contents: mass of the contents in the last load case.
    added_mass: Ca rho pi D^2 / 4.
    drag: Cd rho D / 2, the transverse force of water at a velocity of 1.
    drag_coefficient, added_mass_coefficient: Cd and Ca.
    has_coefficients: False where these are assumed.
    bending, axial: EI and EA, for curves their slope at 0; 0 for sections without bending stiffness.
    axial_drag_coefficient, axial_added_mass: values along the pipe, 0 if not given.
    """

    weight: Floats
    mass: Floats
    contents: Floats
    added_mass: Floats
    drag: Floats
    drag_coefficient: Floats
    added_mass_coefficient: Floats
    has_coefficients: Mask
    bending: Floats
    axial: Floats
    axial_drag_coefficient: Floats
    axial_added_mass: Floats


def pipe_of(scene: ResolvedDeck) -> Pipe:
    """Return the elements of a scene with the contents of its load case and its hydrodynamic coefficients."""
    table, around = scene.section_table, scene.surroundings
    filled = contents(scene)
    inside = filled[-1].mass if filled else np.zeros(len(scene.element_ids))
    added, drag, from_deck, with_buoyancy, along = _coefficients(scene)
    entries = [section.entry.section for section in table.sections]
    outer = picked((number(each, "do", number(each, "dd")) for each in entries), table.of_element)
    drag_diameter = picked((number(each, "dd", number(each, "do")) for each in entries), table.of_element)
    buoyancy = picked((number(each, "db", number(each, "do")) for each in entries), table.of_element)
    size = np.where(with_buoyancy, buoyancy, drag_diameter)
    size = np.where(size > 0.0, size, outer)
    with np.errstate(all="ignore"):
        displaced = around.density * math.pi / 4.0 * size * size
        of_sections = [stiffnesses(scene.deck, section) for section in table.sections]
        return Pipe(
            weight=scene.submerged_weight + inside * around.gravity,
            mass=scene.mass_per_length,
            contents=inside,
            added_mass=added * displaced,
            drag=0.5 * drag * around.density * drag_diameter,
            drag_coefficient=drag,
            added_mass_coefficient=added,
            has_coefficients=from_deck,
            bending=np.nan_to_num(picked((each.bending for each in of_sections), table.of_element)),
            axial=picked((each.axial for each in of_sections), table.of_element),
            axial_drag_coefficient=along[:, 0],
            axial_added_mass=along[:, 1] * displaced,
        )


def _coefficients(scene: ResolvedDeck) -> tuple[Floats, Floats, Mask, Mask, Floats]:
    """Return Ca (m,), Cd (m,), two masks (m,), and Cd and Ca along the pipe (m, 2).

    The masks are the elements with coefficients in the deck, and those whose inertia uses the buoyancy diameter.
    """
    count = len(scene.element_ids)
    added, drag = np.full(count, _ADDED_MASS), np.full(count, _DRAG)
    from_deck, with_buoyancy = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    along = np.zeros((count, 2))
    for _, block in scene.deck.blocks("HYDRODYNAMIC SETS"):
        hydrodynamic = cast("HydrodynamicSets", block)
        for entry in hydrodynamic.sets:
            name, row = known_name(entry.set_name), entry.constant
            holder = None if name is None else scene.set_table.find(name)
            if holder is None or row is None:
                continue
            rows = holder.elements
            inertia = number(row, "normal_inertia", _INERTIA)
            added[rows] = number(row, "normal_added_mass", max(inertia - 1.0, 0.0))
            drag[rows] = number(row, "normal_drag", _DRAG)
            along[rows] = [number(row, f"tangential_{name}", 0.0) for name in ("drag", "added_mass")]
            from_deck[rows], with_buoyancy[rows] = True, hydrodynamic.diameter == "BUOYANCY"
    return added, drag, from_deck, with_buoyancy, along
