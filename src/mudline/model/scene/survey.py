"""Where the surveyed seabed of a deck ends: the ends of a profile, the hull of a surface, the bounds of planes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from importlib.util import find_spec

import numpy as np

from mudline.model.contact.seabed import heading
from mudline.model.scene.numbering import Floats, Mask
from mudline.model.scene.seabed import SeabedKind, SeabedShape, made_seabed

REACH = 100.0
"""Diameters above the level of the seabed beyond its end: a part of the line that hangs higher touches no seabed."""


class Survey(ABC):
    """The part of the seabed that is known.

    Attributes:
        end: what lies beyond it, as the words behind "node 3 lies".
        consequence: what the evaluator takes there.
    """

    end: str
    consequence = "no seabed holds the line there; give it as far as the line goes, or correct the coordinates"

    @abstractmethod
    def heights(self, places: Floats) -> Floats:
        """Heights (n,) of `places` (n, 3) beyond the end above the level there, -inf at least; NaN within it."""

    def left(self, places: Floats, diameter: float) -> Mask:
        """Which of `places` (n, 3) lie beyond the end, and so low that the seabed matters there."""
        with np.errstate(over="ignore", invalid="ignore"):
            return np.asarray(self.heights(places) <= REACH * diameter)


class _Profile(Survey):
    def __init__(self, seabed: SeabedShape) -> None:
        points = seabed.points[np.argsort(seabed.points[:, 0], kind="stable")]
        (self._first, self._start), (self._last, self._stop) = points[0].tolist(), points[-1].tolist()
        self._heading = heading(seabed.direction)
        axis = "Y" if seabed.direction == 0.0 else "along it"
        self.end = f"beyond the ends of the seabed profile ({axis} = {self._first:.6g} to {self._last:.6g})"
        self.consequence = (
            "it is taken as level there; give the profile as far as the line goes, or correct the coordinates"
        )

    def heights(self, places: Floats) -> Floats:
        x, y, z = places.T
        along = y * self._heading[0] + z * self._heading[1]
        levels = np.where(along < self._first, self._start, np.where(along > self._last, self._stop, np.nan))
        return np.asarray(x - levels)


class _Surface(Survey):
    def __init__(self, seabed: SeabedShape) -> None:
        from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - only now is it needed

        from mudline.model.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only now is it needed

        try:
            corners = ConvexHull(seabed.points[:, 1:]).vertices
        except QhullError as error:
            raise ValueError("the points lie on a line") from error
        self._hull, self._top = ScatteredSeabed(seabed.points[corners]), float(seabed.points[:, 0].max())
        self.end = f"outside of the hull of the seabed's {len(seabed.points)} points"

    def heights(self, places: Floats) -> Floats:
        x, y, z = places.T.copy()
        return np.where(np.isnan(self._hull.elevation(y, z)), x - self._top, np.nan)


class _Planes(Survey):
    def __init__(self, seabed: SeabedShape) -> None:
        self._seabed, self._shape = made_seabed(seabed), seabed
        self.end = "outside of the bounds of all planes of the seabed"

    def heights(self, places: Floats) -> Floats:
        x, y, z = places.T.copy()
        level = np.full(len(x), -np.inf)
        for plane in self._shape.planes:  # at its place nearest to each node
            y_min, y_max, z_min, z_max = plane.bounds
            level = np.fmax(level, self._seabed.elevation(np.clip(y, y_min, y_max), np.clip(z, z_min, z_max)))
        return np.where(np.isnan(self._seabed.elevation(y, z)), x - level, np.nan)


def survey_of(seabed: SeabedShape) -> Survey | None:
    """Return where a seabed ends; None for one without an end, or whose points are not known or make no seabed."""
    surveys: dict[SeabedKind, type[_Profile | _Surface | _Planes]] = {
        SeabedKind.PROFILE: _Profile,
        SeabedKind.SURFACE: _Surface,
        SeabedKind.PLANES: _Planes,
    }
    kind = surveys.get(seabed.kind)
    if kind is None or seabed.missing or (kind is not _Planes and len(seabed.points) < 2):
        return None
    if kind is _Surface and find_spec("scipy") is None:
        return None
    try:
        return kind(seabed)
    except ValueError:  # other findings say what is wrong with it
        return None
