"""`*SEABED UNLOADING`: the stiffness of elements on reversal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.inputs import LawKind
from mudline.scene.contact_parts.picking import picked, refuse, refuse_entry
from mudline.scene.given import number
from mudline.scene.numbering import Floats, Mask

if TYPE_CHECKING:
    from mudline.scene.extensions import Extension
    from mudline.scene.model import Scene

KEYWORD = "SEABED UNLOADING"


def unloading_stiffness(scene: Scene, smooth: Mask) -> Floats | None:
    """Stiffness ku of the elements (m,) on a curve or a linear law, NaN for the others; None where no element has it.

    Raises RefusedError: a stiffness that is not above 0, or an element whose law is smoothed (`smooth`, (m,)).
    """
    extension = scene.extensions[KEYWORD]
    for entry, where in zip(extension.entries, extension.places, strict=True):
        if not number(entry, "stiffness") > 0.0:
            refuse_entry(where, "stiffness", "the unloading stiffness is not above 0")
    held = (extension.of_element >= 0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR))
    refuse(extension, held & smooth, scene.element_ids, "there is smoothing too where the reaction unloads")
    return np.where(held, given_stiffness(extension), np.nan) if held.any() else None


def given_stiffness(extension: Extension) -> Floats:
    """The stiffness of the block that each element (m,) follows, NaN without one."""
    return picked((number(entry, "stiffness") for entry in extension.entries), extension.of_element)
