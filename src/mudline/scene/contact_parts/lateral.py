"""`LATERAL=` of `*SEABED PROPERTIES` and of the legacy surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mudline.contact.inputs import LawKind
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.scene.model import Scene


def lateral_stiffness(scene: Scene) -> Floats:
    """Lateral springs of the elements (m,) on an elastic bed, per unit length; NaN for those without."""
    stiffness = scene.bed.column("lateral")
    return np.where((stiffness > 0.0) & (scene.law != LawKind.RIGID), stiffness, np.nan)
