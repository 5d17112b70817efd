"""Shape of the suction over the uplift: rise, plateau, release."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray


def trapezoid(share: FloatArray, first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the mobilised part of the largest suction, 0 to 1, and its slope, at `share` = x / Delta_B of the uplift.

    It rises from 0 at 0 to 1 at `first`, stays 1 up to `second` and falls to 0 at 1. At its corners the slope is that
    of the plateau, or 0 at the ends.
    """
    with np.errstate(all="ignore"):
        rise, fall = share / first, (1.0 - share) / (1.0 - second)
        part = np.clip(np.minimum(rise, fall), 0.0, 1.0)
        rises, falls = (share > 0.0) & (share < first), (share > second) & (share < 1.0)
        return part, rises / first - falls / (1.0 - second)
