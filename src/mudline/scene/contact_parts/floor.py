"""The bed of a scene, for the evaluator."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.seabed.base import SeabedError
from mudline.scene.contact_parts.refused import RefusedError
from mudline.scene.floor import Floor, FloorKind

if TYPE_CHECKING:
    from typing import Literal

    from mudline.contact.seabed.base import Seabed
    from mudline.contact.seabed.profile import Interpolation


def contact_seabed(floor: Floor) -> Seabed | None:
    """The bed; None for a flat one at elevation 0.

    Raises RefusedError for what no check covers: files of a deck that came from no folder, points that only their
    triangulation refuses, and a package that is missing.
    """
    if floor.kind is FloorKind.FLAT:
        return None
    if floor.missing:
        raise RefusedError(f"the seabed is not known: {floor.missing}; this cannot be evaluated", floor.where)
    try:
        return made_seabed(floor)
    except SeabedError as error:
        raise RefusedError(f"{error}; this cannot be evaluated", floor.where) from error


def made_seabed(floor: Floor) -> Seabed:
    """The bed of a floor that is not flat; raises SeabedError for one that is none. Imports the module of its kind."""
    if floor.kind is FloorKind.SLOPING:
        from mudline.contact.seabed.base import SlopingSeabed  # noqa: PLC0415 - only now is it needed

        return SlopingSeabed(floor.slope, floor.direction)
    if floor.kind is FloorKind.PROFILE:
        from mudline.contact.seabed.profile import ProfileSeabed  # noqa: PLC0415 - only now is it needed

        how = cast("Interpolation", floor.interpolation)
        return ProfileSeabed(floor.points[:, 0], floor.points[:, 1], how, floor.direction)
    if floor.kind is FloorKind.PLANES:
        return _planes(floor)
    if find_spec("scipy") is None:
        what = "a 3D surface needs scipy, which is not installed: pip install 'mudline[study]'"
        raise RefusedError(what, floor.where)
    from mudline.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only now is it needed

    return ScatteredSeabed(floor.points, cast("Literal['LINEAR', 'CUBIC']", floor.interpolation))


def _planes(floor: Floor) -> Seabed:
    from mudline.contact.seabed.base import PlanesSeabed  # noqa: PLC0415 - only now is it needed

    return PlanesSeabed(
        np.array([plane.point for plane in floor.planes]),
        np.array([plane.slope for plane in floor.planes]),
        np.array([plane.direction for plane in floor.planes]),
        np.array([plane.bounds for plane in floor.planes]),
    )
