"""`SUCTION=` of `*SEABED PROPERTIES` and of the legacy surface: springs against uplift."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.extras import SuctionSprings
from mudline.contact.inputs import LawKind

if TYPE_CHECKING:
    from mudline.scene.model import Scene


def suction_springs(scene: Scene) -> SuctionSprings:
    """Stiffness and extent of the elements (m,), 0 for those that have none; a rigid bed has none.

    A spring without an extent of its zone holds nothing.
    """
    stiffness, extent = scene.bed.column("suction"), scene.bed.column("extent")
    held = (stiffness > 0.0) & (extent > 0.0) & (scene.law != LawKind.RIGID)
    return SuctionSprings(np.where(held, stiffness, 0.0), np.where(held, extent, 0.0))
