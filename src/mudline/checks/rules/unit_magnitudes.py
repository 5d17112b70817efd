"""Gravity, forces and friction of another system of units or of another field."""

from __future__ import annotations

from collections.abc import Iterator
from math import isnan
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.checks.context import LintContext, entries_of_sets
from mudline.checks.rules.curve_shape import swapped
from mudline.checks.rules.seabed_friction import given
from mudline.language.deck.reading import GRAVITIES
from mudline.language.diagnostics import Code, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.model import Scene

if TYPE_CHECKING:
    from mudline.language.keywords.library.ocean import Ocean

UNT001 = Code("UNT001", "gravity-mismatch", Severity.WARNING)
UNT002 = Code("UNT002", "suspicious-magnitude", Severity.WARNING)
UNT003 = Code("UNT003", "large-friction", Severity.WARNING)

_NEAR = 0.02
_LENGTHS = {"metric": "m/s2", "imperial": "ft/s2"}


class _Least(NamedTuple):
    """The least that supports a pipe, in a system of units: less is a value in `thousands`."""

    stiffness: float
    side: float
    force: float
    cohesion: float
    force_unit: str
    length_unit: str
    pressure_unit: str
    thousands: str
    pressure_thousands: str


LEAST = {
    "metric": _Least(500.0, 100.0, 10.0, 100.0, "N/m", "metre", "Pa", "kN", "kPa"),
    "imperial": _Least(10.0, 2.0, 0.7, 2.0, "lbf/ft", "foot", "lbf/ft2", "kip", "kip/ft2"),
}
"""Nothing is known of user units."""
NARROWEST = {"metric": 0.1, "imperial": 0.328}
"""Diameter of a pipe below which the least force falls with the diameter."""
ROUGHEST = 2.0


@rule(UNT001)
def gravity_mismatch(context: LintContext) -> Iterator[Problem]:
    """The gravity of *OCEAN does not fit the unit system of the file.

    The suffix says in which units a deck is: .keyxm in metres and newtons, gravity 9.81; .keyxi in feet and pounds,
    gravity 32.2. A deck with the gravity of the other system was saved under the wrong suffix, or only half of it was
    converted. Correct the gravity, or give the file its suffix. A difference above 2 % is reported.

    Example on ocean:
        - 500.0, 1025.0, 32.2
        + 500.0, 1025.0, 9.81

    Finds: 3:17
    """
    scene = context.scene
    expected = GRAVITIES.get(scene.units)
    for where, block in context.blocks("OCEAN") if expected else ():
        gravity = cast("Ocean", block).gravity
        if not isinstance(gravity, int | float) or isnan(gravity) or expected is None or _near(gravity, expected):
            continue
        other = next((f", as of {name} units" for name, g in GRAVITIES.items() if _near(gravity, g)), "")
        message = (
            f"gravity {gravity!r}{other}, in a deck in {scene.units} units, expected about {expected} "
            f"{_LENGTHS[scene.units]}: correct it, or the suffix of the file"
        )
        yield Problem(UNT001, message, where=where.inside("gravity"))


def _near(gravity: float, expected: float) -> bool:
    return abs(gravity - expected) <= _NEAR * expected


@rule(UNT002)
def suspicious_magnitude(context: LintContext) -> Iterator[Problem]:
    """A force or stiffness of the seabed looks as if it were in kilonewtons or kips.

    Metric decks are in metres and newtons, imperial ones in feet and pounds (lbf). A seabed of less than 500 N/m for
    each metre (10 lbf/ft for each foot), or a curve that nowhere reaches 10 N/m (0.7 lbf/ft), supports no pipe, lateral
    springs and suction of less than 100 N/m for each metre (2 lbf/ft for each foot) hold none, and a cohesion of less
    than 100 Pa (2 lbf/ft2) is that of a fluid. The least stiffness of a seabed is that of its unloading, too. Such a
    value is usually written in other units. Write it in newtons or pounds. For cables thinner than 0.1 m the least
    force of a curve falls with their diameter. A stiffness or a cohesion of 0 is accepted.

    Example on seabed:
        - STIFFNESS=50.0
        + STIFFNESS=50000.0

    Finds: 5:12
    """
    if least := LEAST.get(context.scene.units):
        for kind in (_soft, _weak, _fluid, _unloaded):
            yield from kind(context.scene, least)
        yield from _slight(context, least)


