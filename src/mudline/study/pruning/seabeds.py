"""Seabeds of the scenes that are timed: the place of each on the line is that of a gentle slope."""

from __future__ import annotations

import numpy as np

from mudline.contact.seabed import PlanesSeabed, ProfileSeabed, Seabed, SlopingSeabed

_RISE = 0.001


def planes(number: int, reach: float) -> PlanesSeabed:
    """A valley of this many planes over lengths 0 to `reach`; one more plane is steeper than the one before."""
    places = np.linspace(0.0, reach, number)
    points = np.column_stack([np.zeros(number), places, np.zeros(number)])
    return PlanesSeabed(points, np.linspace(0.0, _RISE, number))


def profile(points: int, reach: float) -> ProfileSeabed:
    """A cubic through waves."""
    places = np.linspace(0.0, reach, points)
    return ProfileSeabed(places, _RISE * np.sin(places / reach * 20.0), "CUBIC BESSEL")


def sloping() -> SlopingSeabed:
    """One slope, turned to the line."""
    return SlopingSeabed(_RISE, 30.0)


def scattered(points: int, reach: float) -> Seabed:
    """A plain strip of triangles about the line; raises ImportError without scipy."""
    from mudline.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only this seabed needs scipy

    rng = np.random.default_rng(1)
    along = np.concatenate([[-reach, -reach, 2.0 * reach, 2.0 * reach], rng.uniform(0.0, reach, points - 4)])
    across = np.concatenate([[-reach, reach, -reach, reach], rng.uniform(-0.1 * reach, 0.1 * reach, points - 4)])
    return ScatteredSeabed(np.column_stack([_RISE * np.sin(along / reach * 20.0), along, across]))
