"""Suction that lets go."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.critical_step import release_stiffness
from mudline.contact.suction.law import SuctionLaw, from_cohesion
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_suction import SuctionSet

STB001 = Code("STB001", "suction-snap", Severity.INFO)

_METRES = {"metric": 1.0, "imperial": 0.3048}
"""Length of a unit in metres; laws made from a cohesion hold in SI units only."""
_SLOWEST = 1.0e-3
"""m/s: the velocity below which the force is capped, unless the deck says otherwise."""
_CORNERS = (("first", 0.2), ("second", 0.8))
_SMALLEST_PART, _LARGEST_PART = 0.01, 0.99


@rule(STB001)
def suction_snap(context: LintContext) -> Iterator[Problem]:
    """Suction falls while the pipe goes on rising: the seabed lets go of it.

    From the second corner of the trapezoid to breakout, the suction falls with slope F_max / ((1 - xc2) Delta_B). This
    is a negative stiffness. A static or quasi-static solution is unique only where the stiffness of the pipe itself,
    per unit length, is greater; elsewhere the pipe snaps off the bed, and the solver with it. The number is that of the
    velocity of REGULARISATION=, and of the element that needs most. Know it, give smaller steps to the lift-off, or
    take a linear SUCTION=.

    Bad:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=ALL
         207.0E9, 79.6E9, 0.3, 0.265, 7850.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0

    Good:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=ALL
         207.0E9, 79.6E9, 0.3, 0.265, 7850.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         SUCTION=15000.0, 0.05

    Finds: 18:2
    """
    scene = context.scene
    extension = scene.extensions.get("SEABED SUCTION")
    if extension is None:
        return
    for index, entry in enumerate(extension.entries):
        elements = np.flatnonzero(extension.of_element == index)
        needed = _release(cast("SuctionSet", entry), scene.diameter[elements], scene.units)
        known = np.flatnonzero(np.isfinite(needed) & (needed > 0.0))
        if known.size:
            worst = int(known[np.argmax(needed[known])])
            message = (
                f"the release of the suction is softening: equilibrium needs a structural stiffness per unit length "
                f"above F_max / ((1 - xc2) Delta_B) = {needed[worst]:.6g} at the velocity of REGULARISATION= "
                f"(element {scene.element_ids[elements[worst]]})"
            )
            yield Problem(STB001, message, where=extension.places[index])


def _release(given: SuctionSet, diameter: Floats, units: str) -> Floats:
    """|slope| of the release branch, per unit length, for pipes of some diameters; NaN where it is not known."""
    metre = _METRES.get(units, np.nan)
    slowest = _number(given, "regularisation", _SLOWEST / metre)
    corners = [_number(getattr(given, "cutoff", None), name, corner) for name, corner in _CORNERS]
    if not (_SMALLEST_PART <= corners[1] <= _LARGEST_PART and slowest > 0.0):
        return np.full(len(diameter), np.nan)
    cohesion = _number(given, "cohesion")
    factors = from_cohesion(np.full(len(diameter), cohesion), np.where(np.isnan(cohesion), np.nan, diameter), metre)
    if (own := getattr(given, "force", None)) is not None:
        factors = factors._replace(
            force_factor=_same(own, "factor", diameter), force_exponent=_same(own, "exponent", diameter)
        )
    if (own := getattr(given, "depth", None)) is not None:
        factors = factors._replace(
            depth_factor=_same(own, "factor", diameter), depth_exponent=_same(own, "exponent", diameter)
        )
    rest = (*corners, _number(given, "cyclic", 1.0), slowest)
    law = SuctionLaw(*factors, *(np.full(len(diameter), value) for value in rest))
    return release_stiffness(law, law.regularisation)


def _same(part: object, name: str, diameter: Floats) -> Floats:
    return np.full(len(diameter), _number(part, name))


def _number(part: object, name: str, default: float = np.nan) -> float:
    """A value of a part; `default` where it is left out, NaN where it is no number."""
    value = getattr(part, name, None)
    if value is None:
        return default
    return float(value) if isinstance(value, int | float) else float("nan")
