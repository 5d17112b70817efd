"""`*ELASTIC SURFACE`: linear elastic seabed (superseded, still legal)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from mudline.keywords.common import CHARACTERISTIC_LENGTH, CONSTANT_FRICTION, SUCTION_STIFFNESS, Surface
from mudline.keywords.model import Row, about
from mudline.keywords.values import Real


class ElasticProperties(Row):
    """The first line."""

    stiffness: Annotated[
        Real | None, about("stiffness per unit length; without it *EMBEDMENT is required", unit="F/L2", at_least=0)
    ] = None
    longitudinal: Annotated[
        Real | None, about("longitudinal friction coefficient", unit="-", default="0", at_least=0)
    ] = None
    transverse: Annotated[Real | None, about("transverse friction coefficient", unit="-", default="0", at_least=0)] = (
        None
    )
    lateral: Annotated[Real | None, about("lateral stiffness", unit="F/L2", at_least=0)] = None
    suction_stiffness: Annotated[
        Real | None, about("suction stiffness", unit="F/L2", at_least=0, inferred=SUCTION_STIFFNESS)
    ] = None
    suction_extent: Annotated[Real | None, about("height of the suction zone above the bed", unit="L", at_least=0)] = (
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


class ElasticSurface(Surface):
    """Elastic seabed."""

    rule: ClassVar[str] = "elastic_surface"
    names: ClassVar[tuple[str, ...]] = ("ELASTIC SURFACE",)
    summary: ClassVar[str] = "Elastic seabed: stiffness, friction, slope or profile (superseded by *SEABED PROPERTIES)."
    example: ClassVar[str] = "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n"

    keyword: Literal["ELASTIC SURFACE"] = "ELASTIC SURFACE"
    properties: Annotated[ElasticProperties, about("stiffness, friction, lateral resistance, suction")]


BLOCK = ElasticSurface
