"""The suction of a scene: the laws of the elements under `*SEABED SUCTION`."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import RUN001
from mudline.contact.arrays import FloatArray
from mudline.contact.extras import ElementSuction
from mudline.contact.inputs import ContactInput
from mudline.contact.laws.spring import LawError
from mudline.contact.suction.law import SuctionFactors, SuctionLaw, from_cohesion
from mudline.diagnostics import DeckError, Problem
from mudline.scene.model import Scene

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_suction import SuctionSet

_UNITS = {"metric": (1.0, 1.0), "imperial": (0.3048, 4.4482216152605)}
"""Units of length and force in metres and newtons; without them a cohesion makes no law."""
_SLOWEST = 1e-3
_CORNERS = (0.2, 0.8)


def input_with_suction(scene: Scene) -> ContactInput:
    """What the evaluator is made from, the suction of the deck included; raises DeckError."""
    given = scene.contact_input()
    if given.extras.suction is not None:
        return given
    return replace(given, extras=replace(given.extras, suction=suction_of(scene)))


def suction_of(scene: Scene) -> ElementSuction | None:
    """The elements with suction and their laws; None without any. Raises DeckError where a law cannot be held."""
    extension = scene.extensions.get("SEABED SUCTION")
    if extension is None:
        return None
    elements = np.flatnonzero(extension.of_element >= 0)
    rows = [extension.of_element[elements] == index for index in range(len(extension.entries))]
    law = SuctionLaw(*(np.zeros(len(elements)) for _ in SuctionLaw._fields))
    for entry, place, row in zip(extension.entries, extension.places, rows, strict=True):
        one = _law(cast("SuctionSet", entry), scene.diameter[elements[row]], scene.units)
        try:
            one.checked()
        except LawError as error:
            raise DeckError(scene.deck.diagnose([Problem(RUN001, str(error), where=place)])) from error
        for whole, part in zip(law, one, strict=True):
            whole[row] = part
    return ElementSuction(elements, law) if elements.size else None


def _law(given: SuctionSet, diameter: FloatArray, units: str) -> SuctionLaw:
    metre, newton = _UNITS.get(units, (np.nan, np.nan))
    count = len(diameter)
    factors = SuctionFactors(*(np.full(count, np.nan) for _ in SuctionFactors._fields))
    if given.cohesion is not None:
        factors = from_cohesion(np.full(count, float(given.cohesion)), diameter, metre, newton)
    for part, names in (
        (given.force, ("force_factor", "force_exponent")),
        (given.depth, ("depth_factor", "depth_exponent")),
    ):
        if part is not None:
            values = (np.full(count, float(value)) for value in (part.factor, part.exponent))
            factors = factors._replace(**dict(zip(names, values, strict=True)))
    corners = _CORNERS if given.cutoff is None else (float(given.cutoff.first), float(given.cutoff.second))
    cyclic = 1.0 if given.cyclic is None else float(given.cyclic)
    slowest = _SLOWEST / metre if given.regularisation is None else float(given.regularisation)
    return SuctionLaw(*factors, *(np.full(count, value) for value in (*corners, cyclic, slowest)))
