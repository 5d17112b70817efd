"""The evaluator's shape of a seabed, and how much of each element lies where that rises above the water."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, Literal, cast

import numpy as np

from mudline.model.contact.seabed import PlanesSeabed, SlopingSeabed
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.seabed import SeabedKind, SeabedShape

if TYPE_CHECKING:
    from mudline.model.contact.seabed import Seabed
    from mudline.model.contact.seabed.profile import Interpolation


def made_seabed(seabed: SeabedShape) -> Seabed:
    """The evaluator's shape of a seabed that is not flat; raises ValueError for numbers that make none."""
    if seabed.kind is SeabedKind.SLOPING:
        return SlopingSeabed(seabed.slope, seabed.direction)
    if seabed.kind is SeabedKind.PROFILE:
        from mudline.model.contact.seabed.profile import ProfileSeabed  # noqa: PLC0415 - only now is it needed

        how = cast("Interpolation", seabed.interpolation)
        return ProfileSeabed(seabed.points[:, 0], seabed.points[:, 1], how, seabed.direction)
    if seabed.kind is SeabedKind.PLANES:
        columns = (
            [getattr(plane, name) for plane in seabed.planes] for name in ("point", "slope", "direction", "bounds")
        )
        return PlanesSeabed(*map(np.array, columns))
    from mudline.model.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only now is it needed

    return ScatteredSeabed(seabed.points, cast("Literal['LINEAR', 'CUBIC']", seabed.interpolation))


def on_land(seabed: SeabedShape, level: float, places: Floats, ends: Indices) -> Floats | None:
    """Share (m,) of each element that lies where the seabed is above the `level` of the water; None where it never is.

    Between the nodes of an element, `ends` (m, 2) of `places` (n, 3), the seabed is taken as straight.
    """
    if not _may_rise_above(seabed, level):
        return None
    try:
        heights = made_seabed(seabed).elevation(places[:, 1], places[:, 2]) - level
    except ValueError:  # numbers that make no seabed are refused where it is evaluated
        return None
    at_ends = np.append(heights, np.nan)[ends]
    low, high = at_ends.min(axis=1), at_ends.max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        share: Floats = np.nan_to_num(np.clip(high / (high - low), 0.0, 1.0))
    return share


def _may_rise_above(seabed: SeabedShape, level: float) -> bool:
    """Whether some of the seabed may be dry; not where its points are not known."""
    if seabed.missing or not level < np.inf or (seabed.kind is SeabedKind.SURFACE and find_spec("scipy") is None):
        return False
    column = {SeabedKind.PROFILE: 1, SeabedKind.SURFACE: 0}.get(seabed.kind)
    return column is None or bool((seabed.points[:, column] > level).any())
