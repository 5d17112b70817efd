"""`*RIGID SURFACE`: rigid seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from mudline.keywords.common import CHARACTERISTIC_LENGTH, CONSTANT_FRICTION, Surface
from mudline.keywords.model import Row, about
from mudline.keywords.values import Real


class RigidProperties(Row):
    """The first line."""

    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0)
    ] = None
    transverse: Annotated[Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0)] = (
        None
    )
    longitudinal_length: Annotated[
        Real | None,
        about("largest longitudinal characteristic length", unit="L", default=CHARACTERISTIC_LENGTH, above=0),
    ] = None
    transverse_length: Annotated[
        Real | None, about("largest transverse characteristic length", unit="L", default=CHARACTERISTIC_LENGTH, above=0)
    ] = None
    constant: Annotated[Real | None, about("constant friction force coefficient", inferred=CONSTANT_FRICTION)] = None
    longitudinal_mobilisation: Annotated[Real | None, about("longitudinal mobilisation length", unit="L", above=0)] = (
        None
    )
    transverse_mobilisation: Annotated[Real | None, about("transverse mobilisation length", unit="L", above=0)] = None


class RigidSurface(Surface):
    """Rigid seabed."""

    rule: ClassVar[str] = "rigid_surface"
    names: ClassVar[tuple[str, ...]] = ("RIGID SURFACE",)
    summary: ClassVar[str] = "Rigid seabed: friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example: ClassVar[str] = "*RIGID SURFACE\n 0.3, 0.5\n"

    keyword: Literal["RIGID SURFACE"] = "RIGID SURFACE"
    properties: Annotated[RigidProperties, about("friction")]


BLOCK = RigidSurface
