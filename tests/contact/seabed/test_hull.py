"""The edge of a seabed of scattered points belongs to it, however it is turned."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest

from mudline.contact.arrays import FloatArray
from mudline.contact.seabed.scattered import ScatteredSeabed

CORNERS = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


def turned(places: FloatArray, degrees: float) -> FloatArray:
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    found: FloatArray = places @ np.array([[cosine, sine], [-sine, cosine]])
    return found


@pytest.mark.parametrize("degrees", [0.0, 17.0, 31.0, 45.0, 88.0])
@pytest.mark.parametrize("interpolation", ["LINEAR", "CUBIC"])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
def test_places_on_the_edge(degrees: float, interpolation: Literal["LINEAR", "CUBIC"], size: float) -> None:
    inside = np.random.default_rng(7).uniform(0.0, 10.0, (30, 2))
    places = size * turned(np.vstack([CORNERS, inside]), degrees)
    slope = np.array([0.02, -0.03])
    seabed = ScatteredSeabed(np.column_stack([size + places @ slope, places]), interpolation)
    shares = np.linspace(0.0, 1.0, 50)[:, None]
    on_edge = np.vstack(
        [one + (other - one) * shares for one, other in zip(places[:4], places[[1, 2, 3, 0]], strict=True)]
    )
    gaps, normals = np.empty(len(on_edge)), np.empty((len(on_edge), 3))
    seabed.locate(np.column_stack([np.zeros(len(on_edge)), on_edge]), gaps, normals)
    upward = 1.0 / np.sqrt(1.0 + slope @ slope)
    assert gaps == pytest.approx(-upward * (size + on_edge @ slope), rel=0.0, abs=1e-8 * size)
    assert normals == pytest.approx(np.tile(upward * np.array([1.0, -0.02, 0.03]), (len(on_edge), 1)), abs=1e-7)
    middle = places[:4].mean(axis=0)
    outside = middle + (on_edge - middle) * (1.0 + 1e-6)
    assert np.isnan(seabed.elevation(*outside.T)).all()