def _soft(scene: Scene, least: _Least) -> Iterator[Problem]:
    for grant in scene.laws.set_laws:
        if grant.kind is LawKind.LINEAR and not grant.unknown and 0.0 < grant.stiffness < least.stiffness:
            message = _stiffness_message("a seabed", grant.stiffness, least.stiffness, least)
            yield Problem(UNT002, message, where=grant.where)


def _slight(context: LintContext, least: _Least) -> Iterator[Problem]:
    """Lateral springs and suction."""
    for entry in given(context):
        for name, what in (("lateral", "lateral"), ("suction_stiffness", "suction")):
            stiffness = entry.value(name)
            if stiffness is not None and 0.0 < stiffness < least.side:
                message = _stiffness_message(f"a {what}", stiffness, least.side, least)
                yield Problem(UNT002, message, where=entry.place(name))


def _weak(scene: Scene, least: _Least) -> Iterator[Problem]:
    for index, curve in enumerate(scene.laws.curves):
        if curve.points.size and abs(curve.points[-1, 1]) >= least.force:
            continue
        largest = float(np.abs(curve.points[:, 1]).max(initial=0.0))
        if not curve.whole or not 0.0 < largest < least.force or swapped(curve):
            continue
        widest = float(np.fmax.reduce(scene.diameter[scene.laws.followers(index)], initial=0.0))
        if widest == 0.0 or largest < least.force * widest / NARROWEST[scene.units]:
            message = (
                f"no force of curve {shown(curve.name)} is above {largest!r} {least.force_unit}, expected at least "
                f"{least.force:g} for a pipe: write them in {least.force_unit} ({least.thousands}?)"
            )
            yield Problem(UNT002, message, where=curve.where)


def _fluid(scene: Scene, least: _Least) -> Iterator[Problem]:
    suction = scene.extensions.get("SEABED SUCTION")
    for entry, where in zip(suction.entries, suction.places, strict=True) if suction else ():
        cohesion = getattr(entry, "cohesion", None)
        if isinstance(cohesion, float) and 0.0 < cohesion < least.cohesion:
            message = (
                f"a cohesion of {cohesion!r} {least.pressure_unit}, expected at least {least.cohesion:g}: write it in "
                f"{least.pressure_unit} ({least.pressure_thousands}?)"
            )
            yield Problem(UNT002, message, where=where.inside("cohesion"))


def _unloaded(scene: Scene, least: _Least) -> Iterator[Problem]:
    unloading = scene.extensions.get("SEABED UNLOADING")
    for entry, where in zip(unloading.entries, unloading.places, strict=True) if unloading else ():
        stiffness = getattr(entry, "stiffness", None)
        if isinstance(stiffness, float) and 0.0 < stiffness < least.stiffness:
            message = _stiffness_message("an unloading", stiffness, least.stiffness, least)
            yield Problem(UNT002, message, where=where.inside("stiffness"))


def _stiffness_message(what: str, stiffness: float, expected: float, least: _Least) -> str:
    return (
        f"{what} stiffness of {stiffness!r} {least.force_unit} per {least.length_unit}, expected at least "
        f"{expected:g}: write it in {least.force_unit} ({least.thousands}?)"
    )


@rule(UNT003)
def large_friction(context: LintContext) -> Iterator[Problem]:
    """A friction coefficient is above 2.

    Pipes on soil have coefficients of 0.2 to 1, seldom a little more. Above 2 the field usually holds a stiffness or a
    mobilisation length: the fields of FRICTION= have another order than those of *ELASTIC SURFACE, which begin with the
    stiffness. Correct the field.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=50000.0, 0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    for where, values, names in _coefficients(context):
        for name in names:
            value = getattr(values, name, None)
            if isinstance(value, int | float) and value > ROUGHEST:
                message = f"a friction coefficient of {value!r} ({name}): correct it, coefficients are seldom above 1"
                yield Problem(UNT003, message, where=where.inside(name))


def _coefficients(context: LintContext) -> Iterator[tuple[Where, object, tuple[str, str]]]:
    """What holds friction coefficients, and the names of the two."""
    both = ("longitudinal", "transverse")
    for where, surface in context.scene.context.surfaces:
        yield where.inside("properties"), surface.properties, both
    for where, entry in entries_of_sets(context.blocks("SEABED PROPERTIES")):
        if entry.friction is not None:
            yield where.inside("friction"), entry.friction, both
    for where, entry in entries_of_sets(context.blocks("SEABED FRICTION")):
        yield where.inside("coefficients"), getattr(entry, "coefficients", None), ("first", "second")
