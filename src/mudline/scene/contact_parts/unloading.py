"""`*SEABED UNLOADING`: the stiffness of elements on reversal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.input import LawAssignment, LawKind
from mudline.scene.contact_parts.picking import picked
from mudline.scene.given import number
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED UNLOADING"


def unloading_lines(scene: Scene) -> LawAssignment:
    """The elements on a curve or a linear law that unload on a line of their own."""
    extension = scene.extensions[KEYWORD]
    rows = np.flatnonzero((extension.of_element >= 0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    return LawAssignment("unloading", rows, {"stiffness": given_stiffness(extension)[rows]})


def given_stiffness(extension: Extension) -> Floats:
    """The stiffness of the block that each element (m,) follows, NaN without one."""
    return picked((number(entry, "stiffness") for entry in extension.entries), extension.of_element)
