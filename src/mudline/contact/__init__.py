"""Contact of pipe elements with the sea floor: plain arrays in, depths, forces, stiffnesses and reactions out.

    model = ContactModel(ContactInput(...))
    print(model.plan)
    result = model.evaluate(positions)

Nothing here knows decks, sets or keywords. X is up, the units are those of the input and are never converted.
"""

from __future__ import annotations

from mudline.contact.errors import ElementError, PositionError
from mudline.contact.inputs import ContactInput, LawKind, Tension
from mudline.contact.model import ContactModel
from mudline.contact.plan import Plan, Stage
from mudline.contact.result import ContactResult

__all__ = [
    "ContactInput",
    "ContactModel",
    "ContactResult",
    "ElementError",
    "LawKind",
    "Plan",
    "PositionError",
    "Stage",
    "Tension",
]
