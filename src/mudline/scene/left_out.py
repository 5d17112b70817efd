"""What a deck asks for and this version does not evaluate."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from mudline.deck.model import Deck

if TYPE_CHECKING:
    from mudline.keywords.common import Surface
    from mudline.keywords.library.seabed_properties import SeabedProperties

_KEYWORDS = {
    "SEABED PROFILE": "floor",
    "SEABED PLANES": "floor",
    "SEABED CONTACT": "normal law",
    "SEABED UNLOADING": "normal law",
    "SEABED SUCTION": "suction",
    "SEABED FRICTION": "friction",
    "SEABED TRENCH": "trench",
}
"""Keywords that are kept as they are, and the stage of the plan that they belong to."""

_FRICTION = ("longitudinal", "transverse", "lateral")


def left_out(deck: Deck) -> dict[str, str]:
    """By stage of the plan, what is asked for and not evaluated; nothing for stages of which all is evaluated.

    `deck` has its equations evaluated.
    """
    asked: dict[str, Counter[str]] = {}
    for stage, what in [*_keywords(deck), *_properties(deck), *_surfaces(deck)]:
        asked.setdefault(stage, Counter())[what] += 1
    return {stage: f"not evaluated in this version: {_listed(counts)}" for stage, counts in asked.items()}


def _listed(counts: Counter[str]) -> str:
    return ", ".join(what if count == 1 else f"{what} ({count} times)" for what, count in counts.items())


def _keywords(deck: Deck) -> Iterator[tuple[str, str]]:
    for section in deck.sections:
        for block in section.blocks:
            if section.name == "MODEL" and block.keyword in _KEYWORDS:
                yield _KEYWORDS[block.keyword], f"*{block.keyword}"


def _properties(deck: Deck) -> Iterator[tuple[str, str]]:
    for _, block in deck.blocks("SEABED PROPERTIES"):
        for entry in cast("SeabedProperties", block).sets:
            if entry.friction and (entry.friction.longitudinal or entry.friction.transverse):
                yield "friction", "FRICTION="
            if entry.lateral:
                yield "friction", "LATERAL="
            if entry.suction and entry.suction.stiffness:
                yield "suction", "SUCTION="


def _surfaces(deck: Deck) -> Iterator[tuple[str, str]]:
    for keyword in ("ELASTIC SURFACE", "RIGID SURFACE"):
        for _, block in deck.blocks(keyword):
            surface = cast("Surface", block)
            if surface.slope or surface.profile is not None:
                yield "floor", f"the slope or profile of *{keyword}"
            if any(getattr(surface.properties, name, None) for name in _FRICTION):
                yield "friction", f"the friction of *{keyword}"
            if getattr(surface.properties, "suction_stiffness", None):
                yield "suction", f"the suction of *{keyword}"
