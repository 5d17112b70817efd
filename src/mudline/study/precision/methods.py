"""Ways to evaluate a curve: mudline's own, and those that people use instead."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator, PPoly

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve

Evaluation = Callable[[FloatArray], NDArray[np.floating]]
TABLES = tuple(4**power for power in range(2, 9))
"""Entries of the uniform tables: 16 to 65536."""


class Method(NamedTuple):
    """A way to evaluate a curve.

    family: methods of one family are one line of a picture.
    prepare: takes the curve and returns what evaluates it.
    """

    name: str
    family: str
    prepare: Callable[[ForceCurve], Evaluation]


def methods(tables: tuple[int, ...] = TABLES) -> Iterator[Method]:
    """All of them; "fast" needs its extra when it is prepared."""
    yield Method("mudline, numpy", "mudline, numpy", _numpy)
    yield Method("mudline, fast", "mudline, fast", _fast)
    yield Method("np.interp", "np.interp", _interp)
    yield Method("scipy PPoly", "scipy PPoly", _ppoly)
    yield Method("scipy PCHIP", "scipy PCHIP", _pchip)
    yield Method("float32", "float32", _float32)
    for entries in tables:
        yield Method(f"table of {entries}", "uniform tables, 16 to 65536", partial(_table, entries=entries))


def _numpy(curve: ForceCurve) -> Evaluation:
    return lambda ratios: curve.evaluate(ratios, backend="numpy")[0]


def _fast(curve: ForceCurve) -> Evaluation:
    curve.evaluate(curve.ratios, backend="fast")
    return lambda ratios: curve.evaluate(ratios, backend="fast")[0]


def _interp(curve: ForceCurve) -> Evaluation:
    return lambda ratios: np.interp(ratios, curve.ratios, curve.forces)


def _ppoly(curve: ForceCurve) -> Evaluation:
    return PPoly(np.array([curve.slopes, curve.forces[:-1]]), curve.ratios)


def _pchip(curve: ForceCurve) -> Evaluation:
    return PchipInterpolator(curve.ratios, curve.forces)


def _float32(curve: ForceCurve) -> Evaluation:
    ratios, forces, slopes = (array.astype(np.float32) for array in (curve.ratios, curve.forces, curve.slopes))

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        single = query.astype(np.float32)
        left = np.searchsorted(ratios[1:-1], single, side="right")
        return forces[left] + slopes[left] * (single - ratios[left])

    return evaluate


def _table(curve: ForceCurve, entries: int) -> Evaluation:
    """The curve resampled at even distances, and straight lines between: what a lookup table does."""
    first, last = float(curve.ratios[0]), float(curve.ratios[-1])
    forces = curve.evaluate(np.linspace(first, last, entries), backend="numpy")[0]
    slopes = np.diff(forces)
    scale = (entries - 1) / (last - first)

    def evaluate(query: FloatArray) -> NDArray[np.floating]:
        place = (query - first) * scale
        left = np.clip(place, 0, entries - 2).astype(np.intp)
        return forces[left] + slopes[left] * (place - left)

    return evaluate
