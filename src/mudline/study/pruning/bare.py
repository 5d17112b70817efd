"""What nobody who wants the same results can do without, in plain numpy: a line of code for each."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput


def bare_evaluation(inputs: ContactInput, points: FloatArray) -> tuple[NDArray[np.float64 | np.bool_], ...]:
    """Depth, ratio, contact, force, slope, stiffness, and reactions, of a chain of elements on one curve, flat seabed.

    All elements are taken to touch the seabed; nothing is checked, no history, no other law or seabed.
    """
    gap = points[:, 0] + 0.0
    depth = -0.5 * (gap[:-1] + gap[1:])
    ratio = depth / inputs.diameter
    contact = depth > 0.0
    force, slope = inputs.curves[0].evaluate(ratio)
    stiffness = slope / inputs.diameter
    share = 0.5 * inputs.length * force
    normal_force = np.zeros(len(points))
    normal_force[:-1] += share
    normal_force[1:] += share
    reaction = np.zeros(points.shape)
    reaction[:, 0] = normal_force
    return gap, depth, ratio, contact, force, slope, stiffness, normal_force, reaction
