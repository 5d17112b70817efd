"""The contact laws: in each module a kind of them, with parameters, equation, tangents, state and source.

A law is known by its name and imported when an input has it. `register` adds one: a normal law of a module of your own
is evaluated, stepped, planned and differentiated like the others, with numpy and with compiled loops.
"""

from __future__ import annotations

from importlib import import_module

from mudline.contact.laws.base import Law, NormalLaw, Parameter, where

__all__ = ["Law", "NormalLaw", "Parameter", "known_laws", "law_named", "register", "where"]

_LAWS: dict[str, str | Law] = {
    "linear": "linear:LINEAR",
    "smoothed": "linear:SMOOTHED",
    "nodal": "linear:NODAL",
    "curve": "curve:CURVE",
    "rigid": "linear:RIGID",
    "unloading": "unloading:UNLOADING",
    "suction spring": "linear:SUCTION_SPRING",
    "suction": "suction:SUCTION_LAW",
    "friction": "friction:FRICTION",
    "lateral": "linear:LATERAL",
    "trench peak": "trench:TRENCH_PEAK",
    "trench table": "trench:TRENCH_TABLE",
    "trench wall": "trench:TRENCH_WALL",
}
"""Module and name of each law, or the law itself once it was asked for."""
BUILT_IN = tuple(_LAWS)
"""Names of the laws of this package; others are added with `register`."""


def known_laws() -> tuple[str, ...]:
    """Return the names of all laws."""
    return tuple(_LAWS)


def law_named(name: str) -> Law:
    """Return the law of this name.

    Raises:
        ValueError: there is no such law.
    """
    found = _LAWS.get(name)
    if found is None:
        raise ValueError(f"unknown contact law {name!r}; known are {', '.join(_LAWS)}")
    if isinstance(found, str):
        module, _, attribute = found.partition(":")
        law: Law = getattr(import_module(f"{__name__}.{module}"), attribute)
        _LAWS[name] = found = law
    return found


def register(law: Law) -> NormalLaw:
    """Add a normal law of elements or nodes, and return it.

    Raises:
        TypeError: it is not a normal law without history, or has no reaction or steepest stiffness.
        ValueError: another law has its name.
    """
    if not isinstance(law, NormalLaw) or law.history or law.tables or law.reaction is None or law.steepest is None:
        raise TypeError("only normal laws without history can be added: a NormalLaw with reaction and steepest")
    if law.name in _LAWS and _LAWS[law.name] is not law:
        raise ValueError(f"there is a contact law {law.name!r} already")
    _LAWS[law.name] = law
    return law
