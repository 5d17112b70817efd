"""SUCTION= of `*SEABED PROPERTIES`: a spring against uplift, up to some height above the bed, without a history."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray


def suction_spring(uplift: FloatArray, stiffness: FloatArray, extent: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the force -k x per unit length for 0 < x <= extent, 0 elsewhere, and d force / d x.

    `uplift` x (..., m) is the height above the bed, `stiffness` k (m,) force per unit length and length of uplift.
    """
    with np.errstate(all="ignore"):
        held = (uplift > 0.0) & (uplift <= extent)
        return np.where(held, 0.0 - stiffness * uplift, 0.0), np.where(held, 0.0 - stiffness, 0.0)
