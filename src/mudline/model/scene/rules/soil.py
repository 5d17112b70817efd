"""`*SEABED SOIL`: what it does not go with, values that no soil has, and unusual ones."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.deck_values import number

if TYPE_CHECKING:
    from mudline.model.contact.laws import Parameter
    from mudline.model.scene.laws import Extension
    from mudline.model.scene.resolved import ResolvedDeck

EXT010 = Code("EXT010", "soil-conflict", Severity.ERROR)
EXT011 = Code("EXT011", "impossible-soil", Severity.ERROR)
EXT012 = Code("EXT012", "unusual-soil", Severity.WARNING)

_KEYWORD = "SEABED SOIL"
_USUAL = {"factor": (5.0, 7.0), "exponent": (0.2, 0.3), "stiffness": (50.0, 500.0), "suction": (0.0, 1.0)}
"""By parameter of the law: what published soils have."""
_NAMES = {"factor": "a of BEARING=", "exponent": "b of BEARING=", "stiffness": "K_max", "suction": "f_suc"}


def _fields(extension: Extension) -> Iterator[tuple[int, Parameter, tuple[str, ...], float]]:
    """Block, parameter, path and value of every number that a block gives."""
    from mudline.model.contact.laws.soil import SOIL  # noqa: PLC0415 - most decks have no soil
    from mudline.model.scene.assignments import SOIL_FIELDS  # noqa: PLC0415 - as above

    for index, entry in enumerate(extension.entries):
        for parameter in SOIL.parameters:
            path = SOIL_FIELDS.get(parameter.name, ())
            holder = getattr(entry, path[0], None) if len(path) == 2 else entry
            value = number(holder, path[-1]) if path else np.nan
            if np.isfinite(value):
                yield index, parameter, path, value


@rule(EXT010, blocks=True)
def soil_conflict(scene: ResolvedDeck) -> Iterator[Problem]:
    """An element with *SEABED SOIL has another law of its normal reaction.

    The soil says what resists penetration, uplift and penetrating again. *SEABED SUCTION and *SEABED UNLOADING would
    add a second law of the same, and NODAL STIFFNESS= of *SEABED CONTACT replaces all of it: remove one of the two. The
    soil replaces the curve of an element, which is said as information; the number that the keyword family asks for is
    replaced without a word.

    Example on pipe:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        | STRENGTH=5000.0, 1500.0
        -*SEABED UNLOADING
        - SET=ALL
        - STIFFNESS=500000.0

    Finds: 18:6
    """
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    soft = scene.laws_given != LawKind.RIGID
    beside = {
        f"*{keyword}": scene.extensions[keyword].of_element >= 0
        for keyword in ("SEABED SUCTION", "SEABED UNLOADING")
        if keyword in scene.extensions
    }
    beside["NODAL STIFFNESS="] = scene.nodal
    for index, where in enumerate(extension.places):
        held = (extension.of_element == index) & soft
        for name, others in beside.items():
            if np.any(both := held & others):
                message = f"{scene.describe(both)} {name} too, which the soil has no place for: remove one of the two"
                yield Problem(EXT010, message, where=where.inside("set"))
        if np.any(both := held & (scene.laws_given == LawKind.CURVE)):
            message = f"{scene.describe(both)} a curve too: the soil replaces it"
            yield Problem(EXT010, message, None, Severity.INFO, where.inside("set"))


@rule(EXT011, blocks=True)
def impossible_soil(scene: ResolvedDeck) -> Iterator[Problem]:
    """A value of *SEABED SOIL is one that no soil has.

    Strength at the mudline, bearing factor and exponent, K_max and the length of the decay of suction divide or are
    raised to powers and must be above 0; a strength that falls with depth would become negative, and ratios, weights
    and factors below 0 have no meaning. Correct the value.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        - STRENGTH=5000.0, -1500.0
        + STRENGTH=5000.0, 1500.0

    Finds: 8:19
    """
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    for index, parameter, path, value in _fields(extension):
        if parameter.invalid(np.array([value]))[0]:
            message = f"{value!r}: expected {parameter.valid_range} for the {parameter.meaning.split(', ')[-1]}"
            yield Problem(EXT011, message, where=extension.places[index].inside(*path))
    for entry, where in zip(extension.entries, extension.places, strict=True):
        for name in ("factor", "weight"):
            value = number(getattr(entry, "buoyancy", None), name)
            if value < 0.0:
                message = f"{value!r}: expected >= 0 for the {name} of BUOYANCY="
                yield Problem(EXT011, message, where=where.inside("buoyancy", name))


@rule(EXT012, blocks=True)
def unusual_soil(scene: ResolvedDeck) -> Iterator[Problem]:
    """A value of *SEABED SOIL is outside of what published soils have, or its units cannot be checked.

    Bearing factors have a from 5 to 7 and b from 0.2 to 0.3, K_max is from 50 to 500, and suction is at most as large
    as the resistance against penetration. A value in another unit or in the wrong field is the usual cause. With user
    units the numbers are taken as they are, which is said as information: use one system for lengths and forces.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED SOIL
        | SET=ALL
        | STRENGTH=5000.0, 1500.0
        - BEARING=6000.0, 0.25
        + BEARING=6.0, 0.25

    Finds: 9:10
    """
    extension = scene.extensions.get(_KEYWORD)
    if extension is None:
        return
    for index, parameter, path, value in _fields(extension):
        low, high = _USUAL.get(parameter.name, (-np.inf, np.inf))
        if not low <= value <= high and not parameter.invalid(np.array([value]))[0]:
            usual = f"{_NAMES[parameter.name]} is {low:g} to {high:g} in published soils"
            message = f"{value:g}: {usual}; correct it if it is a slip"
            yield Problem(EXT012, message, where=extension.places[index].inside(*path))
    if scene.units == "user":
        message = "the deck has user units: strength, weight and diameter must be in one system"
        for where in extension.places[:1]:
            yield Problem(EXT012, message, None, Severity.INFO, where.inside("strength"))
