"""The penetrations at which two decks are compared."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mudline.contact.input import ContactInput
from mudline.curves import ForceCurve
from mudline.scene.numbering import Floats

_FRACTIONS = (0.25, 0.5, 0.75)
_PLAIN = np.array([-1.0, -1e-9, 0.0, 5e-324, 1e-9, 1e-3, 0.1, 1.0, 37.5, 1e6])


def depths_of(inputs: Sequence[ContactInput]) -> Floats:
    """Depths (steps, elements) for inputs with the same elements, in their unit of length.

    For an element with a curve: every point of its curves and the floats beside it, three places within each segment,
    and places far beyond both ends; for every element the seabed itself, just above and below it, and some depths.
    """
    curves: dict[tuple[int, ...], Floats] = {}
    columns: list[Floats] = []
    of_element = np.column_stack([given.curve_index for given in inputs]).tolist()
    for diameter, indices in zip(inputs[0].diameter.tolist(), map(tuple, of_element), strict=True):
        if indices not in curves:
            found = [ratios_of(given.curves[index]) for given, index in zip(inputs, indices, strict=True) if index >= 0]
            curves[indices] = np.unique(np.concatenate(found)) if found else np.zeros(0)
        columns.append(np.concatenate([_PLAIN, curves[indices] * diameter]))
    steps = max((len(column) for column in columns), default=0)
    return np.column_stack(
        [np.pad(column, (0, steps - len(column)), mode="edge") for column in columns] or [_PLAIN[:0]]
    )


def ratios_of(curve: ForceCurve) -> Floats:
    """Ratios at, beside and between the points of a curve, and beyond its ends."""
    points = curve.ratios
    widths = np.diff(points)
    inside = [points[:-1] + fraction * widths for fraction in _FRACTIONS]
    width = float(points[-1] - points[0])
    beyond = np.array([points[0] - width, points[0] - 10.0 * width, points[-1] + width, points[-1] + 10.0 * width])
    beside = [np.nextafter(points, -np.inf), points, np.nextafter(points, np.inf)]
    found: Floats = np.concatenate([*beside, *inside, beyond])
    kept: Floats = found[np.isfinite(found)]
    return kept
