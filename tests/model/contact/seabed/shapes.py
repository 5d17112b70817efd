"""Places on shapes, for the tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed
from mudline.model.contact.seabed.profile import ProfileSeabed
from mudline.model.contact.seabed.scattered import ScatteredSeabed

PROFILE_Y = (-60.0, -35.0, -20.0, 5.0, 12.0, 40.0, 70.0)
PROFILE_X = (2.0, 1.0, -3.0, -4.0, 0.5, 2.0, -1.0)
_RANDOM = np.random.default_rng(7)
CLOUD = np.vstack(
    [
        [[0.0, -50.0, -50.0], [1.0, 50.0, -50.0], [2.0, -50.0, 50.0], [-1.0, 50.0, 50.0]],
        _RANDOM.uniform((-3.0, -49.0, -49.0), (3.0, 49.0, 49.0), (30, 3)),
    ]
)
SEABEDS: tuple[Seabed, ...] = (
    FlatSeabed(),
    SlopingSeabed(-12.0, 77.0),
    SlopingSeabed(89.9, 200.0),
    PlanesSeabed(
        [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0]], [5.0, -20.0], [30.0, 120.0], [[-40, 40, -40, 40], [-20, 90, -9, 9]]
    ),
    PlanesSeabed([[1.0, 2.0, 3.0]], [30.0], [45.0]),
    ProfileSeabed(PROFILE_Y, PROFILE_X, "LINEAR", 20.0),
    ProfileSeabed(PROFILE_Y, PROFILE_X, "CUBIC SPLINE", 20.0),
    ProfileSeabed(PROFILE_Y, PROFILE_X, "CUBIC BESSEL", 20.0),
    ScatteredSeabed(CLOUD),
    ScatteredSeabed(CLOUD, "CUBIC"),
)


def located(seabed: Seabed, points: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return gaps and normals of points."""
    places = np.asarray(points, np.float64)
    gap, normal = np.full(places.shape[:-1], 99.0), np.full(places.shape, 99.0)
    seabed.locate(places, gap, normal)
    return gap, normal


def level(seabed: Seabed, y: ArrayLike, z: ArrayLike = 0.0) -> FloatArray:
    """Return elevations at places."""
    return seabed.elevation(*np.broadcast_arrays(np.asarray(y, np.float64), np.asarray(z, np.float64)))


def cloud(count: int = 2000, reach: float = 80.0) -> FloatArray:
    """Return points around the shapes above."""
    return np.random.default_rng(3).uniform(-reach, reach, (count, 3))
