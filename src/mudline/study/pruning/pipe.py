"""The pipe that laws are forced on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput
from mudline.curves import ForceCurve


class Pipe(NamedTuple):
    """What the forced laws are made for: a curve, its steepest slope as stiffness, a diameter, an element length."""

    curve: ForceCurve
    stiffness: float
    diameter: float
    length: float


def pipe_of(inputs: ContactInput, usual: ForceCurve) -> Pipe:
    """The curve that most elements have (`usual` if none has any), the middle diameter and length of the elements."""
    given = inputs.assigned.get("curve")
    curve = usual if given is None else inputs.curves[int(np.bincount(given["curve"].astype(np.intp)).argmax())]
    diameter = _middle(inputs.diameter, 0.3)
    return Pipe(curve, float(np.abs(curve.slopes).max()) / diameter or 1.0, diameter, _middle(inputs.length, 1.0))


def _middle(values: FloatArray, default: float) -> float:
    usable = values[np.isfinite(values) & (values > 0.0)]
    return float(np.median(usable)) if usable.size else default
