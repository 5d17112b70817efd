"""`*RIGID SURFACE`: rigid seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from mudline.keywords import common
from mudline.keywords.about import about
from mudline.keywords.common import Surface
from mudline.keywords.model import Row
from mudline.keywords.values import Real


class RigidProperties(Row):
    """The first line."""

    longitudinal: Annotated[Real | None, common.AXIAL_FRICTION] = None
    transverse: Annotated[Real | None, common.LATERAL_FRICTION] = None
    longitudinal_length: Annotated[Real | None, common.AXIAL_LENGTH] = None
    transverse_length: Annotated[Real | None, common.LATERAL_LENGTH] = None
    constant: Annotated[Real | None, common.CONSTANT_FRICTION] = None
    longitudinal_mobilisation: Annotated[Real | None, common.AXIAL_MOBILISATION] = None
    transverse_mobilisation: Annotated[Real | None, common.LATERAL_MOBILISATION] = None


class RigidSurface(Surface):
    """Rigid seabed."""

    rule: ClassVar[str] = "rigid_surface"
    names: ClassVar[tuple[str, ...]] = ("RIGID SURFACE",)
    summary: ClassVar[str] = "Rigid seabed: friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example: ClassVar[str] = "*RIGID SURFACE\n 0.3, 0.5\n"

    keyword: Literal["RIGID SURFACE"] = "RIGID SURFACE"
    properties: Annotated[RigidProperties, about("friction")]


BLOCK = RigidSurface
