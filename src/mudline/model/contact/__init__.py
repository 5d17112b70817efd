"""Contact of pipe elements with the seabed: plain arrays in, depths, forces, stiffnesses and reactions out.

    model = ContactModel(ContactInput(...))
    print(model.plan)
    result = model.evaluate(positions)

Nothing here knows decks, sets or keywords. X is up, the units are those of the input and are never converted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mudline.model.contact.input import ContactInput, ElementError, LawAssignment, LawKind, PositionError, Tension
    from mudline.model.contact.model import ContactModel
    from mudline.model.contact.plan import Plan, Stage
    from mudline.model.contact.result import ContactResult
    from mudline.model.contact.tables import ContactState

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

_HOMES = {
    "ContactModel": "model",
    "ContactResult": "result",
    "ContactState": "tables",
    "Plan": "plan",
    "Stage": "plan",
}
"""Modules of names that are not in `input`."""


def __getattr__(name: str) -> object:
    """Import a public name when it is first used: a deck is linted with the input alone."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415 - as above

    value = globals()[name] = getattr(import_module(f"{__name__}.{_HOMES.get(name, 'input')}"), name)
    return value


def __dir__() -> list[str]:
    return __all__
