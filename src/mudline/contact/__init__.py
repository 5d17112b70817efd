"""Contact of pipe elements with the seabed: plain arrays in, depths, forces, stiffnesses and reactions out.

    model = ContactModel(ContactInput(...))
    print(model.plan)
    result = model.evaluate(positions)

Nothing here knows decks, sets or keywords. X is up, the units are those of the input and are never converted.
"""

from __future__ import annotations

from mudline.contact.input import ContactInput, ElementError, LawAssignment, LawKind, PositionError, Tension
from mudline.contact.model import ContactModel
from mudline.contact.plan import Plan, Stage
from mudline.contact.result import ContactResult
from mudline.contact.tables import ContactState

__all__ = [
    "ContactInput",
    "ContactModel",
    "ContactResult",
    "ContactState",
    "ElementError",
    "LawAssignment",
    "LawKind",
    "Plan",
    "PositionError",
    "Stage",
    "Tension",
]
