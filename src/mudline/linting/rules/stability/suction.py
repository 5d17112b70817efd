"""Suction that lets go."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.contact.laws.suction import SuctionLaw
from mudline.contact.stiffest import release_stiffness
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.assignments import suction_law
from mudline.scene.numbering import Floats

STB001 = Code("STB001", "suction-snap", Severity.INFO)

_SMALLEST_PART, _LARGEST_PART = 0.01, 0.99


@rule(STB001)
def suction_snap(context: LintContext) -> Iterator[Problem]:
    """Suction falls while the pipe goes on rising: the seabed lets go of it.

    From the second corner of the trapezoid to breakout, the suction falls with slope F_max / ((1 - xc2) Delta_B). This
    is a negative stiffness. A static or quasi-static solution is unique only where the stiffness of the pipe itself,
    per unit length, is greater; elsewhere the pipe snaps off the bed, and the solver with it. The number is that of the
    velocity of REGULARISATION=, and of the element that needs most. Know it, give smaller steps to the lift-off, or
    take a linear SUCTION=.

    Example:
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
        -*SEABED SUCTION
        - SET=ALL
        - COHESION=5000.0
        + SUCTION=15000.0, 0.05

    Finds: 18:2
    """
    scene = context.scene
    extension = scene.extensions.get("SEABED SUCTION")
    if extension is None:
        return
    for index, where in enumerate(extension.places):
        elements = np.flatnonzero(extension.of_element == index)
        needed = _release(suction_law(scene, extension, elements))
        known = np.flatnonzero(np.isfinite(needed) & (needed > 0.0))
        if known.size:
            worst = int(known[np.argmax(needed[known])])
            message = (
                f"the release of the suction is softening: equilibrium needs a structural stiffness per unit length "
                f"above F_max / ((1 - xc2) Delta_B) = {needed[worst]:.6g} at the velocity of REGULARISATION= "
                f"(element {scene.element_ids[elements[worst]]})"
            )
            yield Problem(STB001, message, where=where)


def _release(law: SuctionLaw) -> Floats:
    """|slope| of the release branch, per unit length, of some elements; NaN where it is not known."""
    with np.errstate(all="ignore"):
        usable = (law.second_corner >= _SMALLEST_PART) & (law.second_corner <= _LARGEST_PART)
        return np.where(usable & (law.regularisation > 0.0), release_stiffness(law, law.regularisation), np.nan)
